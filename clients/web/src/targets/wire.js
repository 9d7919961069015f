// The messages of protocol/wire/targets.proto: what a view's plotter tells, and what a mariner orders of it.
import { message, WireError, Writer } from '../protobuf.js';

// TargetState, AlertPriority, AlertState, Stabilisation, AutoAcquire and TargetZone.Kind of the schema.
export const ACQUIRING = 0, TREND = 1, TRACKED = 2, LOST = 3, FROZEN = 4;
export const CAUTION = 0, WARNING = 1, ALARM = 2;
export const ACTIVE = 0, SILENCED = 1, ACKNOWLEDGED = 2, RECTIFIED = 3;
export const GROUND = 0, WATER = 1;
export const ACQUIRES = 0, EXCLUDES = 1;
// Test targets are numbered from here on.
export const FIRST_TEST = 1000001;
// More of any is no list of a plotter: a server tracks at most 200 and tells of 240 by AIS.
const MOST = { targets: 1000, ais: 1000, alerts: 2000, zones: 64, past: 200, outcomes: 2000 };

const PastPlace = message({ 1: ['latitudeDeg', 'double'], 2: ['longitudeDeg', 'double'], 3: ['rangeM', 'double'], 4: ['bearingDeg', 'double'] });
const Target = message({
  1: ['number', 'uint32'], 2: ['state', 'uint32'], 3: ['byHand', 'bool'], 4: ['latitudeDeg', 'double'], 5: ['longitudeDeg', 'double'],
  6: ['rangeM', 'double'], 7: ['bearingDeg', 'double'], 8: ['courseDeg', 'double?'], 9: ['speedKn', 'double?'],
  10: ['relativeCourseDeg', 'double?'], 11: ['relativeSpeedKn', 'double?'], 12: ['cpaNm', 'double?'], 13: ['tcpaMin', 'double?'],
  14: ['isDangerous', 'bool'], 15: ['isNew', 'bool'], 16: ['isReference', 'bool'], 17: ['isTest', 'bool'], 18: ['ageS', 'double'],
  19: ['trackedS', 'double'], 20: ['hits', 'uint32'], 21: ['looks', 'uint32'], 22: ['placeSigmaM', 'double'],
  23: ['speedSigmaKn', 'double'], 24: ['lengthM', 'double'], 25: ['widthM', 'double'], 26: ['mmsi', 'uint32'], 27: ['name', 'string'],
  28: ['past', [PastPlace]],
});
const AisTarget = message({
  1: ['mmsi', 'uint32'], 2: ['name', 'string'], 3: ['latitudeDeg', 'double'], 4: ['longitudeDeg', 'double'], 5: ['rangeM', 'double'],
  6: ['bearingDeg', 'double'], 7: ['courseDeg', 'double?'], 8: ['speedKn', 'double?'], 9: ['headingDeg', 'double?'],
  10: ['cpaNm', 'double?'], 11: ['tcpaMin', 'double?'], 12: ['isDangerous', 'bool'], 13: ['isActivated', 'bool'], 14: ['isLost', 'bool'],
  15: ['target', 'uint32'], 16: ['ageS', 'double'],
});
const Alert = message({
  1: ['number', 'uint32'], 2: ['instance', 'uint32'], 3: ['revision', 'uint32'], 4: ['priority', 'uint32'], 5: ['category', 'string'],
  6: ['state', 'uint32'], 7: ['title', 'string'], 8: ['text', 'string'], 9: ['target', 'uint32'], 10: ['mmsi', 'uint32'],
  11: ['utcNs', 'fixed64'], 12: ['escalations', 'uint32'],
});
const TargetZone = message({
  1: ['number', 'uint32'], 2: ['kind', 'uint32'], 3: ['innerNm', 'double'], 4: ['outerNm', 'double'], 5: ['fromDeg', 'double'],
  6: ['toDeg', 'double'], 7: ['relative', 'bool'],
});
const TargetRules = message({
  1: ['acquire', 'uint32?'], 2: ['capacity', 'uint32?'], 3: ['cpaNm', 'double?'], 4: ['tcpaMin', 'double?'],
  5: ['stabilisation', 'uint32?'], 6: ['pastIntervalS', 'double?'], 7: ['associate', 'bool?'], 8: ['associationPercent', 'double?'],
  9: ['lostWarnings', 'bool?'], 10: ['leastSpeedKn', 'double?'], 11: ['furthestNm', 'double?'],
});
const TrialOrder = message({
  1: ['courseDeg', 'double'], 2: ['speedKn', 'double'], 3: ['delayMin', 'double'], 4: ['turnRateDegMin', 'double'],
  5: ['accelerationKnMin', 'double'],
});
const Outcome = message({
  1: ['target', 'uint32'], 2: ['mmsi', 'uint32'], 3: ['cpaNm', 'double'], 4: ['tcpaMin', 'double'], 5: ['isDangerous', 'bool'],
});
const Trial = message({ 1: ['order', TrialOrder], 2: ['beginsS', 'double'], 3: ['outcomes', [Outcome]] });
export const TargetList = message({
  1: ['radar', 'uint32'], 2: ['view', 'uint32'], 3: ['utcNs', 'fixed64'], 4: ['scenarioNs', 'fixed64'], 5: ['targets', [Target]],
  6: ['ais', [AisTarget]], 7: ['alerts', [Alert]], 8: ['stabilisation', 'uint32'], 9: ['stabilisedBy', 'string'], 10: ['problem', 'string'],
  11: ['rules', TargetRules], 12: ['zones', [TargetZone]], 13: ['tracked', 'uint32'], 14: ['trial', Trial], 15: ['testTargets', 'bool'],
  16: ['ownCourseDeg', 'double?'], 17: ['ownSpeedKn', 'double?'], 18: ['ownLatitudeDeg', 'double'], 19: ['ownLongitudeDeg', 'double'],
  20: ['ownHeadingDeg', 'double?'], 21: ['plots', 'uint64'], 22: ['spokesLost', 'uint64'], 23: ['aisLeftOut', 'uint32'],
});

