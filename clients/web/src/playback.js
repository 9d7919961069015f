// Playback: what comes was recorded; where in it we are, and how it is played. Of the console and the instructor's
// page.
import { t } from './language/language.js';
import { $ } from './widgets.js';
import { duration, utcClock } from './format.js';

const RATES = [0.1, 0.25, 0.5, 1, 2, 5, 10, 20, 50, 100];
const rateText = (rate) => `${Number(rate.toFixed(2))}×`;

function write(id, text) {
  if ($(id).textContent !== text) $(id).textContent = text;
}

export class Playback {
  // send(change): the request number, or null; the names are those of the message Playback.
  // notify(text, kind): to the operator. seconds(): of a clock that never goes back.
  constructor(send, notify, seconds) {
    this.send = send;
    this.notify = notify;
    this.seconds = seconds;
    this.state = null;
    this.pending = null;  // the last request, until it is answered
    this.asked = null;  // what it asks for
    this.on = false;
    $('playback-play').addEventListener('click', () => this.toggle());
    $('playback-back').addEventListener('click', () => this.step(-1));
    $('playback-forward').addEventListener('click', () => this.step(1));
    $('playback-rate').addEventListener('change', () => this.#ask({ rate: Number($('playback-rate').value) }));
    $('playback-loop').addEventListener('change', () => this.#ask({ loop: $('playback-loop').checked }));
    $('playback-mark').addEventListener('change', () => this.#toMark());
    const slider = $('playback-position');
    slider.addEventListener('input', () => { this.dragged = slider.valueAsNumber; this.showPosition(); });
    slider.addEventListener('change', () => {
      this.dragged = null;
      this.seek(slider.valueAsNumber);
    });
    this.dragged = null;  // where the operator holds the slider, seconds
  }

  get isPaused() {
    return this.state !== null && !this.state.playing;
  }
  // How many times faster than it was recorded.
  get rate() {
    return this.state?.rate > 0 ? this.state.rate : 1;
  }

  toggle() {
    if (this.state) this.#ask({ playing: !this.state.playing });
  }

  step(turns) {
    if (this.state) this.#ask({ stepTurns: turns });
  }

  seek(positionS) {
    this.#ask({ positionS });
    if (this.state && this.pending !== null) {
      this.state = { ...this.state, positionS };
      this.takenS = this.seconds();
    }
    this.showPosition();
  }

  // Chosen by its place, because marks may share a name.
  #toMark() {
    const mark = this.state?.marks[Number($('playback-mark').value)];
    $('playback-mark').value = '';
    if (mark) this.seek(mark.positionS);
  }

  #ask(change) {
    this.asked = change;
    this.pending = this.send(change);
    if (this.pending === null) this.notify(t('Not connected: nothing was sent to the playback'), 'error');
  }

  // Whether the reply is ours. What was refused is shown by others; the server's state rules again. What was granted
  // is shown at once: the state that tells of it comes after the reply.
  takeReply(reply) {
    if (this.pending === null || reply.request !== this.pending) return false;
    this.pending = null;
    if (!this.state) return true;
    if (reply.code === 0) {
      const { rate = this.state.rate, loop = this.state.loop, playing = this.state.playing } = this.asked;
      this.#take({ ...this.state, rate, loop, playing, positionS: this.positionS() });
    }
    this.#show();
    return true;
  }

  // Another server, or the same one after a break.
  greet(isPlayback) {
    this.on = isPlayback;
    this.state = null;
    this.pending = this.dragged = null;
    document.documentElement.toggleAttribute('data-playback', isPlayback);
    $('playback').hidden = $('playback-sign').hidden = !isPlayback;
  }

  take(state) {
    const before = this.state;
    this.#take(state);
    if (!before) {
      this.greet(true);
      this.state = state;
    }
    this.#show();
  }

  #take(state) {
    this.state = state;
    this.takenS = this.seconds();
  }

  // Now, between what the server said last and what it will say next.
  positionS() {
    const { positionS, playing, lengthS } = this.state;
    const now = playing ? positionS + (this.seconds() - this.takenS) * this.rate : positionS;
    return Math.min(Math.max(now, 0), lengthS);
  }

  #show() {
    const state = this.state;
    $('playback-play').textContent = state.playing ? t('Pause') : t('Play');
    if (this.pending === null) {
      const rates = RATES.includes(state.rate) ? RATES : [...RATES, state.rate].sort((a, b) => a - b);
      if ($('playback-rate').options.length !== rates.length) {
        $('playback-rate').replaceChildren(...rates.map((rate) => new Option(rateText(rate), rate)));
      }
      $('playback-rate').value = String(state.rate);
      $('playback-loop').checked = state.loop;
    }
    write('playback-file', state.file);
    $('playback-file').title = state.file;
    write('playback-length', duration(state.lengthS));
    write('playback-sign', `${t('Playback')}${state.playing ? (state.rate === 1 ? '' : ` ${rateText(state.rate)}`) : ` · ${t('paused')}`}`);
    write('playback-problem', state.problem);
    $('playback-problem').hidden = state.problem === '';
    this.#showMarks();
    this.showPosition();
  }

  #showMarks() {
    const text = JSON.stringify(this.state.marks);
    if (this.marksShown === text) return;
    this.marksShown = text;
    const marks = this.state.marks;
    $('playback-mark').replaceChildren(new Option(marks.length > 0 ? t('Go to a mark') : t('No marks'), ''),
      ...marks.map((mark, i) => new Option(`${duration(mark.positionS)}  ${mark.name}`, i)));
    $('playback-mark').disabled = marks.length === 0;
    $('playback-ticks').replaceChildren(...marks.slice(0, 200).map((mark) => new Option(mark.name, mark.positionS)));
  }

  showPosition() {
    if (!this.state) return;
    const slider = $('playback-position');
    const at = this.dragged ?? this.positionS();
    slider.max = String(this.state.lengthS);
    if (this.dragged === null) slider.value = String(at);
    slider.style.setProperty('--part', `${this.state.lengthS > 0 ? (at / this.state.lengthS) * 100 : 0}%`);
    slider.setAttribute('aria-valuetext', duration(at));
    write('playback-at', duration(at));
    write('playback-clock', utcClock(this.state.beginUtcNs / 1e6 + at * 1000));
  }
}
