// Motion in the plane around own ship: places in metres east and north of her, speeds in metres a second.
import { NAUTICAL_MILE_M, wrapDeg } from '../view_geometry.js';

const RAD = Math.PI / 180;
const MPS_PER_KN = NAUTICAL_MILE_M / 3600;
// WGS 84.
const EQUATOR_M = 6378137, ECCENTRICITY2 = 0.00669437999014;

export const place = (bearingDeg, rangeM) => ({ east: rangeM * Math.sin(bearingDeg * RAD), north: rangeM * Math.cos(bearingDeg * RAD) });

export function polar({ east, north }) {
  return { bearingDeg: wrapDeg(Math.atan2(east, north) / RAD), rangeM: Math.hypot(east, north) };
}

// null where course or speed is not known.
export function velocity(courseDeg, speedKn) {
  return Number.isFinite(courseDeg) && Number.isFinite(speedKn) ? place(courseDeg, speedKn * MPS_PER_KN) : null;
}

export const minus = (a, b) => (a && b ? { east: a.east - b.east, north: a.north - b.north } : null);
export const moved = (at, by, seconds) => (by ? { east: at.east + by.east * seconds, north: at.north + by.north * seconds } : at);

export function courseAndSpeed(by) {
  if (!by) return { courseDeg: undefined, speedKn: undefined };
  const { bearingDeg, rangeM } = polar(by);
  return { courseDeg: bearingDeg, speedKn: rangeM / MPS_PER_KN };
}

// Where a position lies from own ship's.
// Error: below a thousandth of the distance within 50 NM, but near the poles.
export function fromPosition(own, at) {
  const middle = ((own.latitudeDeg + at.latitudeDeg) / 2) * RAD;
  const w2 = 1 - ECCENTRICITY2 * Math.sin(middle) ** 2;
  const alongMeridian = (EQUATOR_M * (1 - ECCENTRICITY2)) / w2 ** 1.5, across = EQUATOR_M / Math.sqrt(w2);
  const longitudeDeg = wrapDeg(at.longitudeDeg - own.longitudeDeg + 180) - 180;
  return { east: longitudeDeg * RAD * across * Math.cos(middle), north: (at.latitudeDeg - own.latitudeDeg) * RAD * alongMeridian };
}

// When a target crosses own ship's heading line ahead of her, and how far off: { rangeM, seconds }. null: it does
// not, or did already. by: its relative motion.
export function bowCrossing(at, by, headingDeg) {
  if (!by || !Number.isFinite(headingDeg)) return null;
  const ahead = place(headingDeg, 1), starboard = place(headingDeg + 90, 1);
  const across = by.east * starboard.east + by.north * starboard.north;
  if (Math.abs(across) < 0.01) return null;
  const seconds = -(at.east * starboard.east + at.north * starboard.north) / across;
  const rangeM = (at.east + by.east * seconds) * ahead.east + (at.north + by.north * seconds) * ahead.north;
  return seconds >= 0 && rangeM > 0 ? { rangeM, seconds } : null;
}

const shorterTurn = (fromDeg, toDeg) => wrapDeg(toDeg - fromDeg + 180) - 180;
const towards = (from, to, step) => (Math.abs(to - from) <= step ? to : from + Math.sign(to - from) * step);

// Own ship's way in a trial manoeuvre, from now on: places `stepS` apart for `minutes`. She keeps on until it begins, then
// turns the shorter way and changes speed, both at once or at the rates of the order.
// Error: at most half a step of speed, a metre or two at 20 kn; it is for drawing.
export function trialPath({ courseDeg, speedKn }, { order, beginsS }, minutes, stepS = 5) {
  const path = [{ east: 0, north: 0 }];
  let course = courseDeg, speed = speedKn;
  const turn = order.turnRateDegMin > 0 ? (order.turnRateDegMin / 60) * stepS : Infinity;
  const change = order.accelerationKnMin > 0 ? (order.accelerationKnMin / 60) * stepS : Infinity;
  for (let t = 0; t < minutes * 60; t += stepS) {
    // A step in which it begins is cut in two.
    const kept = Math.min(stepS, Math.max(0, beginsS - t));
    let at = moved(path.at(-1), velocity(course, speed), kept);
    if (kept < stepS) {
      const off = shorterTurn(course, order.courseDeg);
      course = Math.abs(off) <= turn ? order.courseDeg : course + Math.sign(off) * turn;
      speed = towards(speed, order.speedKn, change);
      at = moved(at, velocity(course, speed), stepS - kept);
    }
    path.push(at);
  }
  return path;
}
