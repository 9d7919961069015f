// Compares a captured canvas with the bare cells of the same turn, both laid on one polar grid.
import { echoColours, PALETTES } from '../../../clients/web/src/palette.js';
import { angleBetween, isEcho, placeOf } from './measure.mjs';

const DEG = 0.25, PERCENT = 0.25;  // of a bin; per cent of the range scale
const BEARINGS = 360 / DEG, RANGES = 100 / PERCENT;
// So many bins apart lies within 1 deg and 1 % whatever the place in the bin.
const BEARING_TOLERANCE = 1 / DEG - 1, RANGE_TOLERANCE = 1 / PERCENT - 1;
// A coast is at least so deep: 1.5 % of the range scale.
const DEPTH = 6;

// The weakest cell that the console draws as what measure.isEcho() calls an echo.
export function echoThreshold() {
  const colours = echoColours('yellow');
  const sea = PALETTES.day.sea.map((v) => v * 255);
  for (let v = 0; v < 256; ++v) {
    const alpha = colours[4 * v + 3] / 255;
    const data = Uint8Array.from([0, 1, 2].map((c) => sea[c] + alpha * (colours[4 * v + c] - sea[c])).concat(255));
    if (isEcho({ width: 1, data }, 0.5, 0.5)) return v;
  }
  throw new Error('no echo is bright enough to be seen');
}

// PGM (P5, maxval 255 or 15) as `skerry snapshot --raw` writes it: a row per spoke, from the bow.
export function parsePgm(bytes) {
  const head = /^P5\n(\d+) (\d+)\n(\d+)\n/.exec(bytes.subarray(0, 64).toString('latin1'));
  if (!head) throw new Error('not a PGM');
  const [cells, spokes, top] = head.slice(1).map(Number);
  const data = bytes.subarray(head[0].length);
  if (data.length !== cells * spokes) throw new Error(`${data.length} bytes for ${cells} x ${spokes}`);
  return { cells, spokes, scale: top === 15 ? 17 : 1, data };
}

class PolarMask {
  constructor() {
    this.bins = new Uint8Array(BEARINGS * RANGES);
  }
  set(b, r) {
    if (r >= 0 && r < RANGES) this.bins[(((b % BEARINGS) + BEARINGS) % BEARINGS) * RANGES + r] = 1;
  }
  get(b, r) {
    return r >= 0 && r < RANGES ? this.bins[(((b % BEARINGS) + BEARINGS) % BEARINGS) * RANGES + r] : 0;
  }
  count() {
    return this.bins.reduce((a, v) => a + v, 0);
  }
  near(b, r, acrossBins) {
    for (let i = -acrossBins; i <= acrossBins; ++i) {
      for (let j = -RANGE_TOLERANCE; j <= RANGE_TOLERANCE; ++j) if (this.get(b + i, r + j)) return true;
    }
    return false;
  }
  // First range of an echo DEPTH bins deep.
  edge(b) {
    for (let r = 0, run = 0; r < RANGES; ++r) {
      run = this.get(b, r) ? run + 1 : 0;
      if (run === DEPTH) return r - DEPTH + 1;
    }
    return null;
  }
}

// mask, and what lies within one pixel of it: the canvas shows every cell that a pixel touches, so it
// holds all of the mask and nothing but this.
function widened(mask, shot) {
  const wide = new PolarMask();
  const pixelRanges = Math.ceil(RANGES / (shot.radiusPx * shot.pixelRatio));
  for (let r = 0; r < RANGES; ++r) {
    const across = Math.min(BEARINGS / 2, 2 * halfPixelBins(shot, r));
    for (let b = 0; b < BEARINGS; ++b) {
      if (!mask.get(b, r)) continue;
      for (let i = -across; i <= across; ++i) {
        for (let j = -pixelRanges; j <= pixelRanges; ++j) wide.set(b + i, r + j);
      }
    }
  }
  return wide;
}

// How many bearing bins half a pixel is wide at range bin r.
const halfPixelBins = (shot, r) =>
  Math.ceil((Math.atan2(0.71 / shot.pixelRatio, ((r + 0.5) / RANGES) * shot.radiusPx) * 180 / Math.PI) / DEG);

