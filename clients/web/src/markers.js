// Markers: the cursor, the electronic bearing line (EBL) and the variable range marker (VRM), placed
// with the pointer or the arrow keys.
import { wrapDeg } from './view_geometry.js';
import { $ } from './widgets.js';

export class Markers {
  constructor(element) {
    this.pointer = null;  // { x, y } in CSS pixels of the picture, or null
    this.ebl = null;      // { bearingDeg }, true
    this.vrm = null;      // { rangeM }
    this.view = null;     // the ViewGeometry of the last frame
    this.dragging = false;

    element.addEventListener('pointermove', (event) => this.#move(event));
    element.addEventListener('pointerdown', (event) => {
      element.setPointerCapture(event.pointerId);
      this.dragging = true;
      this.#move(event);
    });
    for (const type of ['pointerup', 'pointercancel']) {
      element.addEventListener(type, () => { this.dragging = false; });
    }
    element.addEventListener('pointerleave', () => { this.pointer = null; });
    for (const name of ['ebl', 'vrm']) {
      $(name).addEventListener('change', () => this.#toggle(name, $(name).checked));
    }
  }

  #move(event) {
    this.pointer = { x: event.offsetX, y: event.offsetY };
    const at = this.at();
    if (!this.dragging || !at) return;
    if (this.ebl) this.ebl = { bearingDeg: at.bearingDeg };
    if (this.vrm) this.vrm = { rangeM: at.rangeM };
  }

  #toggle(name, on) {
    if (name === 'ebl') this.ebl = on ? { bearingDeg: wrapDeg((this.view?.upDeg ?? 0) + 45) } : null;
    if (name === 'vrm') this.vrm = on ? { rangeM: (this.view?.rangeM ?? 0) / 2 } : null;
  }

  toggle(name) {
    $(name).checked = !$(name).checked;
    this.#toggle(name, $(name).checked);
  }

  turnEbl(byDeg) {
    if (this.ebl) this.ebl = { bearingDeg: wrapDeg(this.ebl.bearingDeg + byDeg) };
  }

  moveVrm(byPart) {
    if (!this.vrm || !this.view) return;
    const rangeM = this.vrm.rangeM + byPart * this.view.rangeM;
    this.vrm = { rangeM: Math.min(this.view.rangeM, Math.max(0, rangeM)) };
  }

  // True bearing and range under the pointer; null outside the picture.
  at() {
    if (!this.pointer || !this.view || !(this.view.rangeM > 0)) return null;
    const at = this.view.fromPixel(this.pointer.x, this.pointer.y);
    return at.inside ? at : null;
  }
}
