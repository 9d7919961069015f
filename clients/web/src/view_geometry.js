// ViewGeometry: where a bearing and range lie on the screen. CSS pixels from the canvas's top left
// corner; bearings true, degrees; ranges in metres.
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
    this.rangeM = 0;     // at the edge of the picture
  }

  get centre() {
    return this.side / 2;
  }

  get own() { return { x: this.centre, y: this.centre }; }

  toPixel(bearingDeg, rangeM) {
    const angle = (bearingDeg - this.upDeg) * RAD;
    const r = this.rangeM > 0 ? (rangeM / this.rangeM) * this.radius : 0;
    return { x: this.centre + r * Math.sin(angle), y: this.centre - r * Math.cos(angle) };
  }

  fromPixel(x, y) {
    const dx = x - this.centre, dy = this.centre - y;
    return {
      bearingDeg: wrapDeg(Math.atan2(dx, dy) / RAD + this.upDeg),
      rangeM: (Math.hypot(dx, dy) / this.radius) * this.rangeM,
      inside: Math.hypot(dx, dy) <= this.radius,
    };
  }
}

// Range rings of a scale, in nautical miles: how many, and how far apart. The last is the edge.
export function ringsFor(rangeNm) {
  const spacings = { 0.125: 0.025, 0.25: 0.05, 0.5: 0.1, 0.75: 0.25, 1.5: 0.25 };
  const spacingNm = spacings[rangeNm] ?? rangeNm / 6;
  return { spacingNm, count: Math.round(rangeNm / spacingNm) };
}
