// Instructor: sea, air, rain and artefacts of the whole world, for all radars.
import { bearing, fixed } from './format.js';
import { capital, later, t } from './language/language.js';
import { showRefusal } from './panel/refusal.js';
import { PendingRequests } from './shared_setting.js';
import { NAUTICAL_MILE_M } from './view_geometry.js';
import { $, bindNumber, bindSlider, bindSwitch } from './widgets.js';

const NUMBERS = ['windFromDeg', 'swellHeightM', 'swellPeriodS', 'swellFromDeg', 'waveHeightM', 'kFactor'];
// RainKind of the schema by name, in the order of the list.
const RAIN_KINDS = new Map([[0, later('cell')], [2, later('showers')], [3, later('squall line')], [1, later('even')]]);
const RAIN = later('rain');  // of another kind
const EARTH_M = 6371000;

// A place that far from another, on a sphere: a rain cell need not be put more exactly.
export function placeFrom({ latitudeDeg, longitudeDeg }, bearingDeg, rangeM) {
  const rad = Math.PI / 180;
  const north = (rangeM / EARTH_M) * Math.cos(bearingDeg * rad) / rad;
  const latitude = Math.max(-90, Math.min(90, latitudeDeg + north));
  const across = Math.max(0.01, Math.cos((latitudeDeg + north / 2) * rad));
  const longitude = longitudeDeg + (rangeM / EARTH_M) * Math.sin(bearingDeg * rad) / (rad * across);
  return { latitudeDeg: latitude, longitudeDeg: ((longitude + 540) % 360 + 360) % 360 - 180 };
}

export class Instructor {
  // artefacts: the table's, whose elements buildPanel() has made.  set(values): sends them, and returns the request
  // number or null.  ownShip(): OwnShip or null.
  constructor(artefacts, set, ownShip) {
    this.set = set;
    this.ownShip = ownShip;
    this.pending = new PendingRequests();
    const settings = this.settings = {};
    const send = (name) => (value) => this.pending.add(set({ world: { [name]: value } }), settings[name]);
    settings.seaState = bindSlider('seaState', send('seaState'), (value) => fixed(value, 1));
    settings.ducting = bindSlider('ducting', send('ducting'), (value) => fixed(value, 2));
    for (const name of NUMBERS) settings[name] = bindNumber(name, send(name));
    for (const { name } of artefacts) settings[name] = bindSwitch(name, send(name));
    $('rain-kind').replaceChildren(...[...RAIN_KINDS].map(([kind, name]) => new Option(capital(t(name)), kind)));
    $('rain-add').addEventListener('submit', (event) => { event.preventDefault(); this.#addRain(); });
  }

  #addRain() {
    const ship = this.ownShip();
    if (!ship) return;
    const value = (id) => $(id).valueAsNumber;
    const cell = { id: 0, ...placeFrom(ship, value('rain-bearing'), value('rain-range') * NAUTICAL_MILE_M),
      radiusNm: value('rain-radius'), rateMmH: value('rain-rate'), driftDeg: value('rain-drift'),
      driftKn: value('rain-speed'), kind: Number($('rain-kind').value) };
    for (const name of Object.keys(cell)) if (Number.isNaN(cell[name])) delete cell[name];
    if (cell.latitudeDeg !== undefined && cell.longitudeDeg !== undefined) {
      this.pending.add(this.set({ world: { rain: [cell] } }), { settle: () => {}, refused: (why) => showRefusal($('rain-kind'), why) });
    }
  }

  takeReply(reply, why) {
    this.pending.takeReply(reply, why);
  }

  take(world) {
    for (const name of Object.keys(this.settings)) this.settings[name].take(world[name]);
    $('rain-cells').replaceChildren(...world.rain.map((cell) => this.#rainItem(cell)));
  }

  #rainItem(cell) {
    const item = document.createElement('li');
    const text = document.createElement('span');
    text.textContent = `${cell.id}: ${t(RAIN_KINDS.get(cell.kind) ?? RAIN)}, ${fixed(cell.rateMmH, 0)} mm/h, ${fixed(cell.radiusNm, 1)} NM, ` +
      t('to {course}° at {speed} kn', { course: bearing(cell.driftDeg, 0), speed: fixed(cell.driftKn, 0) });
    const remove = document.createElement('button');
    remove.type = 'button';
    remove.textContent = t('Remove');
    remove.ariaLabel = t('Remove rain cell {id}', { id: cell.id });
    remove.addEventListener('click', () => this.set({ world: { removeRain: [cell.id] } }));
    item.append(text, remove);
    return item;
  }
}
