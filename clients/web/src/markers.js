// Markers: the cursor, and the hand that moves the measuring tools and own ship with mouse, pen or fingers.
//
// A press takes the marker under it, or in free picture places the active EBL and VRM. Two fingers move own ship. A mode
// gives the press another meaning until it is left:
//   'off-centre'  own ship shall be there
//   'measure'     from there to the next press
//   'origin'      the active EBL and VRM begin there
// In the mode 'cursor' presses mean what they do without a mode: it is keys that move the cursor then.
import { grabbed, shapesOf } from './picture/tool_geometry.js';
import { inFrame, originFrom, trueBearing } from './picture/tools.js';
import { placeAt } from './picture/places.js';
import { wrapDeg } from './view_geometry.js';

const MOUSE_PX = 12, TOUCH_PX = 22;
const RAD = Math.PI / 180;

export class Markers {
  // tools: Tools; events: putOwn({ x, y }) in parts of the radius from the centre, moveOwn({ x, y }) from where
  // she is, modeChanged(mode), told(text).
  constructor(element, tools, events) {
    this.tools = tools;
    this.events = events;
    this.pointer = null;   // { x, y } in CSS pixels of the picture, or null
    this.view = null;      // the ViewGeometry of the last frame
    this.now = { bowDeg: 0, ownPlace: null };
    this.mode = null;
    this.measured = null;  // { from, to } as origins of tools.js; to: null while the second point is awaited
    this.held = null;      // what a press has taken: { ebl, vrm, line, end }
    this.fingers = new Map();

    element.addEventListener('pointermove', (event) => this.#move(event));
    element.addEventListener('pointerdown', (event) => {
      element.setPointerCapture(event.pointerId);
      this.#press(event);
    });
    for (const type of ['pointerup', 'pointercancel']) element.addEventListener(type, (event) => this.#release(event));
    // A finger that is lifted leaves the cursor where it was: beneath it nobody sees what is read.
    element.addEventListener('pointerleave', (event) => { if (event.pointerType !== 'touch') this.pointer = null; });
  }

  setMode(mode) {
    this.mode = this.mode === mode ? null : mode;
    if (mode !== 'measure' || this.mode === null) this.measured = null;
    this.events.modeChanged(this.mode);
  }

  get shapes() {
    return this.view ? shapesOf(this.tools, this.view, this.now) : { ebls: [], vrms: [], lines: [] };
  }

  // True bearing and range under the pointer; null outside the picture.
  at() {
    if (!this.pointer || !this.view || !(this.view.rangeM > 0)) return null;
    const at = this.view.fromPixel(this.pointer.x, this.pointer.y);
    return at.inside ? at : null;
  }

  // Where that is on the earth; null if own ship's place is not known.
  placeOf({ bearingDeg, rangeM }) {
    return this.now.ownPlace ? placeAt(this.now.ownPlace, bearingDeg, rangeM) : null;
  }

  #press(event) {
    this.pointer = { x: event.offsetX, y: event.offsetY };
    if (event.pointerType === 'touch') {
      this.fingers.set(event.pointerId, { x: event.clientX, y: event.clientY });
      if (this.fingers.size === 2) { this.#spread(); return; }
    }
    const at = this.at();
    if (!at) return;
    if (this.mode && this.mode !== 'cursor') { this.#choose(at); return; }
    const { tools } = this;
    this.before = structuredClone({ ebls: tools.ebls, vrms: tools.vrms, lines: tools.lines });
    const reachPx = event.pointerType === 'touch' ? TOUCH_PX : MOUSE_PX;
    const taken = grabbed(this.shapes, this.pointer, reachPx);
    const isFree = taken.ebl === null && taken.vrm === null && taken.line === null;
    this.held = isFree ? { ebl: tools.active, vrm: tools.active, line: null } : taken;
    if (!isFree && taken.line === null) tools.activate(taken.ebl ?? taken.vrm);
    if (taken.line !== null) this.held.end = this.#endUnder(taken.line, reachPx);
    // A marker that is taken stays where it is until the hand moves.
    if (isFree) this.#drag(event, at);
  }

  // Two fingers: what the first one did was not meant.
  #spread() {
    if (this.held && this.before) {
      Object.assign(this.tools, this.before);
      this.tools.changed(false);
    }
    this.held = null;
  }

  #move(event) {
    const finger = this.fingers.get(event.pointerId);
    if (finger && this.fingers.size === 2 && this.view) {
      const { radius } = this.view;
      // Half, as there are two that move.
      const by = { x: (event.clientX - finger.x) / radius / 2, y: (finger.y - event.clientY) / radius / 2 };
      Object.assign(finger, { x: event.clientX, y: event.clientY });
      this.pointer = null;
      this.events.moveOwn(by);
      return;
    }
    this.pointer = { x: event.offsetX, y: event.offsetY };
    const at = this.at();
    if (this.held && at) this.#drag(event, at);
  }

  #release(event) {
    this.fingers.delete(event.pointerId);
    if (this.held) this.tools.changed();
    this.held = null;
  }

