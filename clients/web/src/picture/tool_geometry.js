// Where the measuring tools lie on the screen, for drawing and for the hand that takes them. Pixels of the view.
import { originFrom, trueBearing } from './tools.js';

const RAD = Math.PI / 180;

// What the shapes depend on besides the tools: { bowDeg, ownPlace (or null) }.
// { lines: [{ tool: 'ebls' | 'lines', n, from, to, ... }], circles: [{ tool: 'vrms', n, centre, radius }] } of all that are on.
export function shapesOf(tools, view, at) {
  const shapes = { ebls: [], vrms: [], lines: [] };
  if (!(view.rangeM > 0)) return shapes;
  const scale = view.radius / view.rangeM;
  for (const n of [0, 1]) {
    const ebl = tools.ebls[n], vrm = tools.vrms[n];
    const origin = originFrom(ebl.origin, at.ownPlace);
    if (origin === null) continue;
    const centre = view.toPixel(origin.bearingDeg, origin.rangeM);
    const isOff = ebl.origin !== null;
    if (vrm.on) shapes.vrms.push({ n, centre, radius: vrm.rangeM * scale, isOff });
    if (!ebl.on) continue;
    const way = direction(trueBearing(ebl, at.bowDeg) - view.upDeg);
    const reach = chord(view, centre, way);
    if (reach === null || reach[1] <= 0) continue;
    const from = Math.max(0, reach[0]);
    const tick = vrm.on && vrm.rangeM * scale < reach[1] ? along(centre, way, vrm.rangeM * scale) : null;
    shapes.ebls.push({ n, from: along(centre, way, from), to: along(centre, way, reach[1]), way, tick, centre, isOff });
  }
  if (!tools.areLinesOn) return shapes;
  tools.lines.forEach((line, n) => {
    if (!line.on) return;
    const bearingDeg = trueBearing(line, at.bowDeg);
    const way = direction(bearingDeg - view.upDeg);
    const foot = view.toPixel(bearingDeg + 90, line.offsetM);
    const reach = chord(view, foot, way);
    if (reach === null) return;
    const least = Math.max(reach[0], line.fromM === null ? -Infinity : line.fromM * scale);
    const most = Math.min(reach[1], line.toM === null ? Infinity : line.toM * scale);
    if (least < most) shapes.lines.push({ n, from: along(foot, way, least), to: along(foot, way, most), way, foot });
  });
  return shapes;
}

// Unit vector on the screen (y down) so many degrees clockwise of its top.
export function direction(deg) {
  return { x: Math.sin(deg * RAD), y: -Math.cos(deg * RAD) };
}

function along(from, way, px) {
  return { x: from.x + way.x * px, y: from.y + way.y * px };
}

// [from, to] along `way` within the picture's circle, pixels from `point`; null if it misses the circle.
export function chord(view, point, way) {
  const x = point.x - view.centre, y = point.y - view.centre;
  const middle = -(x * way.x + y * way.y);
  const rest = view.radius ** 2 - (x + middle * way.x) ** 2 - (y + middle * way.y) ** 2;
  if (rest <= 0) return null;
  const half = Math.sqrt(rest);
  return [middle - half, middle + half];
}

export function toSegment(p, a, b) {
  const dx = b.x - a.x, dy = b.y - a.y;
  const t = Math.min(1, Math.max(0, ((p.x - a.x) * dx + (p.y - a.y) * dy) / (dx * dx + dy * dy || 1)));
  return Math.hypot(p.x - a.x - t * dx, p.y - a.y - t * dy);
}

// What a hand at p takes, at most reachPx away: { ebl, vrm, line }, numbers or null. Near both an EBL and its own VRM it takes
// both; near an EBL's origin (where all bearings meet) no EBL.
export function grabbed(shapes, p, reachPx) {
  const near = (list, distance) => {
    let best = null, least = reachPx;
    for (const shape of list) {
      const px = distance(shape);
      if (px <= least) { best = shape; least = px; }
    }
    return best;
  };
  const ebl = near(shapes.ebls, (s) => (Math.hypot(p.x - s.centre.x, p.y - s.centre.y) < reachPx ? Infinity : toSegment(p, s.from, s.to)));
  const vrm = near(shapes.vrms, (s) => Math.abs(Math.hypot(p.x - s.centre.x, p.y - s.centre.y) - s.radius));
  const line = ebl || vrm ? null : near(shapes.lines, (s) => toSegment(p, s.from, s.to));
  const both = ebl && vrm && ebl.n === vrm.n;
  return { ebl: ebl?.n ?? null, vrm: vrm && (!ebl || both) ? vrm.n : null, line: line?.n ?? null };
}
