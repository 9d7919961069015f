// Targets and alerts without a browser: messages against protobufjs, motion against closed forms.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { AlertHistory } from '../../../../clients/web/src/alerts/alert_history.js';
import { AlertSound } from '../../../../clients/web/src/alerts/alert_sound.js';
import { byUrgency, clockOf, mayBeAcknowledged, priorityOf, symbolOf } from '../../../../clients/web/src/alerts/alert_words.js';
import { decodeFrames, encodeSubscribe, encodeTargetOrder } from '../../../../clients/web/src/messages.js';
import { WireError } from '../../../../clients/web/src/protobuf.js';
import { bowCrossing, courseAndSpeed, fromPosition, place, polar, trialPath, velocity } from '../../../../clients/web/src/targets/motion.js';
import { readings } from '../../../../clients/web/src/targets/readings.js';
import { RULES, TRIALS, withBounds, ZONES } from '../../../../clients/web/src/targets/rules.js';
import { ownMotion, shownOf, TargetStore } from '../../../../clients/web/src/targets/target_store.js';
import { VectorSettings } from '../../../../clients/web/src/targets/vector_settings.js';
import { widthDeg, zoneOfDrag } from '../../../../clients/web/src/targets/zone_shape.js';
import { ClientMessage, schema, ServerMessage } from '../mock_server.mjs';
import { ais, alert, target, targetList } from '../mock_targets.mjs';
import { random } from '../random.mjs';

const NM = 1852;
const frame = (message) => ServerMessage.encodeDelimited(ServerMessage.fromObject(message)).finish();
function decode(list) {
  const out = [];
  decodeFrames(new Uint8Array(frame({ targets: list })), (m) => out.push(m));
  return out[0].targets;
}
const refused = (list) => assert.throws(() => decode(list), (error) => error instanceof WireError && error.kind === 'out_of_range');
const near = (a, b, within, what) => assert.ok(Math.abs(a - b) <= within, `${what ?? ''} ${a}, not ${b}`);

test('a list has every field as protobuf wrote it, and tells what is absent', () => {
  const type = schema.lookupType('skerry.wire.TargetList');
  const r = random(7);
  const value = (field) => {
    if (field.resolvedType?.fields) return made(field.resolvedType);
    if (field.resolvedType) return r.below(2);
    return { bool: () => true, string: () => `ü${r.below(99)}`, double: () => r() * 0.5 + 0.1 }[field.type]?.() ?? 1 + r.below(100);
  };
  const made = (message) => Object.fromEntries(Object.values(message.fields).map((field) => [field.name, field.repeated ? [value(field), value(field)] : value(field)]));
  const want = made(type);
  const got = decode(want);
  const same = (a, b, path) => {
    if (b === null || typeof b !== 'object') { assert.equal(a, b, path); return; }
    for (const name of Object.keys(b)) same(a[name], b[name], `${path}.${name}`);
    assert.deepEqual(Object.keys(a).length, Object.keys(b).length, path);
  };
  same(got, want, 'list');
  const [bare] = decode({ targets: [{ number: 1 }] }).targets;
  for (const name of ['courseDeg', 'speedKn', 'relativeCourseDeg', 'relativeSpeedKn', 'cpaNm', 'tcpaMin']) assert.equal(bare[name], undefined, name);
  assert.equal(decode({ targets: [{ number: 1, cpaNm: 0, tcpaMin: -0.5 }] }).targets[0].cpaNm, 0);
  assert.equal(decode({ ownCourseDeg: 0 }).ownCourseDeg, 0);
  assert.equal(decode({}).ownCourseDeg, undefined);
  assert.equal(decode({}).trial, null);
});

test('lists that cannot be are refused', () => {
  for (const bad of [{ rangeM: NaN }, { rangeM: -1 }, { bearingDeg: Infinity }, { latitudeDeg: 91 }, { longitudeDeg: -181 }, { courseDeg: NaN }, { cpaNm: -1 },
    { tcpaMin: NaN }, { past: [{ rangeM: NaN }] }, { past: Array(300).fill({}) }, { speedKn: 1e9 }]) refused({ targets: [{ number: 1, ...bad }] });
  for (const bad of [{ ais: [{ mmsi: 1, headingDeg: NaN }] }, { ownLatitudeDeg: NaN }, { rules: { cpaNm: NaN } }, { zones: [{ innerNm: -Infinity }] },
    { trial: { beginsS: NaN } }, { trial: { order: { courseDeg: NaN } } }, { trial: { outcomes: [{ cpaNm: NaN }] } },
    { targets: Array(1001).fill({ number: 1 }) }]) refused(bad);
});

