// Ships: what is true of the selected ship, and the orders that the selected ships can be given.
import * as format from '../format.js';
import { $, write } from '../widgets.js';
import { keyOf } from './exercise.js';
import { LiveField } from './live_field.js';
import { parseLatitude, parseLongitude } from './place.js';
import { choices, spoken } from './tool_forms.js';
import { GIVE_WAY, ROUTE_END } from './wire.js';

const { NONE } = format;
const STEERING = ['By hand', 'By heading', 'By track'];
const degrees = (deg) => `${format.bearing(deg)}°`;
const knots = (kn) => `${format.fixed(kn, 1)} kn`;

export function routeText(ship) {
  if (ship.route.length === 0) return 'none';
  const points = `${ship.route.length} waypoint${ship.route.length === 1 ? '' : 's'}, then ${ROUTE_END[ship.routeEnd] ?? 'stop'}`;
  return ship.onCourse ? `left; ${points}` : points;
}

const ROWS = [
  ['Position', (s) => `${format.position(s.latitudeDeg, 'N', 'S', 2)} ${format.position(s.longitudeDeg, 'E', 'W', 3)}`],
  ['Heading', (s) => degrees(s.headingDeg)],
  ['Over ground', (s) => `${degrees(s.courseOverGroundDeg)} ${knots(s.speedKn)}`],
  ['Rate of turn', (s) => `${format.rateOfTurn(s.rateOfTurnDegMin)} °/min`],
  ['Ordered', (s) => `${degrees(s.orderedCourseDeg)} ${knots(s.orderedSpeedKn)}`],
  ['Route', (s) => routeText(s), 'target'],
  ['Size', (s) => `${format.fixed(s.lengthM, 0)} × ${format.fixed(s.beamM, 0)} m`],
  ['MMSI', (s) => (s.mmsi > 0 ? String(s.mmsi) : NONE)],
  ['Con', (s) => s.con || 'free', 'own'],
  ['Gyro error', (s) => `${s.gyroErrorDeg.toFixed(1).replace('-', '\u2212')}°`, 'own'],
  ['GNSS error', (s) => `${format.fixed(s.gnssErrorM, 0)} m`, 'own'],
];

export class ShipsPanel {
  // openTrainee(ship); notify(text).
  constructor(exercise, orders, { openTrainee, notify }) {
    Object.assign(this, { exercise, orders, openTrainee, notify, shown: '' });
    $('gives-way').replaceChildren(...choices(GIVE_WAY));
    $('end-now').replaceChildren(...choices(ROUTE_END));
    $('steering').replaceChildren(...STEERING.map((name, i) => new Option(name, i)));
    const toTargets = (name, what) => (value) => orders.targets(exercise.chosenTargets, { [name]: value }, what);
    this.fields = {
      givesWay: new LiveField($('gives-way'), toTargets('givesWay', 'giving way')),
      routeEnd: new LiveField($('end-now'), toTargets('routeEnd', 'end of the route')),
      sart: new LiveField($('sart'), toTargets('sart', 'SART')),
      aisOff: new LiveField($('ais-off'), toTargets('aisOff', 'AIS')),
    };
    this.#form('order-form', () => this.#steer());
    this.#form('ais-form', () => this.#ais());
    this.#form('con-form', () => this.#con());
    this.#form('put-form', () => this.#put());
    $('put-read').addEventListener('click', () => this.#fillPut());
    $('resume').addEventListener('click', () =>
      orders.targets(exercise.chosenTargets, { resume: true }, 'resume her route'),
    );
    $('remove').addEventListener('click', () => {
      const removed = !(exercise.chosenTargets[0]?.removed ?? false);
      orders.targets(exercise.chosenTargets, { removed }, removed ? 'remove' : 'put back');
    });
    $('see-console').addEventListener('click', () => {
      const [ship] = exercise.chosenOwn;
      if (ship) openTrainee(ship);
    });
  }

  #form(id, order) {
    $(id).addEventListener('submit', (event) => {
      event.preventDefault();
      order();
    });
  }

