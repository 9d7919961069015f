// The graphics over the picture, on two canvases: the graticule (rings, bearing scale), drawn when the
// view changes, and the marks (heading line, EBL, VRM, cursor, own ship), drawn when any of them moves.
import { ringsFor } from './view_geometry.js';
import { rangeNm as formatRange } from './format.js';

const RAD = Math.PI / 180;
const FONT = 'system-ui, "Segoe UI", Roboto, "DejaVu Sans", sans-serif';

export class Layer {
  constructor(canvas) {
    this.canvas = canvas;
    this.context = canvas.getContext('2d');
    this.drawn = '';
  }

  // Draws if anything that key names has changed. paint(context) works in CSS pixels.
  draw(view, key, paint) {
    const side = Math.round(view.side * view.pixelRatio);
    const full = JSON.stringify([side, view.pixelRatio, view.radius, key]);
    if (full === this.drawn) return;
    this.drawn = full;
    if (this.canvas.width !== side) this.canvas.width = this.canvas.height = side;
    const c = this.context;
    c.setTransform(view.pixelRatio, 0, 0, view.pixelRatio, 0, 0);
    c.clearRect(0, 0, view.side, view.side);
    paint(c);
  }
}

export class Overlay {
  constructor(graticule, marks) {
    this.graticule = new Layer(graticule);
    this.marks = new Layer(marks);
  }

  // look: { paletteName, palette, rangeNm, rings, headingLine, headingDeg, headUp, ebl, vrm, cursor }.
  // ebl: { bearingDeg }, vrm: { rangeM }, cursor: { x, y }; each or null.
  draw(view, look) {
    const up = look.headUp ? 0 : view.upDeg;  // head-up: the scale counts from the bow
    const font = Math.max(10, Math.min(20, view.side / 62));
    this.graticule.draw(view, [look.paletteName, look.rangeNm, look.rings, up, font], (c) => {
      if (look.rings) drawRings(c, view, look, font);
      drawScale(c, view, look, up, font);
    });
    const heading = look.headingDeg === null ? null : Math.round(look.headingDeg * 20) / 20;
    const mark = [look.paletteName, look.headingLine, heading, view.upDeg, view.rangeM, look.ebl,
                  look.vrm, look.cursor, look.headUp];
    this.marks.draw(view, mark, (c) => drawMarks(c, view, look, font));
  }
}

function drawRings(c, view, look, font) {
  if (!(look.rangeNm > 0)) return;
  const { spacingNm, count } = ringsFor(look.rangeNm);
  c.strokeStyle = look.palette.ring;
  c.lineWidth = 1;
  for (let i = 1; i < count; ++i) {
    c.beginPath();
    c.arc(view.centre, view.centre, (view.radius * i) / count, 0, 2 * Math.PI);
    c.stroke();
  }
  c.fillStyle = look.palette.ringText;
  c.font = `${font * 0.82}px ${FONT}`;
  c.textAlign = 'left';
  c.textBaseline = 'middle';
  for (let i = 1; i < count; ++i) {
    const r = (view.radius * i) / count + font * 0.35;
    c.fillText(formatRange(spacingNm * i), view.centre + r * Math.sin(40 * RAD), view.centre - r * Math.cos(40 * RAD));
  }
}

function drawScale(c, view, look, up, font) {
  const { centre, radius } = view;
  c.strokeStyle = look.palette.scale;
  c.lineWidth = 1.25;
  c.beginPath();
  c.arc(centre, centre, radius + 0.5, 0, 2 * Math.PI);
  c.stroke();
  const fine = radius > 260;
  c.lineWidth = 1;
  c.beginPath();
  for (let deg = 0; deg < 360; deg += fine ? 1 : 5) {
    const length = font * (deg % 10 === 0 ? 0.8 : deg % 5 === 0 ? 0.55 : 0.3);
    const s = Math.sin((deg - up) * RAD), k = -Math.cos((deg - up) * RAD);
    c.moveTo(centre + (radius + 1) * s, centre + (radius + 1) * k);
    c.lineTo(centre + (radius + 1 + length) * s, centre + (radius + 1 + length) * k);
  }
  c.stroke();
  c.fillStyle = look.palette.scaleText;
  c.textAlign = 'center';
  c.textBaseline = 'middle';
  for (let deg = 0; deg < 360; deg += fine ? 10 : 30) {
    const r = radius + font * 1.7;
    c.font = `${deg % 30 === 0 ? 600 : 400} ${font * (deg % 30 === 0 ? 0.95 : 0.8)}px ${FONT}`;
    c.fillText(String(deg).padStart(3, '0'), centre + r * Math.sin((deg - up) * RAD),
               centre - r * Math.cos((deg - up) * RAD));
  }
}

function drawMarks(c, view, look, font) {
  const { centre, radius, rangeM } = view;
  const { palette } = look;
  c.save();
  c.beginPath();
  c.arc(centre, centre, radius, 0, 2 * Math.PI);
  c.clip();
  const edge = (bearingDeg, colour, dash) => {
    const end = view.toPixel(bearingDeg, rangeM || 1);
    if (!(rangeM > 0)) return;
    stroke(c, colour, 1.25, dash, () => { c.moveTo(centre, centre); c.lineTo(end.x, end.y); });
  };
  if (look.ebl) edge(look.ebl.bearingDeg, palette.ebl, [font * 0.6, font * 0.35]);
  if (look.vrm && rangeM > 0) {
    stroke(c, palette.vrm, 1.25, [font * 0.6, font * 0.35], () => {
      c.arc(centre, centre, (look.vrm.rangeM / rangeM) * radius, 0, 2 * Math.PI);
    });
  }
  if (look.headingDeg !== null && look.headingLine) edge(look.headingDeg, palette.heading, []);
  const s = Math.max(3, font * 0.3);
  stroke(c, palette.ship, 1.25, [], () => {
    c.moveTo(centre - s, centre); c.lineTo(centre + s, centre);
    c.moveTo(centre, centre - s); c.lineTo(centre, centre + s);
  });
  if (look.cursor) drawCursor(c, look.cursor, palette.cursor, font);
  c.restore();
  drawNorth(c, view, palette, font);
}

function drawCursor(c, { x, y }, colour, font) {
  const inner = font * 0.45, outer = font * 1.3;
  stroke(c, colour, 1.5, [], () => {
    for (const [dx, dy] of [[1, 0], [-1, 0], [0, 1], [0, -1]]) {
      c.moveTo(x + dx * inner, y + dy * inner);
      c.lineTo(x + dx * outer, y + dy * outer);
    }
  });
}

// A small arrow on the inner edge: where true north is, whatever is up.
function drawNorth(c, view, palette, font) {
  const { centre, radius } = view;
  c.save();
  c.translate(centre, centre);
  c.rotate(-view.upDeg * RAD);
  c.fillStyle = palette.north;
  c.beginPath();
  c.moveTo(0, -radius + 1);
  c.lineTo(font * 0.38, -radius + font * 0.95);
  c.lineTo(-font * 0.38, -radius + font * 0.95);
  c.fill();
  c.restore();
}

function stroke(c, colour, width, dash, path) {
  c.strokeStyle = colour;
  c.lineWidth = width;
  c.setLineDash(dash);
  c.beginPath();
  path();
  c.stroke();
  c.setLineDash([]);
}
