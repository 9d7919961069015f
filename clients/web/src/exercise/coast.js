// Coast: the shore about the view, asked for when the view needs it.
import { NAUTICAL_MILE_M } from '../view_geometry.js';
import { mercator, wrapLongitude } from './chart_view.js';
import { fromTo } from './place.js';

const RAD = Math.PI / 180;
export const MAX_RADIUS_NM = 60,
  MIN_RADIUS_NM = 0.5;
// More than is shown, so that a small move asks for nothing.
const ROOM = 1.7;
// A coast that is so much coarser than a pixel is asked for again when less than this part of it is shown.
const COARSE_PX = 2,
  FINER = 0.45;
const WAIT_MS = 250,
  SILENCE_MS = 8000,
  REFUSED_MS = 5000;
// Of Path2D: single precision, so it has Mercator's plane in units that suit it.
export const PATH_UNIT = 1e-5;

// Points of a line of Coastline: [longitude, latitude, ...] in degrees, the longitude not wrapped.
export function decodeLine({ points }, centre) {
  const out = new Float64Array(points.length - (points.length % 2));
  let east = 0,
    north = 0;
  for (let i = 0; i + 1 < points.length; i += 2) {
    east += points[i];
    north += points[i + 1];
    out[i] = centre.longitudeDeg + east * 1e-6;
    out[i + 1] = centre.latitudeDeg + north * 1e-6;
  }
  return out;
}

export class Coast {
  // ask({ latitudeDeg, longitudeDeg, radiusNm }): the request number or null.  changed(): there is something to draw.
  constructor(ask, changed) {
    Object.assign(this, { ask, changed, asked: null, lines: 0, points: 0 });
    this.forget();
  }

  forget() {
    clearTimeout(this.timer);
    this.shown = this.asked = this.timer = this.waiting = null;
    this.areas = []; // { path, water }, in the order in which they lie over each other
    this.shore = null; // of lines that are no areas
  }

  // The circle to ask for, or null if what is there, or on its way, will do.
  static needed(view, have) {
    const needNm = Math.min(MAX_RADIUS_NM, Math.max(MIN_RADIUS_NM / ROOM, view.radiusM / NAUTICAL_MILE_M));
    const whole = view.radiusM / NAUTICAL_MILE_M <= MAX_RADIUS_NM;
    if (have) {
      const offNm = fromTo(have, view).metres / NAUTICAL_MILE_M;
      const covers = whole
        ? offNm + needNm <= have.radiusNm * 1.001
        : have.radiusNm >= MAX_RADIUS_NM && offNm < MAX_RADIUS_NM / 3;
      if (covers && !(have.detailM > COARSE_PX * view.metresPerPixel && needNm < FINER * have.radiusNm)) return null;
    }
    return {
      latitudeDeg: view.latitudeDeg,
      longitudeDeg: view.longitudeDeg,
      radiusNm: Math.min(MAX_RADIUS_NM, needNm * ROOM),
    };
  }

  // The view has moved.
  look(view) {
    this.view = view;
    if (this.timer === null)
      this.timer = setTimeout(() => {
        this.timer = null;
        this.#askIfNeeded();
      }, WAIT_MS);
  }

  #askIfNeeded() {
    if (this.asked || !this.view) return;
    const circle = Coast.needed(this.view, this.shown);
    if (!circle) return;
    const request = this.ask(circle);
    if (request === null) return;
    this.asked = { ...circle, request };
    this.waiting = setTimeout(() => {
      this.asked = null;
      this.#askIfNeeded();
    }, SILENCE_MS);
  }

  // An answer is one for all that is asked; there is never more than one question.
  take(coastline) {
    clearTimeout(this.waiting);
    this.asked = null;
    const { latitudeDeg, longitudeDeg, radiusNm, detailM, chart } = coastline;
    this.shown = { latitudeDeg, longitudeDeg, radiusNm, detailM, chart };
    this.areas = [];
    this.shore = new Path2D();
    this.lines = coastline.lines.length;
    this.points = 0;
    for (const line of coastline.lines) this.#draw(decodeLine(line, this.shown), line);
    this.changed();
    if (this.view) this.look(this.view);
  }

  takeReply(reply) {
    if (reply.request !== this.asked?.request || reply.code === 0) return false;
    clearTimeout(this.waiting);
    this.waiting = setTimeout(() => {
      this.asked = null;
      this.#askIfNeeded();
    }, REFUSED_MS);
    return true;
  }

  #pathOf({ closed, water }) {
    if (!closed) return this.shore;
    if (this.areas.at(-1)?.water !== water) this.areas.push({ path: new Path2D(), water });
    return this.areas.at(-1).path;
  }

  #draw(line, kind) {
    const middle = mercator(this.shown.latitudeDeg);
    const path = this.#pathOf(kind);
    for (let i = 0; i < line.length; i += 2) {
      const x = ((line[i] - this.shown.longitudeDeg) * RAD) / PATH_UNIT,
        y = (middle - mercator(line[i + 1])) / PATH_UNIT;
      if (i === 0) path.moveTo(x, y);
      else path.lineTo(x, y);
    }
    if (kind.closed) path.closePath();
    this.points += line.length / 2;
  }

  // How its paths lie on the view: a canvas transform, but for the pixel ratio.
  transform(view) {
    const scale = view.scale * PATH_UNIT;
    return {
      scale,
      x: view.width / 2 + wrapLongitude(this.shown.longitudeDeg - view.longitudeDeg) * RAD * view.scale,
      y: view.height / 2 - (mercator(this.shown.latitudeDeg) - mercator(view.latitudeDeg)) * view.scale,
    };
  }
}
