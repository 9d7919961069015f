// Exercise: what this page knows of it, and which ships are selected. No drawing.
import { Tracks } from './tracks.js';

export const keyOf = (ship) => `${ship.own ? 'own' : 'target'}-${ship.number}`;

export class Exercise {
  constructor(changed) {
    Object.assign(this, { changed, selection: [], grouping: false });
    this.forget();
  }

  // After a break.
  forget() {
    this.state = this.world = null;
    this.byKey = new Map();
    this.tracks = new Tracks();
  }

  // leapt: so much lies between this and the state before that nobody knows where ships sailed.
  take(state, leapt = false) {
    this.state = state;
    this.byKey = new Map(state.ships.map((ship) => [keyOf(ship), ship]));
    const known = this.selection.filter((key) => this.byKey.has(key));
    if (known.length !== this.selection.length) this.selection = known;
    this.tracks.take(
      state.exerciseS,
      state.ships
        .filter((ship) => !ship.removed)
        .map((ship) => ({ key: keyOf(ship), latitudeDeg: ship.latitudeDeg, longitudeDeg: ship.longitudeDeg })),
      leapt,
    );
    this.changed();
  }

  get ships() {
    return this.state?.ships ?? [];
  }

  get chosen() {
    return this.selection.map((key) => this.byKey.get(key)).filter(Boolean);
  }

  get chosenTargets() {
    return this.chosen.filter((ship) => !ship.own);
  }

  get chosenOwn() {
    return this.chosen.filter((ship) => ship.own);
  }

  get own() {
    return this.ships.filter((ship) => ship.own);
  }

  isChosen(ship) {
    return this.selection.includes(keyOf(ship));
  }

  // ship: null for none.  add: to those that are selected, or away from them.
  select(ship, add = this.grouping) {
    // What is being typed is for the ships that were selected.
    document.activeElement?.closest?.('[data-of-ship]') && document.activeElement.blur();
    if (ship === null) {
      if (!add) this.selection = [];
    } else {
      const key = keyOf(ship),
        had = this.selection.includes(key);
      if (!add) this.selection = [key];
      else this.selection = had ? this.selection.filter((k) => k !== key) : [...this.selection, key];
    }
    this.changed();
  }
}
