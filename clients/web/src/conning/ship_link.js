// ShipLink: what this page knows of one own ship, and what it sends her.  No drawing.
import { SharedSetting, PendingRequests } from '../shared_setting.js';
import { hindrance, holderOf, lockedOrders } from './con_holder.js';

export const OWN_SHIP_HZ = 5;
// A ship that is silent for so long is not shown any more.
const SILENCE_S = 1.5;
// Orders that are shown as given at once, and where ConState tells them.
const ORDERS = {
  rudderDeg: 'rudderOrderDeg', enginePercent: 'enginePercent', bowThrusterPercent: 'bowThrusterPercent',
  sternThrusterPercent: 'sternThrusterPercent',
};

export class ShipLink {
  // send(values): a Set to the radar, the request number or null.  changed(): something is to be shown anew.
  constructor(send, changed) {
    Object.assign(this, { send, changed, radar: 0, hello: null, instructor: false, isLive: false, herShip: '' });
    this.pending = new PendingRequests();
    this.orders = {};
    for (const name of Object.keys(ORDERS)) {
      this.orders[name] = new SharedSetting((value) => this.pending.add(this.order({ [name]: value }), this.orders[name]), changed);
    }
    this.forget();
  }

  // Another ship, or the same after a break.
  forget() {
    this.ownShip = this.world = null;
    this.heardS = -Infinity;
    this.locked = [];
    this.takes = null;  // the request that takes or gives away the con
    for (const setting of Object.values(this.orders)) { setting.server = null; setting.settle(); }
  }

  takeHello(hello) {
    this.hello = hello;
    if (!hello.radars.some((r) => r.radar === this.radar) && hello.radars.length > 0) this.radar = hello.radars[0].radar;
  }

  // Whoever is of one ship alone has a radar of hers: gives whether that is another one than till now. '': of none.
  goAboard(ship = this.herShip) {
    this.herShip = ship;
    const radars = this.hello?.radars ?? [], hers = radars.find(({ ownShip }) => ownShip === ship);
    if (ship === '' || !hers || radars.find((each) => each.radar === this.radar)?.ownShip === ship) return false;
    this.radar = hers.radar;
    return true;
  }

  takeOwnShip(ownShip, nowS) {
    if (ownShip.radar !== this.radar) return;
    this.ownShip = ownShip;
    this.heardS = nowS;
    if (ownShip.con) for (const [name, told] of Object.entries(ORDERS)) this.orders[name].take(ownShip.con[told]);
    this.changed();
  }

  takeSettings(settings) {
    if (settings.radar !== this.radar) return;
    this.locked = settings.locked;
    this.changed();
  }

  takeReply(reply) {
    this.pending.takeReply(reply);
  }

  // Radars of one ship share her: { radar, name } of each ship.
  ships() {
    const first = new Map();
    for (const { radar, ownShip, name } of this.hello?.radars ?? []) {
      const ship = ownShip || name || `Radar ${radar}`;
      if (!first.has(ship)) first.set(ship, radar);
      if (radar === this.radar) first.set(ship, radar);
    }
    return [...first].map(([name, radar]) => ({ name, radar }));
  }

  isFresh(nowS) {
    return this.isLive && this.ownShip !== null && nowS - this.heardS < SILENCE_S;
  }

  // What is shown: nothing that is out of date.
  view(nowS) {
    const fresh = this.isFresh(nowS);
    const ship = fresh ? this.ownShip : null;
    const you = this.hello?.you ?? '';
    const hindered = hindrance({ fresh, ship, con: ship?.con, you, instructor: this.instructor, playback: this.hello?.playback });
    const locks = this.instructor ? { course: false, speed: false } : lockedOrders(this.locked);
    const orders = {};
    for (const [name, setting] of Object.entries(this.orders)) {
      orders[name] = { value: ship?.con ? setting.value() ?? NaN : NaN, pending: ship !== null && setting.own !== null };
    }
    return { fresh, ship, con: ship?.con ?? null, holder: holderOf(ship?.con, you), hindered, locks, orders };
  }

  order(con) {
    return this.send({ con });
  }

  // Wheel, engine, thrusters: shown at once, sent as fast as the server is to be asked.
  change(name, value) {
    this.orders[name].change(value);
  }

  // The order that a step starts from.
  valueOf(name) {
    return this.orders[name].value() ?? 0;
  }
}
