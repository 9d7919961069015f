// MapEditor: lines and points drawn in the picture, by mouse, pen or finger. While a mode is on, what is pressed in the picture is
// its own and reaches nobody else; while none is, nothing is taken.
import { t } from '../language/language.js';
import { LocalPlane } from './earth.js';

const RAD = Math.PI / 180;
const TWICE_MS = 400, TWICE_PX = 10;
const REACH_PX = 12, COARSE_REACH_PX = 24;  // of a finger

export class MapEditor {
  // parts: items (MapItems), painter (MapPainter), now(): { view, place }, form(): { kind, text }, notify(text), changed(),
  // released(): a drag has ended.
  constructor(element, parts) {
    Object.assign(this, parts, { element, mode: 'off', draft: null, selected: null, drag: null, lastPress: null });
    const listen = (type, handler) => element.addEventListener(type, handler, { capture: true });
    listen('pointerdown', (event) => this.#press(event));
    listen('pointermove', (event) => this.#move(event));
    listen('pointerup', (event) => this.#release(event));
    listen('pointercancel', (event) => this.#release(event));
    for (const type of ['click', 'dblclick', 'contextmenu']) {
      listen(type, (event) => { if (this.mode !== 'off') event.stopImmediatePropagation(); });
    }
    window.addEventListener('keydown', (event) => this.#key(event), { capture: true });
  }

  // 'off', 'line', 'point' or 'edit'.
  setMode(mode) {
    if (mode === this.mode) return;
    this.finish();
    this.mode = mode;
    this.drag = this.lastPress = null;
    this.changed();
  }

  select(id, vertex = 0) {
    this.selected = id === null ? null : { id, vertex };
    this.changed();
  }

  // A place that was pressed or typed: the next of a line, or a point.
  put(place) {
    const wrong = this.items.refusal((this.draft?.places.length ?? 0) + 1);
    if (wrong) return this.notify(wrong);
    const { kind, text } = this.form();
    if (this.mode !== 'line') {
      this.items.add({ type: 'point', kind, text, places: [place] });
      return this.changed();
    }
    this.draft = { type: 'line', kind, places: [...(this.draft?.places ?? []), place], end: null };
    return this.changed();
  }

  // Ends the line that is being drawn; one of a single point is dropped.
  finish() {
    const draft = this.draft;
    this.draft = null;
    if (draft && draft.places.length > 1) this.items.add({ ...draft, text: this.form().text });
    this.changed();
  }

  dropLast() {
    if (!this.draft) return;
    const places = this.draft.places.slice(0, -1);
    this.draft = places.length > 0 ? { ...this.draft, places } : null;
    this.changed();
  }

  cancel() {
    this.draft = null;
    this.changed();
  }

  #placeOf(event) {
    const { view, place } = this.now();
    if (!place || !(view.rangeM > 0)) return null;
    const at = view.fromPixel(event.offsetX, event.offsetY);
    if (!at.inside) return null;
    return new LocalPlane(place).fromPlane(at.rangeM * Math.sin(at.bearingDeg * RAD), at.rangeM * Math.cos(at.bearingDeg * RAD));
  }

  #press(event) {
    if (this.mode === 'off' || event.button !== 0 || !event.isPrimary) return;
    event.stopImmediatePropagation();
    const at = { x: event.offsetX, y: event.offsetY, ms: event.timeStamp };
    const isTwice = this.lastPress && at.ms - this.lastPress.ms < TWICE_MS && Math.hypot(at.x - this.lastPress.x, at.y - this.lastPress.y) < TWICE_PX;
    this.lastPress = at;
    if (this.mode === 'edit') { this.#take(event); return; }
    if (this.mode === 'line' && isTwice && this.draft) { this.lastPress = null; this.finish(); return; }
    const place = this.#placeOf(event);
    if (place) this.put(place);
    else if (!this.now().place) this.notify(t('Own ship\u2019s position is not known: nothing can be drawn'));
  }

  // The nearest point within reach is dragged.
  #take(event) {
    const reach = event.pointerType === 'mouse' ? REACH_PX : COARSE_REACH_PX;
    let best = { px: reach, id: null, vertex: 0 };
    for (const item of this.items.items) {
      this.painter.pixelsOf(item).forEach(({ x, y }, vertex) => {
        const px = Math.hypot(x - event.offsetX, y - event.offsetY);
        if (px <= best.px) best = { px, id: item.id, vertex };
      });
    }
    this.select(best.id, best.vertex);
    if (best.id === null) return;
    this.element.setPointerCapture(event.pointerId);
    this.drag = { id: best.id, vertex: best.vertex, pointerId: event.pointerId };
  }

  #move(event) {
    if (this.mode === 'line' && this.draft && event.pointerType !== 'touch') {
      this.draft = { ...this.draft, end: this.#placeOf(event) };
      return;
    }
    if (this.drag?.pointerId !== event.pointerId) return;
    const place = this.#placeOf(event);
    if (place) this.movePoint(this.drag.id, this.drag.vertex, place);
  }

  // more: kind and text, if they change too.
  movePoint(id, vertex, place, more = {}) {
    const item = this.items.find(id);
    if (item) this.items.change(id, { ...more, places: item.places.map((each, i) => (i === vertex ? place : each)) });
  }

  #release(event) {
    if (this.drag?.pointerId !== event.pointerId) return;
    event.stopImmediatePropagation();
    this.drag = null;
    this.released();
  }

  #key(event) {
    if (this.mode === 'off' || event.ctrlKey || event.altKey || event.metaKey) return;
    if (event.target.matches?.('input:not([type=radio], [type=checkbox]), select, textarea, button, summary, a')) return;
    const keys = {
      Enter: () => this.finish(),
      Escape: () => (this.draft ? this.cancel() : this.setMode('off')),
      Backspace: () => this.dropLast(),
      Delete: () => this.removeSelected(),
    };
    const act = keys[event.key];
    if (!act || document.querySelector('dialog[open]')) return;
    act();
    event.preventDefault();
    event.stopImmediatePropagation();
  }

  removeSelected() {
    if (this.selected) this.items.remove(this.selected.id);
    this.selected = null;
    this.changed();
  }
}
