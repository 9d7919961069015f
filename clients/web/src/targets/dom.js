// Elements of the panels, made here so that text from outside is text and nothing else.
import { t } from '../language/language.js';

export function element(name, properties = {}, ...children) {
  const { dataset, ...rest } = properties;
  const made = Object.assign(document.createElement(name), rest);
  Object.assign(made.dataset, dataset);
  made.append(...children.filter((child) => child !== null));
  return made;
}

export function button(id, words, pressed, properties = {}) {
  const made = element('button', { id, type: 'button', textContent: words, ...properties });
  made.addEventListener('click', pressed);
  return made;
}

// A box that is a button to look at; changed(isOn).
export function toggle(id, words, changed, properties = {}) {
  const box = element('input', { id, type: 'checkbox' });
  box.addEventListener('change', () => changed(box.checked));
  return element('label', properties, box, element('span', { textContent: words }));
}

export function details(id, words, isOpen, ...children) {
  return element('details', { id, open: isOpen }, element('summary', { textContent: words }), ...children);
}

// What the operator has chosen stands so long, until the server's lists tell of it, or do not.
const HOLD_MS = 1600;
const chosenAt = new WeakMap();

// A checkbox or list that shows what the server says, by follow().
export function following(control) {
  control.addEventListener('change', () => chosenAt.set(control, performance.now()));
  return control;
}

export function follow(control, value) {
  if (performance.now() - (chosenAt.get(control) ?? -Infinity) < HOLD_MS) return;
  const name = control.type === 'checkbox' ? 'checked' : 'value';
  if (control[name] !== value) control[name] = value;
}

// Where a control says what was wrong with what it was given.
export function refusal(id) {
  return element('p', { id, className: 'problem', role: 'alert', hidden: true });
}

export function say(element, words) {
  if (element.textContent !== words) element.textContent = words;
}

export function sayProblem(element, words) {
  say(element, words);
  element.hidden = words === '';
}

// Asks before something that cannot be taken back; asked again, it asks anew.
export class Question {
  constructor(id) {
    this.words = element('p', { id: `${id}-words` });
    this.yes = element('button', { id: `${id}-yes`, value: 'yes' });
    const no = element('button', { id: `${id}-no`, value: 'no', textContent: t('No'), autofocus: true });
    this.dialog = element('dialog', { id }, element('form', { method: 'dialog' }, this.words, this.yes, no));
    this.dialog.setAttribute('aria-labelledby', this.words.id);
    this.dialog.addEventListener('close', () => { if (this.dialog.returnValue === 'yes') this.then?.(); });
    // Keys of the console are not pressed through a dialog.
    this.dialog.addEventListener('keydown', (event) => event.stopPropagation());
    document.body.append(this.dialog);
  }

  ask(words, yes, then) {
    this.words.textContent = words;
    this.yes.textContent = yes;
    this.then = then;
    this.dialog.returnValue = 'no';
    this.dialog.showModal();
  }

  // What was asked is void.
  close() {
    this.then = null;
    if (this.dialog.open) this.dialog.close('no');
  }
}
