// Lines and points of one's own. An item: { id, type: 'line' | 'point', kind, text, places: [{ latitudeDeg, longitudeDeg }], utc }; utc
// is the instant of an event as an ISO text, or ''. Items are never changed, but replaced.
import { later, t } from '../language/language.js';

export const KINDS = ['note', 'track', 'limit', 'danger', 'event'];
export const KIND_NAMES = { note: later('Note'), track: later('line|Track'), limit: later('line|Limit'), danger: later('Danger'), event: later('Event') };
export const MOST_ITEMS = 500, MOST_PLACES = 5000, LONGEST_TEXT = 80;

// Text without control characters, cut to length; whole characters.
export function cleanText(text) {
  // eslint-disable-next-line no-control-regex
  return [...String(text).replace(/[\u0000-\u001f\u007f-\u009f\u2028\u2029]/g, ' ').trim()].slice(0, LONGEST_TEXT).join('');
}

export class MapItems {
  // changed(): the items are others now.
  constructor(changed) {
    this.changed = changed;
    this.items = [];
    this.lastId = 0;
    this.version = 0;
  }

  // Why no more can be taken, or ''.
  refusal(places) {
    if (this.items.length >= MOST_ITEMS) return t('A map has at most {n} lines and points', { n: MOST_ITEMS });
    const all = this.items.reduce((sum, item) => sum + item.places.length, places);
    return all > MOST_PLACES ? t('A map has at most {n} points in all', { n: MOST_PLACES }) : '';
  }

  // The new item, or null where there is no room for it.
  add({ type, kind, text = '', places, utc = '' }) {
    if (this.refusal(places.length)) return null;
    const item = { id: ++this.lastId, type, kind, text: cleanText(text), places, utc };
    this.#set([...this.items, item]);
    return item;
  }

  change(id, values) {
    const text = values.text === undefined ? {} : { text: cleanText(values.text) };
    this.#set(this.items.map((item) => (item.id === id ? { ...item, ...values, ...text } : item)));
  }

  remove(id) {
    this.#set(this.items.filter((item) => item.id !== id));
  }

  replaceAll(items) {
    this.#set(items.map((item) => ({ ...item, id: ++this.lastId })));
  }

  find(id) {
    return this.items.find((item) => item.id === id) ?? null;
  }

  #set(items) {
    this.items = items;
    this.version += 1;
    this.changed();
  }
}
