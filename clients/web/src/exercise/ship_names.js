// Ship names on the chart: whose come first, and where each goes so that none lies over another.
import { NAUTICAL_MILE_M } from '../view_geometry.js';
import { wrapLongitude } from './chart_view.js';

const CLOSE_M = 0.5 * NAUTICAL_MILE_M,
  SOON_S = 12 * 60;
const METRES_PER_DEGREE = 60 * NAUTICAL_MILE_M;
const RAD = Math.PI / 180;

const way = ({ courseOverGroundDeg, speedKn }) => {
  const mps = (speedKn * NAUTICAL_MILE_M) / 3600;
  return { east: mps * Math.sin(courseOverGroundDeg * RAD), north: mps * Math.cos(courseOverGroundDeg * RAD) };
};

// From an own ship: how far, and whether the two come within 0.5 NM in the next 12 minutes, if both keep their ways.
function meeting(own, ship) {
  const north = (ship.latitudeDeg - own.latitudeDeg) * METRES_PER_DEGREE,
    east = wrapLongitude(ship.longitudeDeg - own.longitudeDeg) * METRES_PER_DEGREE * Math.cos(own.latitudeDeg * RAD);
  const [mine, hers] = [way(own), way(ship)];
  const [u, v] = [hers.east - mine.east, hers.north - mine.north];
  const metres = Math.hypot(east, north),
    speed2 = u * u + v * v;
  const afterS = speed2 > 1e-6 ? Math.max(0, Math.min(SOON_S, -(east * u + north * v) / speed2)) : 0;
  return { metres, isClose: Math.hypot(east + u * afterS, north + v * afterS) < CLOSE_M };
}

// Ships in the order in which their names are placed: own ships, selected ones, those that give way or come close to an
// own ship, then by their distance from the nearest own ship.
export function byRank(ships, isChosen) {
  const own = ships.filter((ship) => ship.own && !ship.removed);
  const ranked = ships.map((ship) => {
    let metres = Infinity,
      isClose = false;
    if (!ship.own)
      for (const each of own) {
        const met = meeting(each, ship);
        metres = Math.min(metres, met.metres);
        isClose ||= met.isClose && !ship.removed;
      }
    const rank = ship.own ? 0 : isChosen(ship) ? 1 : ship.givesWayNow || isClose ? 2 : 3;
    return { ship, rank, metres };
  });
  const nearer = (a, b) => (a.metres === b.metres ? 0 : a.metres - b.metres);
  return ranked.sort((a, b) => a.rank - b.rank || nearer(a, b)).map(({ ship }) => ship);
}

const overlap = (a, b) => a.x < b.x + b.width && b.x < a.x + a.width && a.y < b.y + b.height && b.y < a.y + a.height;

// labels: { at, clear, width, height }, highest rank first; `clear`: room that the ship's own mark takes, to either
// side.
// Gives the box of each: below to the right, above to the right, below to the left or above to the left of the ship,
// whichever is the first that no box before it overlaps; null where there is none.
export function placeNames(labels) {
  const taken = [];
  return labels.map(({ at, clear, width, height }) => {
    const places = [
      [at.x + clear, at.y + 9],
      [at.x + clear, at.y - 9],
      [at.x - clear - width, at.y + 9],
      [at.x - clear - width, at.y - 9],
    ].map(([x, middle]) => ({ x, y: middle - height / 2, width, height }));
    const box = places.find((place) => !taken.some((other) => overlap(place, other))) ?? null;
    if (box) taken.push(box);
    return box;
  });
}
