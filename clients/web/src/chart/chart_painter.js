// ChartPainter: the loaded chart on its canvas, under the rings and over the echoes.
import { canvasLosses, layerContext, painted } from '../picture/layers.js';
import { SYMBOL_PX, Symbols } from './symbols.js';

const RAD = Math.PI / 180;
// The picture is drawn anew when something in it has moved by so much.
const STEP_PX = 0.25;
const FONT = 'system-ui, "Segoe UI", Roboto, "DejaVu Sans", sans-serif';
const LABELS_PX = 90;  // a contour's depth stands on it every so many pixels, at most
const MOST_LABELS = 80;

// From own ship to the furthest point that is shown, metres.
export function reachOf(view) {
  const { own, centre, radius, rangeM } = view;
  return ((radius + Math.hypot(own.x - centre, own.y - centre)) / radius) * rangeM;
}

// How a plane lies on the view: pixels of a point, CSS pixels, and the canvas transform of the same.
export function layPlane(plane, place, view) {
  const at = plane.toPlane(place.latitudeDeg, place.longitudeDeg);
  const scale = view.radius / view.rangeM;
  const turn = (view.upDeg + plane.northDeg(place.latitudeDeg, place.longitudeDeg)) * RAD;
  const cos = Math.cos(turn) * scale, sin = Math.sin(turn) * scale;
  const { x, y } = view.own;
  return {
    ...at, scale, cos, sin,
    toPixel: (east, north) => ({
      x: x + (east - at.east) * cos - (north - at.north) * sin,
      y: y - (east - at.east) * sin - (north - at.north) * cos,
    }),
    // Of points (east, -north), as paths have them.
    transform: (pixelRatio) => [
      cos * pixelRatio, -sin * pixelRatio, sin * pixelRatio, cos * pixelRatio,
      (x - at.east * cos + at.north * sin) * pixelRatio, (y + at.east * sin + at.north * cos) * pixelRatio,
    ],
  };
}

// The same while nothing has moved by STEP_PX.
export function lieKey(view, lie) {
  const steps = (px) => Math.round(px / STEP_PX);
  return [view.side, view.pixelRatio, view.radius, view.rangeM, view.own.x, view.own.y, steps(view.upDeg * RAD * view.radius),
          steps(lie.east * lie.scale), steps(lie.north * lie.scale)];
}

export class ChartPainter {
  constructor(canvas) {
    this.canvas = canvas;
    this.context = layerContext(canvas);
    this.symbols = new Symbols();
    this.drawn = '';
    this.lie = null;  // how the chart lies on the view; null: nothing is shown
    this.times = { frames: 0, lastMs: 0 };
  }

  // look: { paletteName, colours, coast, contours, buoys (switches) }; colours go with the palette. loaded: LoadedChart or null; place: own ship or null.
  draw(view, loaded, place, look) {
    const shows = loaded && place && view.rangeM > 0 && (look.coast || look.contours || look.buoys);
    this.lie = null;
    if (!shows) { this.#clear(); return; }
    const laidAnew = loaded.layAbout(place);
    const lie = layPlane(loaded.plane, place, view);
    this.lie = lie;
    const key = JSON.stringify([canvasLosses(), lieKey(view, lie), look.paletteName, look.coast, look.contours, look.buoys]);
    if (key === this.drawn && !laidAnew) return;
    this.drawn = key;
    painted(this.canvas);
    const began = performance.now();
    this.#paint(view, loaded, lie, look);
    this.times.frames += 1;
    this.times.lastMs = performance.now() - began;
  }

  // Another chart: what is drawn is of the one before.
  forget() {
    this.drawn = '';
  }

  #clear() {
    if (this.drawn === 'nothing') return;
    this.drawn = 'nothing';
    painted(this.canvas);
    this.context.setTransform(1, 0, 0, 1, 0, 0);
    this.context.clearRect(0, 0, this.canvas.width, this.canvas.height);
  }

  #paint(view, loaded, lie, look) {
    const c = this.context;
    const side = Math.round(view.side * view.pixelRatio);
    if (this.canvas.width !== side) this.canvas.width = this.canvas.height = side;
    c.setTransform(view.pixelRatio, 0, 0, view.pixelRatio, 0, 0);
    c.clearRect(0, 0, view.side, view.side);
    c.save();
    c.beginPath();
    c.arc(view.centre, view.centre, view.radius, 0, 2 * Math.PI);
    c.clip();
    const paths = loaded.pathsFor(1 / (lie.scale * view.pixelRatio), lie.east, lie.north, reachOf(view));
    c.setTransform(...lie.transform(view.pixelRatio));
    c.lineJoin = 'round';
    const line = (path, colour, widthPx, dashPx = []) => {
      c.strokeStyle = colour;
      c.lineWidth = widthPx / lie.scale;
      c.setLineDash(dashPx.map((px) => px / lie.scale));
      c.stroke(path);
    };
    if (look.contours) {
      line(paths.deep, look.colours.deep, 1);
      line(paths.shoal, look.colours.shoal, 1.4);
    }
    if (look.coast) line(paths.coast, look.colours.coast, 1.6);
    c.setTransform(view.pixelRatio, 0, 0, view.pixelRatio, 0, 0);
    if (look.contours) this.#labelDepths(c, view, loaded, lie, look);
    if (look.buoys) this.#drawMarks(c, view, loaded, lie, look);
    c.restore();
  }

  #drawMarks(c, view, loaded, lie, look) {
    const half = SYMBOL_PX / 2;
    for (const mark of loaded.marks) {
      const { x, y } = lie.toPixel(mark.east, mark.north);
      if (!isIn(view, x, y, half)) continue;
      // On whole pixels of the device, so that a symbol stays sharp.
      const snap = (px) => Math.round((px - half) * view.pixelRatio) / view.pixelRatio;
      c.drawImage(this.symbols.of(mark, look.paletteName, look.colours.buoy, view.pixelRatio), snap(x), snap(y), SYMBOL_PX, SYMBOL_PX);
    }
  }

  #labelDepths(c, view, loaded, lie, look) {
    const font = Math.max(9, Math.min(14, view.side / 80));
    c.font = `${font}px ${FONT}`;
    c.textAlign = 'center';
    c.textBaseline = 'middle';
    c.fillStyle = look.colours.text;
    const taken = [];
    for (const line of loaded.lines) {
      if (line.kind === 0 || taken.length >= MOST_LABELS) continue;
      if (Math.hypot(line.box.east - line.box.west, line.box.north - line.box.south) * lie.scale < LABELS_PX) continue;
      const middle = 2 * Math.floor(line.plane.length / 4);
      const { x, y } = lie.toPixel(line.plane[middle], line.plane[middle + 1]);
      if (!isIn(view, x, y, 0) || taken.some((at) => Math.hypot(at.x - x, at.y - y) < LABELS_PX / 2)) continue;
      taken.push({ x, y });
      c.fillText(String(Number(line.depthM.toFixed(1))), x, y);
    }
  }
}

const isIn = (view, x, y, marginPx) => Math.hypot(x - view.centre, y - view.centre) <= view.radius + marginPx;
