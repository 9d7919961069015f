// MapPainter: lines and points of one's own, what is being drawn, and the man overboard, on their canvas over the chart.
import { canvasLosses, layerContext, painted } from '../picture/layers.js';
import { layPlane, lieKey } from './chart_painter.js';
import { LocalPlane } from './earth.js';

const REACH_M = 5000;  // own ship from the plane's anchor
const FONT = 'system-ui, "Segoe UI", Roboto, "DejaVu Sans", sans-serif';
export const DASHES = { note: [], track: [10, 5], limit: [12, 4, 2, 4], danger: [3, 4], event: [] };

export class MapPainter {
  constructor(canvas) {
    this.canvas = canvas;
    this.context = layerContext(canvas);
    this.plane = null;
    this.laid = new WeakMap();  // item: its points on the plane
    this.lie = null;
    this.drawn = '';
  }

  // look: { paletteName, colours, lines (switch) }; draft: { type, kind, places, end: place or null } or null; selected: an id or
  // null; handles: whether the points of lines can be dragged; mob: place or null.
  draw(view, place, { items, version, draft, selected, handles, mob }, look) {
    this.lie = null;
    const c = this.context;
    const side = Math.round(view.side * view.pixelRatio);
    const isShown = place && view.rangeM > 0 && ((look.lines && items.length > 0) || draft || mob);
    if (place && view.rangeM > 0) this.#lay(place, view);
    const key = isShown
      ? JSON.stringify([canvasLosses(), side, lieKey(view, this.lie), version, draft, selected, handles, mob, look.paletteName, look.lines])
      : 'nothing';
    if (key === this.drawn) return;
    this.drawn = key;
    painted(this.canvas);
    if (this.canvas.width !== side) this.canvas.width = this.canvas.height = side;
    c.setTransform(view.pixelRatio, 0, 0, view.pixelRatio, 0, 0);
    c.clearRect(0, 0, view.side, view.side);
    if (!isShown) return;
    c.save();
    c.beginPath();
    c.arc(view.centre, view.centre, view.radius, 0, 2 * Math.PI);
    c.clip();
    const font = Math.max(11, Math.min(16, view.side / 66));
    c.font = `${font}px ${FONT}`;
    c.textBaseline = 'middle';
    c.textAlign = 'left';
    if (look.lines) for (const item of items) this.#drawItem(c, item, look.colours.mine[item.kind], { selected: item.id === selected, handles });
    if (draft) this.#drawItem(c, { ...draft, text: '', places: [...draft.places, ...(draft.end ? [draft.end] : [])] }, look.colours.mine[draft.kind], { selected: true, handles: true });
    if (mob) this.#drawMob(c, view, mob, look.colours.mob);
    c.restore();
  }

  #lay(place, view) {
    if (this.plane) {
      const { east, north } = this.plane.toPlane(place.latitudeDeg, place.longitudeDeg);
      if (Math.hypot(east, north) > REACH_M) this.plane = null;
    }
    if (!this.plane) {
      this.plane = new LocalPlane(place);
      this.laid = new WeakMap();
    }
    this.lie = layPlane(this.plane, place, view);
  }

  // Pixels of the points of an item; none while nothing can be shown.
  pixelsOf(item) {
    if (!this.lie) return [];
    let laid = this.laid.get(item);
    if (!laid) {
      laid = item.places.map(({ latitudeDeg, longitudeDeg }) => this.plane.toPlane(latitudeDeg, longitudeDeg));
      this.laid.set(item, laid);
    }
    return laid.map(({ east, north }) => this.lie.toPixel(east, north));
  }

  #drawItem(c, item, colour, { selected, handles }) {
    const at = this.pixelsOf(item);
    if (at.length === 0) return;
    c.strokeStyle = c.fillStyle = colour;
    c.lineWidth = selected ? 2.4 : 1.5;
    if (item.type === 'line') {
      c.setLineDash(DASHES[item.kind]);
      c.beginPath();
      at.forEach(({ x, y }, i) => (i === 0 ? c.moveTo(x, y) : c.lineTo(x, y)));
      c.stroke();
      c.setLineDash([]);
      if (handles) for (const { x, y } of at) c.fillRect(x - 3, y - 3, 6, 6);
    } else {
      pointSymbol(c, item.kind, at[0]);
    }
    const words = item.text || (item.utc ? item.utc.slice(11, 19) : '');
    if (words) c.fillText(words, at[0].x + 9, at[0].y - 9);
  }

  // The mark, a line to it from own ship, and where it is beyond the picture, an arrow at its edge.
  #drawMob(c, view, mob, colour) {
    const { east, north } = this.plane.toPlane(mob.latitudeDeg, mob.longitudeDeg);
    const { x, y } = this.lie.toPixel(east, north);
    c.strokeStyle = c.fillStyle = colour;
    c.lineWidth = 2;
    c.setLineDash([7, 4]);
    c.beginPath();
    c.moveTo(view.own.x, view.own.y);
    c.lineTo(x, y);
    c.stroke();
    c.setLineDash([]);
    const off = Math.hypot(x - view.centre, y - view.centre);
    if (off <= view.radius - 12) {
      c.beginPath();
      c.arc(x, y, 9, 0, 2 * Math.PI);
      c.moveTo(x - 6.4, y - 6.4); c.lineTo(x + 6.4, y + 6.4);
      c.moveTo(x + 6.4, y - 6.4); c.lineTo(x - 6.4, y + 6.4);
      c.stroke();
      c.fillText('MOB', x + 13, y);
      return;
    }
    const angle = Math.atan2(y - view.own.y, x - view.own.x);
    const edge = edgeOf(view, angle);
    c.save();
    c.translate(edge.x, edge.y);
    c.rotate(angle);
    c.beginPath();
    c.moveTo(-2, 0); c.lineTo(-18, -9); c.lineTo(-18, 9);
    c.fill();
    c.restore();
  }
}

// Where the way from own ship leaves the picture.
function edgeOf({ own, centre, radius }, angle) {
  const dx = Math.cos(angle), dy = Math.sin(angle);
  const ox = own.x - centre, oy = own.y - centre;
  const along = ox * dx + oy * dy;
  const t = -along + Math.sqrt(Math.max(0, along * along + radius * radius - ox * ox - oy * oy));
  return { x: own.x + t * dx, y: own.y + t * dy };
}

// Each kind has a shape of its own.
function pointSymbol(c, kind, { x, y }) {
  const r = 6;
  c.beginPath();
  if (kind === 'note') c.rect(x - r + 1, y - r + 1, 2 * r - 2, 2 * r - 2);
  else if (kind === 'track') c.arc(x, y, r, 0, 2 * Math.PI);
  else if (kind === 'limit') { c.moveTo(x, y - r - 1); c.lineTo(x + r + 1, y); c.lineTo(x, y + r + 1); c.lineTo(x - r - 1, y); c.closePath(); }
  else if (kind === 'danger') { c.moveTo(x, y - r - 1); c.lineTo(x + r + 1, y + r); c.lineTo(x - r - 1, y + r); c.closePath(); }
  else { c.moveTo(x, y); c.lineTo(x, y - 13); c.lineTo(x + 9, y - 9.5); c.lineTo(x, y - 6); }  // a flag
  c.stroke();
  c.beginPath();
  c.arc(x, y, 1.4, 0, 2 * Math.PI);
  c.fill();
}
