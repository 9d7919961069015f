// Which pixels lie where, as spans of a line each: those of a circle, and those of a sector seen from own ship. Lines
// are counted from the top; a pixel lies where its middle does.
const MOST_RAD = Math.PI / 6;
const EDGE_PX = 2;  // a sector reaches so far beyond its rows: half a pixel's diagonal, and rounding

// [from, to) of each line of a square whose middles are less than `radius` from its middle.
export function circleSpans(side, radius) {
  const spans = new Int32Array(2 * side), half = side / 2;
  for (let y = 0; y < side; ++y) {
    const up = half - y - 0.5, left = radius * radius - up * up;
    if (left <= 0) continue;
    const across = Math.sqrt(left);
    // The middles that are nearer than `across`: x + 0.5 - half > -across.
    spans[2 * y] = Math.max(0, Math.floor(half - across - 0.5) + 1);
    spans[2 * y + 1] = Math.min(side, Math.ceil(half + across - 0.5));
  }
  return spans;
}

// Calls take(y, from, to) for what lies within `circle` (of circleSpans) on the bearings from..to, in turns from the
// top clockwise as own ship sees them. Gives the box around it, { left, top, right, bottom }, or null.
export function eachSpan(circle, side, own, from, to, take) {
  const box = { left: side, top: side, right: 0, bottom: 0 };
  const total = (to - from) * 2 * Math.PI, parts = Math.ceil(total / MOST_RAD);
  for (let part = 0; part < parts; ++part) {
    const a = from * 2 * Math.PI + (total * part) / parts;
    eachSpanOf(circle, side, own, a, a + total / parts, box, take);
  }
  return box.left < box.right ? box : null;
}

function eachSpanOf(circle, side, own, a, b, box, take) {
  const half = side / 2, middle = (a + b) / 2, reach = 2 * side;
  // Within three lines: right of the sector's left side, left of its right one, not behind own ship. x, y: normals
  // inwards.
  const normals = [Math.cos(a), -Math.sin(a), -Math.cos(b), Math.sin(b), Math.sin(middle), Math.cos(middle)];
  const ends = [0, reach * Math.cos(a), reach * Math.cos(b)];
  const top = Math.max(0, Math.floor(half - own.y - Math.max(...ends) - 2 * EDGE_PX));
  const bottom = Math.min(side, Math.ceil(half - own.y - Math.min(...ends) + 2 * EDGE_PX));
  for (let y = top; y < bottom; ++y) {
    const up = half - y - 0.5 - own.y;
    let left = circle[2 * y] + 0.5 - half - own.x, right = circle[2 * y + 1] - 0.5 - half - own.x;
    for (let k = 0; k < 6; k += 2) {
      const across = normals[k], rest = -EDGE_PX - normals[k + 1] * up;
      if (across > 1e-9) left = Math.max(left, rest / across);
      else if (across < -1e-9) right = Math.min(right, rest / across);
      else if (rest > 0) right = -Infinity;
    }
    const from = Math.ceil(left + half + own.x - 0.5), to = Math.floor(right + half + own.x - 0.5) + 1;
    if (from >= to) continue;
    if (from < box.left) box.left = from;
    if (to > box.right) box.right = to;
    if (y < box.top) box.top = y;
    if (y >= box.bottom) box.bottom = y + 1;
    take(y, from, to);
  }
}
