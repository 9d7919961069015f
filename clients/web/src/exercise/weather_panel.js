// Weather: sea, wind, swell, current, depth, visibility and rain, for all.
import { bearing, CLEAR_NM, fixed } from '../format.js';
import { $ } from '../widgets.js';
import { LiveField } from './live_field.js';
import { RAIN_KINDS } from './tool_forms.js';

const FIELDS = {
  seaState: 'sea state',
  windFromDeg: 'wind',
  windKn: 'wind',
  swellHeightM: 'swell',
  swellPeriodS: 'swell',
  swellFromDeg: 'swell',
  currentSetDeg: 'current',
  currentKn: 'current',
  depthM: 'depth',
  visibilityNm: 'visibility',
};

export class WeatherPanel {
  constructor(exercise, orders) {
    Object.assign(this, { exercise, orders, rain: '' });
    this.fields = Object.fromEntries(
      Object.entries(FIELDS).map(([name, what]) => [
        name,
        new LiveField($(`weather-${name}`), (value) => orders.world({ [name]: value }, what)),
      ]),
    );
    $('rain-clear').addEventListener('click', () => orders.world({ removeAllRain: true }, 'rain'));
  }

  show() {
    const { world } = this.exercise;
    if (!world) return;
    const told = { ...world, visibilityNm: world.visibilityNm ?? CLEAR_NM };
    for (const [name, field] of Object.entries(this.fields)) field.take(told[name]);
    $('rain-clear').disabled = world.rain.length === 0;
    const text = JSON.stringify(world.rain);
    if (text === this.rain) return;
    this.rain = text;
    $('rain-list').replaceChildren(...world.rain.map((cell) => this.#item(cell)));
  }

  #item(cell) {
    const item = document.createElement('li'),
      text = document.createElement('span'),
      remove = document.createElement('button');
    const kind = (RAIN_KINDS.find(([number]) => number === cell.kind)?.[1] ?? 'Rain').toLowerCase();
    text.textContent =
      `${cell.id}: ${kind}, ${fixed(cell.rateMmH, 1)} mm/h, ${fixed(cell.radiusNm, 1)} NM` +
      (cell.driftKn >= 0.05 ? `, to ${bearing(cell.driftDeg, 0)}° at ${fixed(cell.driftKn, 0)} kn` : '');
    remove.type = 'button';
    remove.textContent = 'Remove';
    remove.ariaLabel = `Remove rain ${cell.id}`;
    remove.addEventListener('click', () => this.orders.world({ removeRain: [cell.id] }, 'rain'));
    item.append(text, remove);
    return item;
  }
}