  #drag(event, at) {
    const { tools, view, held, pointer } = this;
    const from = (n) => {
      const origin = originFrom(tools.ebls[n].origin, this.now.ownPlace);
      return origin && view.toPixel(origin.bearingDeg, origin.rangeM);
    };
    const ebl = held.ebl === null ? null : tools.ebls[held.ebl], vrm = held.vrm === null ? null : tools.vrms[held.vrm];
    if (ebl?.on) {
      const centre = from(held.ebl);
      if (centre) {
        const deg = wrapDeg(Math.atan2(pointer.x - centre.x, centre.y - pointer.y) / RAD + view.upDeg);
        tools.set('ebls', held.ebl, { bearingDeg: inFrame(ebl.frame, deg, this.now.bowDeg) }, false);
      }
    }
    if (vrm?.on) {
      const centre = from(held.vrm);
      if (centre) {
        const rangeM = (Math.hypot(pointer.x - centre.x, pointer.y - centre.y) / view.radius) * view.rangeM;
        tools.set('vrms', held.vrm, { rangeM }, false);
      }
    }
    if (held.line !== null) this.#dragLine(event, at);
  }

  // The line follows; with Shift it turns about own ship; held at an end, that end follows.
  #dragLine(event, at) {
    const { tools, held, now } = this;
    const line = tools.lines[held.line];
    const bearing = trueBearing(line, now.bowDeg);
    const off = (at.bearingDeg - bearing) * RAD;
    const along = at.rangeM * Math.cos(off), athwart = at.rangeM * Math.sin(off);
    if (held.end) {
      tools.set('lines', held.line, { [held.end]: along }, false);
    } else if (event.shiftKey) {
      const rest = at.rangeM ** 2 - line.offsetM ** 2;
      if (rest <= 0) return;
      const s = Math.sign(along || 1) * Math.sqrt(rest);
      const turned = wrapDeg(at.bearingDeg - Math.atan2(line.offsetM, s) / RAD);
      tools.set('lines', held.line, { bearingDeg: inFrame(line.frame, turned, now.bowDeg) }, false);
    } else {
      tools.set('lines', held.line, { offsetM: athwart }, false);
    }
  }

  // 'fromM' or 'toM' if the line ends there, in the picture.
  #endUnder(n, reachPx) {
    const { tools, pointer, view } = this;
    const shape = this.shapes.lines.find((s) => s.n === n);
    const near = (p) => Math.hypot(p.x - pointer.x, p.y - pointer.y) <= reachPx;
    const inside = (p) => Math.hypot(p.x - view.centre, p.y - view.centre) < view.radius - 1;
    if (tools.lines[n].toM !== null && near(shape.to) && inside(shape.to)) return 'toM';
    if (tools.lines[n].fromM !== null && near(shape.from) && inside(shape.from)) return 'fromM';
    return null;
  }

  #choose(at) {
    const { tools, view, pointer } = this;
    const point = this.placeOf(at) ?? { bearingDeg: at.bearingDeg, rangeM: at.rangeM };
    if (this.mode === 'off-centre') {
      this.events.putOwn({ x: (pointer.x - view.centre) / view.radius, y: (view.centre - pointer.y) / view.radius });
      this.setMode(null);
    } else if (this.mode === 'origin') {
      const ebl = tools.ebls[tools.active];
      const isCarried = ebl.origin?.rangeM !== undefined;
      tools.set('ebls', tools.active, { origin: isCarried ? { bearingDeg: at.bearingDeg, rangeM: at.rangeM } : point });
      this.setMode(null);
    } else if (this.measured && this.measured.to === null) {
      this.measured.to = point;
    } else {
      this.measured = { from: point, to: null };
    }
  }

  // What is measured, to the pointer while the second point is awaited: { from, to } in pixels, bearingDeg, rangeM; or null.
  measurement() {
    if (!this.measured || !this.view) return null;
    const from = originFrom(this.measured.from, this.now.ownPlace);
    const to = this.measured.to ? originFrom(this.measured.to, this.now.ownPlace) : this.at();
    if (!from || !to) return null;
    const east = to.rangeM * Math.sin(to.bearingDeg * RAD) - from.rangeM * Math.sin(from.bearingDeg * RAD);
    const north = to.rangeM * Math.cos(to.bearingDeg * RAD) - from.rangeM * Math.cos(from.bearingDeg * RAD);
    return {
      from: this.view.toPixel(from.bearingDeg, from.rangeM), to: this.view.toPixel(to.bearingDeg, to.rangeM),
      bearingDeg: wrapDeg(Math.atan2(east, north) / RAD), rangeM: Math.hypot(east, north),
    };
  }

  // By keys: so many pixels to the right and down, from own ship if there is no cursor; not beyond the picture.
  moveCursor({ x, y }) {
    const { view } = this;
    if (!view) return;
    const from = this.pointer ?? view.own;
    const off = { x: from.x + x - view.centre, y: from.y + y - view.centre };
    const least = Math.min(1, (view.radius - 1) / Math.hypot(off.x, off.y));
    this.pointer = { x: view.centre + off.x * least, y: view.centre + off.y * least };
  }

  // By keys: the active ones.
  turnEbl(byDeg) {
    const { tools } = this;
    const ebl = tools.ebls[tools.active];
    if (ebl.on) tools.set('ebls', tools.active, { bearingDeg: wrapDeg(ebl.bearingDeg + byDeg) });
  }

  moveVrm(byPart) {
    const { tools, view } = this;
    const vrm = tools.vrms[tools.active];
    if (!vrm.on || !view) return;
    const most = Math.max(view.rangeM * 1.75, vrm.rangeM);
    tools.set('vrms', tools.active, { rangeM: Math.min(most, Math.max(0, vrm.rangeM + byPart * view.rangeM)) });
  }
}
