// The graphics over the picture, on two canvases: the graticule (rings, bearing scale), drawn when the
// view changes, and the marks (heading line, measuring tools, cursor, own ship), drawn when any of them moves.
import { drawScale } from './picture/bearing_scale.js';
import { drawTools } from './picture/draw_tools.js';
import { canvasLosses, layerContext, painted } from './picture/layers.js';
import { drawOwnShip } from './picture/own_ship_symbol.js';
import { ringsFor } from './view_geometry.js';
import { rangeNm as formatRange } from './format.js';

const RAD = Math.PI / 180;
export const FONT = 'system-ui, "Segoe UI", Roboto, "DejaVu Sans", sans-serif';

export class Layer {
  constructor(canvas) {
    this.canvas = canvas;
    this.context = layerContext(canvas);
    this.drawn = '';
  }

  // Draws if anything that key names has changed. paint(context) works in CSS pixels.
  draw(view, key, paint) {
    const side = Math.round(view.side * view.pixelRatio);
    const full = JSON.stringify([side, canvasLosses(), view.pixelRatio, view.radius, view.ownAt, key]);
    if (full === this.drawn) return;
    this.drawn = full;
    if (this.canvas.width !== side) this.canvas.width = this.canvas.height = side;
    const c = this.context;
    c.setTransform(view.pixelRatio, 0, 0, view.pixelRatio, 0, 0);
    c.clearRect(0, 0, view.side, view.side);
    paint(c);
    painted(this.canvas);
  }
}

export class Overlay {
  constructor(graticule, marks) {
    this.graticule = new Layer(graticule);
    this.marks = new Layer(marks);
  }

  // look: { paletteName, palette, rangeNm, rings, scaleUpDeg (what the scale shows at the top), headingLine, sternMarks, bowDeg, ship
  // (OwnShip or null), pxPerMm (of the screen), brilliance (percent by layer), shapes (of tool_geometry.js), active, measured, cursor: { x, y } or null }.
  draw(view, look) {
    const font = Math.max(10, Math.min(20, view.side / 62));
    const { rings, scale } = look.brilliance;
    this.graticule.draw(view, [look.paletteName, look.rangeNm, look.rings, look.scaleUpDeg, font, rings, scale], (c) => {
      c.globalAlpha = rings / 100;
      if (look.rings) drawRings(c, view, look, font);
      c.globalAlpha = scale / 100;
      drawScale(c, view, look, font, FONT);
    });
    const { lengthM, beamM } = look.ship ?? {};
    const mark = [look.paletteName, look.headingLine, look.sternMarks, Math.round(look.bowDeg * 20) / 20, view.upDeg, view.rangeM,
                  lengthM, beamM, look.brilliance, look.shapes, look.active, look.measured, look.cursor, look.pxPerMm];
    this.marks.draw(view, mark, (c) => drawMarks(c, view, look, font));
  }
}

// Around own ship. In an off-centre view they go on to the farthest edge.
function drawRings(c, view, look, font) {
  if (!(look.rangeNm > 0)) return;
  const { spacingNm, count } = ringsFor(look.rangeNm);
  const { centre, radius, own } = view;
  const off = Math.hypot(own.x - centre, own.y - centre);
  c.strokeStyle = look.palette.ring;
  c.lineWidth = 1;
  c.save();
  c.beginPath();
  c.arc(centre, centre, radius, 0, 2 * Math.PI);
  c.clip();
  const last = Math.ceil(((radius + off) / radius) * count - 0.001);
  for (let i = 1; i < last; ++i) {
    c.beginPath();
    c.arc(own.x, own.y, (radius * i) / count, 0, 2 * Math.PI);
    c.stroke();
  }
  c.fillStyle = look.palette.ringText;
  c.font = `${font * 0.82}px ${FONT}`;
  c.textAlign = 'left';
  c.textBaseline = 'middle';
  // Towards the far side, so that every ring there is has its number.
  const angle = off > 1 ? Math.atan2(centre - own.x, own.y - centre) + 0.12 : 40 * RAD;
  for (let i = 1; i < last; ++i) {
    const r = (radius * i) / count + font * 0.35;
    c.fillText(formatRange(spacingNm * i), own.x + r * Math.sin(angle), own.y - r * Math.cos(angle));
  }
  c.restore();
}

function drawMarks(c, view, look, font) {
  const { centre, radius, own } = view;
  const { palette, brilliance } = look;
  c.save();
  c.beginPath();
  c.arc(centre, centre, radius, 0, 2 * Math.PI);
  c.clip();
  c.globalAlpha = brilliance.marks / 100;
  drawTools(c, { ...look, font });
  c.globalAlpha = brilliance.heading / 100;
  const edge = (bearingDeg, colour, dash) => {
    const r = view.edgePx(bearingDeg), angle = (bearingDeg - view.upDeg) * RAD;
    stroke(c, colour, 1.25, dash, () => {
      c.moveTo(own.x, own.y);
      c.lineTo(own.x + r * Math.sin(angle), own.y - r * Math.cos(angle));
    });
  };
  if (look.bowDeg !== null && look.headingLine) edge(look.bowDeg, palette.heading, []);
  if (look.bowDeg !== null && look.sternMarks) edge(look.bowDeg + 180, palette.heading, [font * 0.2, font * 0.5]);
  c.globalAlpha = 1;
  drawOwnShip(c, view, look, font);
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
  const { own } = view;
  const r = view.edgePx(0), angle = -view.upDeg * RAD;
  c.save();
  c.translate(own.x + r * Math.sin(angle), own.y - r * Math.cos(angle));
  c.rotate(angle);
  c.fillStyle = palette.north;
  c.beginPath();
  c.moveTo(0, 1);
  c.lineTo(font * 0.38, font * 0.95);
  c.lineTo(-font * 0.38, font * 0.95);
  c.fill();
  c.restore();
}

export function stroke(c, colour, width, dash, path) {
  c.strokeStyle = colour;
  c.lineWidth = width;
  c.setLineDash(dash);
  c.beginPath();
  path();
  c.stroke();
  c.setLineDash([]);
}
