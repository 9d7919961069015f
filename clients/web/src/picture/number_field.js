// NumberField: a number typed by hand, with its range. What is out of range is refused beside the field, and the old value stands.
import { t } from '../language/language.js';

let fields = 0;

export class NumberField {
  // label: for eyes and screen readers; unit; least and most; digits shown; isOptional: empty means null.
  // enter(value): a value within the range.
  constructor({ label, name = label, unit, least, most, digits, isOptional = false }, enter) {
    Object.assign(this, { digits, least, most, unit, isOptional, shown: null });
    this.element = document.createElement('label');
    this.field = Object.assign(document.createElement('input'), {
      type: 'number', step: 'any', min: least, max: most, inputMode: 'decimal', ariaLabel: name, title: `${label}, ${this.range}`,
    });
    this.refusal = Object.assign(document.createElement('span'), { className: 'refusal', role: 'alert', hidden: true, id: `refusal-${++fields}` });
    this.field.setAttribute('aria-describedby', this.refusal.id);
    this.element.append(this.field, Object.assign(document.createElement('span'), { textContent: unit }), this.refusal);
    this.field.addEventListener('change', () => {
      const value = this.field.value === '' && !this.field.validity.badInput ? null : this.field.valueAsNumber;
      const isGood = value === null ? isOptional : value >= least && value <= most;
      this.refusal.hidden = isGood;
      this.refusal.textContent = isGood ? '' : t('Allowed: {range}', { range: this.range });
      this.field.classList.toggle('refused', !isGood);
      if (isGood) enter(value);
      else this.#write();
    });
  }

  get range() {
    const range = `${t('{min} to {max}', { min: this.least, max: this.most })} ${this.unit}`;
    return this.isOptional ? t('{range}, or empty', { range }) : range;
  }

  #write() {
    this.field.value = this.shown === null ? '' : this.shown.toFixed(this.digits);
  }

  // What was typed so far is entered, as by leaving the field: before it shows another thing's number. Not every browser takes the
  // focus to a button that is pressed.
  leave() {
    if (document.activeElement === this.field) this.field.blur();
  }

  // What is being typed is not overwritten.
  show(value) {
    this.shown = value;
    if (document.activeElement !== this.field) this.#write();
  }
}
