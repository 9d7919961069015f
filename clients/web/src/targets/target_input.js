// TargetInput: the pointer in the picture, as far as it is about targets. It is heard before the bearing line and the
// range marker, and keeps from them only what it uses: presses on a symbol, and all while it acquires or draws a zone.
import { wrapDeg } from '../view_geometry.js';
import { zoneOfDrag } from './zone_shape.js';

const REACH_PX = { mouse: 22, pen: 22, touch: 32 };
// A press that moves farther is a drag, and chooses nothing.
const STILL_PX = 10;
const LEAST_ZONE_DEG = 0.2;

export class TargetInput {
  // mode: 'select', 'acquire' or 'zone'. events: symbol(shown), acquire(place), zone(zone), draft(zone or null), narrow() (a drag
  // without a sector), isBusy() (whether another part of the console waits for a press).
  constructor(ppi, layer, events) {
    this.ppi = ppi;
    this.layer = layer;
    this.events = events;
    this.mode = 'select';
    this.view = null;
    this.press = null;
    for (const [type, take] of [['pointerdown', this.#down], ['pointermove', this.#moved], ['pointerup', this.#up], ['pointercancel', this.#cancelled],
                                ['dblclick', this.#twice]]) {
      ppi.addEventListener(type, take.bind(this), { capture: true });
    }
  }

  #at(event) {
    const box = this.ppi.getBoundingClientRect();
    return { x: event.clientX - box.left, y: event.clientY - box.top };
  }

  // True bearing and range; null outside the picture.
  #place({ x, y }) {
    if (!(this.view?.rangeM > 0)) return null;
    const place = this.view.fromPixel(x, y);
    return place.inside ? place : null;
  }

  // The nearest symbol in reach, or null.
  symbolAt({ x, y }, pointerType = 'mouse') {
    const near = this.layer.shown.map((shown) => ({ shown, px: Math.hypot(shown.x - x, shown.y - y) }))
      .filter(({ px, shown }) => px <= (REACH_PX[pointerType] ?? 22) && this.view.fromPixel(shown.x, shown.y).inside);
    near.sort((a, b) => a.px - b.px);
    return near[0]?.shown ?? null;
  }

  #down(event) {
    if (event.button !== 0 || this.press || !this.view) return;
    if (this.mode === 'select' && this.events.isBusy()) return;
    const at = this.#at(event);
    const place = this.#place(at);
    const shown = this.mode === 'select' ? this.symbolAt(at, event.pointerType) : null;
    if (this.mode === 'select' ? !shown : !place) return;
    event.stopImmediatePropagation();
    this.ppi.setPointerCapture(event.pointerId);
    this.press = { id: event.pointerId, at, place, shown, mode: this.mode, turnedDeg: 0, last: place };
  }

  #moved(event) {
    const { press } = this;
    if (!press || event.pointerId !== press.id || press.mode !== 'zone') return;
    const at = this.#at(event);
    const now = this.view.fromPixel(at.x, at.y);
    press.turnedDeg += wrapDeg(now.bearingDeg - press.last.bearingDeg + 180) - 180;
    press.last = now;
    this.events.draft(zoneOfDrag(press.place, now, press.turnedDeg));
  }

  #up(event) {
    const { press } = this;
    if (!press || event.pointerId !== press.id) return;
    this.#moved(event);
    this.press = null;
    event.stopImmediatePropagation();
    const at = this.#at(event);
    const isStill = Math.hypot(at.x - press.at.x, at.y - press.at.y) <= STILL_PX;
    if (press.mode === 'zone') {
      this.events.draft(null);
      if (isStill) return;
      // Equal ends would be all round.
      if (Math.abs(press.turnedDeg) < LEAST_ZONE_DEG) this.events.narrow();
      else this.events.zone(zoneOfDrag(press.place, press.last, press.turnedDeg));
    } else if (isStill && press.shown) {
      this.events.symbol(press.shown);
    } else if (isStill) {
      this.events.acquire(press.place);
    }
  }

  #cancelled(event) {
    if (event.pointerId !== this.press?.id) return;
    if (this.press.mode === 'zone') this.events.draft(null);
    this.press = null;
    event.stopImmediatePropagation();
  }

  #twice(event) {
    if (this.events.isBusy()) return;
    const at = this.#at(event);
    const place = this.#place(at);
    if (this.mode !== 'select' || !place || this.symbolAt(at)) return;
    event.stopImmediatePropagation();
    this.events.acquire(place);
  }
}
