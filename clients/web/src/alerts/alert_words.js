// Alerts by IEC 62923-1 as words and symbols: a priority is told by shape and word, and by colour besides.
import { later, t } from '../language/language.js';
import { ACKNOWLEDGED, ACTIVE, ALARM, CAUTION, RECTIFIED, SILENCED, WARNING } from '../targets/wire.js';

// Full: not acknowledged; hollow: acknowledged.
const PRIORITIES = {
  [ALARM]: { word: later('Alarm'), name: 'alarm', full: '\u25b2', hollow: '\u25b3' },
  [WARNING]: { word: later('Warning'), name: 'warning', full: '\u25cf', hollow: '\u25cb' },
  [CAUTION]: { word: later('Caution'), name: 'caution', full: '\u25a0', hollow: '\u25a1' },
};
const STATES = {
  [ACTIVE]: later('not acknowledged'), [SILENCED]: later('silenced'), [ACKNOWLEDGED]: later('acknowledged'), [RECTIFIED]: later('rectified, not acknowledged'),
};

// A priority above what is known here, such as an emergency, is an alarm.
export const rankOf = ({ priority }) => Math.min(priority, ALARM);
export const priorityOf = (alert) => PRIORITIES[rankOf(alert)] ?? PRIORITIES[CAUTION];
export const wordOf = (alert) => t(priorityOf(alert).word);
export const stateWord = ({ state }) => (STATES[state] ? t(STATES[state]) : t('state {state}', { state }));
export const keyOf = ({ number, instance }) => `${number}.${instance}`;
export const symbolOf = (alert) => (alert.state === ACKNOWLEDGED ? priorityOf(alert).hollow : priorityOf(alert).full);
// Cautions are not acknowledged, nor is anything of category C.
export const mayBeAcknowledged = (alert) => alert.state !== ACKNOWLEDGED && alert.priority !== CAUTION && alert.category !== 'C';
export const isUnacknowledged = (alert) => alert.state !== ACKNOWLEDGED && alert.priority !== CAUTION;

// 14:03:59, UTC; nanoseconds since 1970.
export function clockOf(utcNs) {
  const at = new Date(utcNs / 1e6);
  return utcNs > 0 && !Number.isNaN(at.getTime()) ? at.toISOString().slice(11, 19) : '\u2013';
}

// The worst first: what is not acknowledged, then by priority, then the newest.
export function byUrgency(a, b) {
  return isUnacknowledged(b) - isUnacknowledged(a) || rankOf(b) - rankOf(a) || b.utcNs - a.utcNs;
}
