// Chart: the canvas, drawn anew with the next picture of the screen whenever something on it has changed.
import { CHART_PALETTES } from './chart_palette.js';
import { ChartView } from './chart_view.js';
import { paintCoast, paintGrid, paintRain, paintScale } from './paint_ground.js';
import { paintRoute, paintShips } from './paint_ships.js';

export class Chart {
  // tools: what is planned with them is drawn too.
  constructor(canvas, exercise, coast, tools) {
    Object.assign(this, {
      canvas,
      exercise,
      coast,
      tools,
      view: new ChartView(),
      palette: 'day',
      vectorMin: 6,
      trackS: 600,
      moved: new Map(),
      drawn: 0,
    });
    this.context = canvas.getContext('2d');
    this.fitted = false;
    this.pointer = null;
    new ResizeObserver(() => this.resize()).observe(canvas.parentElement);
    this.resize();
  }

  resize() {
    const { clientWidth, clientHeight } = this.canvas.parentElement;
    this.view.width = Math.max(50, clientWidth);
    this.view.height = Math.max(50, clientHeight);
    this.pixelRatio = window.devicePixelRatio || 1;
    this.canvas.width = Math.round(this.view.width * this.pixelRatio);
    this.canvas.height = Math.round(this.view.height * this.pixelRatio);
    this.#paint();
    this.moveTo();
  }

  changed() {
    if (this.asked) return;
    this.asked = true;
    requestAnimationFrame(() => {
      this.asked = false;
      this.#paint();
    });
  }

  // The view has been changed by `move`.
  moveTo(move) {
    move?.(this.view);
    if (this.fitted) this.coast.look(this.view);
    this.changed();
  }

  fitAll() {
    const ships = this.exercise.chosen.length > 1 ? this.exercise.chosen : this.exercise.ships;
    if (ships.length === 0) return;
    this.fitted = true;
    this.moveTo((view) => view.fit(ships));
  }

  #paint() {
    const { context, view } = this,
      colours = CHART_PALETTES[this.palette];
    context.setTransform(this.pixelRatio, 0, 0, this.pixelRatio, 0, 0);
    paintCoast(context, view, this.coast, colours, this.pixelRatio);
    paintGrid(context, view, colours);
    paintRain(context, view, this.exercise.world, colours);
    paintShips(context, view, this.exercise, {
      colours,
      vectorMin: this.vectorMin,
      trackS: this.trackS,
      moved: this.moved,
    });
    this.#paintPlan(colours);
    paintScale(context, view, colours);
    this.drawn += 1;
  }

  // What a click would make: a route, a circle of rain, a cross in the middle for those who use keys.
  #paintPlan(colours) {
    const { context, view, tools } = this;
    const { waypoints, from } = tools.plan();
    if (waypoints.length > 0) {
      const end = this.pointer && tools.name === 'route' ? [view.fromPixel(this.pointer.x, this.pointer.y)] : [];
      for (const start of from.length > 0 ? from : [null])
        paintRoute(context, view, start, [...waypoints, ...end], colours.plan, { dash: [6, 4] });
    }
    const radiusPx = tools.rainRadiusM() / view.metresPerPixel;
    if (radiusPx > 0 && this.pointer) {
      context.strokeStyle = colours.plan;
      context.lineWidth = 1.3;
      context.setLineDash([6, 4]);
      context.beginPath();
      context.arc(this.pointer.x, this.pointer.y, radiusPx, 0, 2 * Math.PI);
      context.stroke();
      context.setLineDash([]);
    }
    if (tools.name === 'look' || tools.name === 'move') return;
    const [x, y] = [Math.round(view.width / 2) + 0.5, Math.round(view.height / 2) + 0.5];
    context.strokeStyle = colours.plan;
    context.lineWidth = 1;
    context.beginPath();
    for (const [dx, dy] of [
      [1, 0],
      [-1, 0],
      [0, 1],
      [0, -1],
    ]) {
      context.moveTo(x + 4 * dx, y + 4 * dy);
      context.lineTo(x + 12 * dx, y + 12 * dy);
    }
    context.stroke();
  }
}
