// Pace: when the next picture is due. Where the browser draws with the processor alone it is drawn MOST_PER_S times a second, so
// that spokes and other programs have their share, and at once when the operator does something; elsewhere with each frame.
import { drawsInSoftware } from './layers.js';

const MOST_PER_S = 12;
const SOONER_MS = 1;  // frames do not come to the millisecond
const HANDS = ['pointerdown', 'pointermove', 'pointerup', 'keydown', 'keyup', 'input', 'change', 'click', 'wheel'];

export class Pace {
  constructor(everyMs = drawsInSoftware() ? 1000 / MOST_PER_S : 0, hands = document) {
    this.everyMs = everyMs;
    this.drawnMs = -Infinity;
    for (const kind of HANDS) hands.addEventListener(kind, () => { this.drawnMs = -Infinity; }, { capture: true, passive: true });
  }

  // To be asked once a frame; the picture is then drawn.
  isDue(nowMs) {
    if (nowMs - this.drawnMs < this.everyMs - SOONER_MS) return false;
    this.drawnMs = nowMs;
    return true;
  }
}
