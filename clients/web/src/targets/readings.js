// What panel and list say of a target, as texts. What is not known, or not valid any more, is a dash.
import { bearing, fixed, NONE } from '../format.js';
import { NAUTICAL_MILE_M } from '../view_geometry.js';
import { bowCrossing, courseAndSpeed } from './motion.js';
import { labelOf } from './target_store.js';
import { ACQUIRING, FROZEN, LOST } from './wire.js';

const STATES = ['ACQUIRING', 'TREND', 'TRACKED', 'LOST', 'FROZEN'];

export function stateOf({ entry: { track, ais }, byAis, isLost }) {
  const words = track ? [byAis && track.state === LOST ? 'TRACK LOST' : STATES[track.state] ?? NONE] : [isLost ? 'LOST' : ais.isActivated ? 'ACTIVATED' : 'SLEEPING'];
  if (byAis && track && isLost) words.push('AIS LOST');
  if (track?.isReference) words.push('REF');
  return words.join(' ');
}

export const nameOf = ({ track, ais }) => track?.name || ais?.name || String(track?.mmsi || ais?.mmsi || NONE);
export const headingOf = ({ track, ais }) => (track ? labelOf(track.number) : ais.name || String(ais.mmsi));
export const rangeText = (shown) => fixed(shown.rangeM / NAUTICAL_MILE_M, 2);
const signed = (value, digits) => fixed(value, digits).replace('-', '\u2212');
export const tcpaText = (minutes) => signed(minutes, 1);
export const cpaText = (nm) => fixed(nm, 2);

// Whether motions and approaches still hold.
export function isValid({ entry: { track }, byAis, isLost }) {
  if (isLost) return false;
  return byAis || ![ACQUIRING, LOST, FROZEN].includes(track.state);
}

// [label, unit, text] of each row of the panel.
export function readings(shown, headingDeg, trialOutcome) {
  const { entry: { track, ais }, from } = shown;
  const holds = isValid(shown);
  const of = (value, words) => (holds ? words(value) : NONE);
  const relative = courseAndSpeed(shown.relative);
  const bow = holds ? bowCrossing(shown.at, shown.relative, headingDeg) : null;
  const rows = [
    ['Name', '', nameOf(shown.entry)],
    ['MMSI', '', String(ais?.mmsi || track?.mmsi || NONE)],
    ['Source', '', shown.source],
    ['State', '', stateOf(shown)],
    ['Range', 'NM', rangeText(shown)],
    ['Bearing', '\u00b0T', bearing(shown.bearingDeg)],
    ['CPA', 'NM', of(from.cpaNm, cpaText)],
    ['TCPA', 'min', of(from.tcpaMin, tcpaText)],
    ['Course', '\u00b0T', of(from.courseDeg, bearing)],
    ['Speed', 'kn', of(from.speedKn, (kn) => fixed(kn, 1))],
    ['Rel. course', '\u00b0T', of(relative.courseDeg, bearing)],
    ['Rel. speed', 'kn', of(relative.speedKn, (kn) => fixed(kn, 1))],
    ['BCR', 'NM', fixed(bow ? bow.rangeM / NAUTICAL_MILE_M : NaN, 2)],
    ['BCT', 'min', fixed(bow ? bow.seconds / 60 : NaN, 1)],
    ['Hits', '', track && !track.isTest ? `${track.hits}/${track.looks}` : NONE],
  ];
  if (trialOutcome !== undefined) {
    rows.push(['Trial CPA', 'NM', cpaText(trialOutcome?.cpaNm)], ['Trial TCPA', 'min', tcpaText(trialOutcome?.tcpaMin)]);
  }
  return rows;
}
