// Bounds of what may be ordered of the plotter: those of targets.proto, unless /controls.json has others.
import { later } from '../language/language.js';

export const RULES = [
  { name: 'cpaNm', label: later('CPA limit'), min: 0, max: 10, unit: 'NM', help: later('Closer is dangerous, if soon; 0: no alarm') },
  { name: 'tcpaMin', label: later('TCPA limit'), min: 1, max: 99, unit: 'min', help: later('Sooner is dangerous, if close') },
  { name: 'pastIntervalS', label: later('Past interval'), min: 15, max: 360, unit: 's', help: later('Between past positions') },
  { name: 'capacity', label: later('Capacity'), min: 10, max: 200, unit: '', help: later('Targets tracked at once') },
  { name: 'associationPercent', label: later('Association'), min: 100, max: 300, unit: '%', help: later('How far AIS and track may differ') },
  { name: 'leastSpeedKn', label: later('Least speed'), min: 0, max: 20, unit: 'kn', help: later('What is slower does not move') },
  { name: 'furthestNm', label: later('Furthest'), min: 0.1, max: 48, unit: 'NM', help: later('Beyond, nothing is acquired') },
];
export const ZONES = [
  { name: 'innerNm', label: later('From range'), min: 0, max: 48, unit: 'NM' },
  { name: 'outerNm', label: later('To range'), min: 0.1, max: 48, unit: 'NM' },
  { name: 'fromDeg', label: later('From'), min: 0, max: 360, unit: '\u00b0' },
  { name: 'toDeg', label: later('To'), min: 0, max: 360, unit: '\u00b0', help: later('Clockwise; where both are equal: all round') },
];
export const TRIALS = [
  { name: 'courseDeg', label: later('Course'), min: 0, max: 360, unit: '\u00b0' },
  { name: 'speedKn', label: later('Speed'), min: 0, max: 60, unit: 'kn' },
  { name: 'delayMin', label: later('Delay'), min: 0, max: 30, unit: 'min', help: later('Until she begins') },
  { name: 'turnRateDegMin', label: later('Rate of turn'), min: 0, max: 720, unit: '\u00b0/min', help: later('0: at once') },
  { name: 'accelerationKnMin', label: later('Acceleration'), min: 0, max: 60, unit: 'kn/min', help: later('0: at once') },
];
export const MOST_ZONES = 8;

// entries: of /controls.json, or undefined where it has none.
export function withBounds(rules, entries) {
  return rules.map((rule) => {
    const told = entries?.find?.((entry) => entry.name === rule.name);
    return { ...rule, min: told?.min ?? rule.min, max: told?.max ?? rule.max };
  });
}
