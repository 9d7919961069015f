// PpiCanvas: the polar memory drawn as a plan position indicator by the processor, on a 2D canvas: what PpiRenderer
// draws, for browsers without WebGL2. Same two passes, same rules, no shader: canvas/polar_pass.js,
// canvas/colour_pass.js.
//
// A picture costs what has changed in it: only pixels that new spokes touch are made anew, only sectors that look
// otherwise than they were painted (row_look.js) are coloured anew, and only the boxes around these are put on the
// canvas. It costs the most when all is new (range, size, orientation): once through all pixels.
import { ColourPass } from './canvas/colour_pass.js';
import { PolarPass } from './canvas/polar_pass.js';
import { circleSpans, eachSpan } from './canvas/spans.js';
import { MAX_SPOKES } from './messages.js';
import { discFor, ownOnDisc, trailTurn, videoEnd } from './picture/disc.js';
import { RowLook } from './picture/row_look.js';

const TRAIL_STEPS = 128;  // a true trail is faded in so many
const PLACE_STEPS = 4;    // own ship's place: of a pixel, or of a cell of the true trails

export class PpiCanvas {
  kind = '2d';

  // Error: throws if the browser has no 2D canvas.
  constructor(canvas) {
    this.canvas = canvas;
    // In plain memory. With `desynchronized` a picture costs a third less, but Chromium without a graphics processor
    // shows none.
    this.context = canvas.getContext('2d', { alpha: false, willReadFrequently: true });
    if (!this.context) throw new Error('there is no 2D canvas');
    this.maxRows = MAX_SPOKES;
    this.rows = new RowLook();
    this.generation = -1;  // of the store whose shape the rows have
    this.side = this.radius = 0;
    this.drawn = null;     // what the disc was made for
    this.painted = '';     // what the whole picture was painted for
    canvas.addEventListener('contextrestored', () => { this.painted = ''; });
  }

  setEchoColours(bytes) {
    this.colours = bytes;
    this.painted = '';
  }

  // As of PpiRenderer.
  draw(store, view, look) {
    this.#fit(store, Math.round(view.side * view.pixelRatio), view.radius * view.pixelRatio);
    const runs = store.takeDirtyRuns();
    const own = ownOnDisc(view), video = videoEnd(view, look.videoM);
    const isNew = this.#makeDisc(store, view, own, runs);
    this.rows.update(store.meta, look);
    const trails = look.trueTrails && this.#trails(look, view, own);
    const place = [own.x, own.y].map((v) => Math.round(PLACE_STEPS * v));
    const key = JSON.stringify([view.rangeM, place, look.palette, look.videoM, look.echo, look.trails, trails?.key]);
    const isWhole = isNew || key !== this.painted;
    this.painted = key;
    const sectors = this.rows.take(runs, isWhole);
    if (sectors.length === 0) return;
    this.paint.begin(this.polar.disc, this.rows.bytes, look, this.colours, own, video);
    this.#colour(isWhole ? null : sectors, own, trails);
  }

  #fit(store, side, radius) {
    if (this.side !== side || this.radius !== radius) {
      Object.assign(this, { side, radius, drawn: null, painted: '' });
      this.canvas.width = this.canvas.height = side;
      this.circle = circleSpans(side, radius + 0.5);
      this.polar = new PolarPass(side);
      this.paint = new ColourPass(side, radius, this.circle, circleSpans(side, radius - 0.5));
    }
    if (this.generation !== store.generation) {
      this.rows.resize(Math.max(1, store.rows));
      this.polar.disc.fill(0);
      store.dirty.fill(1);
      this.generation = store.generation;
      this.drawn = null;
    }
  }

  // Whether the whole of it was made anew.
  #makeDisc(store, view, own, runs) {
    const wanted = discFor(view, this.drawn), isNew = !wanted.stays;
    if (!isNew && runs.length === 0) return false;
    this.drawn = wanted;
    if (store.rows === 0) return isNew;
    const { polar } = this;
    polar.begin(store, own, wanted, isNew);
    if (isNew) this.#everywhere((y, from, to) => polar.make(y, from, to));
    else this.#sectors(runs, own, (y, from, to) => polar.make(y, from, to));
    return isNew;
  }

  #everywhere(take) {
    const { circle, side } = this;
    for (let y = 0; y < side; ++y) if (circle[2 * y] < circle[2 * y + 1]) take(y, circle[2 * y], circle[2 * y + 1]);
  }

  // Where these rows lie, as [first, count]; gives the boxes around each.
  #sectors(runs, own, take) {
    const { rows } = this.rows, upTurn = this.drawn.upDeg / 360;
    const turnOf = (row) => (row - 0.5) / rows - upTurn;
    return runs
      .map(([first, count]) => eachSpan(this.circle, this.side, own, turnOf(first), turnOf(first + count), take))
      .filter((box) => box !== null);
  }

  // What the colours need of true trails; key: of what is seen of them but where spokes come. New trails are where
  // those are.
  #trails({ trueTrails, nowS, trailS }, view, own) {
    if (!trueTrails.dirty.includes(0)) this.painted = '';  // cleared, or of another range
    trueTrails.dirty.fill(0);
    const { cellM, own: ownCell, nowTick, lifeTicks } = trueTrails.look(nowS, trailS);
    const turn = trailTurn(view, cellM);
    const key = [cellM, view.upDeg, lifeTicks, ...ownCell.map((v) => Math.round(PLACE_STEPS * v)),
                 lifeTicks > 0 ? Math.floor((TRAIL_STEPS * nowTick) / lifeTicks) : 0];
    return { own, ownCell, nowTick, lifeTicks, cells: trueTrails.cells, ...turn, key };
  }

  // sectors: runs of rows; null: everywhere.
  #colour(sectors, own, trails) {
    const { paint, context } = this;
    const take = (y, from, to) => paint.colour(y, from, to, trails);
    if (sectors === null) {
      this.#everywhere(take);
      context.putImageData(paint.image, 0, 0);
      return;
    }
    const boxes = this.#sectors(sectors, own, take);
    const around = {
      left: Math.min(...boxes.map((box) => box.left)), top: Math.min(...boxes.map((box) => box.top)),
      right: Math.max(...boxes.map((box) => box.right)), bottom: Math.max(...boxes.map((box) => box.bottom)),
    };
    const area = (box) => (box.right - box.left) * (box.bottom - box.top);
    const put = boxes.reduce((sum, box) => sum + area(box), 0) < area(around) ? boxes : [around];
    for (const { left, top, right, bottom } of put) {
      context.putImageData(paint.image, 0, 0, left, top, right - left, bottom - top);
    }
  }

  // The canvas as RGBA, top row first.
  readPixels() {
    const { side } = this;
    return { width: side, height: side, data: new Uint8Array(this.context.getImageData(0, 0, side, side).data.buffer) };
  }
}
