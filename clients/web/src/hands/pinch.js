// Pinch: two fingers on the picture that go apart shorten the range, that come together lengthen it. A step for every
// STEP times of their distance, so that fingers which only lie or move together change nothing.
const STEP = 1.4;
const LEAST_PX = 30;  // fingers closer than that are one

export class Pinch {
  // step(by): 1 a longer range, -1 a shorter one.
  constructor(element, step) {
    this.touches = new Map();  // pointer: place
    this.step = step;
    this.from = null;          // distance at the last step, CSS pixels
    element.addEventListener('pointerdown', (event) => this.#put(event));
    element.addEventListener('pointermove', (event) => { if (this.touches.has(event.pointerId)) this.#put(event); });
    for (const type of ['pointerup', 'pointercancel', 'lostpointercapture']) {
      element.addEventListener(type, (event) => { this.touches.delete(event.pointerId); this.from = null; });
    }
  }

  #put(event) {
    if (event.pointerType !== 'touch') return;
    this.touches.set(event.pointerId, { x: event.clientX, y: event.clientY });
    if (this.touches.size !== 2) { this.from = null; return; }
    const [a, b] = this.touches.values();
    const apart = Math.max(LEAST_PX, Math.hypot(a.x - b.x, a.y - b.y));
    this.from ??= apart;
    if (apart >= this.from * STEP) this.#stepTo(-1, apart);
    else if (apart <= this.from / STEP) this.#stepTo(1, apart);
  }

  #stepTo(by, apart) {
    this.from = apart;
    this.step(by);
  }
}
