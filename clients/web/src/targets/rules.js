// Bounds of what may be ordered of the plotter: those of targets.proto, unless /controls.json has others.
export const RULES = [
  { name: 'cpaNm', label: 'CPA limit', min: 0, max: 10, unit: 'NM', help: 'Closer is dangerous, if soon; 0: no alarm' },
  { name: 'tcpaMin', label: 'TCPA limit', min: 1, max: 99, unit: 'min', help: 'Sooner is dangerous, if close' },
  { name: 'pastIntervalS', label: 'Past interval', min: 15, max: 360, unit: 's', help: 'Between past positions' },
  { name: 'capacity', label: 'Capacity', min: 10, max: 200, unit: '', help: 'Targets tracked at once' },
  { name: 'associationPercent', label: 'Association', min: 100, max: 300, unit: '%', help: 'How far AIS and track may differ' },
  { name: 'leastSpeedKn', label: 'Least speed', min: 0, max: 20, unit: 'kn', help: 'What is slower does not move' },
  { name: 'furthestNm', label: 'Furthest', min: 0.1, max: 48, unit: 'NM', help: 'Beyond, nothing is acquired' },
];
export const ZONES = [
  { name: 'innerNm', label: 'From range', min: 0, max: 48, unit: 'NM' },
  { name: 'outerNm', label: 'To range', min: 0.1, max: 48, unit: 'NM' },
  { name: 'fromDeg', label: 'From', min: 0, max: 360, unit: '\u00b0' },
  { name: 'toDeg', label: 'To', min: 0, max: 360, unit: '\u00b0', help: 'Clockwise; where both are equal: all round' },
];
export const TRIALS = [
  { name: 'courseDeg', label: 'Course', min: 0, max: 360, unit: '\u00b0' },
  { name: 'speedKn', label: 'Speed', min: 0, max: 60, unit: 'kn' },
  { name: 'delayMin', label: 'Delay', min: 0, max: 30, unit: 'min', help: 'Until she begins' },
  { name: 'turnRateDegMin', label: 'Rate of turn', min: 0, max: 720, unit: '\u00b0/min', help: '0: at once' },
  { name: 'accelerationKnMin', label: 'Acceleration', min: 0, max: 60, unit: 'kn/min', help: '0: at once' },
];
export const MOST_ZONES = 8;

// entries: of /controls.json, or undefined where it has none.
export function withBounds(rules, entries) {
  return rules.map((rule) => {
    const told = entries?.find?.((entry) => entry.name === rule.name);
    return { ...rule, min: told?.min ?? rule.min, max: told?.max ?? rule.max };
  });
}
