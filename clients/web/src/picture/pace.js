// Pace: when the next picture is due. Where the browser draws with the processor alone it is drawn every EVERY_MS, so
// that spokes and other programs have their share, and at once when the operator does something; elsewhere with each
// frame.
const EVERY_MS = 1000 / 12;
const SOONER_MS = 1;  // frames do not come to the millisecond
const HANDS = ['pointerdown', 'pointermove', 'pointerup', 'keydown', 'keyup', 'input', 'change', 'click', 'wheel'];

export class Pace {
  // bySoftware(): whether the processor alone draws now; another renderer may come later.
  constructor(bySoftware, hands = document) {
    this.bySoftware = bySoftware;
    this.drawnMs = -Infinity;
    for (const kind of HANDS) hands.addEventListener(kind, () => { this.drawnMs = -Infinity; }, { capture: true, passive: true });
  }

  // To be asked once a frame; the picture is then drawn.
  isDue(nowMs) {
    if (this.bySoftware() && nowMs - this.drawnMs < EVERY_MS - SOONER_MS) return false;
    this.drawnMs = nowMs;
    return true;
  }
}
