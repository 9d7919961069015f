// Places on the chart: how far apart, where to, and as they are typed.
import { NAUTICAL_MILE_M } from '../view_geometry.js';
import { EARTH_M, wrapLongitude } from './chart_view.js';

const RAD = Math.PI / 180;

// { metres, deg } from one place to another, on a sphere; good for the distances of a chart.
export function fromTo(a, b) {
  const north = (b.latitudeDeg - a.latitudeDeg) * RAD * EARTH_M;
  const east =
    wrapLongitude(b.longitudeDeg - a.longitudeDeg) *
    RAD *
    EARTH_M *
    Math.cos(((a.latitudeDeg + b.latitudeDeg) / 2) * RAD);
  return { metres: Math.hypot(north, east), deg: (Math.atan2(east, north) / RAD + 360) % 360 };
}

// Where a ship is after so many minutes on that course.
export function after({ latitudeDeg, longitudeDeg }, courseDeg, speedKn, minutes) {
  const angle = (speedKn * NAUTICAL_MILE_M * minutes) / 60 / EARTH_M / RAD;
  const latitude = latitudeDeg + angle * Math.cos(courseDeg * RAD);
  const across = Math.max(0.01, Math.cos(((latitudeDeg + latitude) / 2) * RAD));
  return {
    latitudeDeg: Math.max(-90, Math.min(90, latitude)),
    longitudeDeg: wrapLongitude(longitudeDeg + (angle * Math.sin(courseDeg * RAD)) / across),
  };
}

// Degrees as a mariner types them: 60.3925, -4.5, 60 23.55 N, 60°23.550′N, 4 30 0 W. NaN if it is none.
export function parseAngle(text, positive, negative, most) {
  const match = new RegExp(
    `^([+-]?)(\\d+(?:[.,]\\d+)?)(?:[°\\s]+(\\d+(?:[.,]\\d+)?))?(?:['′\\s]+(\\d+(?:[.,]\\d+)?))?['′"″\\s]*([${positive}${negative}]?)$`,
    'i',
  ).exec(text.trim());
  if (!match) return NaN;
  const [, sign, degrees, minutes = '0', seconds = '0', side] = match;
  const [d, m, s] = [degrees, minutes, seconds].map((part) => Number(part.replace(',', '.')));
  if (m >= 60 || s >= 60 || (sign && side)) return NaN;
  const value = (sign === '-' || side.toUpperCase() === negative ? -1 : 1) * (d + m / 60 + s / 3600);
  return Math.abs(value) <= most ? value : NaN;
}

export const parseLatitude = (text) => parseAngle(text, 'N', 'S', 90);
export const parseLongitude = (text) => parseAngle(text, 'E', 'W', 180);
