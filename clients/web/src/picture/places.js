// Places on the earth around own ship: { latitudeDeg, longitudeDeg }, bearings true in degrees, metres.
//
// Error: WGS84's radii at the mean latitude; within 0.1 % of the range up to 96 NM below 75 degrees of latitude.
import { wrapDeg } from '../view_geometry.js';

const RAD = Math.PI / 180;
const EQUATOR_M = 6378137, E2 = 0.00669437999014;

function radii(latitudeDeg) {
  const root = Math.sqrt(1 - E2 * Math.sin(latitudeDeg * RAD) ** 2);
  return { north: (EQUATOR_M * (1 - E2)) / root ** 3, east: (EQUATOR_M / root) * Math.max(0.001, Math.cos(latitudeDeg * RAD)) };
}

export const wrapLongitude = (deg) => wrapDeg(deg + 180) - 180;

export function isPlace(place) {
  return Number.isFinite(place?.latitudeDeg) && Math.abs(place.latitudeDeg) <= 90 &&
    Number.isFinite(place.longitudeDeg) && Math.abs(place.longitudeDeg) <= 180;
}

// How far b is east and north of a.
export function offsetM(a, b) {
  const r = radii((a.latitudeDeg + b.latitudeDeg) / 2);
  return {
    eastM: wrapLongitude(b.longitudeDeg - a.longitudeDeg) * RAD * r.east,
    northM: (b.latitudeDeg - a.latitudeDeg) * RAD * r.north,
  };
}

// { bearingDeg, rangeM } of b from a.
export function fromTo(a, b) {
  const { eastM, northM } = offsetM(a, b);
  return { bearingDeg: wrapDeg(Math.atan2(eastM, northM) / RAD), rangeM: Math.hypot(eastM, northM) };
}

export function placeAt(from, bearingDeg, rangeM) {
  const north = rangeM * Math.cos(bearingDeg * RAD);
  const latitudeDeg = Math.max(-90, Math.min(90, from.latitudeDeg + north / radii(from.latitudeDeg).north / RAD));
  const east = radii((from.latitudeDeg + latitudeDeg) / 2).east;
  return { latitudeDeg, longitudeDeg: wrapLongitude(from.longitudeDeg + (rangeM * Math.sin(bearingDeg * RAD)) / east / RAD) };
}
