// ChartView: which part of the Earth the chart shows, and where. CSS pixels from the canvas's top left corner, north up.
// Mercator of a sphere: shapes are those of a paper chart to 0.4 %; the server alone reckons where ships go.
const RAD = Math.PI / 180;
export const EARTH_M = 6371000;
const MIN_SCALE = 0.15,
  MAX_SCALE = 450; // metres per pixel, at the centre
const MAX_LATITUDE = 84;

export const wrapLongitude = (deg) => ((((deg + 180) % 360) + 360) % 360) - 180;
export const mercator = (latitudeDeg) =>
  Math.log(Math.tan(Math.PI / 4 + (Math.max(-89, Math.min(89, latitudeDeg)) * RAD) / 2));
const latitudeOf = (y) => (2 * Math.atan(Math.exp(y)) - Math.PI / 2) / RAD;

export class ChartView {
  constructor() {
    Object.assign(this, { width: 100, height: 100, latitudeDeg: 0, longitudeDeg: 0, metresPerPixel: 20 });
  }

  // Pixels per unit of Mercator's plane, which is a radian of longitude.
  get scale() {
    return (EARTH_M * Math.cos(this.latitudeDeg * RAD)) / this.metresPerPixel;
  }

  // From the centre to a corner.
  get radiusM() {
    return (Math.hypot(this.width, this.height) / 2) * this.metresPerPixel;
  }

  toPixel({ latitudeDeg, longitudeDeg }) {
    return {
      x: this.width / 2 + wrapLongitude(longitudeDeg - this.longitudeDeg) * RAD * this.scale,
      y: this.height / 2 - (mercator(latitudeDeg) - mercator(this.latitudeDeg)) * this.scale,
    };
  }

  fromPixel(x, y) {
    return {
      latitudeDeg: latitudeOf(mercator(this.latitudeDeg) + (this.height / 2 - y) / this.scale),
      longitudeDeg: wrapLongitude(this.longitudeDeg + (x - this.width / 2) / this.scale / RAD),
    };
  }

  centreOn({ latitudeDeg, longitudeDeg }) {
    this.latitudeDeg = Math.max(-MAX_LATITUDE, Math.min(MAX_LATITUDE, latitudeDeg));
    this.longitudeDeg = wrapLongitude(longitudeDeg);
  }

  // The chart is moved along with a finger, as a sheet: its scale at the centre follows the latitude.
  panBy(dx, dy) {
    const { scale } = this;
    this.centreOn(this.fromPixel(this.width / 2 - dx, this.height / 2 - dy));
    this.metresPerPixel = (EARTH_M * Math.cos(this.latitudeDeg * RAD)) / scale;
  }

  // What is under the pixel stays there; factor above 1 shows more detail.
  zoomAt(factor, x = this.width / 2, y = this.height / 2) {
    const before = this.fromPixel(x, y);
    this.metresPerPixel = Math.max(MIN_SCALE, Math.min(MAX_SCALE, this.metresPerPixel / factor));
    const now = this.toPixel(before);
    this.panBy(x - now.x, y - now.y);
  }

  // Shows all the places, with some room about them, and at least `leastM` across.
  fit(places, leastM = 4000) {
    if (places.length === 0) return;
    const first = places[0];
    const x = places.map((p) => wrapLongitude(p.longitudeDeg - first.longitudeDeg) * RAD),
      y = places.map((p) => mercator(p.latitudeDeg));
    const [left, right, bottom, top] = [Math.min(...x), Math.max(...x), Math.min(...y), Math.max(...y)];
    this.centreOn({
      latitudeDeg: latitudeOf((top + bottom) / 2),
      longitudeDeg: first.longitudeDeg + (left + right) / 2 / RAD,
    });
    const metres = EARTH_M * Math.cos(this.latitudeDeg * RAD);
    const across = Math.max(
      leastM / this.width,
      ((right - left) * metres) / (0.75 * this.width),
      ((top - bottom) * metres) / (0.7 * this.height),
    );
    this.metresPerPixel = Math.max(MIN_SCALE, Math.min(MAX_SCALE, across));
  }
}

const STEPS = [0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 30, 60, 120, 300, 600, 1800];
// Minutes between grid lines that are at least so many pixels apart.
export function gridStep(pixelsPerMinute, least) {
  return STEPS.find((step) => step * pixelsPerMinute >= least) ?? STEPS.at(-1);
}

// A round length that fills at most so many pixels: { metres, text }.
export function scaleBar(metresPerPixel, most) {
  const fits = (unit, text) => {
    const whole = 10 ** Math.floor(Math.log10((most * metresPerPixel) / unit));
    const value = [5, 2, 1].map((n) => n * whole).find((n) => n * unit <= most * metresPerPixel);
    return { metres: value * unit, text: `${Number(value.toPrecision(1))} ${text}` };
  };
  return most * metresPerPixel >= 370.4 ? fits(1852, 'NM') : fits(1, 'm');
}
