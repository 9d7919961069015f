// Tracks: where ships have been, as long as this page has looked. True positions, on the exercise's clock.
import { fromTo } from './place.js';

const EVERY_S = 10,
  KEPT_S = 3600,
  MOST = 400;
// A ship that is so much faster than any was put there.
const LEAP_MPS = 45,
  LEAP_M = 150;

export class Tracks {
  constructor() {
    this.of = new Map(); // key -> [{ s, latitudeDeg, longitudeDeg, leap }], oldest first
    this.nowS = 0;
  }

  // ships: { key, latitudeDeg, longitudeDeg } of all that are on the water.  leapt: all tracks begin anew here, as
  // after a seek.
  take(nowS, ships, leapt = false) {
    // Back to a snapshot: what came after it has not been.
    if (nowS < this.nowS) {
      for (const [key, track] of this.of)
        this.of.set(
          key,
          track.filter((point) => point.s <= nowS),
        );
    }
    this.nowS = nowS;
    for (const ship of ships) {
      const track = this.of.get(ship.key) ?? [];
      this.of.set(ship.key, track);
      const last = track.at(-1);
      const { latitudeDeg, longitudeDeg } = ship;
      const metres = last ? fromTo(last, ship).metres : 0;
      const leap = last !== undefined && (leapt || metres > LEAP_M + LEAP_MPS * (nowS - last.s));
      if (last && !leap && nowS - last.s < EVERY_S) continue;
      track.push({ s: nowS, latitudeDeg, longitudeDeg, leap });
      while (track.length > MOST || track[0].s < nowS - KEPT_S) track.shift();
    }
  }

  // Its parts without leaps, newer than `lengthS`.
  partsOf(key, lengthS) {
    const parts = [];
    for (const point of this.of.get(key) ?? []) {
      if (point.s < this.nowS - lengthS) continue;
      if (point.leap || parts.length === 0) parts.push([]);
      parts.at(-1).push(point);
    }
    return parts;
  }
}
