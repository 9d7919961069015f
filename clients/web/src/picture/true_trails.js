// TrueTrails: where echoes were on the earth (or on the water), so that what lies still leaves no trail however own
// ship moves or turns.
//
// A square of SIDE cells, north up, that wraps around: cell (i, j) holds every place whose column is i and row is j modulo SIDE, and
// only what lies within SIDE / 2 cells of own ship is kept. As she moves, nothing is shifted: the columns and rows that come into
// reach are emptied. Each cell holds when the last strong echo was there, in ticks of TICK_S, 0: never; so the trails'
// length may change without losing any. A change of range keeps what it shows, as finely as it was.
import { MAX_CELLS } from '../messages.js';

export const SIDE = 1024;
export const TILE = 64;        // what is uploaded at a time
const TILES = SIDE / TILE;
const TICK_S = 0.5;
const REACH = 1.75;            // ranges from own ship: across the picture when she is farthest out
const TRAIL_THRESHOLD = 112;   // as of ScanStore: receiver noise leaves none
const MOST_TICKS = 60000, REBASE_TICKS = 30000;
const UNITS_TO_RAD = (2 * Math.PI) / 4294967296;
const wrap = (i) => i & (SIDE - 1);

export class TrueTrails {
  constructor() {
    this.cells = new Uint16Array(SIDE * SIDE);
    this.dirty = new Uint8Array(TILES * TILES).fill(1);
    this.cellM = 0;      // side of a cell; 0: no range yet
    this.beginS = 0;     // when tick 1 was
    this.column = 0;     // own ship's cell
    this.row = 0;
    this.motion = { eastM: 0, northM: 0, jumps: 0 };
  }

  clear() {
    this.cells.fill(0);
    this.dirty.fill(1);
  }

  setRange(rangeM) {
    const cellM = (2 * REACH * rangeM) / SIDE;
    if (!(cellM > 0) || cellM === this.cellM) return;
    const ratio = this.cellM > 0 ? cellM / this.cellM : 0;
    const old = this.cells, column = this.column, row = this.row;
    this.cellM = cellM;
    this.column = Math.floor(this.motion.eastM / cellM);
    this.row = Math.floor(this.motion.northM / cellM);
    this.cells = new Uint16Array(SIDE * SIDE);
    this.dirty.fill(1);
    if (ratio > 0) this.#rescale(old, column, row, ratio);
  }

