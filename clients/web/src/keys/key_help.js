// The dialog of keys: the table of keys by group, each key a button that takes another one.
import { t } from '../language/language.js';
import { keyOf, writtenKey } from './key_names.js';

function element(name, properties = {}, ...children) {
  const made = Object.assign(document.createElement(name), properties);
  made.append(...children);
  return made;
}

export class KeyHelp {
  // dialog: holds .key-groups, .key-news and .key-reset.  changed(): keys do something else now.
  constructor(dialog, table, changed) {
    this.dialog = dialog;
    this.table = table;
    this.changed = changed;
    this.asking = null;  // { id, button, taken: the key that was pressed though another action has it }
    dialog.querySelector('.key-reset').addEventListener('click', () => { table.reset(); changed(); this.#show(); this.#say(t('All keys are as delivered')); });
    dialog.addEventListener('keydown', (event) => this.#press(event), true);
    dialog.addEventListener('close', () => { this.asking = null; });
  }

  open() {
    if (this.dialog.open) return;
    this.#say('');
    this.#show();
    this.dialog.showModal();
    // On its head, not on the first key: a space would change it.
    this.dialog.querySelector('h2').focus();
  }

  #say(text) {
    this.dialog.querySelector('.key-news').textContent = text;
  }

  #show() {
    const groups = new Map();
    for (const action of this.table.actions.values()) groups.set(action.group, [...(groups.get(action.group) ?? []), action]);
    this.dialog.querySelector('.key-groups').replaceChildren(...[...groups].map(([group, actions]) =>
      element('section', {}, element('h3', { textContent: group }), element('ul', {}, ...actions.map((action) => this.#row(action))))));
  }

  #row(action) {
    const key = this.table.keyOf(action.id);
    const keys = key ? writtenKey(key) : [t('key|none')];
    const button = element('button', { type: 'button', className: 'key' }, ...keys.map((part) => element('kbd', { textContent: part })));
    button.dataset.action = action.id;
    button.dataset.changed = t('changed');  // shown by style.css
    button.classList.toggle('changed', key !== action.key);
    const named = { words: action.words, key: keys.join(' ') };
    button.ariaLabel = key === action.key ? t('{words}: key {key}; press to change it', named) : t('{words}: key {key}, changed; press to change it', named);
    button.addEventListener('click', () => this.#ask(action, button));
    return element('li', {}, button, element('span', { textContent: action.words }));
  }

  #ask(action, button) {
    this.#show();
    this.asking = { id: action.id, taken: null };
    this.#button(action.id).classList.add('asking');
    this.#button(action.id).focus();
    this.#say(t('Press the new key for: {words}. Delete takes its key away, Escape leaves it.', { words: action.words }));
  }

  #button(id) {
    return this.dialog.querySelector(`.key[data-action="${CSS.escape(id)}"]`);
  }

  #press(event) {
    if (!this.asking || event.key === 'Tab') return;
    const { id, taken } = this.asking;
    if (event.key === 'Escape') { event.preventDefault(); this.#done(t('Nothing was changed')); return; }
    if (event.key === 'Delete') { event.preventDefault(); this.table.change(id, ''); this.#done(t('It has no key now')); return; }
    const key = keyOf(event);
    if (key === null) return;
    event.preventDefault();
    event.stopPropagation();
    const written = writtenKey(key).join(' ');
    const other = this.table.change(id, key, taken === key);
    if (other === null) { this.#done(`${written}: ${this.table.actions.get(id).words}`); return; }
    this.asking.taken = key;
    this.#say(t('{key} is the key for: {words}. Press it again to take it from there, or press another key.', { key: written, words: other.words }));
  }

  #done(text) {
    const { id } = this.asking;
    this.asking = null;
    this.changed();
    this.#show();
    this.#button(id)?.focus();
    this.#say(text);
  }
}