  // The numbers of those fields that are filled; the fields are then empty.
  #take(ids) {
    const values = {};
    for (const [id, name] of Object.entries(ids)) {
      const value = $(id).valueAsNumber;
      if (!Number.isNaN(value)) values[name] = value;
    }
    if (Object.keys(values).length === 0) {
      this.notify('Fill in a field first');
      return null;
    }
    for (const id of Object.keys(ids)) $(id).value = '';
    return values;
  }

  #steer() {
    const values = this.#take({ 'order-course': 'courseDeg', 'order-speed': 'speedKn' });
    if (values) this.orders.steer(this.exercise.chosen, values);
  }

  #ais() {
    const values = this.#take({ 'ais-heading': 'aisHeadingErrorDeg', 'ais-position': 'aisPositionErrorM' });
    if (values) this.orders.targets(this.exercise.chosenTargets, values, 'AIS error');
  }

  #con() {
    const con = {};
    for (const [id, name] of [
      ['con-rudder', 'rudderDeg'],
      ['con-engine', 'enginePercent'],
    ]) {
      const value = $(id).valueAsNumber;
      if (!Number.isNaN(value)) con[name] = value;
      $(id).value = '';
    }
    if (con.rudderDeg === undefined) con.steering = Number($('steering').value);
    for (const ship of this.exercise.chosenOwn) this.orders.ownShip(ship, { con }, 'con');
  }

  #put() {
    const latitudeDeg = parseLatitude($('put-latitude').value),
      longitudeDeg = parseLongitude($('put-longitude').value);
    const [ship] = this.exercise.chosen;
    if (Number.isNaN(latitudeDeg) || Number.isNaN(longitudeDeg)) {
      this.notify('A position is like 60 23.5 N and 5 19.2 E, or 60.392 and 5.32');
      return;
    }
    const optional = (id) => (Number.isNaN($(id).valueAsNumber) ? undefined : $(id).valueAsNumber);
    if (ship)
      this.orders.put([
        { ship, latitudeDeg, longitudeDeg, headingDeg: optional('put-heading'), speedKn: optional('put-speed') },
      ]);
    for (const id of ['put-latitude', 'put-longitude', 'put-heading', 'put-speed']) $(id).value = '';
  }

  #fillPut() {
    const [ship] = this.exercise.chosen;
    if (!ship) return;
    $('put-latitude').value = format.position(ship.latitudeDeg, 'N', 'S', 2);
    $('put-longitude').value = format.position(ship.longitudeDeg, 'E', 'W', 3);
  }

  show() {
    const { chosen, chosenTargets, chosenOwn } = this.exercise;
    const ship = chosen[0] ?? null,
      keys = chosen.map(keyOf).join(' ');
    if (keys !== this.shown) this.#select(keys);
    $('ship').hidden = ship === null;
    $('no-ship').hidden = ship !== null;
    if (!ship) return;
    document.body.dataset.chosen = chosenTargets.length === 0 ? 'own' : chosenOwn.length === 0 ? 'target' : 'both';
    write('ship-name', ship.name);
    write(
      'ship-note',
      [
        chosen.length > 1 ? `and ${chosen.length - 1} more: orders go to each` : '',
        ship.own ? 'own ship' : 'target',
        spoken(ship.shipClass || 'no class').toLowerCase(),
      ]
        .filter(Boolean)
        .join(' · '),
    );
    const flags = [
      ship.aground && 'Aground: put her elsewhere',
      ship.givesWayNow && 'Gives way now',
      ship.removed && 'Off the water',
      ship.onCourse && 'Off her route',
      ship.sart && 'SART on',
      ship.aisOff && 'AIS silent',
    ].filter(Boolean);
    write('ship-flags', flags.join(' · '));
    this.#showRows(ship);
    const target = chosenTargets[0];
    for (const [name, field] of Object.entries(this.fields)) if (target) field.take(target[name]);
    write('remove', target?.removed ? 'Put back' : 'Remove');
    $('resume').disabled = !chosenTargets.some((each) => each.onCourse);
    $('con-form').hidden = !chosenOwn.some((each) => each.shipClass);
    $('see-console').disabled = !(chosenOwn[0]?.radars.length > 0);
    if (chosenOwn[0]) $('see-con').href = `conning?radar=${chosenOwn[0].radars[0] ?? 0}`;
    $('put-form').hidden = chosen.length > 1;
  }

  // Other ships: what was typed was not for them.
  #select(keys) {
    this.shown = keys;
    for (const field of Object.values(this.fields)) field.forget();
    for (const input of $('ship').querySelectorAll('input:is([type=number], [type=text])')) input.value = '';
  }

  #showRows(ship) {
    const kind = ship.own ? 'own' : 'target';
    const rows = ROWS.filter(([, , only]) => !only || only === kind);
    const list = $('ship-truth');
    if (list.dataset.kind !== kind) {
      list.dataset.kind = kind;
      list.replaceChildren(
        ...rows.map(([name]) => {
          const row = document.createElement('div'),
            term = document.createElement('dt');
          term.textContent = name;
          row.append(term, document.createElement('dd'));
          return row;
        }),
      );
    }
    rows.forEach(([, text], i) => {
      const cell = list.children[i].lastChild,
        now = text(ship);
      if (cell.textContent !== now) cell.textContent = now;
    });
  }
}
