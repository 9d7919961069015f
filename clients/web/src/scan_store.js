// ScanStore: the polar picture in memory, as the renderer uploads it.
//
// Row r holds what was seen at TRUE bearing r / rows of a turn, so that a turning ship does not smear
// its picture. Each row keeps the cell size and the time it was painted with: after a change of range
// the old rows are still drawn where they belong until the antenna has passed over them.
// Two bytes a cell: the echo, and the trail: 255 where an echo is (the echo is drawn there), 254 when it has gone, and
// it fades with time.
// Doppler classes, if spokes have them, lie beside it: two bits a cell.
import { MAX_CELLS, MAX_SPOKES } from './messages.js';

const TURN = 4294967296;
// Echoes at least this strong leave a trail; receiver noise must not.
const TRAIL_THRESHOLD = 112;
// A turning ship makes the antenna skip rows. So many are filled from their neighbour; more is a jump
// of the heading, not a turn.
const MAX_FILL = 6;
const HERE = 255, GONE = 254;  // the trail's byte

export class ScanStore {
  // maxRows: of the renderer's textures. Above it neighbouring spokes share a row, the stronger wins.
  constructor(maxRows = MAX_SPOKES) {
    this.maxRows = maxRows;
    this.generation = 0;  // grows when rows and cols change
    this.trailS = 0;      // seconds a trail lives; 0: none, below 0: it stays
    this.resize(0, 0);
  }

  resize(rows, cols) {
    this.rows = rows;
    this.cols = cols;
    this.cells = new Uint8Array(rows * cols * 2);
    this.meta = new Float32Array(rows * 4);  // time s, cell size m (0: never painted), cells, scan
    this.dirty = new Uint8Array(rows);
    this.scratch = new Uint8Array(cols);
    this.dopplerCols = (cols + 3) >> 2;
    this.doppler = null;  // until a spoke has any
    this.generation += 1;
    this.lastRow = -1;
  }

  clear() {
    this.cells.fill(0);
    this.doppler?.fill(0);
    this.meta.fill(0);
    this.dirty.fill(1);
    this.lastRow = -1;
  }

  // follows: whether no spoke is missing between this one and the one before.
  put(spoke, nowS, follows) {
    const rows = Math.min(spoke.spokesPerTurn, this.maxRows);
    const cols = Math.min(spoke.cellCount, MAX_CELLS);
    if (rows !== this.rows || cols !== this.cols) this.resize(rows, cols);

    if (spoke.doppler?.length > 0 && this.doppler === null) {
      this.doppler = new Uint8Array(rows * this.dopplerCols);
      this.generation += 1;
    }

    const bearing = (Math.floor((spoke.index * TURN) / spoke.spokesPerTurn) + spoke.heading) % TURN;
    const row = Math.floor((bearing * rows) / TURN + 0.5) % rows;
    const step = follows && this.lastRow >= 0 ? (row - this.lastRow + rows) % rows : 1;
    this.#paint(row, spoke, nowS, step === 0);
    if (step > 1 && step <= MAX_FILL) {
      for (let i = 1; i < step; ++i) this.#copy(row, (this.lastRow + i) % rows);
    }
    this.lastRow = row;
  }

  #paint(row, spoke, nowS, merge) {
    const { cells, meta, cols, scratch } = this;
    const base = row * cols * 2;
    const oldCellSize = meta[row * 4 + 1];
    const cellSize = Math.fround(spoke.cellSizeM);
    const fade = this.#fade(meta[row * 4], nowS);
    if (oldCellSize !== cellSize) this.#rescaleTrail(base, oldCellSize, cellSize);

