// ShipList: all ships by name, own ships first, those that match what is typed.
import { $ } from '../widgets.js';
import { keyOf } from './exercise.js';

export class ShipList {
  // found(ship): she is to be seen on the chart.
  constructor(exercise, found) {
    this.exercise = exercise;
    this.rows = new Map(); // key -> button
    this.list = $('ship-list');
    $('ship-filter').addEventListener('input', () => this.show());
    this.list.addEventListener('click', (event) => {
      const ship = this.exercise.byKey.get(event.target.closest('button')?.dataset.key);
      if (!ship) return;
      this.exercise.select(ship, event.shiftKey || event.ctrlKey || event.metaKey || this.exercise.grouping);
      if (this.exercise.isChosen(ship)) found(ship);
    });
    // Along the list by the arrows.
    this.list.addEventListener('keydown', (event) => {
      const step = { ArrowDown: 'nextElementSibling', ArrowUp: 'previousElementSibling' }[event.key];
      const to = step && event.target.closest('li')?.[step]?.querySelector('button');
      if (!step) return;
      to?.focus();
      event.preventDefault();
      event.stopPropagation();
    });
  }

  matches({ name, shipClass, mmsi }, words) {
    const text = `${name} ${shipClass} ${mmsi}`.toLowerCase();
    return words.every((word) => text.includes(word));
  }

  show() {
    const words = $('ship-filter').value.toLowerCase().split(/\s+/).filter(Boolean);
    const ships = this.exercise.ships.filter((ship) => this.matches(ship, words));
    const keys = ships.map(keyOf).join(' ');
    if (keys !== this.keys) {
      this.keys = keys;
      this.rows = new Map(ships.map((ship) => [keyOf(ship), this.#row(ship)]));
      this.list.replaceChildren(
        ...[...this.rows.values()].map((button) => {
          const item = document.createElement('li');
          item.append(button);
          return item;
        }),
      );
    }
    for (const ship of ships) this.#tell(this.rows.get(keyOf(ship)), ship);
    $('ship-count').textContent = `${ships.length} of ${this.exercise.ships.length}`;
  }

  #row(ship) {
    const button = document.createElement('button');
    button.type = 'button';
    button.dataset.key = keyOf(ship);
    button.dataset.kind = ship.own ? 'own' : 'target';
    button.append(document.createElement('span'), document.createElement('span'));
    return button;
  }

  #tell(button, ship) {
    const [name, note] = button.children;
    const flags = [
      ship.removed && 'removed',
      ship.givesWayNow && 'gives way',
      ship.sart && 'SART',
      ship.aisOff && 'no AIS',
      ship.own && Object.values(ship.faults ?? {}).some(Boolean) && 'faults',
    ].filter(Boolean);
    const text = flags.length > 0 ? flags.join(', ') : ship.shipClass.replaceAll('_', ' ');
    if (name.textContent !== ship.name) name.textContent = ship.name;
    if (note.textContent !== text) note.textContent = text;
    note.className = flags.length > 0 ? 'flag' : '';
    button.setAttribute('aria-pressed', String(this.exercise.isChosen(ship)));
  }
}