test('damaged lists never do more than raise WireError', () => {
  const r = random(11);
  const good = Buffer.from(frame({ targets: targetList({ targets: [target(1, 45, 3, 2, { courseDeg: 1, past: [{}] })], ais: [ais(257, 1, 1)], alerts: [alert(3044, 1, 2)], trial: { order: {}, outcomes: [{}] } }) }));
  let bad = 0;
  for (let i = 0; i < 20000; ++i) {
    const bytes = Uint8Array.from(good);
    for (let k = 1 + r.below(4); k > 0; --k) bytes[r.below(bytes.length)] = r.below(256);
    try { decodeFrames(bytes, () => {}); } catch (error) { assert.ok(error instanceof WireError, String(error.stack)); bad += 1; }
  }
  assert.ok(bad > 100);
});

test('orders are read by protobuf as they were meant', () => {
  const order = {
    acquire: { rangeNm: 3.25, bearingDeg: 0 }, cancel: [3, 1000], cancelAll: true, rules: { cpaNm: 0, lostWarnings: false, acquire: 2 },
    zones: [{ number: 2, kind: 1, innerNm: 1, outerNm: 2.5, fromDeg: 350, toDeg: 10, relative: true }], removeZones: [1], reference: 0,
    trial: { courseDeg: 90, speedKn: 12, delayMin: 5, turnRateDegMin: 60, accelerationKnMin: 2 }, endTrial: true, testTargets: false,
    acknowledge: [{ number: 3044, instance: 1 }], silence: true, activate: [257000001], letSleep: [257000002], defaultRules: true,
  };
  const message = ClientMessage.decodeDelimited(encodeTargetOrder(9, 1, 3, order, 'secret'));
  assert.equal(message.request, 9);
  const got = ClientMessage.toObject(message).targetOrder;
  assert.deepEqual(JSON.parse(JSON.stringify(got)), { radar: 1, view: 3, token: 'secret', ...order });
  const bare = ClientMessage.decodeDelimited(encodeTargetOrder(1, 0, 0, { silence: true })).targetOrder;
  assert.equal(bare._reference, undefined);
  assert.equal(bare._testTargets, undefined);
  assert.equal(ClientMessage.decodeDelimited(encodeSubscribe(1, 0, 0, false, '', { targetsHz: 2 })).subscribe.targetsHz, 2);
});

test('bounds are those of targets.proto, unless the server has others', () => {
  for (const [name, rules] of [['TargetRules', RULES], ['TargetZone', ZONES], ['TrialOrder', TRIALS]]) {
    for (const { name: field, min, max } of rules) {
      const { options } = schema.lookupType(`skerry.wire.${name}`).fields[field];
      assert.deepEqual([min, max], [options['(skerry.config.rule).min'], options['(skerry.config.rule).max']], field);
    }
  }
  assert.deepEqual(withBounds(RULES, [{ name: 'cpaNm', min: 0.1, max: 9.9 }])[0].max, 9.9);
  assert.equal(withBounds(RULES, undefined)[0].max, 10);
});

test('bow crossing: range and time, and none where there is none', () => {
  // 2 NM to starboard, 3 NM ahead, going west at 12 kn past a ship that lies: crosses 3 NM ahead in 10 min.
  const at = { east: 2 * NM, north: 3 * NM };
  const crossing = bowCrossing(at, velocity(270, 12), 0);
  near(crossing.rangeM / NM, 3, 1e-9);
  near(crossing.seconds / 60, 10, 1e-9);
  assert.equal(bowCrossing(at, velocity(90, 12), 0), null, 'passed already');
  assert.equal(bowCrossing({ east: 2 * NM, north: -NM }, velocity(270, 12), 0), null, 'astern');
  assert.equal(bowCrossing(at, velocity(0, 12), 0), null, 'never');
  assert.equal(bowCrossing(at, null, 0), null);
  assert.equal(bowCrossing(at, velocity(270, 12), undefined), null);
  // The bow to the east: the target ahead goes north over it.
  near(bowCrossing({ east: 4 * NM, north: -NM }, velocity(0, 6), 90).rangeM / NM, 4, 1e-9);
});

