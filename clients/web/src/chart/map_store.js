// Maps kept in this browser by their names, as GeoJSON. What is kept may have been written by anybody who had this browser: it is read
// as a file is.
import { later, t } from '../language/language.js';
import { fromGeoJson, MapFileError, toGeoJson } from './geojson.js';

const KEY = 'skerry.maps';
export const FIRST_NAME = later('My map');
const MOST_MAPS = 30;

export class MapStore {
  // storage: localStorage, or one like it.
  constructor(storage) {
    this.storage = storage;
    this.current = t(FIRST_NAME);
    this.maps = {};
    const current = this.#read();
    if (isName(current) && Object.hasOwn(this.maps, current)) this.current = current;
  }

  // The maps as they are now: another page of this browser may have written some. Gives the name of the one that was open last.
  #read() {
    try {
      const kept = JSON.parse(this.storage.getItem(KEY)) ?? {};
      const maps = {};
      for (const [name, text] of Object.entries(kept.maps ?? {}).slice(0, MOST_MAPS)) {
        if (typeof text === 'string' && isName(name)) maps[name] = text;
      }
      this.maps = maps;
      return kept.current;
    } catch {
      return null;  // nothing kept, or not ours
    }
  }

  get names() {
    return [...new Set([this.current, ...Object.keys(this.maps)])].sort();
  }

  // "My map", or with a number if there is such a one.
  freeName() {
    const first = t(FIRST_NAME);
    for (let i = 1; ; ++i) {
      const name = i === 1 ? first : `${first} ${i}`;
      if (!this.names.includes(name)) return name;
    }
  }

  // Items of a map. Error: MapFileError.
  load(name) {
    const text = Object.hasOwn(this.maps, name) ? this.maps[name] : null;
    const items = text === null ? [] : fromGeoJson(text);
    this.current = name;
    this.#write();
    return items;
  }

  // Whether the browser kept it.
  save(name, items) {
    this.#read();
    if (!Object.hasOwn(this.maps, name) && Object.keys(this.maps).length >= MOST_MAPS) throw new MapFileError(t('at most {n} maps are kept', { n: MOST_MAPS }));
    this.maps[name] = toGeoJson(name, items);
    this.current = name;
    return this.#write();
  }

  remove(name) {
    this.#read();
    delete this.maps[name];
    this.current = Object.keys(this.maps).sort()[0] ?? t(FIRST_NAME);
    this.#write();
  }

  #write() {
    try {
      this.storage.setItem(KEY, JSON.stringify({ current: this.current, maps: this.maps }));
      return true;
    } catch {
      return false;
    }
  }
}

// A name that a list can show. Not one of an object's own words.
export const isName = (name) => typeof name === 'string' && name.trim() !== '' && name.length <= 60 && !(name in {});