  // Of a coarser cell the latest of the finer ones that begin in it.
  #rescale(old, column, row, ratio) {
    const half = SIDE / 2;
    const step = Math.min(1, ratio);  // of the old cells, fine enough for the smaller of both
    const reach = Math.floor(Math.min(half, half * ratio) / step);
    for (let j = -reach; j < reach; ++j) {
      const oldRow = wrap(row + Math.floor(j * step)) * SIDE;
      const newRow = wrap(this.row + Math.floor((j * step) / ratio)) * SIDE;
      for (let i = -reach; i < reach; ++i) {
        const tick = old[oldRow + wrap(column + Math.floor(i * step))];
        const at = newRow + wrap(this.column + Math.floor((i * step) / ratio));
        if (tick > this.cells[at]) this.cells[at] = tick;
      }
    }
  }

  // motion: OwnMotion. rows: spokes a turn, so that no gap is left between them.
  put(spoke, nowS, motion) {
    if (!(this.cellM > 0)) return;
    if (motion.jumps !== this.motion.jumps) this.clear();
    this.#moveTo(motion);
    const tick = this.tick(nowS);
    const bearing = (spoke.index / spoke.spokesPerTurn) * 2 * Math.PI + spoke.heading * UNITS_TO_RAD;
    const sin = Math.sin(bearing), cos = Math.cos(bearing);
    const perCell = spoke.cellSizeM / this.cellM;  // cells of the square along a cell of the spoke
    const count = Math.min(spoke.cellCount, MAX_CELLS, Math.floor((SIDE / 2 - 2) / perCell));
    const east = motion.eastM / this.cellM, north = motion.northM / this.cellM;
    const halfStep = Math.PI / spoke.spokesPerTurn;
    const eightBits = spoke.bits === 8;
    let next = 0;  // along the spoke, in cells of the square
    for (let c = 0; c < count; ++c) {
      const echo = eightBits ? spoke.cells[c] : ((c & 1) === 0 ? spoke.cells[c >> 1] & 15 : spoke.cells[c >> 1] >> 4) * 17;
      if (echo < TRAIL_THRESHOLD) continue;
      const r = (c + 0.5) * perCell;
      if (r < next) continue;
      next = r + 0.7;
      const across = Math.floor(r * halfStep);
      for (let a = -across; a <= across; ++a) {
        this.#mark(Math.floor(east + r * sin + a * cos), Math.floor(north + r * cos - a * sin), tick);
      }
    }
  }

  #mark(column, row, tick) {
    const i = wrap(column), j = wrap(row);
    this.cells[j * SIDE + i] = tick;
    this.dirty[(j >> 6) * TILES + (i >> 6)] = 1;
  }

  // Ticks at nowS; long after the begin the old ones are moved, and what is older than 4 h becomes as old as can be told.
  tick(nowS) {
    if (this.beginS === 0) this.beginS = nowS;
    const tick = Math.floor((nowS - this.beginS) / TICK_S) + 1;
    if (tick <= MOST_TICKS) return Math.max(1, tick);
    const { cells } = this;
    for (let i = 0; i < cells.length; ++i) if (cells[i] > 0) cells[i] = Math.max(1, cells[i] - REBASE_TICKS);
    this.beginS += REBASE_TICKS * TICK_S;
    this.dirty.fill(1);
    return this.tick(nowS);
  }

  // What the renderer needs to find a place: own ship in the square, now and the length of a trail in ticks (below 0: permanent).
  look(nowS, trailS) {
    const own = (m) => { const at = m / this.cellM; return at - Math.floor(at / SIDE) * SIDE; };
    return {
      cellM: this.cellM, own: [own(this.motion.eastM), own(this.motion.northM)],
      nowTick: (nowS - this.beginS) / TICK_S + 1, lifeTicks: trailS / TICK_S,
    };
  }

  #moveTo({ eastM, northM, jumps }) {
    this.motion = { eastM, northM, jumps };
    const column = Math.floor(eastM / this.cellM), row = Math.floor(northM / this.cellM);
    this.#enter(this.column, column, (i) => this.#emptyColumn(i));
    this.#enter(this.row, row, (j) => this.#emptyRow(j));
    this.column = column;
    this.row = row;
  }

  // Calls empty(index) for each that comes into reach on the way.
  #enter(from, to, empty) {
    const steps = Math.min(SIDE, Math.abs(to - from)), way = Math.sign(to - from);
    for (let k = 1; k <= steps; ++k) empty(wrap(from + way * (k + SIDE / 2) - (way < 0 ? 0 : 1)));
  }

  #emptyColumn(i) {
    for (let j = 0; j < SIDE; ++j) this.cells[j * SIDE + i] = 0;
    for (let t = 0; t < TILES; ++t) this.dirty[t * TILES + (i >> 6)] = 1;
  }

  #emptyRow(j) {
    this.cells.fill(0, j * SIDE, (j + 1) * SIDE);
    this.dirty.fill(1, (j >> 6) * TILES, (j >> 6) * TILES + TILES);
  }

  // Tiles changed since the last call, as [column, row] of their first cell.
  takeDirtyTiles() {
    const tiles = [];
    for (let t = this.dirty.indexOf(1); t >= 0; t = this.dirty.indexOf(1, t + 1)) {
      tiles.push([(t % TILES) * TILE, Math.floor(t / TILES) * TILE]);
    }
    this.dirty.fill(0);
    return tiles;
  }
}
