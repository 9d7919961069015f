// ChartInput: mouse, fingers, pen and keys on the chart. Dragging pans, unless "Move" is in hand and a ship is under it.
import { keyOf } from './exercise.js';
import { fromTo } from './place.js';
import { shipAt } from './paint_ships.js';
import { wrapLongitude } from './chart_view.js';

const REACH_PX = 16,
  REACH_TOUCH_PX = 24;
const STILL_PX = 4,
  STILL_TOUCH_PX = 9;
const WHEEL = 0.0016,
  PAN_PX = 80;

export class ChartInput {
  // pointed(place or null): what is under the pointer.
  constructor(chart, exercise, tools, orders, pointed) {
    Object.assign(this, { chart, exercise, tools, orders, pointed, fingers: new Map(), drag: null });
    const { canvas } = chart;
    canvas.addEventListener('pointerdown', (event) => this.#down(event));
    canvas.addEventListener('pointermove', (event) => this.#move(event));
    canvas.addEventListener('pointerup', (event) => this.#up(event));
    canvas.addEventListener('pointercancel', (event) => this.#lost(event));
    canvas.addEventListener('lostpointercapture', (event) => this.#lost(event));
    canvas.addEventListener('pointerleave', () => {
      if (this.fingers.size === 0) this.#point(null);
    });
    canvas.addEventListener(
      'wheel',
      (event) => {
        event.preventDefault();
        const lines = event.deltaMode === 1 ? 30 : 1;
        chart.moveTo((view) => view.zoomAt(Math.exp(-event.deltaY * lines * WHEEL), event.offsetX, event.offsetY));
      },
      { passive: false },
    );
    canvas.addEventListener('contextmenu', (event) => event.preventDefault());
    canvas.addEventListener('keydown', (event) => this.#key(event));
  }

  #point(at) {
    this.chart.pointer = at;
    this.pointed(at ? this.chart.view.fromPixel(at.x, at.y) : null);
    if (this.tools.places) this.chart.changed();
  }

  #down(event) {
    if (event.button !== 0) return;
    const { canvas, view } = this.chart,
      at = { x: event.offsetX, y: event.offsetY };
    canvas.focus({ preventScroll: true });
    canvas.setPointerCapture(event.pointerId);
    this.fingers.set(event.pointerId, { ...at });
    if (this.fingers.size > 1) {
      // two fingers zoom, whatever one of them has begun
      this.#forgetDrag();
      this.pinched = true;
      return;
    }
    const touch = event.pointerType === 'touch';
    this.pinched = false;
    this.drag = {
      id: event.pointerId,
      from: at,
      still: touch ? STILL_TOUCH_PX : STILL_PX,
      reach: touch ? REACH_TOUCH_PX : REACH_PX,
      moved: false,
      ships: null,
    };
    if (this.tools.name === 'move') {
      const ship = shipAt(this.exercise, view, at.x, at.y, this.drag.reach);
      if (ship) {
        if (!this.exercise.isChosen(ship)) {
          this.exercise.select(ship, this.#adds(event));
          this.drag.hasSelected = true;
        }
        this.drag.ships = this.exercise.chosen.map((each) => ({
          key: keyOf(each),
          latitudeDeg: each.latitudeDeg,
          longitudeDeg: each.longitudeDeg,
        }));
        this.drag.place = view.fromPixel(at.x, at.y);
      }
    }
    this.#point(at);
  }

  #move(event) {
    const at = { x: event.offsetX, y: event.offsetY },
      finger = this.fingers.get(event.pointerId);
    if (!finger) {
      this.#point(at);
      return;
    }
    const { chart, drag } = this;
    if (this.fingers.size === 2) {
      const [a, b] = [...this.fingers.values()],
        before = { x: (a.x + b.x) / 2, y: (a.y + b.y) / 2 },
        span = Math.hypot(a.x - b.x, a.y - b.y);
      Object.assign(finger, at);
      const now = { x: (a.x + b.x) / 2, y: (a.y + b.y) / 2 };
      chart.moveTo((view) => {
        view.panBy(now.x - before.x, now.y - before.y);
        view.zoomAt(Math.hypot(a.x - b.x, a.y - b.y) / Math.max(1, span), now.x, now.y);
      });
      return;
    }
    if (drag?.id === event.pointerId) {
      drag.moved ||= Math.hypot(at.x - drag.from.x, at.y - drag.from.y) > drag.still;
      if (drag.moved && drag.ships) this.#carry(at);
      else if (drag.moved) chart.moveTo((view) => view.panBy(at.x - finger.x, at.y - finger.y));
    }
    if (!drag || drag.moved) Object.assign(finger, at);
    this.#point(at);
  }

  // The ships go along with the pointer; the chart stays.
  #carry(at) {
    const { drag, chart } = this,
      now = chart.view.fromPixel(at.x, at.y);
    chart.moved = new Map(
      drag.ships.map(({ key, latitudeDeg, longitudeDeg }) => [
        key,
        {
          latitudeDeg: Math.max(-89, Math.min(89, latitudeDeg + now.latitudeDeg - drag.place.latitudeDeg)),
          longitudeDeg: wrapLongitude(longitudeDeg + now.longitudeDeg - drag.place.longitudeDeg),
        },
      ]),
    );
    chart.changed();
  }

  #up(event) {
    const { drag } = this;
    if (!this.fingers.delete(event.pointerId) || drag?.id !== event.pointerId || this.pinched) return;
    this.drag = null;
    if (drag.moved && drag.ships) {
      const places = [...this.chart.moved]
        .map(([key, place]) => ({ ship: this.exercise.byKey.get(key), ...place }))
        .filter(({ ship }) => ship);
      this.orders.put(places);
      this.#forgetDrag();
    } else if (!drag.moved && !drag.hasSelected) {
      this.#tap(event, drag.from, drag.reach);
    }
    if (event.pointerType === 'touch') this.#point(null);
  }

  #lost(event) {
    this.fingers.delete(event.pointerId);
    if (this.drag?.id === event.pointerId) this.#forgetDrag();
  }

  #forgetDrag() {
    this.drag = null;
    this.chart.moved = new Map();
    this.chart.changed();
  }

