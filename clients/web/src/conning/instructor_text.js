// The instructor's text to this con: shown until it is acknowledged, also on a page that was opened later.
import { $, write } from '../widgets.js';

const REMEMBERED = 'skerry.texts';

export class InstructorText {
  constructor() {
    this.read = new Map(); // ship -> how many of her texts were acknowledged
    this.ship = null;
    try {
      this.read = new Map(JSON.parse(sessionStorage.getItem(REMEMBERED)) ?? []);
    } catch {
      // Nothing is remembered: the last text is shown again.
    }
    $('message-read').addEventListener('click', () => this.acknowledge());
  }

  // ship: OwnShip, or null while nothing is known.
  show(ship) {
    if (!ship) return;
    this.ship = ship;
    // A server that began anew counts from 0.
    if (ship.texts < (this.read.get(ship.name) ?? 0)) this.read.set(ship.name, 0);
    const isNew = ship.text !== '' && ship.texts > (this.read.get(ship.name) ?? 0);
    $('message').hidden = !isNew;
    if (isNew) write('message-text', ship.text);
  }

  acknowledge() {
    if (!this.ship) return;
    this.read.set(this.ship.name, this.ship.texts);
    try {
      sessionStorage.setItem(REMEMBERED, JSON.stringify([...this.read]));
    } catch {
      // It is acknowledged for as long as the page lives.
    }
    this.show(this.ship);
  }
}
