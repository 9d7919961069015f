// ViewGeometry: where a bearing and range lie on the screen. CSS pixels from the canvas's top left
// corner; bearings true, degrees; ranges in metres from own ship, who need not be in the middle.
export const NAUTICAL_MILE_M = 1852;
const RAD = Math.PI / 180;

export function wrapDeg(deg) {
  return ((deg % 360) + 360) % 360;
}

export class ViewGeometry {
  // side: of the square canvas; margin: left free around the picture for the bearing scale.
  constructor(side, margin, pixelRatio) {
    this.side = side;
    this.pixelRatio = pixelRatio;
    this.radius = Math.max(8, side / 2 - margin);
    this.upDeg = 0;      // true bearing of the screen's top
    this.rangeM = 0;     // along the radius
    this.ownAt = { x: 0, y: 0 };  // own ship from the centre, in parts of the radius; x right, y up
    this.jumps = 0;      // grows when own ship is put elsewhere on the screen; not while she sails over it
  }

  get centre() {
    return this.side / 2;
  }

  // Own ship on the screen.
  get own() {
    return { x: this.centre + this.ownAt.x * this.radius, y: this.centre - this.ownAt.y * this.radius };
  }

  toPixel(bearingDeg, rangeM) {
    const angle = (bearingDeg - this.upDeg) * RAD;
    const r = this.rangeM > 0 ? (rangeM / this.rangeM) * this.radius : 0;
    const own = this.own;
    return { x: own.x + r * Math.sin(angle), y: own.y - r * Math.cos(angle) };
  }

  // inside: of the picture's circle.
  fromPixel(x, y) {
    const own = this.own;
    const dx = x - own.x, dy = own.y - y;
    return {
      bearingDeg: wrapDeg(Math.atan2(dx, dy) / RAD + this.upDeg),
      rangeM: (Math.hypot(dx, dy) / this.radius) * this.rangeM,
      inside: Math.hypot(x - this.centre, y - this.centre) <= this.radius,
    };
  }

  // Pixels from own ship to the picture's edge on that bearing.
  edgePx(bearingDeg) {
    const angle = (bearingDeg - this.upDeg) * RAD;
    const along = this.ownAt.x * Math.sin(angle) + this.ownAt.y * Math.cos(angle);
    const short = 1 - this.ownAt.x ** 2 - this.ownAt.y ** 2;
    return this.radius * (Math.sqrt(Math.max(0, along * along + short)) - along);
  }
}

// Range rings of a scale, in nautical miles: how many, and how far apart. The last is the edge.
export function ringsFor(rangeNm) {
  const spacings = { 0.125: 0.025, 0.25: 0.05, 0.5: 0.1, 0.75: 0.125, 1.5: 0.25 };
  const spacingNm = spacings[rangeNm] ?? rangeNm / 6;
  return { spacingNm, count: Math.round(rangeNm / spacingNm) };
}
