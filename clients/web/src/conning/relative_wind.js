// The wind that is felt on board: the true one less her way over ground.
const RAD = Math.PI / 180;

// con: ConState.  { fromDeg: off the bow, starboard positive, -180 .. 180; kn }, or null without a heading.
export function relativeWind({ windFromDeg, windKn, groundAheadKn, groundStarboardKn }, headingDeg) {
  if (!Number.isFinite(headingDeg)) return null;
  const off = (windFromDeg - headingDeg) * RAD;
  const ahead = windKn * Math.cos(off) + groundAheadKn;
  const starboard = windKn * Math.sin(off) + groundStarboardKn;
  const kn = Math.hypot(ahead, starboard);
  return { fromDeg: kn < 1e-9 ? 0 : Math.atan2(starboard, ahead) / RAD, kn };
}
