// A picture that is known in closed form: where the coast begins on every true bearing, and where the
// targets are. Bearings in degrees, ranges in metres.
export const NM = 1852;

export const TARGETS = [
  { bearingDeg: 5, rangeM: 900 }, { bearingDeg: 118, rangeM: 1500 }, { bearingDeg: 145, rangeM: 4100 },
  { bearingDeg: 190, rangeM: 2500 }, { bearingDeg: 265, rangeM: 7300 }, { bearingDeg: 349.5, rangeM: 3300 },
];
const HALF_BEAM_DEG = 0.7, HALF_LENGTH_M = 45;

// Leading edge of the land, or null over open sea; the land is at least LAND_DEPTH_M deep.
export const LAND_DEPTH_M = 1400;
export function coastM(bearingDeg) {
  const b = bearingDeg * Math.PI / 180;
  if (bearingDeg >= 20 && bearingDeg <= 95) return 2600 + 350 * Math.sin(5 * b) + 60 * Math.sin(31 * b);
  if (bearingDeg >= 205 && bearingDeg <= 320) return 4700 + 900 * Math.cos(3 * b) + 110 * Math.sin(23 * b);
  return null;
}

function angleBetween(a, b) {
  return Math.abs(((a - b + 540) % 360) - 180);
}

// Cells of one spoke, 0..255. gain 50 shows echoes at 210; noise stays below a fifth of them.
export function cellsAt(bearingDeg, { cells, cellSizeM, gain, noise = true }) {
  const out = new Uint8Array(cells);
  const level = Math.min(255, Math.round(210 * gain / 50));
  if (noise) {
    let h = Math.imul(Math.round(bearingDeg * 1000) + 1, 0x9e3779b1);
    for (let c = 0; c < cells; ++c) {
      h ^= h << 13; h ^= h >>> 17; h ^= h << 5;
      out[c] = ((h >>> 24) * gain * 40) / (255 * 50);
    }
  }
  const fill = (fromM, toM) => {
    const a = Math.max(0, Math.round(fromM / cellSizeM)), b = Math.min(cells, Math.round(toM / cellSizeM));
    if (b > a) out.fill(level, a, b);
    else if (b === a && a < cells) out[a] = level;
  };
  const coast = coastM(bearingDeg);
  if (coast !== null) fill(coast, coast + LAND_DEPTH_M + 500 * Math.sin(bearingDeg / 9));
  for (const target of TARGETS) {
    if (angleBetween(bearingDeg, target.bearingDeg) <= HALF_BEAM_DEG) {
      fill(target.rangeM - HALF_LENGTH_M, target.rangeM + HALF_LENGTH_M);
    }
  }
  return out;
}
