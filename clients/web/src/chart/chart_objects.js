// A loaded piece of the chart on a plane of metres, ready to be drawn at any scale.
import { LocalPlane } from './earth.js';
import { COAST } from './chart_wire.js';

// Own ship may be so far from the plane's anchor; then the piece is laid on a new one.
const REACH_M = 5000;
// Of a pixel: what a line may be off, so that the more is left out the longer the range.
const TOLERANCE_PX = 0.4;
// A contour at or below this depth is drawn strongly.
export const SHOAL_M = 10;

export class LoadedChart {
  constructor(objects) {
    this.objects = objects;
    this.lines = objects.lines.map((line) => decode(line, objects));
    this.marks = objects.marks.map((mark) => ({
      ...mark,
      latitudeDeg: objects.latitudeDeg + mark.latitude * 1e-6,
      longitudeDeg: objects.longitudeDeg + mark.longitude * 1e-6,
      east: 0, north: 0,
    }));
    this.points = this.lines.reduce((sum, line) => sum + line.places.length / 2, 0);
    this.plane = null;
    this.paths = null;
  }

  // Lays all on a plane about `place`, unless the one there still serves. Whether it did.
  layAbout(place) {
    if (this.plane) {
      const { east, north } = this.plane.toPlane(place.latitudeDeg, place.longitudeDeg);
      if (Math.hypot(east, north) <= REACH_M) return false;
    }
    this.plane = new LocalPlane(place);
    this.paths = null;
    for (const line of this.lines) {
      for (let i = 0; i < line.places.length; i += 2) {
        const { east, north } = this.plane.toPlane(line.places[i + 1], line.places[i]);
        line.plane[i] = east;
        line.plane[i + 1] = north;
      }
      line.counts ??= significance(line.plane);
      line.box = boxOf(line.plane);
    }
    for (const mark of this.marks) Object.assign(mark, this.plane.toPlane(mark.latitudeDeg, mark.longitudeDeg));
    return true;
  }

  // Path2Ds, metres east and south of the anchor: { coast, shoal, deep, points }, without what is beyond reachM of (east, north) and
  // what is smaller than a part of a pixel. Kept while scale and place serve.
  pathsFor(metresPerPixel, east, north, reachM) {
    const have = this.paths;
    if (have && have.metresPerPixel === metresPerPixel && Math.hypot(east - have.east, north - have.north) + reachM <= have.reachM) return have;
    const paths = { coast: new Path2D(), shoal: new Path2D(), deep: new Path2D(), points: 0, metresPerPixel, east, north, reachM: reachM * 1.25 };
    const toleranceM = metresPerPixel * TOLERANCE_PX;
    for (const line of this.lines) {
      const { box } = line;
      if (box.west > east + paths.reachM || box.east < east - paths.reachM || box.south > north + paths.reachM || box.north < north - paths.reachM) continue;
      if (Math.max(box.east - box.west, box.north - box.south) < toleranceM) continue;
      const path = line.kind === COAST ? paths.coast : line.depthM <= SHOAL_M ? paths.shoal : paths.deep;
      paths.points += trace(path, line, toleranceM);
    }
    this.paths = paths;
    return paths;
  }
}

function trace(path, { plane, counts }, toleranceM) {
  let points = 0;
  for (let i = 0; i < counts.length; ++i) {
    if (!(counts[i] > toleranceM)) continue;
    if (points === 0) path.moveTo(plane[0], -plane[1]);
    else path.lineTo(plane[2 * i], -plane[2 * i + 1]);
    points += 1;
  }
  return points;
}

// { kind, depthM, places: [longitude, latitude, ...] }.
function decode({ kind, depthM, points }, { latitudeDeg, longitudeDeg }) {
  const places = new Float64Array(points.length - (points.length % 2));
  let east = 0, north = 0;
  for (let i = 0; i < places.length; i += 2) {
    east += points[i];
    north += points[i + 1];
    places[i] = longitudeDeg + east * 1e-6;
    places[i + 1] = latitudeDeg + north * 1e-6;
  }
  return { kind, depthM, places, plane: new Float64Array(places.length), counts: null, box: null };
}

function boxOf(plane) {
  const box = { west: Infinity, east: -Infinity, south: Infinity, north: -Infinity };
  for (let i = 0; i < plane.length; i += 2) {
    box.west = Math.min(box.west, plane[i]);
    box.east = Math.max(box.east, plane[i]);
    box.south = Math.min(box.south, plane[i + 1]);
    box.north = Math.max(box.north, plane[i + 1]);
  }
  return box;
}

// Of each vertex the tolerance from which on it may be left out (Ramer, Douglas and Peucker); the ends stay.
export function significance(plane) {
  const n = plane.length / 2;
  const counts = new Float64Array(n);
  if (n === 0) return counts;
  counts[0] = counts[n - 1] = Infinity;
  const spans = [[0, n - 1, Infinity]];
  while (spans.length > 0) {
    const [first, last, most] = spans.pop();
    if (last - first < 2) continue;
    const ax = plane[2 * first], ay = plane[2 * first + 1];
    const wx = plane[2 * last] - ax, wy = plane[2 * last + 1] - ay;
    const square = wx * wx + wy * wy;
    let furthest = first + 1, off2 = -1;
    for (let i = first + 1; i < last; ++i) {
      const px = plane[2 * i] - ax, py = plane[2 * i + 1] - ay;
      const along = square > 0 ? Math.max(0, Math.min(1, (px * wx + py * wy) / square)) : 0;
      const dx = px - along * wx, dy = py - along * wy;
      const d2 = dx * dx + dy * dy;
      if (d2 > off2) { off2 = d2; furthest = i; }
    }
    if (!(off2 > 0)) continue;  // nothing between them is off the line: left out at any scale
    counts[furthest] = Math.min(most, Math.sqrt(off2));
    spans.push([first, furthest, counts[furthest]], [furthest, last, counts[furthest]]);
  }
  return counts;
}
