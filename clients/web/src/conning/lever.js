// Lever: a handle on a scale that mouse, touch and keys move; the elements of the wheel, the engine lever and the
// thrusters.  It does not hold its value: show() does what the order is.
const TAP_PX = 6;

function element(className, content = '') {
  const made = document.createElement('div');
  made.className = className;
  made.textContent = content;
  return made;
}

export class Lever {
  // vertical: more is up.  marks: { value: text }.  change(value) is called with whole multiples of `step`.
  constructor(parent, { label, least, most, step = 1, page = 5, vertical = false, marks = {}, words, change }) {
    Object.assign(this, { least, most, step, page, vertical, words, change });
    this.track = element(`lever ${vertical ? 'vertical' : 'horizontal'}`);
    Object.assign(this.track, { tabIndex: 0, role: 'slider', ariaLabel: label, ariaOrientation: vertical ? 'vertical' : 'horizontal' });
    this.fill = element('fill');
    this.handle = element('handle');
    this.scale = element('marks');
    this.track.append(element('groove'), this.fill, this.scale, this.handle);
    parent.append(this.track);
    this.setScale(least, most, marks);
    this.#listen();
    this.show(NaN, false);
  }

  setScale(least, most, marks) {
    Object.assign(this, { least, most });
    this.track.ariaValueMin = String(least);
    this.track.ariaValueMax = String(most);
    this.scale.replaceChildren(...Object.entries(marks).map(([value, name]) => {
      const mark = element('mark-at', name);
      mark.style.setProperty('--at', this.#part(Number(value)));
      return mark;
    }));
  }

  get isDisabled() {
    return this.track.closest('fieldset:disabled') !== null;
  }

  #part(value) {
    return String(Math.max(0, Math.min(1, (value - this.least) / (this.most - this.least))));
  }

  // NaN: not known.  pending: this page's own, not yet told by the server.
  show(value, pending) {
    this.value = value;
    const known = Number.isFinite(value);
    for (const part of [this.handle, this.fill]) part.style.visibility = known ? '' : 'hidden';
    if (known) {
      this.handle.style.setProperty('--at', this.#part(value));
      const zero = Number(this.#part(0)), at = Number(this.#part(value));
      this.fill.style.setProperty('--from', String(Math.min(zero, at)));
      this.fill.style.setProperty('--size', String(Math.abs(at - zero)));
      this.fill.classList.toggle('port', value < 0);
      this.fill.classList.toggle('starboard', value > 0);
    }
    this.handle.classList.toggle('pending', pending);
    if (known) this.track.ariaValueNow = String(Math.round(value * 10) / 10);
    else this.track.removeAttribute('aria-valuenow');
    this.track.ariaValueText = known ? this.words(value) : 'not known';
  }

  // On the scale, and whole steps.
  order(value) {
    if (!Number.isFinite(value)) return;
    const whole = Math.round(value / this.step) * this.step;
    this.value = Math.max(this.least, Math.min(this.most, whole));  // keys may come faster than show()
    this.change(this.value);
  }

  // Under a finger a movement across the lever scrolls the page: only one along it, or a tap, is an order.
  #listen() {
    const { track } = this;
    let begun = null;  // where the finger came down, until it has moved along
    const order = (event) => {
      const box = track.getBoundingClientRect();
      const pad = this.vertical ? this.handle.offsetHeight / 2 : this.handle.offsetWidth / 2;
      const part = this.vertical ? (box.bottom - pad - event.clientY) / (box.height - 2 * pad)
        : (event.clientX - box.left - pad) / (box.width - 2 * pad);
      this.order(this.least + Math.max(0, Math.min(1, part)) * (this.most - this.least));
    };
    track.addEventListener('pointerdown', (event) => {
      if (event.button !== 0 || !event.isPrimary || this.isDisabled) return;
      track.setPointerCapture(event.pointerId);
      this.held = event.pointerId;
      begun = event.pointerType === 'touch' ? { x: event.clientX, y: event.clientY } : null;
      if (!begun) order(event);
    });
    track.addEventListener('pointermove', (event) => {
      if (this.held !== event.pointerId) return;
      if (begun) {
        const along = this.vertical ? event.clientY - begun.y : event.clientX - begun.x;
        if (Math.abs(along) < TAP_PX) return;
        begun = null;
      }
      order(event);
    });
    track.addEventListener('pointerup', (event) => {
      if (this.held !== event.pointerId) return;
      this.held = null;
      if (begun) order(event);
      begun = null;
      track.blur();
    });
    track.addEventListener('pointercancel', () => { this.held = null; begun = null; });
    track.addEventListener('keydown', (event) => this.#key(event));
  }

  #key(event) {
    const step = event.shiftKey ? this.page : this.step;
    const keys = this.vertical
      ? { ArrowUp: this.value + step, ArrowDown: this.value - step }
      : { ArrowRight: this.value + step, ArrowLeft: this.value - step };
    Object.assign(keys, { PageUp: this.value + this.page, PageDown: this.value - this.page, Home: this.least, End: this.most });
    if (!(event.key in keys) || event.ctrlKey || event.altKey || event.metaKey) return;
    this.order(keys[event.key]);
    event.preventDefault();
    event.stopPropagation();
  }
}
