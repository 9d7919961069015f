// Lists of targets for tests: TargetList, Target, AisTarget and Alert of targets.proto with every field that a plotter sets.
import { NM } from './mock_scene.mjs';

export const OWN = { ownLatitudeDeg: 60.3925, ownLongitudeDeg: 5.3233 };
export const RULES = {
  acquire: 1, capacity: 100, cpaNm: 1, tcpaMin: 12, stabilisation: 0, pastIntervalS: 120, associate: true, associationPercent: 100,
  lostWarnings: true, leastSpeedKn: 2, furthestNm: 24,
};

// A place near own ship's, on a sphere.
export function placeAt(bearingDeg, rangeM) {
  const angle = (bearingDeg * Math.PI) / 180;
  return {
    latitudeDeg: OWN.ownLatitudeDeg + (rangeM * Math.cos(angle)) / 111412,
    longitudeDeg: OWN.ownLongitudeDeg + (rangeM * Math.sin(angle)) / (111412 * Math.cos((OWN.ownLatitudeDeg * Math.PI) / 180)),
  };
}

// state: TargetState; a motion only where more gives one.
export function target(number, bearingDeg, rangeNm, state = 2, more = {}) {
  return { number, state, bearingDeg, rangeM: rangeNm * NM, ...placeAt(bearingDeg, rangeNm * NM), trackedS: 400, hits: 9, looks: 10, ...more };
}

export function ais(mmsi, bearingDeg, rangeNm, more = {}) {
  return { mmsi, bearingDeg, rangeM: rangeNm * NM, ...placeAt(bearingDeg, rangeNm * NM), ...more };
}

export const alert = (number, instance, priority, more = {}) => ({
  number, instance, priority, revision: 1, category: number === 3044 ? 'A' : 'B', state: 0, title: 'CPA/TCPA', text: `Target ${instance}: near`, target: instance,
  utcNs: 1.7e18, ...more,
});

export function targetList(more = {}) {
  return {
    targets: [], ais: [], alerts: [], zones: [], stabilisation: 0, stabilisedBy: 'GNSS', problem: '', rules: { ...RULES }, tracked: 0, trial: null, testTargets: false,
    ownCourseDeg: 0, ownSpeedKn: 12, ownHeadingDeg: 0, ...OWN, ...more,
  };
}
