// What panel and list say of a target, as texts. What is not known, or not valid any more, is a dash.
import { bearing, fixed, NONE } from '../format.js';
import { later, t } from '../language/language.js';
import { NAUTICAL_MILE_M } from '../view_geometry.js';
import { bowCrossing, courseAndSpeed } from './motion.js';
import { labelOf } from './target_store.js';
import { ACQUIRING, FROZEN, LOST } from './wire.js';

const STATES = [later('ACQUIRING'), later('TREND'), later('TRACKED'), later('LOST'), later('FROZEN')];

function statesOf({ entry: { track, ais }, byAis, isLost }) {
  const tracked = track && (byAis && track.state === LOST ? t('TRACK LOST') : STATES[track.state] ? t(STATES[track.state]) : NONE);
  const words = [tracked ?? (isLost ? t('LOST') : ais.isActivated ? t('ACTIVATED') : t('SLEEPING'))];
  if (byAis && track && isLost) words.push(t('AIS LOST'));
  if (track?.isReference) words.push(t('REF'));
  return words;
}
export const stateOf = (shown) => statesOf(shown).join(' ');
// The same without what goes without saying in a list.
export function unusualStateOf(shown) {
  const usual = [t('TRACKED'), t('ACTIVATED')];
  return statesOf(shown).filter((words) => !usual.includes(words)).join(' ');
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
    [t('Name'), '', nameOf(shown.entry)],
    ['MMSI', '', String(ais?.mmsi || track?.mmsi || NONE)],
    [t('Source'), '', shown.source],
    [t('State'), '', stateOf(shown)],
    [t('Range'), 'NM', rangeText(shown)],
    [t('Bearing'), '\u00b0T', bearing(shown.bearingDeg)],
    ['CPA', 'NM', of(from.cpaNm, cpaText)],
    ['TCPA', 'min', of(from.tcpaMin, tcpaText)],
    [t('Course'), '\u00b0T', of(from.courseDeg, bearing)],
    [t('Speed'), 'kn', of(from.speedKn, (kn) => fixed(kn, 1))],
    [t('Rel. course'), '\u00b0T', of(relative.courseDeg, bearing)],
    [t('Rel. speed'), 'kn', of(relative.speedKn, (kn) => fixed(kn, 1))],
    ['BCR', 'NM', fixed(bow ? bow.rangeM / NAUTICAL_MILE_M : NaN, 2)],
    ['BCT', 'min', fixed(bow ? bow.seconds / 60 : NaN, 1)],
    [t('Hits'), '', track && !track.isTest ? `${track.hits}/${track.looks}` : NONE],
  ];
  if (trialOutcome !== undefined) {
    rows.push([t('Trial CPA'), 'NM', cpaText(trialOutcome?.cpaNm)], [t('Trial TCPA'), 'min', tcpaText(trialOutcome?.tcpaMin)]);
  }
  return rows;
}
