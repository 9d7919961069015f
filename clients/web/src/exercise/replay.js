// Replay: a recording as the instructor looks at it. The bar that plays it is the console's (Playback); this adds the
// marks and mishaps of the whole recording, keys, and who else moved it.
import { duration } from '../format.js';
import { Playback } from '../playback.js';
import { $ } from '../widgets.js';
import { KINDS } from './exercise_panel.js';

const STEP_S = 5,
  FAR_S = 60;
// A mark so near is the one that we stand on.
const HERE_S = 0.5;
// Longer than this between two states, beyond what was played meanwhile, is a seek.
const LEAP_S = 5;

export class Replay {
  // send(change): the request number, or null; notify(text, kind).
  constructor(send, notify) {
    Object.assign(this, { notify, marks: [], shown: '', obeyed: 0, orders: null, last: null });
    this.playback = new Playback(send, notify, () => performance.now() / 1000);
    $('replay-before').addEventListener('click', () => this.toMark(-1));
    $('replay-after').addEventListener('click', () => this.toMark(1));
    $('replay-mark').addEventListener('change', () => {
      const mark = this.marks[Number($('replay-mark').value)];
      $('replay-mark').value = '';
      if (mark) this.playback.seek(mark.positionS);
    });
    $('playback-position').addEventListener('keydown', (event) => this.#key(event));
  }

  get on() {
    return this.playback.on;
  }

  get state() {
    return this.playback.state;
  }

  greet(isPlayback) {
    this.orders = this.last = null;
    this.obeyed = 0;
    this.#showMarks([]);
    this.playback.greet(isPlayback);
  }

  take(state) {
    this.#tellOthers(state);
    this.playback.take(state);
  }

  // Two who move it at once both hear of it; the last order counts.
  #tellOthers({ orders, lastBy, positionS }) {
    const others = this.orders === null ? 0 : orders - this.orders - this.obeyed;
    if (others > 0) this.notify(`The recording was moved by ${lastBy}: ${duration(positionS)}`, 'info');
    this.obeyed = Math.max(0, -others);
    this.orders = orders;
  }

  takeReply(reply) {
    const ours = this.playback.takeReply(reply);
    if (ours && reply.code === 0) this.obeyed += 1;
    return ours;
  }

  // What the exercise's news say of the recording. Whether it was sought since the state before.
  takeExercise({ playedMarks, exerciseS, rate }) {
    this.#showMarks(playedMarks);
    const ms = performance.now(),
      last = this.last;
    this.last = { exerciseS, ms };
    if (!last || !this.on) return false;
    const played = ((ms - last.ms) / 1000) * rate * this.playback.rate;
    return exerciseS - last.exerciseS > 2 * played + LEAP_S;
  }

  toMark(direction) {
    if (!this.state) return;
    const at = this.playback.positionS();
    const mark =
      direction > 0
        ? this.marks.find(({ positionS }) => positionS > at + HERE_S)
        : this.marks.findLast(({ positionS }) => positionS < at - HERE_S);
    if (mark) this.playback.seek(mark.positionS);
    else this.notify(direction > 0 ? 'There is no mark after this' : 'There is no mark before this', 'info');
  }

  #key(event) {
    // The browser's own End stops at its last whole step.
    const signs = { ArrowRight: 1, ArrowUp: 1, ArrowLeft: -1, ArrowDown: -1, PageUp: 1, PageDown: -1, End: 1 };
    const sign = signs[event.key];
    if (!sign || !this.state || event.ctrlKey || event.altKey || event.metaKey) return;
    event.preventDefault();
    event.stopPropagation();
    const { lengthS } = this.state;
    const stepS =
      event.key === 'End' ? lengthS : event.key.startsWith('Page') ? lengthS / 10 : event.shiftKey ? FAR_S : STEP_S;
    this.playback.seek(Math.min(lengthS, Math.max(0, this.playback.positionS() + sign * stepS)));
  }

  #showMarks(marks) {
    const text = JSON.stringify([marks, this.state?.lengthS]);
    if (text === this.shown) return;
    this.shown = text;
    this.marks = marks;
    $('replay-mark').replaceChildren(
      new Option(marks.length > 0 ? `Marks (${marks.length})` : 'No marks', ''),
      ...marks.map(
        ({ positionS, kind, text }, i) => new Option(`${duration(positionS)}  ${KINDS[kind] ?? kind}: ${text}`, i),
      ),
    );
    for (const id of ['replay-mark', 'replay-before', 'replay-after']) $(id).disabled = marks.length === 0;
    $('replay-ticks').replaceChildren(...marks.map((mark) => this.#tick(mark)));
  }

  #tick({ positionS, kind }) {
    const tick = document.createElement('i');
    tick.dataset.kind = kind;
    tick.style.setProperty('--at', this.state?.lengthS > 0 ? positionS / this.state.lengthS : 0);
    return tick;
  }
}
