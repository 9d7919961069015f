// Symbols of charted marks, simple ones after S-52, each painted once and kept as a picture. The middle of a picture is the place of
// the mark. A lateral mark is told by its shape (can or cone) as well as by its colour.
import { MARK } from './chart_wire.js';

export const SYMBOL_PX = 34;  // side of a picture, CSS pixels
const COLOURS = { 1: 'white', 2: 'black', 3: 'red', 4: 'green', 6: 'yellow' };  // of S-57
const DEFAULTS = { [MARK.SPECIAL]: 'yellow', [MARK.SAFE_WATER]: 'red', [MARK.ISOLATED_DANGER]: 'red', [MARK.LIGHT_VESSEL]: 'red' };

// The colour that tells most of a mark: red, green, yellow before black and white.
export function colourOf({ kind, colours }) {
  if (kind >= MARK.CARDINAL_NORTH && kind <= MARK.CARDINAL_WEST) return 'yellow';
  const named = colours.map((code) => COLOURS[code]).filter(Boolean);
  return named.find((name) => name !== 'white' && name !== 'black') ?? named[0] ?? DEFAULTS[kind] ?? 'plain';
}

export class Symbols {
  constructor() {
    this.kept = new Map();
    this.for = '';
  }

  // A canvas with the symbol of a mark, of SYMBOL_PX * pixelRatio.
  of(mark, paletteName, colours, pixelRatio) {
    if (this.for !== `${paletteName} ${pixelRatio}`) {
      this.for = `${paletteName} ${pixelRatio}`;
      this.kept.clear();
    }
    const colour = colourOf(mark);
    const key = `${mark.kind} ${colour} ${mark.fixed} ${mark.light !== ''} ${mark.racon}`;
    let canvas = this.kept.get(key);
    if (!canvas) {
      canvas = document.createElement('canvas');
      canvas.width = canvas.height = Math.round(SYMBOL_PX * pixelRatio);
      const c = canvas.getContext('2d');
      c.scale(pixelRatio, pixelRatio);
      c.translate(SYMBOL_PX / 2, SYMBOL_PX / 2);
      paint(c, mark, colours, colours[colour]);
      this.kept.set(key, canvas);
    }
    return canvas;
  }
}

function shape(c, points, fill = true) {
  c.beginPath();
  points.forEach(([x, y], i) => (i === 0 ? c.moveTo(x, y) : c.lineTo(x, y)));
  c.closePath();
  if (fill) c.fill();
  c.stroke();
}
function ball(c, y, r = 3.2) {
  c.beginPath();
  c.arc(0, y, r, 0, 2 * Math.PI);
  c.fill();
  c.stroke();
}
const up = (c, y) => shape(c, [[-4, y], [4, y], [0, y - 6]]);
const down = (c, y) => shape(c, [[-4, y - 6], [4, y - 6], [0, y]]);
const can = (c) => shape(c, [[-3.6, -4], [3.6, -4], [3.6, -12], [-3.6, -12]]);
const cone = (c) => shape(c, [[-4.6, -4], [4.6, -4], [0, -13]]);

// Above the place, on a stem.
const HEADS = {
  [MARK.LATERAL_PORT]: can,
  [MARK.PREFERRED_STARBOARD]: can,
  [MARK.LATERAL_STARBOARD]: cone,
  [MARK.PREFERRED_PORT]: cone,
  [MARK.CARDINAL_NORTH]: (c) => { up(c, -4); up(c, -10.5); },
  [MARK.CARDINAL_EAST]: (c) => { down(c, -4); up(c, -10.5); },
  [MARK.CARDINAL_SOUTH]: (c) => { down(c, -4); down(c, -10.5); },
  [MARK.CARDINAL_WEST]: (c) => { up(c, -4); down(c, -10.5); },
  [MARK.ISOLATED_DANGER]: (c) => { ball(c, -6); ball(c, -12.8); },
  [MARK.SAFE_WATER]: (c) => ball(c, -8, 4),
  [MARK.SPECIAL]: (c) => stroke(c, 1.8, [[-4, -12], [4, -4]], [[4, -12], [-4, -4]]),
  [MARK.LIGHT_VESSEL]: (c) => shape(c, [[-9, -7], [9, -7], [6, -2], [-6, -2]]),
};

function stroke(c, width, ...lines) {
  c.lineWidth = width;
  c.beginPath();
  for (const [[x0, y0], [x1, y1]] of lines) { c.moveTo(x0, y0); c.lineTo(x1, y1); }
  c.stroke();
}

function paint(c, { kind, fixed, light, racon }, colours, colour) {
  c.strokeStyle = c.fillStyle = colour;
  c.lineJoin = 'round';
  c.lineWidth = 1;
  if (kind === MARK.WRECK) {
    c.strokeStyle = colours.danger;
    stroke(c, 1.4, [[-8, 0], [8, 0]], [[-4.5, -3], [-4.5, 3]], [[0, -5], [0, 5]], [[4.5, -3], [4.5, 3]]);
  } else if (kind === MARK.OBSTRUCTION) {
    c.strokeStyle = c.fillStyle = colours.danger;
    c.setLineDash([1.5, 2]);
    c.beginPath();
    c.arc(0, 0, 5, 0, 2 * Math.PI);
    c.stroke();
    c.setLineDash([]);
    c.fillRect(-1, -1, 2, 2);
  } else if (kind === MARK.ROCK) {
    c.strokeStyle = colours.danger;
    stroke(c, 1.4, [[-5, 0], [5, 0]], [[0, -5], [0, 5]]);
  } else if (kind === MARK.LIGHT || kind === MARK.RACON) {
    c.fillStyle = colours.plain;
    ball(c, 0, 1.6);
  } else {
    stroke(c, 1.4, [[0, 0], [0, -5]]);
    c.lineWidth = 1;
    (HEADS[kind] ?? ((head) => ball(head, -8, 3)))(c);
    c.strokeStyle = colours.plain;
    // A beacon stands on a foot; a buoy swims on a circle. Either way the place is its middle.
    if (fixed) stroke(c, 1.4, [[-4, 0], [4, 0]]);
    else { c.lineWidth = 1.2; c.beginPath(); c.arc(0, 0, 2, 0, 2 * Math.PI); c.stroke(); }
  }
  if (light) flare(c, colours.light);
  if (racon) {
    c.strokeStyle = colours.light;
    c.setLineDash([2.5, 2]);
    c.lineWidth = 1;
    c.beginPath();
    c.arc(0, 0, 13, 0, 2 * Math.PI);
    c.stroke();
    c.setLineDash([]);
  }
}

// A light: a drop that points at the place, from below and the right.
function flare(c, colour) {
  c.fillStyle = colour;
  c.beginPath();
  c.moveTo(2, 2);
  c.quadraticCurveTo(8, 5, 12, 12);
  c.quadraticCurveTo(5, 8, 2, 2);
  c.fill();
}
