// PolarPass: polar memory to a disc of the screen's pixels, as the first shader of shaders.js does it: for every
// pixel the strongest cell that its square touches. Where each pixel lies as own ship sees it is worked out once, and
// serves until she is put elsewhere; while she sails, it is worked out for the pixels that are made.
const TAU = 2 * Math.PI;
const MOST_ROWS = 32, MOST_CELLS = 20;  // as of the shader

// A pixel of the disc: echo, trail << 8, Doppler class of the strongest cell << 16, row << ROW_SHIFT.
export const ROW_SHIFT = 18;

export class PolarPass {
  // side: of the square disc, pixels.
  constructor(side) {
    this.side = side;
    this.disc = new Uint32Array(side * side);
    this.turns = new Float32Array(side * side);   // bearing from own ship, 0..1 of a turn from the top
    this.ranges = new Float32Array(side * side);  // from own ship, pixels
    this.mapped = null;                           // own ship's place that both are of
  }

  // Before pixels are made. own: as of ownOnDisc(); isNew: all pixels will be.
  begin(store, own, { upDeg, metresPerPixel }, isNew) {
    Object.assign(this, { store, own, metresPerPixel, upTurn: (((upDeg / 360) % 1) + 1) % 1 });
    if (isNew && (this.mapped === null || this.mapped.x !== own.x || this.mapped.y !== own.y)) this.#map(own);
    this.isMapped = this.mapped.x === own.x && this.mapped.y === own.y;
  }

  #map(own) {
    const { side, turns, ranges } = this, half = side / 2;
    for (let y = 0, i = 0; y < side; ++y) {
      const up = half - y - 0.5 - own.y;
      for (let x = 0; x < side; ++x, ++i) {
        const right = x + 0.5 - half - own.x, turn = Math.atan2(right, up) / TAU;
        turns[i] = turn < 0 ? turn + 1 : turn;
        ranges[i] = Math.sqrt(right * right + up * up);
      }
    }
    this.mapped = own;
  }

  // Makes the pixels from..to of line y.
  make(y, from, to) {
    const { side, disc, turns, ranges, isMapped, own, upTurn, metresPerPixel } = this;
    const { rows, cols, cells, meta, doppler, dopplerCols } = this.store;
    const half = side / 2, up = half - y - 0.5 - own.y, spread = (0.5 / TAU) * rows;
    for (let x = from, i = y * side + from; x < to; ++x, ++i) {
      let r = 0, turn = 0;
      if (isMapped) {
        r = ranges[i];
        turn = turns[i];
      } else {
        const right = x + 0.5 - half - own.x;
        r = Math.sqrt(right * right + up * up);
        turn = Math.atan2(right, up) / TAU + 1;
      }
      turn += upTurn;
      turn -= Math.floor(turn);
      const row = turn * rows;
      const halfRows = Math.min(0.5 * rows, spread / (r > 0.25 ? r : 0.25));
      const first = Math.floor(row - halfRows + 0.5);
      const count = Math.floor(row + halfRows + 0.5) - first + 1;
      const taps = count < MOST_ROWS ? count : MOST_ROWS;
      const nearM = (r > 0.5 ? r - 0.5 : 0) * metresPerPixel, farM = (r + 0.5) * metresPerPixel;
      let echo = 0, trail = 0, strongestRow = 0, strongestCell = 0;
      for (let k = 0; k < taps; ++k) {
        let at = first + (count === taps ? k : Math.floor((k * count) / taps));
        if (at < 0) at += rows;
        else if (at >= rows) at -= rows;
        const cellM = meta[4 * at + 1];
        if (!(cellM > 0)) continue;
        const a = Math.floor(nearM / cellM), last = meta[4 * at + 2] - 1;
        let b = Math.floor(farM / cellM);
        if (b > last) b = last;
        const across = b - a + 1, base = at * cols;
        const steps = across < MOST_CELLS ? across : MOST_CELLS;
        for (let j = 0; j < steps; ++j) {
          const cell = a + (across === steps ? j : Math.floor((j * across) / steps)), c = 2 * (base + cell);
          if (cells[c] > echo) {
            echo = cells[c];
            strongestRow = at;
            strongestCell = cell;
          }
          if (cells[c + 1] > trail) trail = cells[c + 1];
        }
      }
      let motion = 0;
      if (doppler !== null && echo > 0) {
        motion = (doppler[strongestRow * dopplerCols + (strongestCell >> 2)] >> (2 * (strongestCell & 3))) & 3;
      }
      let nearest = Math.floor(row + 0.5);
      if (nearest >= rows) nearest -= rows;
      disc[i] = echo | (trail << 8) | (motion << 16) | (nearest << ROW_SHIFT);
    }
  }
}
