// MapPanel: the panel's part for lines and points of one's own: modes, fields, list, maps by name, files.
import { position } from '../format.js';
import { t } from '../language/language.js';
import { $ } from '../widgets.js';
import { fromGeoJson, MapFileError, MOST_BYTES, toGeoJson } from './geojson.js';
import { cleanText, KIND_NAMES, KINDS } from './map_items.js';
import { FIRST_NAME, isName } from './map_store.js';
import { parsePosition } from './position_text.js';

const latitudeText = (deg) => position(deg, 'N', 'S', 2);
const longitudeText = (deg) => position(deg, 'E', 'W', 3);

export class MapPanel {
  // parts: items, editor, store (MapStore), notify(text, kind).
  constructor(parts) {
    Object.assign(this, parts);
    $('map-kind').replaceChildren(...KINDS.map((kind) => new Option(t(KIND_NAMES[kind]), kind)));
    for (const input of document.querySelectorAll('input[name=map-mode]')) {
      input.addEventListener('change', () => this.editor.setMode(input.value));
    }
    $('map-position').addEventListener('submit', (event) => { event.preventDefault(); this.#enter((place) => this.editor.put(place)); });
    $('map-change').addEventListener('click', () => this.#change());
    $('map-finish').addEventListener('click', () => this.editor.finish());
    $('map-drop').addEventListener('click', () => this.editor.dropLast());
    $('map-name').addEventListener('change', () => this.open($('map-name').value));
    $('map-save').addEventListener('submit', (event) => { event.preventDefault(); this.#saveAs(cleanText($('map-save-name').value)); });
    $('map-remove').addEventListener('click', () => this.#removeMap());
    $('map-export').addEventListener('click', () => this.#export());
    $('map-import').addEventListener('click', () => $('map-file').click());
    $('map-file').addEventListener('change', () => this.#import($('map-file').files[0]));
    this.removing = false;
    this.listed = null;
  }

  get form() {
    return { kind: $('map-kind').value, text: $('map-text').value };
  }

  open(name) {
    let items = [];
    try {
      items = this.store.load(name);
    } catch (error) {
      if (!(error instanceof MapFileError)) throw error;
      this.notify(t('The map {name} cannot be read: {why}', { name, why: error.message }));
      if (this.store.current !== name) return this.show();  // what is open stays open
      // Nothing is written over the damaged one.
      this.store.current = this.store.freeName();
    }
    this.items.replaceAll(items);
    return this.editor.select(null);
  }

  // The items have changed: they are kept.
  keep() {
    if (!this.store.save(this.store.current, this.items.items)) this.notify(t('This browser keeps no maps: export what is to last'));
  }

  #enter(put) {
    const latitude = parsePosition($('map-latitude').value, 'latitude');
    const longitude = parsePosition($('map-longitude').value, 'longitude');
    for (const [id, { wrong = '' }] of [['map-latitude', latitude], ['map-longitude', longitude]]) {
      $(id).ariaInvalid = wrong ? 'true' : 'false';
      $(`${id}-wrong`).hidden = wrong === '';
      $(`${id}-wrong`).textContent = wrong;
    }
    if (latitude.wrong || longitude.wrong) return;
    put({ latitudeDeg: latitude.deg, longitudeDeg: longitude.deg });
  }

  #change() {
    const { selected } = this.editor;
    if (!selected) return;
    this.#enter((place) => this.editor.movePoint(selected.id, selected.vertex, place, this.form));
  }

  #saveAs(name) {
    if (!isName(name)) return this.notify(t('A map needs a name, of at most 60 letters'));
    try {
      this.store.save(name, this.items.items);
    } catch (error) {
      return this.notify(t('The map was not kept: {why}', { why: error.message }));
    }
    $('map-save-name').value = '';
    return this.show();
  }

  // The second press removes.
  #removeMap() {
    if (this.removing) {
      this.store.remove(this.store.current);
      this.open(this.store.current);
    }
    this.removing = !this.removing;
    this.show();
  }

  #export() {
    const link = document.createElement('a');
    link.href = URL.createObjectURL(new Blob([toGeoJson(this.store.current, this.items.items)], { type: 'application/geo+json' }));
    link.download = `${this.store.current.replace(/[^\p{L}\p{N} _-]/gu, '_')}.geojson`;
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 10000);
  }

  async #import(file) {
    if (!file) return;
    try {
      if (file.size > MOST_BYTES) throw new MapFileError(t('it is larger than {size} MB', { size: MOST_BYTES / (1 << 20) }));
      const items = fromGeoJson(await file.text());
      const stem = cleanText(file.name.replace(/\.(geo)?json$/i, '')).slice(0, 50);
      const base = isName(stem) ? stem : t(FIRST_NAME);
      let name = base;
      for (let i = 2; this.store.names.includes(name); ++i) name = `${base} ${i}`;
      this.store.save(name, items);
      this.open(name);
      this.notify(t('{n} lines and points from {file}', { n: items.length, file: file.name }), 'info');
    } catch (error) {
      if (!(error instanceof MapFileError)) throw error;
      this.notify(t('The file {file} is refused: {why}', { file: file.name, why: error.message }));
    } finally {
      $('map-file').value = '';
    }
  }

  // Shows what is so.
  show() {
    const { items, editor, store } = this;
    document.querySelector(`input[name=map-mode][value=${editor.mode}]`).checked = true;
    $('map-finish').hidden = $('map-drop').hidden = editor.mode !== 'line';
    $('map-finish').disabled = $('map-drop').disabled = !editor.draft;
    $('map-change').disabled = !editor.selected;
    $('map-add').textContent = editor.mode === 'line' ? t('Add to line') : t('Add point');
    $('map-remove').textContent = this.removing ? t('Sure?') : t('Delete');
    const names = store.names;
    if (names.join('\n') !== this.named) $('map-name').replaceChildren(...names.map((name) => new Option(name, name)));
    this.named = names.join('\n');
    $('map-name').value = store.current;
    const listed = `${items.version} ${editor.selected?.id} ${editor.selected?.vertex}`;
    if (listed === this.listed) return;
    this.listed = listed;
    this.#showList();
  }

  #showList() {
    const { items, editor } = this;
    $('map-items').replaceChildren(...items.items.map((item) => {
      const row = document.createElement('li');
      const choose = document.createElement('button'), remove = document.createElement('button');
      choose.type = remove.type = 'button';
      const what = item.type === 'line' ? t('line of {n}', { n: item.places.length }) : t('point');
      choose.textContent = [t(KIND_NAMES[item.kind]), what, item.text || item.utc].filter(Boolean).join(' · ');
      choose.ariaPressed = String(editor.selected?.id === item.id);
      choose.addEventListener('click', () => this.#choose(item));
      remove.textContent = t('Delete');
      remove.ariaLabel = t('Delete {what}', { what: choose.textContent });
      remove.addEventListener('click', () => { editor.select(null); items.remove(item.id); });
      row.append(choose, remove);
      return row;
    }));
    const chosen = editor.selected && items.find(editor.selected.id);
    if (chosen && !editor.drag) this.#fill(chosen);
  }

  #choose(item) {
    this.editor.select(this.editor.selected?.id === item.id ? null : item.id);
  }

  #fill(item) {
    const place = item.places[this.editor.selected.vertex] ?? item.places[0];
    $('map-text').value = item.text;
    $('map-kind').value = item.kind;
    $('map-latitude').value = latitudeText(place.latitudeDeg);
    $('map-longitude').value = longitudeText(place.longitudeDeg);
  }
}