  #tap(event, at, reach) {
    const { view } = this.chart;
    if (this.tools.places) {
      this.tools.act(view.fromPixel(at.x, at.y), { ...at, ms: event.timeStamp });
      return;
    }
    this.exercise.select(shipAt(this.exercise, view, at.x, at.y, reach), this.#adds(event));
  }

  #adds(event) {
    return event.shiftKey || event.ctrlKey || event.metaKey || this.exercise.grouping;
  }

  // Space acts in the middle of the chart, so that nothing needs a pointer.
  #key(event) {
    const pans = { ArrowLeft: [PAN_PX, 0], ArrowRight: [-PAN_PX, 0], ArrowUp: [0, PAN_PX], ArrowDown: [0, -PAN_PX] };
    if (event.ctrlKey || event.altKey || event.metaKey) return;
    if (pans[event.key]) this.chart.moveTo((view) => view.panBy(...pans[event.key]));
    else if (event.key === ' ' && this.tools.places)
      this.tools.act({ latitudeDeg: this.chart.view.latitudeDeg, longitudeDeg: this.chart.view.longitudeDeg });
    else if (event.key === ' ') this.#selectInMiddle();
    else if (event.key === 'Enter') this.tools.finish();
    else if (event.key === 'Backspace') this.tools.dropLast();
    else return;
    event.preventDefault();
    event.stopPropagation();
  }

  #selectInMiddle() {
    const middle = { latitudeDeg: this.chart.view.latitudeDeg, longitudeDeg: this.chart.view.longitudeDeg };
    const nearest = [...this.exercise.ships].sort((a, b) => fromTo(middle, a).metres - fromTo(middle, b).metres)[0];
    if (nearest) this.exercise.select(nearest);
  }
}