    if (spoke.bits === 8) {
      scratch.set(spoke.cells);
    } else {
      for (let c = 0; c < cols; ++c) {
        const byte = spoke.cells[c >> 1];
        scratch[c] = ((c & 1) === 0 ? byte & 15 : byte >> 4) * 17;
      }
    }
    const keepOld = merge && oldCellSize === cellSize;
    for (let c = 0, i = base; c < cols; ++c, i += 2) {
      const echo = keepOld && cells[i] > scratch[c] ? cells[i] : scratch[c];
      const trail = cells[i + 1] - fade;
      cells[i] = echo;
      cells[i + 1] = this.trailS !== 0 && echo >= TRAIL_THRESHOLD ? HERE : trail > 0 ? Math.min(trail, GONE) : 0;
    }
    if (this.doppler) this.#paintDoppler(row, spoke.doppler);
    meta[row * 4] = nowS;
    meta[row * 4 + 1] = cellSize;
    meta[row * 4 + 2] = cols;
    meta[row * 4 + 3] = spoke.scan;
    this.dirty[row] = 1;
  }

  // If two spokes share a row, the classes of the newer one stay.
  #paintDoppler(row, classes) {
    const at = row * this.dopplerCols;
    if (classes?.length > 0) this.doppler.set(classes.subarray(0, this.dopplerCols), at);
    else this.doppler.fill(0, at, at + this.dopplerCols);
  }

  // By whole steps of the clock, so that a trail of half an hour, whose step is longer than a turn, fades as it should.
  #fade(fromS, toS) {
    if (this.trailS === 0) return 255;
    if (this.trailS < 0) return 0;
    const steps = (s) => Math.round((255 * s) / this.trailS);
    return Math.min(255, Math.max(0, steps(toS) - steps(fromS)));
  }

  #rescaleTrail(base, oldCellSize, cellSize) {
    const { cells, cols, scratch } = this;
    const ratio = oldCellSize > 0 ? cellSize / oldCellSize : Infinity;
    for (let c = 0; c < cols; ++c) {
      const end = Math.min(cols, Math.ceil((c + 1) * ratio));
      let most = 0;
      for (let from = c > 0 ? Math.floor(c * ratio) : 0; from < end; ++from) {
        most = Math.max(most, cells[base + 2 * from + 1]);
      }
      scratch[c] = most;
    }
    for (let c = 0; c < cols; ++c) cells[base + 2 * c + 1] = scratch[c];
  }

  #copy(from, to) {
    const { cells, meta, cols } = this;
    cells.copyWithin(to * cols * 2, from * cols * 2, (from + 1) * cols * 2);
    meta.copyWithin(to * 4, from * 4, (from + 1) * 4);
    this.doppler?.copyWithin(to * this.dopplerCols, from * this.dopplerCols, (from + 1) * this.dopplerCols);
    this.dirty[to] = 1;
  }

  // The rows painted since the last call, as [first, count] from north clockwise.
  takeDirtyRuns() {
    const runs = [];
    for (let r = this.dirty.indexOf(1); r >= 0; r = this.dirty.indexOf(1, r)) {
      let end = this.dirty.indexOf(0, r);
      if (end < 0) end = this.rows;
      runs.push([r, end - r]);
      if (end === this.rows) break;
      r = end;
    }
    this.dirty.fill(0);
    return runs;
  }
}

// Which turns were received whole.
export class ScanTracker {
  constructor() {
    this.reset();
  }

  reset() {
    this.current = null;  // { scan, spokes, spokesPerTurn, rangeNm, lastIndex, mixed }
    this.last = null;     // the newest turn that was received whole
  }

  take(spoke) {
    if (this.current === null || this.current.scan !== spoke.scan) {
      this.current = { scan: spoke.scan, spokes: 0, spokesPerTurn: spoke.spokesPerTurn,
                       cellSizeM: spoke.cellSizeM, cells: spoke.cellCount, mixed: false };
    }
    const now = this.current;
    now.spokes += 1;
    if (now.cellSizeM !== spoke.cellSizeM) now.mixed = true;
    if (spoke.index === spoke.spokesPerTurn - 1 && now.spokes === spoke.spokesPerTurn) {
      this.last = { scan: now.scan, spokes: now.spokes, cells: now.cells, mixedRanges: now.mixed,
                    rangeM: now.cells * spoke.cellSizeM, headingDeg: (spoke.heading * 360) / TURN };
    }
  }
}