test('places and motions', () => {
  near(courseAndSpeed(velocity(217.5, 14.25)).courseDeg, 217.5, 1e-9);
  near(polar(place(300, 5000)).rangeM, 5000, 1e-9);
  // A minute of latitude at 60 N is 1,857 m; a minute of longitude 930 m; over the date line the short way.
  near(fromPosition({ latitudeDeg: 60, longitudeDeg: 5 }, { latitudeDeg: 60 + 1 / 60, longitudeDeg: 5 }).north, 1857, 1);
  near(fromPosition({ latitudeDeg: 60, longitudeDeg: 179.99 }, { latitudeDeg: 60, longitudeDeg: -179.99 }).east, 1.2 * 930.1, 2);
  const path = trialPath({ courseDeg: 0, speedKn: 12 }, { order: { courseDeg: 90, speedKn: 6, turnRateDegMin: 0, accelerationKnMin: 0 }, beginsS: 303 }, 10);
  near(path.at(-1).north, (12 * NM * 303) / 3600, 1e-6);
  near(path.at(-1).east, (6 * NM * 297) / 3600, 1e-6);
  // A turn of 60 deg/min the shorter way: radius speed/rate, and a quarter of a turn in 1.5 min.
  const radius = ((12 * NM) / 3600) / (Math.PI / 180);
  const turned = trialPath({ courseDeg: 10, speedKn: 12 }, { order: { courseDeg: 280, speedKn: 12, turnRateDegMin: 60, accelerationKnMin: 0 }, beginsS: 0 }, 1.5);
  near(Math.hypot(turned.at(-1).east, turned.at(-1).north), radius * Math.SQRT2, 25);
  assert.ok(turned.at(-1).east < 0, 'to port');
});

test('between lists a target moves on by its relative motion, for three seconds at most', () => {
  const store = new TargetStore();
  store.take(decode(targetList({ targets: [target(1, 0, 1, 2, { relativeCourseDeg: 90, relativeSpeedKn: 36, courseDeg: 90, speedKn: 36 }), target(2, 90, 1, 3, { relativeCourseDeg: 90, relativeSpeedKn: 36 })] })));
  const own = ownMotion(store.list, null);
  const at = (i) => shownOf(store.entries[i], 'ais', own, store.stepS).at;
  near(at(0).east, 0, 1e-9);
  store.pass(2, 1);
  near(at(0).east, 2 * 18.52, 1e-6);
  store.pass(0.5, 2);
  near(at(0).east, 3 * 18.52, 1e-6);
  store.pass(2, 1);
  near(at(0).east, 3 * 18.52, 1e-6);
  near(at(1).east, NM, 1e-6, 'a lost one stays');
  assert.equal(store.isStale, false);
  store.pass(1, 1);
  assert.equal(store.isStale, true);
});

test('what is not valid is a dash', () => {
  const store = new TargetStore();
  const motion = { courseDeg: 90, speedKn: 10, relativeCourseDeg: 180, relativeSpeedKn: 12, cpaNm: 0.5, tcpaMin: 7 };
  store.take(decode(targetList({ targets: [0, 1, 2, 3, 4].map((state) => target(state + 1, 45, 2, state, state === 0 ? {} : motion)), ais: [ais(257, 0, 1, { isLost: true, cpaNm: 1, courseDeg: 3, speedKn: 3 })] })));
  const own = ownMotion(store.list, null);
  const text = (i, label) => readings(shownOf(store.entries[i], 'ais', own, 0), 0).find(([name]) => name === label)[2];
  for (const label of ['CPA', 'TCPA', 'Course', 'Speed', 'Rel. course', 'Rel. speed']) {
    for (const i of [0, 3, 4, 5]) assert.equal(text(i, label), '–', `${label} of ${i}`);
    for (const i of [1, 2]) assert.notEqual(text(i, label), '–', `${label} of ${i}`);
  }
  assert.deepEqual([0, 1, 2, 3, 4, 5].map((i) => text(i, 'State')), ['ACQUIRING', 'TREND', 'TRACKED', 'LOST', 'FROZEN', 'LOST']);
  assert.equal(text(2, 'Range'), '2.00');
  assert.equal(text(2, 'Bearing'), '045.0');
});

test('radar and AIS that agree are one, by the symbol that is chosen', () => {
  const store = new TargetStore();
  store.take(decode(targetList({ targets: [target(4, 10, 3, 2, { mmsi: 257, courseDeg: 1, speedKn: 1 })], ais: [ais(257, 11, 3, { target: 4, courseDeg: 2, speedKn: 2 }), ais(258, 90, 1)] })));
  assert.deepEqual(store.entries.map(({ key }) => key), ['t4', 'a258']);
  const own = ownMotion(store.list, null);
  near(shownOf(store.entries[0], 'ais', own, 0).bearingDeg, 11, 1e-9);
  near(shownOf(store.entries[0], 'radar', own, 0).bearingDeg, 10, 1e-9);
  store.toggle('t4');
  store.take(decode(targetList({ ais: [ais(257, 11, 3)] })));
  assert.deepEqual(store.selected, [], 'a target that is gone is not selected');
  for (let i = 1; i <= 5; ++i) store.toggle(`t${i}`);
  assert.deepEqual(store.selected, ['t2', 't3', 't4', 't5'], 'four at most, the newest');
});

