// AlertSound: an alarm is three short beeps every seven seconds, a warning two a minute, a caution is silent. Nothing is heard
// until the operator has allowed it: browsers play no sound before, and a room of consoles should not.
import { ALARM, WARNING } from '../targets/wire.js';

const PATTERNS = {
  [ALARM]: { beeps: 3, everyMs: 7000, hz: 2400 },
  [WARNING]: { beeps: 2, everyMs: 60000, hz: 1200 },
};
const BEEP_S = 0.12, GAP_S = 0.13, LOUDNESS = 0.25;

export class AlertSound {
  // makeContext(): an AudioContext. nowMs(): of a clock that never goes back.
  constructor(makeContext = () => new AudioContext(), nowMs = () => performance.now()) {
    this.makeContext = makeContext;
    this.nowMs = nowMs;
    this.isAllowed = false;
    this.context = null;
    this.calling = null;   // the priority that sounds, or null
    this.since = '';       // which alerts call: new ones are heard at once
    this.lastMs = -Infinity;
    this.beeps = 0;        // that were sounded
  }

  // Whether sound can be had. Must be called by what the operator pressed.
  allow(on) {
    this.isAllowed = false;
    if (!on) return true;
    try {
      this.context ??= this.makeContext();
      this.#resume();
      this.isAllowed = true;
      this.lastMs = -Infinity;
    } catch {
      return false;
    }
    return true;
  }

  // priority: the highest that calls, or null; which: names the alerts that do.
  call(priority, which) {
    const calling = PATTERNS[priority] ? priority : null;
    if (calling !== this.calling || (calling !== null && which !== this.since)) this.lastMs = -Infinity;
    this.calling = calling;
    this.since = which;
    this.tick();
  }

  // To be called several times a second.
  tick() {
    const pattern = PATTERNS[this.calling];
    const now = this.nowMs();
    if (!this.isAllowed || !pattern || now - this.lastMs < pattern.everyMs) return;
    // While the browser plays nothing its clock stands: tones would pile up and come all at once.
    if (this.context.state === 'suspended' || this.context.state === 'interrupted') { this.#resume(); return; }
    this.lastMs = now;
    for (let i = 0; i < pattern.beeps; ++i) this.#beep(this.context.currentTime + i * (BEEP_S + GAP_S), pattern.hz);
    this.beeps += pattern.beeps;
  }

  #resume() {
    this.context.resume()?.catch?.(() => {});  // it may only be had after another press
  }

  #beep(at, hz) {
    const tone = this.context.createOscillator(), volume = this.context.createGain();
    tone.frequency.value = hz;
    // Without edges, so that it does not click.
    volume.gain.setValueAtTime(0, at);
    volume.gain.linearRampToValueAtTime(LOUDNESS, at + 0.01);
    volume.gain.setValueAtTime(LOUDNESS, at + BEEP_S - 0.01);
    volume.gain.linearRampToValueAtTime(0, at + BEEP_S);
    tone.connect(volume).connect(this.context.destination);
    tone.start(at);
    tone.stop(at + BEEP_S);
  }
}
