// Recording: the server's recorder, as this console shows and drives it.
import { later, t } from './language/language.js';
import { $ } from './widgets.js';
import { bytes, duration } from './format.js';

const OFF = 0, RECORDING = 1, DISK_FULL = 2, FAILED = 3;
const START = 0, STOP = 1, MARK = 2;
const WORDS = [later('Off'), later('Recording'), later('Disk full'), later('Failed')];

function write(id, text) {
  if ($(id).textContent !== text) $(id).textContent = text;
}

export class Recording {
  // send({ action, name }): the request number, or null. notify(text): to the operator.
  constructor(send, notify) {
    this.send = send;
    this.notify = notify;
    this.state = null;
    this.asked = new Map();  // request: what was asked for
    $('record').addEventListener('click', () => this.toggle());
    $('record-marking').addEventListener('submit', (event) => { event.preventDefault(); this.mark($('record-mark').value.trim()); });
  }

  get isRunning() {
    return this.state !== null && (this.state.phase === RECORDING || this.state.phase === DISK_FULL);
  }

  toggle() {
    const stops = this.isRunning;
    this.#ask({ action: stops ? STOP : START }, stops ? t('Recording ends') : t('Recording begins'));
  }

  mark(name) {
    if (!this.isRunning) return;
    this.#ask({ action: MARK, name }, name ? t('Marked: {name}', { name }) : t('Marked'));
    $('record-mark').value = '';
  }

  #ask(record, done) {
    const request = this.send(record);
    if (request === null) this.notify(t('Not connected: nothing was sent to the recorder'), 'error');
    else this.asked.set(request, done);
  }

  // Whether the reply is one of ours.
  takeReply(reply) {
    const done = this.asked.get(reply.request);
    if (done === undefined) return false;
    this.asked.delete(reply.request);
    if (reply.code === 0) this.notify(done, 'info');
    return true;
  }

  // Another server, or the same one after a break.
  greet(canRecord) {
    this.state = null;
    this.asked.clear();
    $('recording').hidden = !canRecord;
    this.#show();
  }

  take(state) {
    this.state = state;
    $('recording').hidden = false;
    this.#show();
  }

  #show() {
    const state = this.state;
    const phase = state?.phase ?? OFF;
    $('recording').dataset.phase = String(phase);
    $('record').textContent = this.isRunning ? t('Stop') : t('Record');
    $('record').setAttribute('aria-pressed', String(this.isRunning));
    $('record-mark').disabled = $('record-marking').querySelector('button').disabled = !this.isRunning;
    write('record-phase', [WORDS[phase] ? t(WORDS[phase]) : '?', state?.inputsOnly ? t('inputs only') : '', state?.allViews ? t('all views') : ''].filter(Boolean).join(', '));
    write('record-time', state ? duration(state.seconds) : '–');
    write('record-size', state ? bytes(state.fileBytes) : '–');
    write('record-rate', state && this.isRunning ? `${bytes(state.bytesPerSecond)}/s` : '–');
    write('record-free', state ? bytes(state.freeBytes) : '–');
    write('record-marks', state ? String(state.marks) : '–');
    write('record-lost', state ? String(state.spokesLost) : '–');
    $('record-lost').classList.toggle('bad', (state?.spokesLost ?? 0) > 0);
    write('record-file', state?.file ?? '');
    $('record-file').title = state?.folder ? `${state.folder}/${state.file}` : '';
    const problem = state?.problem || (phase === DISK_FULL ? t('The disk is full: recording goes on when there is room') : '');
    write('record-problem', problem);
    $('record-problem').hidden = problem === '';
    $('record-sign').hidden = !this.isRunning;
    $('record-sign').classList.toggle('bad', phase === DISK_FULL);
    write('record-sign', phase === DISK_FULL ? t('Disk full') : `${t('Rec')} ${state ? duration(state.seconds) : ''}`);
  }
}
