// The table of keys: what can be done by a single key, which key does it, and what the operator has made of that.
// No drawing; key_help.js shows it.
//
// Each part of the console registers its actions:
//   keys.register({ id: 'ebl', key: 'e', words: 'bearing line (EBL) on, off', group: 'Bearings', run: (event) => ... });
// id: for good, it is what a re-mapping is kept by.  key: the default, named as in key_names.js; '' for none.
// also: further keys that do the same as long as no other action has them.  group: heading of the help.
const REMEMBERED = 'skerry.keys';

export class KeyTable {
  constructor(store = globalThis.localStorage) {
    this.store = store;
    this.actions = new Map();  // id: action
    this.changed = {};         // id: key, where it is not the default
    this.load();
  }

  load() {
    this.changed = {};
    try {
      const kept = JSON.parse(this.store.getItem(REMEMBERED)) ?? {};
      for (const [id, key] of Object.entries(kept)) if (typeof key === 'string') this.changed[id] = key;
    } catch {
      // Nothing kept, or not ours: the defaults stand.
    }
  }

  // Error: throws of an id or a default key that another action has; the page's author is to be told, not the operator.
  register(...actions) {
    for (const action of actions) {
      const { id, key } = action;
      if (this.actions.has(id)) throw new Error(`two actions are called ${id}`);
      const other = key && [...this.actions.values()].find((each) => each.key === key);
      if (other) throw new Error(`the key ${key} is the default of ${other.id} and of ${id}`);
      this.actions.set(id, { group: 'Other', also: [], ...action });
    }
  }

  // '' where there is none.
  keyOf(id) {
    return this.changed[id] ?? this.actions.get(id)?.key ?? '';
  }

  // The action of a key, or undefined.
  actionOf(key) {
    if (!key) return undefined;
    const all = [...this.actions.values()];
    return all.find(({ id }) => this.keyOf(id) === key) ?? all.find(({ also }) => also.includes(key));
  }

  // Gives the key to the action. Another that had it is left with none, but only if take is set.
  // Returns the action that has it already, if it was not taken; else null.
  change(id, key, take = false) {
    const other = key && [...this.actions.values()].find((each) => each.id !== id && this.keyOf(each.id) === key);
    if (other && !take) return other;
    if (other) this.#put(other.id, '');
    this.#put(id, key);
    this.#keep();
    return null;
  }

  reset() {
    this.changed = {};
    this.#keep();
  }

  // Of a set-up.
  replace(changed) {
    this.changed = {};
    for (const [id, key] of Object.entries(changed ?? {})) if (typeof key === 'string') this.changed[id] = key;
    this.#keep();
  }

  #put(id, key) {
    if (key === this.actions.get(id).key) delete this.changed[id];
    else this.changed[id] = key;
  }

  #keep() {
    try {
      this.store.setItem(REMEMBERED, JSON.stringify(this.changed));
    } catch {
      // A browser that keeps nothing obeys until the page is left.
    }
  }
}
