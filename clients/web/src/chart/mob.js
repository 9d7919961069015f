// Mob: a man overboard. His place is marked, with bearing, range and the time since, until that is cancelled twice over. Kept in this
// browser, so that a page that is loaded again still has it.
import { bearing, distance, duration, position } from '../format.js';
import { t } from '../language/language.js';
import { $, write } from '../widgets.js';
import { bearingRange } from './earth.js';

const KEY = 'skerry.mob';
const SURE_MS = 6000;  // the second press of Cancel must come within this

export class Mob {
  // now(): { place, utcMs } of own ship; place null: not known. notify(text): to the operator.
  constructor(now, notify, storage = localStorage) {
    Object.assign(this, { now, notify, storage, at: kept(storage), sureUntilMs: 0 });
    $('mob-mark').addEventListener('click', () => this.mark());
    $('mob-cancel').addEventListener('click', () => this.#cancel());
    this.show();
  }

  mark() {
    const { place, utcMs } = this.now();
    if (this.at) return this.notify(t('Man overboard is marked already; cancel that first'));
    if (!place) return this.notify(t('Man overboard was not marked: own ship\u2019s position is not known'));
    this.at = { ...place, utcMs };
    this.#keep();
    return this.show();
  }

  #cancel() {
    if (performance.now() > this.sureUntilMs) {
      this.sureUntilMs = performance.now() + SURE_MS;
    } else {
      this.at = null;
      this.sureUntilMs = 0;
      this.#keep();
    }
    this.show();
  }

  #keep() {
    try {
      if (this.at) this.storage.setItem(KEY, JSON.stringify(this.at));
      else this.storage.removeItem(KEY);
    } catch {
      // A browser that keeps nothing still shows him.
    }
  }

  // A few times a second.
  show() {
    $('mob').hidden = this.at === null;
    write('mob-alert', this.at ? t('Man overboard is marked') : '');
    if (!this.at) return;
    const { place, utcMs } = this.now();
    const to = place ? bearingRange(place, this.at) : { bearingDeg: NaN, rangeM: NaN };
    write('mob-bearing', `${bearing(to.bearingDeg)}°`);
    write('mob-range', distance(to.rangeM));
    write('mob-since', duration((utcMs - this.at.utcMs) / 1000));
    write('mob-place', `${position(this.at.latitudeDeg, 'N', 'S', 2)} ${position(this.at.longitudeDeg, 'E', 'W', 3)}`);
    write('mob-cancel', performance.now() <= this.sureUntilMs ? t('Press again to cancel') : t('mark|Cancel'));
  }
}

function kept(storage) {
  try {
    const { latitudeDeg, longitudeDeg, utcMs } = JSON.parse(storage.getItem(KEY)) ?? {};
    const isPlace = Math.abs(latitudeDeg) <= 90 && Math.abs(longitudeDeg) <= 180 && Number.isFinite(utcMs);
    return isPlace ? { latitudeDeg, longitudeDeg, utcMs } : null;
  } catch {
    return null;
  }
}
