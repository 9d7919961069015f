// Faults of the selected own ships, made from the server's table: a switch or a number for each.
import { $, write } from '../widgets.js';
import { keyOf } from './exercise.js';
import { LiveField } from './live_field.js';

const GROUPS = {
  gyro: 'Gyro',
  log: 'Log',
  gnss: 'GNSS',
  ais: 'AIS',
  wind: 'Anemometer',
  radar: 'Radars',
  machinery: 'Machinery',
};
const UNITS = { deg: '°', 'deg/min': '°/min' };

function part(name, properties, ...children) {
  const made = Object.assign(document.createElement(name), properties);
  made.append(...children);
  return made;
}

export class FaultsPanel {
  // table: faults of /controls.json.
  constructor(table, exercise, orders) {
    Object.assign(this, { exercise, orders, shown: '', fields: new Map() });
    const groups = new Map();
    for (const fault of table) groups.set(fault.group ?? '', [...(groups.get(fault.group ?? '') ?? []), fault]);
    for (const [group, faults] of groups) $('fault-table').append(this.#group(group, faults));
    $('faults-none').addEventListener('click', () => orders.faults(exercise.chosenOwn, {}, [], 'all faults away'));
    $('no-faults').hidden = table.length > 0;
  }

  #group(group, faults) {
    const switches = faults.filter(({ type }) => type === 'switch'),
      numbers = faults.filter(({ type }) => type !== 'switch');
    const made = part('fieldset', { className: 'faults' }, part('legend', { textContent: GROUPS[group] ?? group }));
    if (switches.length > 0)
      made.append(part('div', { className: 'switches' }, ...switches.map((fault) => this.#switch(fault))));
    if (numbers.length > 0)
      made.append(part('div', { className: 'numbers' }, ...numbers.map((fault) => this.#number(fault))));
    return made;
  }

  #join(fault, input) {
    const send = (value) =>
      this.orders.faults(this.exercise.chosenOwn, { [fault.name]: value }, [fault.field], fault.label);
    this.fields.set(fault.name, new LiveField(input, send));
    return input;
  }

  #switch(fault) {
    const input = this.#join(fault, part('input', { type: 'checkbox', id: `fault-${fault.name}` }));
    return part(
      'label',
      { className: 'switch', title: fault.title ?? '' },
      input,
      part('span', { textContent: fault.label }),
    );
  }

  #number(fault) {
    const input = this.#join(
      fault,
      part('input', {
        type: 'number',
        min: fault.min,
        max: fault.max,
        step: 'any',
        inputMode: 'decimal',
        id: `fault-${fault.name}`,
      }),
    );
    const unit = UNITS[fault.unit] ?? fault.unit ?? '';
    return part(
      'label',
      { title: `${fault.title ?? ''}: ${fault.min} to ${fault.max} ${fault.unit ?? ''}`.trim() },
      part('span', { textContent: fault.label }),
      input,
      part('span', { className: 'unit', textContent: unit }),
    );
  }

  show() {
    const ships = this.exercise.chosenOwn,
      keys = ships.map(keyOf).join(' ');
    if (keys !== this.shown) {
      this.shown = keys;
      for (const field of this.fields.values()) field.forget();
    }
    $('fault-area').hidden = ships.length === 0;
    $('faults-of').hidden = ships.length > 0;
    if (ships.length === 0) return;
    write(
      'fault-ship',
      ships.length === 1 ? ships[0].name : `${ships[0].name} and ${ships.length - 1} more: faults go to each`,
    );
    const faults = ships[0].faults ?? {};
    let any = false;
    for (const [name, field] of this.fields) {
      const value = faults[name] ?? (field.isNumber ? 0 : false);
      field.take(value);
      field.element.closest('label').classList.toggle('at-fault', Boolean(value));
      any ||= Boolean(value);
    }
    $('faults-none').disabled = !any && ships.length === 1;
  }
}
