// ChartRequest: asks for the chart about own ship, and anew when she needs another piece of it.
import { NAUTICAL_MILE_M } from '../view_geometry.js';
import { bearingRange } from './earth.js';

const MAX_RADIUS_NM = 60, MIN_RADIUS_NM = 0.5;
// More than is shown, so that a move asks for nothing.
const ROOM = 1.55;
// A piece of which less than this part is shown is too coarse.
const FINER = 0.45;
const SILENCE_MS = 8000, REFUSED_MS = 5000;

export class ChartRequest {
  // ask({ latitudeDeg, longitudeDeg, radiusNm, toleranceM }): the request number or null. nowMs(): a clock.
  constructor(ask, nowMs = () => performance.now()) {
    Object.assign(this, { ask, nowMs });
    this.forget();
  }

  forget() {
    this.loaded = null;    // the circle that is there
    this.underWay = null;  // { request, circle, sinceMs }
    this.waitUntilMs = -Infinity;
  }

  // The circle to ask for, or null if what there is will do. place: own ship; reachM: from her to the furthest point shown.
  static needed(place, reachM, metresPerPixel, loaded) {
    const reachNm = reachM / NAUTICAL_MILE_M;
    const radiusNm = Math.min(MAX_RADIUS_NM, Math.max(MIN_RADIUS_NM, reachNm * ROOM));
    if (loaded) {
      const gone = bearingRange(loaded, place).rangeM / NAUTICAL_MILE_M;
      const isFarOff = gone > loaded.radiusNm / 3;
      const isShort = radiusNm > loaded.radiusNm * 1.001 && reachNm + gone > loaded.radiusNm;
      const isCoarse = radiusNm < FINER * loaded.radiusNm;
      if (!isFarOff && !isShort && !isCoarse) return null;
    }
    // On a grid, so that consoles of one ship ask for the same piece.
    const stepDeg = radiusNm / 60 / 20;
    const onGrid = (deg) => Math.round(deg / stepDeg) * stepDeg;
    return {
      latitudeDeg: Math.max(-90, Math.min(90, onGrid(place.latitudeDeg))),
      longitudeDeg: Math.max(-180, Math.min(180, onGrid(place.longitudeDeg))),
      radiusNm,
      toleranceM: Math.min(2000, metresPerPixel / 2),
    };
  }

  look(place, reachM, metresPerPixel) {
    const nowMs = this.nowMs();
    if (this.underWay && nowMs - this.underWay.sinceMs < SILENCE_MS) return;
    this.underWay = null;
    if (nowMs < this.waitUntilMs) return;
    const circle = ChartRequest.needed(place, reachM, metresPerPixel, this.loaded);
    if (!circle) return;
    const request = this.ask(circle);
    if (request !== null) this.underWay = { request, circle, sinceMs: nowMs };
    else this.waitUntilMs = nowMs + REFUSED_MS;
  }

  // Whether this answer is ours, of which the circle is kept.
  take(objects) {
    if (!this.underWay) return false;
    this.underWay = null;
    const { latitudeDeg, longitudeDeg, radiusNm } = objects;
    this.loaded = { latitudeDeg, longitudeDeg, radiusNm };
    return true;
  }

  // A refusal: the next question waits.
  takeReply(reply) {
    if (reply.code === 0 || reply.request !== this.underWay?.request) return false;
    this.underWay = null;
    this.waitUntilMs = this.nowMs() + REFUSED_MS;
    return true;
  }
}
