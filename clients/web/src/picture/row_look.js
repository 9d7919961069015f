// RowLook: what of the picture depends on a row alone: how much of its echo is left (afterglow, and a sector that is missing goes out),
// how much of its trail, and the light of the sweep; worked out once a row, not once a pixel, and which rows no longer look as they
// were painted.
const SECTORS = 64;
// A row is painted anew when a byte of its look is so far off: 2 % of an echo's brightness, half a percent of the sweep's light.
const STEP = 6;
export const SWEEP_MOST = 0.25;

const smoothstep = (from, to, x) => { const t = Math.min(1, Math.max(0, (x - from) / (to - from))); return t * t * (3 - 2 * t); };

export class RowLook {
  constructor() {
    this.resize(1);
  }

  // Of so many rows, none of which is painted.
  resize(rows) {
    this.rows = rows;
    this.bytes = new Uint8Array(rows * 4);    // a row: echo, trail, sweep (1 = SWEEP_MOST), nothing
    this.painted = new Uint8Array(rows * 4);  // as they were when last painted
  }

  // look: { nowS, turnS, afterglow (0: even picture, 1: fades to a tenth within a turn), sweepRow (newest row; below 0: no sweep) }.
  update(meta, { nowS, turnS, afterglow, sweepRow }) {
    const { rows, bytes } = this;
    for (let row = 0, i = 0; row < rows; ++row, i += 4) {
      let echo = 0, trail = 0, sweep = 0;
      if (sweepRow >= 0) {
        const behindDeg = (((sweepRow - row + rows) % rows) / rows) * 360;
        if (behindDeg < 90) sweep = (0.16 * Math.exp(-behindDeg / 3) + 0.05 * Math.exp(-behindDeg / 14)) / SWEEP_MOST;
      }
      if (meta[i + 1] > 0) {
        const turns = Math.max(0, nowS - meta[i]) / turnS;
        trail = 1 - smoothstep(1.3, 2.6, turns);
        echo = trail * (1 + afterglow * (Math.exp(-2.3 * Math.min(turns, 1.3)) - 1));
      }
      bytes[i] = 255 * echo + 0.5;
      bytes[i + 1] = 255 * trail + 0.5;
      bytes[i + 2] = 255 * sweep + 0.5;
    }
  }

  // What is to be painted now, as [first, count] of rows: sectors of which a row was changed (runs, of ScanStore) or looks otherwise;
  // they count as painted then. all: every row.
  take(runs, all = false) {
    const { rows, bytes, painted } = this;
    if (all) {
      painted.set(bytes);
      return [[0, rows]];
    }
    const sectors = Math.min(SECTORS, rows), firstOf = (sector) => Math.ceil((sector * rows) / sectors);
    const due = new Uint8Array(sectors);
    for (const [first, count] of runs) {
      due.fill(1, Math.floor((first * sectors) / rows), Math.floor(((first + count - 1) * sectors) / rows) + 1);
    }
    const made = [];
    for (let sector = 0; sector < sectors; ++sector) {
      const from = firstOf(sector), to = firstOf(sector + 1);
      for (let i = 4 * from; i < 4 * to && due[sector] === 0; ++i) {
        // What has gone out leaves nothing behind.
        if (Math.abs(bytes[i] - painted[i]) > STEP || (bytes[i] === 0 && painted[i] > 0)) due[sector] = 1;
      }
      if (due[sector] === 0) continue;
      painted.set(bytes.subarray(4 * from, 4 * to), 4 * from);
      const last = made.at(-1);
      if (last && last[0] + last[1] === from) last[1] = to - last[0];
      else made.push([from, to - from]);
    }
    return made;
  }
}
