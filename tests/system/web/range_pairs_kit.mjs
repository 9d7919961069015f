// What is seen at every range scale alike: an echo in each octave of range, each on a bearing of its own.
import { blobAt } from './measure.mjs';
import { NM } from './mock_scene.mjs';

export const ECHOES = Array.from({ length: 13 }, (_, k) => ({ bearingDeg: (15 + 50 * k) % 360, rangeM: 80 * 2 ** k }));
export const HALF_DEG = 4;
const HALF_LENGTH = 0.08;  // of its range
const LEAST_PX = 20;       // from own ship, so that an echo is some pixels

export const lengthM = (echo) => 2 * HALF_LENGTH * echo.rangeM;

// Cells of one spoke, 0..255, without noise.
export function octaveCells(bearingDeg, { cells, cellSizeM }) {
  const out = new Uint8Array(cells);
  for (const echo of ECHOES) {
    if (Math.abs(((bearingDeg - echo.bearingDeg + 540) % 360) - 180) > HALF_DEG) continue;
    const [from, to] = [1 - HALF_LENGTH, 1 + HALF_LENGTH].map((part) => Math.min(cells, Math.round((part * echo.rangeM) / cellSizeM)));
    out.fill(220, from, to);
  }
  return out;
}

// Every pair of different scales once, each beginning where the one before ended (a circuit of Euler's): numbers of scales.
export function circuit(scales) {
  const left = Array.from({ length: scales }, (_, a) => Array.from({ length: scales }, (_u, b) => b).filter((b) => b !== a));
  const stack = [0], path = [];
  while (stack.length > 0) {
    const from = stack.at(-1);
    if (left[from].length > 0) stack.push(left[from].pop());
    else path.push(stack.pop());
  }
  return path.reverse();
}

// What is wrong in a picture of that range. cellM(echo): the cell it was painted with; reachM(echo): how far the spokes went then.
// Gives texts, and how many places were looked at.
export function wrongEchoes(shot, cellM, reachM = () => shot.rangeM) {
  const wrong = [], pxM = shot.rangeM / (shot.radiusPx * shot.pixelRatio);
  let seen = 0;
  for (const echo of ECHOES) {
    const cell = cellM(echo);
    if (echo.rangeM * (1 + HALF_LENGTH) > shot.rangeM || echo.rangeM < LEAST_PX * pxM || cell > lengthM(echo) / 2) continue;
    seen += 1;
    const found = blobAt(shot, echo.bearingDeg, echo.rangeM, 2 * HALF_DEG, 2 * lengthM(echo));
    const text = `${(shot.rangeM / NM).toFixed(3)} NM: the echo at ${echo.rangeM} m, ${echo.bearingDeg} deg`;
    if (echo.rangeM * (1 - HALF_LENGTH) > reachM(echo)) {
      if (found) wrong.push(`${text} is there, but no spoke went so far`);
      continue;
    }
    if (echo.rangeM * (1 + HALF_LENGTH) > reachM(echo)) continue;
    if (!found) { wrong.push(`${text} is missing`); continue; }
    const offM = found.rangeM - echo.rangeM, offDeg = ((found.bearingDeg - echo.bearingDeg + 540) % 360) - 180;
    const offPx = Math.abs(offDeg) * Math.PI / 180 * echo.rangeM / pxM;
    if (Math.abs(offM) > 0.5 * cell + 1.5 * pxM) wrong.push(`${text} is off by ${offM.toFixed(1)} m (a cell ${cell.toFixed(1)}, a pixel ${pxM.toFixed(1)})`);
    if (Math.abs(offDeg) > 0.75 && offPx > 1.5) wrong.push(`${text} is off by ${offDeg.toFixed(2)} deg`);
  }
  return { wrong, seen };
}
