// Set-ups by name: what an operator has arranged at a console, kept in this browser and as a file. No drawing.
//
// A set-up is { name, parts: { part: values } }. Each part of the console gives one and takes one:
//   store.addPart('picture', { take: () => values, put: (values) => ... });
// values are plain JSON; put() is given what some version of the same part once gave, and takes what it knows of it.
import { t } from '../language/language.js';

const REMEMBERED = 'skerry.setups';
const KIND = 'skerry set-up', VERSION = 1;
const MOST_BYTES = 1 << 20;

const isObject = (value) => typeof value === 'object' && value !== null && !Array.isArray(value);

export class SetupStore {
  constructor(store = globalThis.localStorage) {
    this.store = store;
    this.parts = new Map();
    this.setups = {};
    try {
      const kept = JSON.parse(store.getItem(REMEMBERED));
      if (isObject(kept)) this.setups = Object.fromEntries(Object.entries(kept).filter(([, setup]) => isObject(setup?.parts)));
    } catch {
      // None kept, or not ours.
    }
  }

  addPart(name, part) {
    this.parts.set(name, part);
  }

  get names() {
    return Object.keys(this.setups).sort((a, b) => a.localeCompare(b));
  }

  // As the console is now.
  take(name) {
    return { name, parts: Object.fromEntries([...this.parts].map(([part, { take }]) => [part, take()])) };
  }

  // Error: throws where the browser keeps nothing, or no more.
  save(setup) {
    const setups = { ...this.setups, [setup.name]: setup };
    this.store.setItem(REMEMBERED, JSON.stringify(setups));
    this.setups = setups;
  }

  remove(name) {
    delete this.setups[name];
    this.store.setItem(REMEMBERED, JSON.stringify(this.setups));
  }

  put(setup) {
    for (const [name, part] of this.parts) if (isObject(setup.parts[name])) part.put(setup.parts[name]);
  }

  toFile(setup) {
    return JSON.stringify({ kind: KIND, version: VERSION, ...setup }, null, 2);
  }

  // Error: throws with what is wrong of a text that is no set-up.
  fromFile(text) {
    if (text.length > MOST_BYTES) throw new Error(t('the file is too large for a set-up'));
    let read;
    try { read = JSON.parse(text); } catch { throw new Error(t('the file is no set-up: not JSON')); }
    if (!isObject(read) || read.kind !== KIND || !isObject(read.parts)) throw new Error(t('the file is no set-up of this console'));
    if (read.version !== VERSION) throw new Error(t('the file is a set-up of version {version}, this console reads {own}', { version: Number(read.version), own: VERSION }));
    return { name: String(read.name ?? '').slice(0, 60) || t('Unnamed'), parts: read.parts };
  }
}