test('a drag makes a zone', () => {
  const at = (bearingDeg, nm) => ({ bearingDeg, rangeM: nm * NM });
  assert.deepEqual(zoneOfDrag(at(350, 2), at(20, 3), 30), { innerNm: 2, outerNm: 3, fromDeg: 350, toDeg: 20 });
  assert.deepEqual(zoneOfDrag(at(20, 3), at(350, 2), -30), { innerNm: 2, outerNm: 3, fromDeg: 350, toDeg: 20 });
  assert.equal(widthDeg(zoneOfDrag(at(0, 1), at(300, 2), 300)), 300);
  assert.equal(widthDeg(zoneOfDrag(at(0, 1), at(10, 2), 370)), 360);
});

test('settings of another make, or none, leave the defaults', () => {
  for (const kept of ['nonsense', null, '{"minutes": 7, "relative": "yes", "mmOf100px": -1, "joined": "x"}']) {
    const settings = new VectorSettings({ getItem: () => kept, setItem: () => { throw new Error('full'); } });
    assert.deepEqual([settings.minutes, settings.relative, settings.mmOf100px, settings.joined], [6, false, null, 'ais']);
    near(settings.pxPerMm, 96 / 25.4, 1e-9);
    settings.change({ mmOf100px: 20 });
    assert.equal(settings.pxPerMm, 5);
    for (let i = 0; i < 20; ++i) settings.stepMinutes(1);
    assert.equal(settings.minutes, 60);
    for (let i = 0; i < 20; ++i) settings.stepMinutes(-1);
    assert.equal(settings.minutes, 1);
  }
});

test('alerts: words, order, what may be acknowledged', () => {
  const caution = alert(3043, 1, 0, { category: 'C' }), warning = alert(3052, 1, 1), alarm = alert(3044, 1, 2), quiet = alert(3044, 2, 2, { state: 2 });
  assert.deepEqual([caution, quiet, warning, alarm].sort(byUrgency), [alarm, warning, quiet, caution]);
  assert.deepEqual([alarm, warning, caution].map((a) => priorityOf(a).word), ['Alarm', 'Warning', 'Caution']);
  assert.equal(new Set([alarm, warning, caution, quiet].map(symbolOf)).size, 4);
  assert.deepEqual([alarm, warning, caution, quiet].map(mayBeAcknowledged), [true, true, false, false]);
  assert.equal(priorityOf({ priority: 77 }).word, 'Alarm', 'an emergency, which is louder than what is known here');
  assert.equal(clockOf(1.7e18), '22:13:20');
  assert.equal(clockOf(0), '–');
});

test('the history keeps the last hundred changes', () => {
  const history = new AlertHistory();
  assert.equal(history.take([]), false);
  assert.equal(history.take([alert(3044, 1, 2)]), true);
  assert.equal(history.take([alert(3044, 1, 2)]), false);
  assert.equal(history.take([alert(3044, 1, 2, { state: 2 })]), true);
  history.take([]);
  assert.deepEqual(history.entries.map(({ alert: { state }, gone }) => [state, gone]), [[2, true], [2, false], [0, false]]);
  for (let i = 0; i < 200; ++i) history.take([alert(3044, i + 5, 2)]);
  assert.equal(history.entries.length, 100);
});

test('sounds: three beeps every seven seconds, two a minute, none without leave', () => {
  const started = [];
  const node = { connect: (next) => next, gain: { setValueAtTime() {}, linearRampToValueAtTime() {} }, frequency: {}, stop() {} };
  const context = { currentTime: 5, resume() {}, createOscillator: () => ({ ...node, frequency: {}, start: (at) => started.push(at) }), createGain: () => node };
  let now = 0;
  const sound = new AlertSound(() => context, () => now);
  const run = (ms) => { for (const end = now + ms; now < end; now += 100) sound.tick(); };
  sound.call(2, '3044.1');
  run(20000);
  assert.equal(started.length, 0, 'not allowed yet');
  assert.equal(sound.allow(true), true);
  run(15000);
  assert.equal(started.length, 9);
  sound.call(-1, '');
  run(20000);
  assert.equal(started.length, 9, 'silenced');
  sound.call(1, '3052.1');
  run(61000);
  assert.equal(started.length, 13);
  sound.call(0, '');
  run(10000);
  sound.allow(false);
  sound.call(2, 'x');
  run(10000);
  assert.equal(started.length, 13);
  // A browser that plays nothing: its clock stands, and nothing piles up for later.
  sound.allow(true);
  context.state = 'suspended';
  run(60000);
  assert.equal(started.length, 13);
  context.state = 'running';
  run(7000);
  assert.equal(started.length, 16);
  assert.equal(new AlertSound(() => { throw new Error('none'); }).allow(true), false);
});