export function maskOfCanvas(shot) {
  const mask = new PolarMask();
  for (let y = 0; y < shot.width; ++y) {
    for (let x = 0; x < shot.width; ++x) {
      if (!isEcho(shot, x + 0.5, y + 0.5)) continue;
      const { bearingDeg, rangeM } = placeOf(shot, x + 0.5, y + 0.5);
      const pixelM = shot.rangeM / shot.radiusPx / shot.pixelRatio;
      const half = Math.min(BEARINGS / 2, (Math.atan2(pixelM / 2, rangeM) * 180 / Math.PI) / DEG);
      const b = bearingDeg / DEG;
      for (let i = Math.floor(b - half); i <= Math.floor(b + half); ++i) {
        const from = Math.floor(((rangeM - pixelM / 2) / shot.rangeM) * RANGES), to = Math.floor(((rangeM + pixelM / 2) / shot.rangeM) * RANGES);
        for (let r = Math.max(0, from); r <= to; ++r) mask.set(i, r);
      }
    }
  }
  return mask;
}

export function maskOfScan(scan, headingDeg, threshold) {
  const mask = new PolarMask();
  for (let b = 0; b < BEARINGS; ++b) {
    const from = Math.round(((b * DEG - headingDeg + 720) / 360) * scan.spokes);
    const to = Math.round((((b + 1) * DEG - headingDeg + 720) / 360) * scan.spokes);
    for (let row = from; row <= to; ++row) {
      const base = (row % scan.spokes) * scan.cells;
      for (let c = 0; c < scan.cells; ++c) {
        if (scan.data[base + c] * scan.scale < threshold) continue;
        const last = Math.max(Math.floor((c / scan.cells) * RANGES), Math.ceil(((c + 1) / scan.cells) * RANGES) - 1);
        for (let r = Math.floor((c / scan.cells) * RANGES); r <= last; ++r) mask.set(b, r);
      }
    }
  }
  return mask;
}

// Echoes that stand alone: small, and with open water around them.
function blobsOf(mask) {
  const seen = new Uint8Array(BEARINGS * RANGES);
  const blobs = [];
  for (let b = 0; b < BEARINGS; ++b) {
    for (let r = 0; r < RANGES; ++r) {
      if (!mask.get(b, r) || seen[b * RANGES + r]) continue;
      const bins = [], todo = [[b, r]];
      seen[b * RANGES + r] = 1;
      while (todo.length > 0) {
        const [x, y] = todo.pop();
        bins.push([x, y]);
        for (const [i, j] of [[1, 0], [-1, 0], [0, 1], [0, -1], [1, 1], [1, -1], [-1, 1], [-1, -1]]) {
          const at = (((x + i) % BEARINGS + BEARINGS) % BEARINGS) * RANGES + y + j;
          if (!mask.get(x + i, y + j) || seen[at]) continue;
          seen[at] = 1;
          todo.push([x + i, y + j]);
        }
      }
      blobs.push(bins);
    }
  }
  return blobs.map(boxOf).filter((box) => box.bins >= 4 && box.b1 - box.b0 <= 6 / DEG && box.r1 - box.r0 <= 4 / PERCENT &&
    box.r0 > 5 / PERCENT && box.r1 < RANGES - 2 / PERCENT && sumIn(mask, box, 6).bins === box.bins);
}

function boxOf(bins) {
  const b = bins.map(([x]) => x), r = bins.map(([, y]) => y);
  return { bins: bins.length, b0: Math.min(...b.slice(0, 50000)), b1: Math.max(...b.slice(0, 50000)),
           r0: Math.min(...r.slice(0, 50000)), r1: Math.max(...r.slice(0, 50000)) };
}

function sumIn(mask, box, margin) {
  let bins = 0, b = 0, r = 0;
  for (let i = box.b0 - margin; i <= box.b1 + margin; ++i) {
    for (let j = box.r0 - margin; j <= box.r1 + margin; ++j) {
      if (!mask.get(i, j)) continue;
      bins += 1;
      b += i + 0.5;
      r += j + 0.5;
    }
  }
  return { bins, bearingDeg: (b / bins) * DEG, rangePercent: (r / bins) * PERCENT };
}

