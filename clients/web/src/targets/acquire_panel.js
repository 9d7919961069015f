// AcquirePanel: acquiring and cancelling targets, and calling them by number.
import { t } from '../language/language.js';
import { NAUTICAL_MILE_M } from '../view_geometry.js';
import { button, element, Question, refusal, sayProblem } from './dom.js';
import { labelOf, trackKey } from './target_store.js';
import { FIRST_TEST } from './wire.js';

export class AcquirePanel {
  // orders: TargetOrders; store: TargetStore; setMode('select' or 'acquire'); notify(text, kind); changed(): what is selected has changed.
  constructor({ orders, store, setMode, notify, changed }) {
    Object.assign(this, { orders, store, setMode, notify, changed });
    this.question = new Question('cancel-all-question');
    this.problem = refusal('acquire-refusal');
    this.acquiring = button('acquire', t('Acquire'), () => this.toggleMode(), { title: t('Then press on an echo (Shift+A); at the cursor: A') });
    this.cancelled = button('cancel-target', t('target|Cancel'), () => this.cancelSelected(), { title: t('Cancel the selected targets (Delete)') });
    this.all = button('cancel-all', t('target|Cancel all'), () => this.#askAll());
    this.number = element('input', { id: 'target-number', type: 'text', inputMode: 'numeric', autocomplete: 'off', placeholder: t('No. or MMSI') });
    this.number.setAttribute('aria-label', t('Number of a target, or MMSI'));
    const form = element('form', { id: 'target-call', className: 'call' }, this.number,
      element('button', { type: 'submit', id: 'target-select', textContent: t('Select') }),
      button('target-cancel', t('target|Cancel it'), () => this.#cancelCalled()));
    form.addEventListener('submit', (event) => { event.preventDefault(); this.#select(); });
    this.element = element('div', {}, element('div', { className: 'actions' }, this.acquiring, this.cancelled, this.all), form, this.problem);
    this.show();
  }

  toggleMode(on = this.acquiring.ariaPressed !== 'true') {
    this.acquiring.ariaPressed = String(on);
    this.setMode(on ? 'acquire' : 'select');
  }

  // place: { bearingDeg, rangeM }; null: there is none.
  acquire(place) {
    if (!place) { sayProblem(this.problem, t('No echo chosen: point at one first')); return; }
    const rangeNm = place.rangeM / NAUTICAL_MILE_M;
    this.orders.give({ acquire: { rangeNm, bearingDeg: place.bearingDeg } }, this.problem, (text) => {
      this.notify(t('Acquired: target {number}', { number: text }), 'info');
      if (this.acquiring.ariaPressed === 'true') this.toggleMode(false);
    });
  }

  #selectedTracks() {
    return this.store.selectedEntries.filter(({ track }) => track && !track.isTest).map(({ track }) => track.number);
  }

  cancelSelected() {
    const numbers = this.#selectedTracks();
    if (numbers.length > 0) this.orders.give({ cancel: numbers }, this.problem);
    else sayProblem(this.problem, t('No tracked target is selected'));
  }

  #askAll() {
    const { tracked } = this.store.list;
    this.question.ask(tracked > 0 ? t('Cancel all tracked targets ({n})?', { n: tracked }) : t('Cancel all tracked targets?'), t('target|Cancel all'), () => this.orders.give({ cancelAll: true }, this.problem));
  }

  // The entry that was called: "12", "X3" of test targets, or an MMSI; null, and it is said.
  #called() {
    const typed = this.number.value.trim();
    const test = /^x([1-9]\d?)$/i.exec(typed);
    const number = test ? FIRST_TEST + Number(test[1]) - 1 : /^\d{1,9}$/.test(typed) ? Number(typed) : NaN;
    const entry = (this.store.entries ?? []).find(({ track, ais }) => track?.number === number || ais?.mmsi === number) ?? null;
    sayProblem(this.problem, entry ? '' : typed === '' ? t('Give the number of a target') : t('No target {number}', { number: typed.slice(0, 20) }));
    return entry;
  }

  #select() {
    const entry = this.#called();
    if (!entry) return;
    this.store.select(entry.key);
    this.number.value = '';
    this.changed();
  }

  #cancelCalled() {
    const entry = this.#called();
    if (!entry) return;
    if (!entry.track) { sayProblem(this.problem, t('That is an AIS target: it is not tracked')); return; }
    // What has been typed since stays.
    const typed = this.number.value;
    this.orders.give({ cancel: [entry.track.number] }, this.problem, () => { if (this.number.value === typed) this.number.value = ''; });
  }

  show() {
    const numbers = this.#selectedTracks();
    this.cancelled.disabled = numbers.length === 0;
    const words = numbers.length === 0 ? t('target|Cancel') : t('Cancel {numbers}', { numbers: numbers.map(labelOf).join(', ') });
    if (this.cancelled.textContent !== words) this.cancelled.textContent = words;
    this.all.disabled = !(this.store.entries ?? []).some(({ key, track }) => track && key === trackKey(track.number) && !track.isTest);
  }
}
