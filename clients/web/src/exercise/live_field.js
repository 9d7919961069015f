// LiveField: an input, checkbox or list that shows what the server says and orders what is typed.
const WAIT_MS = 1600;

export class LiveField {
  // send(value): the order; what is ordered is shown, as pending, until the server says so or does not.
  constructor(element, send) {
    this.element = element;
    this.send = send;
    this.forget();
    element.addEventListener('change', () => this.#change());
  }

  get isNumber() {
    return this.element.type === 'number';
  }

  forget() {
    clearTimeout(this.timer);
    this.own = this.server = null;
    this.element.classList.remove('pending');
  }

  #change() {
    const { element } = this;
    if (this.isNumber && (element.value === '' || !element.validity.valid)) {
      this.#refuse();
      return;
    }
    const value = this.isNumber
      ? element.valueAsNumber
      : element.type === 'checkbox'
        ? element.checked
        : Number(element.value);
    if (this.isNumber && this.server !== null && this.own === null && element.value === this.#text(this.server)) return;
    this.own = value;
    element.classList.add('pending');
    clearTimeout(this.timer);
    this.timer = setTimeout(() => this.#settle(), WAIT_MS);
    this.send(value);
  }

  // What the server says stands again; the page hears what was wrong ("refused", a text).
  #refuse() {
    const { element } = this;
    const name = element.ariaLabel ?? element.labels?.[0]?.textContent.trim() ?? 'This';
    const range = element.min && element.max ? ` from ${element.min} to ${element.max}` : '';
    const typed = element.value === '' ? '' : `, not ${element.value}`;
    element.dispatchEvent(new CustomEvent('refused', { bubbles: true, detail: `${name}: a number${range}${typed}` }));
    this.#show(this.server, true);
  }

  #settle() {
    clearTimeout(this.timer);
    this.own = null;
    this.element.classList.remove('pending');
    this.#show(this.server);
  }

  // The server's.
  take(value) {
    this.server = value ?? null;
    if (this.own === null) this.#show(this.server);
    else if (this.own === value || Math.abs(this.own - value) < 1e-6) this.#settle();
  }

  #text(value) {
    return value === null ? '' : String(Number(value.toFixed(2)));
  }

  #show(value, anyway = false) {
    const { element } = this;
    if (element.type === 'checkbox') {
      element.checked = value === true;
      return;
    }
    if (this.isNumber && !anyway && document.activeElement === element) return; // it is being typed in
    const text = this.isNumber ? this.#text(value) : String(value ?? 0);
    if (element.value !== text) element.value = text;
  }
}
