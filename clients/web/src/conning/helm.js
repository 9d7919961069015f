// The helm: wheel, its buttons, the rudder angle indicator, and the thrusters of ships that have them.
import { $ } from '../widgets.js';
import { Lever } from './lever.js';
import { RudderGauge } from './rudder_gauge.js';
import { side } from './sides.js';

export const MOST_RUDDER_DEG = 35;
const THRUSTERS = { bow: ['bowThrusterPercent', 'hasBowThruster'], stern: ['sternThrusterPercent', 'hasSternThruster'] };
const percentSide = (value) => (Math.round(value) === 0 ? 'Stop' : `${side(value, 0)} %`.replace(' P %', ' % P').replace(' S %', ' % S'));

export class Helm {
  // order(name, value): of ConOrder.  rudderDeg(): the order that a step starts from.
  constructor(order, rudderDeg) {
    this.limitDeg = MOST_RUDDER_DEG;
    this.gauge = new RudderGauge($('rudder-gauge'));
    this.wheel = new Lever($('wheel'), {
      label: 'Wheel, degrees', least: -MOST_RUDDER_DEG, most: MOST_RUDDER_DEG, words: (value) => `${side(value, 1)} degrees`,
      change: (value) => order('rudderDeg', value),
    });
    const place = { 'hard-port': -1, midships: 0, 'hard-starboard': 1 };
    for (const button of document.querySelectorAll('[data-rudder]')) {
      button.addEventListener('click', () => order('rudderDeg', place[button.dataset.rudder] * this.limitDeg));
    }
    for (const button of document.querySelectorAll('[data-rudder-step]')) {
      button.addEventListener('click', () => this.wheel.order(rudderDeg() + Number(button.dataset.rudderStep)));
    }
    this.thrusters = Object.entries(THRUSTERS).map(([end, [name, has]]) => {
      const box = $(`${end}-thruster`), lever = new Lever(box, {
        label: `${end === 'bow' ? 'Bow' : 'Stern'} thruster, percent to starboard`, least: -100, most: 100, step: 5, page: 25,
        marks: { [-100]: 'P', 0: '0', 100: 'S' }, words: percentSide, change: (value) => order(name, value),
      });
      box.querySelector('button').addEventListener('click', () => order(name, 0));
      return { name, has, box, lever, output: $(`${end}-value`) };
    });
    this.#scale(MOST_RUDDER_DEG);
  }

  #scale(limitDeg) {
    this.limitDeg = limitDeg;
    const marks = {};
    for (let deg = 0; deg < limitDeg; deg += 10) marks[deg] = marks[-deg] = String(deg);
    this.wheel.setScale(-limitDeg, limitDeg, marks);
  }

  // con: ConState or null.  orders: { value, pending } by name of ConOrder.
  show(con, orders) {
    const limitDeg = con?.rudderLimitDeg > 0 ? Math.min(MOST_RUDDER_DEG, con.rudderLimitDeg) : this.limitDeg;
    if (limitDeg !== this.limitDeg) this.#scale(limitDeg);
    const { value, pending } = con ? orders.rudderDeg : { value: NaN, pending: false };
    this.wheel.show(value, pending);
    this.gauge.show({ rudderDeg: con?.rudderDeg ?? NaN, orderDeg: value, limitDeg, pending });
    for (const { name, has, box, lever, output } of this.thrusters) {
      if (con) box.hidden = !con[has];
      const order = con ? orders[name] : { value: NaN, pending: false };
      lever.show(order.value, order.pending);
      output.textContent = Number.isFinite(order.value) ? percentSide(order.value) : '\u2013';
      output.classList.toggle('pending', order.pending);
    }
    if (con) $('thrusters').hidden = !(con.hasBowThruster || con.hasSternThruster);
  }
}