// What a number's name says of its bounds. Widely set: they keep nonsense out of the picture, not bad luck.
const BOUNDS = [
  [/LatitudeDeg$|^latitudeDeg$/, -90, 90], [/LongitudeDeg$|^longitudeDeg$/, -180, 180], [/Deg$/, -360, 360],
  [/^rangeM$/, 0, 1e6], [/Kn$/, -1000, 1000], [/^tcpaMin$/, -1e9, 1e9], [/^(cpa|inner|outer|furthest)Nm$/, 0, 1e5], [/S$/, -1e9, 1e9],
];

function checkNumbers(part, at) {
  for (const [name, value] of Object.entries(part)) {
    if (typeof value !== 'number') continue;
    const [, least, most] = BOUNDS.find(([named]) => named.test(name)) ?? [null, -Infinity, Infinity];
    if (!Number.isFinite(value) || value < least || value > most) throw new WireError('out_of_range', at, `${name} ${value}`);
  }
}

// Error: WireError where a list cannot be.
export function checkTargets(list, at) {
  const { targets, ais, alerts, zones, rules, trial } = list;
  const outcomes = trial?.outcomes ?? [];
  const counted = { targets, ais, alerts, zones, outcomes };
  for (const target of targets) if (target.past.length > MOST.past) counted.past = target.past;
  for (const [name, entries] of Object.entries(counted)) {
    if (entries.length > MOST[name]) throw new WireError('out_of_range', at, `${entries.length} ${name}, at most ${MOST[name]}`);
  }
  for (const part of [list, ...targets, ...targets.flatMap((target) => target.past), ...ais, ...alerts, ...zones, ...outcomes, rules, trial, trial?.order]) {
    if (part) checkNumbers(part, at);
  }
}

const RULE_FIELDS = {
  acquire: [1, 'uint32'], capacity: [2, 'uint32'], cpaNm: [3, 'double'], tcpaMin: [4, 'double'], stabilisation: [5, 'uint32'],
  pastIntervalS: [6, 'double'], associate: [7, 'uint32'], associationPercent: [8, 'double'], lostWarnings: [9, 'uint32'],
  leastSpeedKn: [10, 'double'], furthestNm: [11, 'double'],
};
const ACQUIRE_FIELDS = { rangeNm: [1, 'double'], bearingDeg: [2, 'double'], latitudeDeg: [3, 'double'], longitudeDeg: [4, 'double'] };
const ZONE_FIELDS = {
  number: [1, 'uint32'], kind: [2, 'uint32'], innerNm: [3, 'double'], outerNm: [4, 'double'], fromDeg: [5, 'double'], toDeg: [6, 'double'],
  relative: [7, 'uint32'],
};
const TRIAL_FIELDS = {
  courseDeg: [1, 'double'], speedKn: [2, 'double'], delayMin: [3, 'double'], turnRateDegMin: [4, 'double'], accelerationKnMin: [5, 'double'],
};
const KEY_FIELDS = { number: [1, 'uint32'], instance: [2, 'uint32'] };
const FLAGS = { cancelAll: 6, reference: 10, endTrial: 12, testTargets: 13, silence: 15, defaultRules: 18 };
const NUMBERS = { cancel: 5, removeZones: 9, activate: 16, letSleep: 17 };

function encode(fields, values) {
  const writer = new Writer();
  for (const [name, [field, type]] of Object.entries(fields)) if (values[name] !== undefined) writer[type](field, Number(values[name]));
  return writer.finish();
}

// order: any fields of TargetOrder by their names: acquire, cancel, cancelAll, rules, zones, removeZones, reference,
// trial, endTrial, testTargets, acknowledge, silence, activate, letSleep, defaultRules.
export function encodeTargetOrderBody(radar, view, order, token = '') {
  const writer = new Writer().uint32(1, radar).uint32(2, view);
  if (token) writer.string(3, token);
  if (order.acquire) writer.bytes(4, encode(ACQUIRE_FIELDS, order.acquire));
  if (order.rules) writer.bytes(7, encode(RULE_FIELDS, order.rules));
  for (const zone of order.zones ?? []) writer.bytes(8, encode(ZONE_FIELDS, zone));
  if (order.trial) writer.bytes(11, encode(TRIAL_FIELDS, order.trial));
  for (const key of order.acknowledge ?? []) writer.bytes(14, encode(KEY_FIELDS, key));
  for (const [name, field] of Object.entries(NUMBERS)) for (const number of order[name] ?? []) writer.uint32(field, number);
  for (const [name, field] of Object.entries(FLAGS)) if (order[name] !== undefined) writer.uint32(field, Number(order[name]));
  return writer.finish();
}
