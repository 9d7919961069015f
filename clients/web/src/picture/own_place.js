// Where own ship stands in the picture, in parts of its radius from the centre: x right, y up.
const RAD = Math.PI / 180;

// Own ship never stands farther out (MSC.192: at most 75 % of the radius).
export const FARTHEST = 0.75;
// After a reset of true motion: most view ahead, and still room before the next reset if a stream sets her outwards.
const RESET = 0.7;
const LOOK_AHEAD = 0.6;

// { x, y, clamped }.
export function clampPlace({ x, y }) {
  const out = Math.hypot(x, y);
  if (!Number.isFinite(out)) return { x: 0, y: 0, clamped: true };
  if (out <= FARTHEST) return { x, y, clamped: false };
  return { x: (x / out) * FARTHEST, y: (y / out) * FARTHEST, clamped: true };
}

// Behind the centre as seen on the course, which stands `courseUpDeg` clockwise of the screen's top.
export function lookAhead(courseUpDeg, part = LOOK_AHEAD) {
  return { x: -part * Math.sin(courseUpDeg * RAD), y: -part * Math.cos(courseUpDeg * RAD) };
}

// True motion: own ship has sailed eastM, northM. Gives { at, reset }: with `reset` she had come to the farthest
// place and stands where she sees most ahead.
export function sailed(at, eastM, northM, upDeg, rangeM) {
  if (!(rangeM > 0)) return { at, reset: false };
  const s = Math.sin(upDeg * RAD), c = Math.cos(upDeg * RAD);
  const next = { x: at.x + (eastM * c - northM * s) / rangeM, y: at.y + (eastM * s + northM * c) / rangeM };
  return { at: next, reset: Math.hypot(next.x, next.y) >= FARTHEST };
}

export function resetPlace(courseUpDeg) {
  return lookAhead(courseUpDeg, RESET);
}
