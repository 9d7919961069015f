// TargetStore: the newest list of targets, where each is by now, and which are selected.
import { t } from '../language/language.js';
import { shortName } from '../names.js';
import { fromPosition, minus, moved, place, polar, velocity } from './motion.js';
import { ACKNOWLEDGED, ACQUIRING, FIRST_TEST, FROZEN, GROUND, LOST } from './wire.js';

// Between lists, targets move on by their vectors for so long; later they are not shown.
const LONGEST_S = 3, STALE_S = 5;
const MOST_NAME = 40, MOST_TEXT = 200;
export const MOST_SELECTED = 4;

export const trackKey = (number) => `t${number}`;
export const aisKey = (mmsi) => `a${mmsi}`;
export const labelOf = (number) => (number >= FIRST_TEST ? `X${number - FIRST_TEST + 1}` : String(number));

export class TargetStore {
  constructor() {
    this.forget();
  }

  forget() {
    this.list = null;
    this.serial = 0;
    this.entries = [];
    this.waitedS = 0;
    this.ageS = 0;         // of the list, in the time of the picture
    this.selected = [];    // keys, the oldest first
  }

  // Texts from outside become lines of bounded length.
  take(list) {
    for (const each of [...list.targets, ...list.ais]) each.name = shortName(each.name, MOST_NAME);
    for (const alert of list.alerts ?? []) Object.assign(alert, { title: shortName(alert.title, MOST_NAME), text: shortName(alert.text, MOST_TEXT) });
    this.list = list;
    this.ageS = 0;
    this.waitedS = 0;
    this.serial += 1;
    this.entries = this.#join(list);
    this.selected = this.selected.filter((key) => this.entries.some((entry) => entry.key === key || entry.also === key))
      .map((key) => this.entries.find((entry) => entry.also === key)?.key ?? key)
      .filter((key, i, all) => all.indexOf(key) === i);
  }

  // rate: of a playback, 0 when it stands.
  pass(seconds, rate = 1) {
    this.ageS += seconds * rate;
    if (rate > 0) this.waitedS += seconds;
  }

  get isStale() {
    return this.list !== null && this.waitedS > STALE_S;
  }

  // What radar and AIS tell of one ship is one entry, with the tracked target's key.
  #join(list) {
    const unacknowledged = list.alerts.filter((alert) => alert.state < ACKNOWLEDGED);
    const calls = (name, value) => value > 0 && unacknowledged.some((alert) => alert[name] === value);
    const byTrack = new Map(list.ais.filter((ais) => ais.target > 0).map((ais) => [ais.target, ais]));
    const entries = list.targets.map((track) => {
      const ais = byTrack.get(track.number) ?? null;
      byTrack.delete(track.number);
      return { key: trackKey(track.number), also: ais ? aisKey(ais.mmsi) : null, track, ais, calls: calls('target', track.number) || calls('mmsi', ais?.mmsi) };
    });
    const joined = new Set(entries.map((entry) => entry.ais));
    for (const ais of list.ais) {
      if (!joined.has(ais)) entries.push({ key: aisKey(ais.mmsi), also: null, track: null, ais, calls: calls('mmsi', ais.mmsi) });
    }
    return entries;
  }

  find(key) {
    return this.entries?.find((entry) => entry.key === key) ?? null;
  }

  get selectedEntries() {
    return this.selected.map((key) => this.find(key)).filter(Boolean);
  }

  toggle(key) {
    if (this.selected.includes(key)) this.selected = this.selected.filter((other) => other !== key);
    else this.selected = [...this.selected, key].slice(-MOST_SELECTED);
  }

  select(key) {
    if (!this.selected.includes(key)) this.toggle(key);
  }

  get stepS() {
    return Math.min(this.ageS, LONGEST_S);
  }
}

// What is shown of an entry: by radar, or by AIS where both know it and AIS is chosen. Own ship's motion: own.list, that
// of the list, in its stabilisation; own.ground, over ground; each null where it is not known.
//   { source, at (place now), motion, relative (velocities or null), cpaNm, tcpaMin, isDangerous, isLost, ... }
export function shownOf(entry, joined, own, stepS) {
  const { track, ais } = entry;
  const byAis = ais !== null && (track === null || joined === 'ais');
  const from = byAis ? ais : track;
  const motion = velocity(from.courseDeg, from.speedKn);
  const relative = byAis ? minus(motion, own.ground) : velocity(track.relativeCourseDeg, track.relativeSpeedKn);
  const rests = byAis ? ais.isLost : track.state === LOST || track.state === FROZEN || track.state === ACQUIRING;
  const at = moved(place(from.bearingDeg, from.rangeM), rests ? null : relative, stepS);
  return {
    entry, key: entry.key, byAis, from, at, ...polar(at), motion, relative,
    source: ais && track ? (byAis ? t('AIS + radar') : t('Radar + AIS')) : byAis ? 'AIS' : track.isTest ? t('Test') : t('Radar'),
    isActive: byAis ? ais.isActivated || track !== null : true,
    isDangerous: (track?.isDangerous ?? false) || (ais?.isDangerous ?? false),
    isLost: byAis ? ais.isLost : track.state === LOST,
    calls: entry.calls,
  };
}

// ownShip: the OwnShip message, or null.
export function ownMotion(list, ownShip) {
  const inUse = velocity(list.ownCourseDeg, list.ownSpeedKn);
  const known = ownShip && !ownShip.noMotion;
  const ground = list.stabilisation === GROUND ? inUse : known ? velocity(ownShip.courseOverGroundDeg, ownShip.speedOverGroundKn) : null;
  return { list: inUse, ground, position: { latitudeDeg: list.ownLatitudeDeg, longitudeDeg: list.ownLongitudeDeg } };
}

// Places of past positions by now. Relative ones are as they were seen; true ones lie still over ground.
export function pastPlaces(track, own, relative, stepS) {
  if (relative) return track.past.map((past) => place(past.bearingDeg, past.rangeM));
  return track.past.map((past) => moved(fromPosition(own.position, past), minus({ east: 0, north: 0 }, own.ground), stepS));
}