// How canvas and scan differ. missing: bins of the scan's echoes that the canvas lacks within 1 deg and
// 1 %; extra: the other way round, and within a pixel, which near the centre is many degrees wide; edges: bearings with a coast in both; edgesOff: of those, where its
// leading edge is further off than what a pixel touches explains, and where (edgesAlike) the first echo
// DEPTH deep is the same in both; blobs and blobsOff: the same of echoes that stand alone.
export function compare(shot, scan, headingDeg) {
  const threshold = echoThreshold();
  const canvas = maskOfCanvas(shot), truth = maskOfScan(scan, headingDeg, threshold);
  const out = { canvasBins: canvas.count(), scanBins: truth.count(), missing: 0, extra: 0, edges: 0, edgesOff: 0, edgesAlike: 0,
                worstEdgePercent: 0, blobs: 0, blobsOff: 0, worstBlobDeg: 0, worstBlobPercent: 0 };
  for (let b = 0; b < BEARINGS; ++b) {
    for (let r = 0; r < RANGES; ++r) {
      if (truth.get(b, r) && !canvas.near(b, r, BEARING_TOLERANCE)) out.missing += 1;
      if (canvas.get(b, r) && !truth.near(b, r, BEARING_TOLERANCE + 2 * halfPixelBins(shot, r))) out.extra += 1;
    }
  }
  compareEdges(canvas, truth, widened(truth, shot), out);
  for (const box of blobsOf(truth)) {
    const want = sumIn(truth, box, 0), got = sumIn(canvas, box, 6);
    out.blobs += 1;
    const deg = angleBetween(got.bearingDeg, want.bearingDeg), percent = Math.abs(got.rangePercent - want.rangePercent);
    if (got.bins === 0 || deg > 1 || percent > 1) { out.blobsOff += 1; continue; }
    out.worstBlobDeg = Math.max(out.worstBlobDeg, deg);
    out.worstBlobPercent = Math.max(out.worstBlobPercent, percent);
  }
  return out;
}

function compareEdges(canvas, truth, wide, out) {
  const edges = (mask) => Array.from({ length: BEARINGS }, (_, b) => mask.edge(b));
  const seen = edges(canvas), latest = edges(truth), earliest = edges(wide);
  const around = (list, b) => {
    const part = [];
    for (let i = -BEARING_TOLERANCE; i <= BEARING_TOLERANCE; ++i) part.push(list[(b + i + BEARINGS) % BEARINGS]);
    return part;
  };
  for (let b = 0; b < BEARINGS; ++b) {
    const known = around(latest, b);
    if (seen[b] === null || known.includes(null)) continue;  // open sea, or the end of a coast
    const near = Math.min(...around(earliest, b)), far = Math.max(...known);
    out.edges += 1;
    const off = Math.max(near - seen[b], seen[b] - far, 0);
    out.worstEdgePercent = Math.max(out.worstEdgePercent, off * PERCENT);
    if (off > RANGE_TOLERANCE) out.edgesOff += 1;
    if (Math.min(...known.map((e) => Math.abs(e - seen[b]))) <= RANGE_TOLERANCE) out.edgesAlike += 1;
  }
}

// Compares canvas and scan. Gives the reasons why they are not.
export function differences(result) {
  const allowed = Math.round(result.scanBins * 0.001);  // heading is known per turn, not per spoke
  // Where an echo is just about DEPTH bins deep, the rounding of one bin decides whether it is an edge.
  const allowedEdges = Math.ceil(result.edges * 0.001);
  const reasons = [];
  if (result.scanBins < 500 || result.canvasBins < 500) reasons.push('empty');
  if (result.missing > allowed) reasons.push(`${result.missing} echoes missing`);
  if (result.extra > allowed) reasons.push(`${result.extra} echoes too many`);
  if (result.edgesOff > allowedEdges) reasons.push(`${result.edgesOff} of ${result.edges} edges off`);
  if (result.blobsOff > 0) reasons.push(`${result.blobsOff} of ${result.blobs} targets off`);
  return reasons;
}
