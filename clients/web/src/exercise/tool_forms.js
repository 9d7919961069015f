// The forms of the tools, over the chart: what a new target, a route and an area of rain shall be.
import { $ } from '../widgets.js';
import { TARGET_CLASSES } from './ship_classes.js';
import { GIVE_WAY, ROUTE_END } from './wire.js';

// RainKind of the schema.
export const RAIN_KINDS = [
  [0, 'Cell'],
  [2, 'Showers'],
  [3, 'Squall line'],
  [1, 'Even'],
];

export const spoken = (word) => {
  const text = word.replaceAll('_', ' ');
  return text[0].toUpperCase() + text.slice(1);
};
export const choices = (words) => words.map((word, i) => new Option(spoken(word), i));

// An empty field is undefined: the server has a value of its own.
const optional = (id) => (Number.isNaN($(id).valueAsNumber) ? undefined : $(id).valueAsNumber);

export class ToolForms {
  constructor() {
    $('new-class').replaceChildren(...TARGET_CLASSES.map((name) => new Option(spoken(name), name)));
    $('new-gives-way').replaceChildren(...choices(GIVE_WAY));
    $('route-end').replaceChildren(...choices(ROUTE_END));
    $('rain-kind').replaceChildren(...RAIN_KINDS.map(([kind, name]) => new Option(name, kind)));
  }

  // Classes that are in the exercise can be had again.
  addClasses(names) {
    const known = new Set([...$('new-class').options].map((option) => option.value));
    for (const name of names)
      if (name && !known.has(name)) {
        $('new-class').append(new Option(spoken(name), name));
        known.add(name);
      }
  }

  #isSound(form) {
    return $(form).reportValidity();
  }

  target() {
    if (!this.#isSound('tool-target')) return null;
    const name = $('new-name').value.trim();
    const values = {
      shipClass: $('new-class').value,
      courseDeg: optional('new-course') ?? 0,
      speedKn: optional('new-speed') ?? 0,
      givesWay: Number($('new-gives-way').value),
    };
    $('new-name').value = ''; // the next has another
    return name ? { name, ...values } : values;
  }

  route() {
    return this.#isSound('tool-route')
      ? { speedKn: optional('route-speed'), routeEnd: Number($('route-end').value) }
      : null;
  }

  rainRadiusNm() {
    return $('rain-radius').valueAsNumber;
  }

  rain() {
    if (!this.#isSound('tool-rain')) return null;
    return {
      radiusNm: optional('rain-radius'),
      rateMmH: optional('rain-rate'),
      driftDeg: optional('rain-drift'),
      driftKn: optional('rain-speed'),
      kind: Number($('rain-kind').value),
    };
  }
}
