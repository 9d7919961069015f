// BoundedField: a number within bounds. What is out of them is refused beside the field, and goes nowhere.
import { t } from '../language/language.js';
import { element, refusal, sayProblem } from './dom.js';

// An ordered value that the server has not confirmed by then gives way to the server's.
const WAIT_MS = 1600;

export const boundsText = ({ label, min, max, unit }) => `${t(label)}: ${t('{min} to {max}', { min, max })}${unit ? ` ${unit}` : ''}`;

export class BoundedField {
  // rule: { label, min, max, unit }. send(value), if there is one, is called for every sound change.
  constructor(id, rule, send = null) {
    this.rule = rule;
    this.send = send;
    this.server = this.own = null;
    this.input = element('input', { id, type: 'number', step: 'any', inputMode: 'decimal', min: rule.min, max: rule.max, autocomplete: 'off' });
    this.problem = refusal(`${id}-refusal`);
    this.input.setAttribute('aria-describedby', this.problem.id);
    this.label = element('label', { title: rule.help ? t(rule.help) : '' }, `${t(rule.label)}${rule.unit ? ` ${rule.unit}` : ''}`, this.input);
    this.element = element('div', { className: 'bounded' }, this.label, this.problem);
    this.input.addEventListener('change', () => this.#change());
    // What was refused is taken back while it is put right: not when the field is left, which would move the button from
    // under the pointer.
    this.input.addEventListener('input', () => { if (!this.problem.hidden && this.#isSound) this.read(); });
  }

  get #isSound() {
    return this.input.valueAsNumber >= this.rule.min && this.input.valueAsNumber <= this.rule.max;
  }

  // null where it is no number within bounds; says so beside the field. An empty field is not a number.
  read() {
    this.input.ariaInvalid = String(!this.#isSound);
    sayProblem(this.problem, this.#isSound ? '' : boundsText(this.rule));
    return this.#isSound ? this.input.valueAsNumber : null;
  }

  #change() {
    const value = this.read();
    if (value === null || !this.send) return;
    this.own = value;
    clearTimeout(this.timer);
    this.timer = setTimeout(() => { this.own = null; this.#show(); }, WAIT_MS);
    this.send(value);
  }

  set(value) {
    this.input.value = Number.isFinite(value) ? String(Number(value.toFixed(2))) : '';
    this.read();
  }

  // The server's value: it is shown, unless another is being typed, was refused, or is on its way.
  take(value) {
    this.server = value;
    if (this.own !== null && Math.abs(this.own - value) < 1e-6) this.own = null;
    this.#show();
  }

  #show() {
    if (this.own !== null || this.server === null || document.activeElement === this.input || !this.problem.hidden) return;
    const text = String(Number(this.server.toFixed(2)));
    if (this.input.value !== text) this.input.value = text;
  }
}
