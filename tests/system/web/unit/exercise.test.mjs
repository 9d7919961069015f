// The instructor page's reckoning, without a browser; its messages, against protobufjs.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { ChartView, gridStep, scaleBar } from '../../../../clients/web/src/exercise/chart_view.js';
import { Coast, decodeLine } from '../../../../clients/web/src/exercise/coast.js';
import { after, fromTo, parseLatitude, parseLongitude } from '../../../../clients/web/src/exercise/place.js';
import { Orders } from '../../../../clients/web/src/exercise/orders.js';
import { scenarioYaml } from '../../../../clients/web/src/exercise/scenario_yaml.js';
import { byRank, placeNames } from '../../../../clients/web/src/exercise/ship_names.js';
import { Tracks } from '../../../../clients/web/src/exercise/tracks.js';
import { visibility } from '../../../../clients/web/src/format.js';
import {
  decodeFrames,
  encodeGetCoastline,
  encodeSet,
  encodeSubscribe,
  useControls,
} from '../../../../clients/web/src/messages.js';
import { WireError } from '../../../../clients/web/src/protobuf.js';
import { coastlineAt, MockExercise } from '../mock_exercise.mjs';
import { random as seeded } from '../random.mjs';
import { ClientMessage, CONTROLS, schema, ServerMessage } from '../mock_server.mjs';

useControls(CONTROLS);
const decode = (message) => {
  const out = [];
  decodeFrames(new Uint8Array(ServerMessage.encodeDelimited(ServerMessage.fromObject(message)).finish()), (m) =>
    out.push(m),
  );
  return out[0];
};
const read = (bytes) => ClientMessage.toObject(ClientMessage.decodeDelimited(bytes));
const near = (a, b, by) => assert.ok(Math.abs(a - b) <= by, `${a} is not ${b}`);

// A message with something in every field, but in those of messages.
function filled(name, i = 1) {
  const out = {};
  for (const field of schema.lookupType(`skerry.wire.${name}`).fieldsArray) {
    const value =
      { double: i + 0.5, string: `text ${i}`, bool: true }[field.type] ??
      (['uint32', 'uint64'].includes(field.type) ? i + 2 : undefined);
    if (value !== undefined) out[field.name] = field.repeated ? [value, value] : value;
    i += 1;
  }
  return out;
}

test('ExerciseState is read as protobuf wrote it, field by field', () => {
  const ship = {
    ...filled('ExerciseShip'),
    givesWay: 2,
    routeEnd: 3,
    route: [filled('Waypoint'), { lat: 1, lon: 2 }],
    faults: filled('Faults'),
  };
  const want = { ...filled('ExerciseState'), ships: [ship], marks: [filled('ExerciseMark')], playedMarks: [filled('PlayedMark')] };
  const { exercise } = decode({ exercise: want });
  assert.deepEqual({ ...exercise.ships[0].route[0] }, ship.route[0]);
  assert.equal(exercise.ships[0].route[1].speedKn, undefined, 'absent is not 0');
  assert.deepEqual({ ...exercise.ships[0].faults }, ship.faults);
  assert.deepEqual({ ...exercise.ships[0], route: [], faults: null }, { ...ship, route: [], faults: null });
  assert.deepEqual({ ...exercise.marks[0] }, want.marks[0]);
  assert.deepEqual({ ...exercise.playedMarks[0] }, want.playedMarks[0]);
  const lists = { ships: [], marks: [], playedMarks: [] };
  assert.deepEqual({ ...exercise, ...lists }, { ...want, ...lists });
  assert.throws(() => decode({ exercise: { playedMarks: [{ positionS: NaN }] } }), WireError);
  assert.throws(() => decode({ exercise: { ships: [{ latitudeDeg: NaN }] } }), WireError);
  assert.throws(() => decode({ exercise: { ships: [{ route: [{ lat: Infinity, lon: 0 }] }] } }), WireError);
});

test('the World tells its wind only where it is given', () => {
  assert.equal(decode({ world: { seaState: 2 } }).world.windKn, undefined);
  const { world } = decode({
    world: { windKn: 0, currentSetDeg: 90, currentKn: 2, depthM: 30, exerciseS: 5, frozen: true, rate: 2 },
  });
  assert.deepEqual(
    [world.windKn, world.currentSetDeg, world.currentKn, world.depthM, world.exerciseS, world.frozen, world.rate],
    [0, 90, 2, 30, 5, true, 2],
  );
});

test('the World tells the visibility only in fog, and 30 NM is taken for clear', () => {
  assert.equal(decode({ world: { seaState: 2 } }).world.visibilityNm, undefined);
  assert.equal(decode({ world: { visibilityNm: 0.5 } }).world.visibilityNm, 0.5);
  assert.deepEqual([undefined, 30, 0.5, 0.054, 12.3456, NaN].map(visibility), ['clear', 'clear', '0.5 NM', '0.054 NM', '12.3 NM', '–']);
});

test('orders are written as protobuf reads them', () => {
  const route = [
    { lat: 60.5, lon: -5.25, speedKn: 8 },
    { lat: 60, lon: 5, arriveMin: 12, stopMin: 1 },
  ];
  const each = [
    { clock: { frozen: false, rate: 0.5 } },
    {
      target: {
        target: 7,
        courseDeg: 0,
        speedKn: 11,
        route,
        routeEnd: 2,
        resume: true,
        givesWay: 1,
        latitudeDeg: 60,
        longitudeDeg: 5,
        removed: false,
        sart: true,
        aisOff: false,
        aisHeadingErrorDeg: -15,
        aisPositionErrorM: 300,
      },
    },
    {
      newTarget: {
        name: 'Åse',
        shipClass: 'tug',
        latitudeDeg: 60,
        longitudeDeg: 5,
        courseDeg: 90,
        speedKn: 4,
        route,
        routeEnd: 1,
        givesWay: 2,
      },
    },
    { ownShip: { ownShip: 1, latitudeDeg: 60, longitudeDeg: 5, headingDeg: 0, speedKn: -2 } },
    { text: { ownShip: 0, text: 'Håll' } },
    { mark: 'now' },
    { snapshot: 'one' },
    { restore: 'one' },
    { undo: true },
  ];
  for (const order of each) {
    const { set } = read(encodeSet(3, 1, 0, { exercise: order, instructor: true }));
    assert.deepEqual(set.exercise, order);
    assert.equal(set.instructor, true);
  }
  assert.equal(
    read(encodeSet(3, 1, 0, { exercise: { text: { text: 'all' } } })).set.exercise.text.ownShip,
    undefined,
    'to all',
  );
  const faults = filled('Faults'),
    change = CONTROLS.faults.map(({ field }) => field);
  const fault = read(encodeSet(3, 0, 0, { exercise: { fault: { ownShip: 1, faults, change } } })).set.exercise.fault;
  assert.deepEqual(fault.faults, faults);
  assert.deepEqual(fault.change, change);
  assert.deepEqual(read(encodeGetCoastline(4, { latitudeDeg: 60, longitudeDeg: 5, radiusNm: 12 })).getCoastline, {
    latitudeDeg: 60,
    longitudeDeg: 5,
    radiusNm: 12,
  });
  const { subscribe } = read(encodeSubscribe(1, 0, 0, false, 'secret', { noSpokes: true, exerciseHz: 2 }));
  assert.deepEqual([subscribe.exerciseHz, subscribe.token, subscribe.noSpokes], [2, 'secret', true]);
  assert.equal(read(encodeSubscribe(1, 0, 0, false, 'secret', {})).subscribe.token, undefined);
});

test('a coastline comes out of its differences, exact to a ten-thousandth of a minute', () => {
  const centre = { latitudeDeg: 60.4, longitudeDeg: 179.9, radiusNm: 30 };
  const { coastline } = decode({
    coastline: {
      ...centre,
      detailM: 15,
      chart: 'c',
      lines: [
        { points: [200000, -5, -1, 300000, 0, -400000], closed: true },
        { points: [1, 1, 2, 2], closed: true, water: true },
      ],
    },
  });
  assert.deepEqual(coastline.lines[0].points, [200000, -5, -1, 300000, 0, -400000]);
  assert.deepEqual([coastline.lines[0].water, coastline.lines[1].water, coastline.detailM], [false, true, 15]);
  const line = decodeLine(coastline.lines[0], centre);
  [180.1, 60.399995, 180.099999, 60.699995, 180.099999, 60.299995].forEach((want, i) => near(line[i], want, 1e-9));
  const mock = coastlineAt({ latitudeDeg: 60, longitudeDeg: 5, radiusNm: 30 });
  near(decodeLine(mock.lines[0], mock)[1], 60.37, 1e-6);
  const big = { latitudeDeg: 0, longitudeDeg: 0, lines: [{ points: new Array(60000).fill(1), closed: true }] };
  assert.equal(decode({ coastline: big }).coastline.lines[0].points.length, 60000);
});

test('a coast is asked for when the view leaves it, is wide enough, and is too coarse, and not otherwise', () => {
  const view = new ChartView();
  Object.assign(view, { width: 800, height: 600, latitudeDeg: 60, longitudeDeg: 5, metresPerPixel: 20 });
  const first = Coast.needed(view, null);
  near(first.radiusNm, (500 * 20 * 1.7) / 1852, 1e-6);
  const have = { ...first, detailM: 10 };
  assert.equal(Coast.needed(view, have), null);
  view.panBy(200, 0);
  assert.equal(Coast.needed(view, have), null, 'a small move');
  view.panBy(900, 0);
  assert.notEqual(Coast.needed(view, have), null);
  Object.assign(view, { longitudeDeg: 5, metresPerPixel: 4 });
  assert.notEqual(Coast.needed(view, have), null, 'coarser than two pixels');
  assert.equal(Coast.needed(view, { ...have, detailM: 5 }), null);
  view.metresPerPixel = 400;
  const most = Coast.needed(view, have);
  assert.equal(most.radiusNm, 60);
  assert.equal(Coast.needed(view, { ...most, detailM: 60 }), null, 'there is no more to be had');
});

test('the chart keeps what is under the pointer when it is zoomed, and goes over the date line', () => {
  const view = new ChartView();
  Object.assign(view, { width: 1000, height: 700, latitudeDeg: 60, longitudeDeg: 179.95, metresPerPixel: 20 });
  const at = view.fromPixel(900, 100);
  near(at.longitudeDeg, -179.906, 1e-3);
  const back = view.toPixel(at);
  near(back.x, 900, 1e-6);
  near(back.y, 100, 1e-6);
  view.zoomAt(3, 900, 100);
  near(view.toPixel(at).x, 900, 0.01);
  near(view.toPixel(at).y, 100, 0.01);
  // A mile is as long on the screen as the scale says, either way.
  const mile = view.toPixel(after(view, 0, 60, 1)),
    east = view.toPixel(after(view, 90, 60, 1));
  near(350 - mile.y, 1852 / view.metresPerPixel, 0.5);
  near(east.x - 500, 1852 / view.metresPerPixel, 0.5);
  for (let i = 0; i < 60; ++i) view.zoomAt(2);
  assert.ok(view.metresPerPixel >= 0.1);
  view.fit([
    { latitudeDeg: 60, longitudeDeg: 179.9 },
    { latitudeDeg: 60.2, longitudeDeg: -179.9 },
  ]);
  near(Math.abs(view.longitudeDeg), 180, 1e-6);
  assert.equal(gridStep(100, 110), 2);
  assert.deepEqual(scaleBar(20, 150), { metres: 1852, text: '1 NM' });
  assert.deepEqual(scaleBar(1, 150), { metres: 100, text: '100 m' });
});

test('positions are read as they are typed', () => {
  for (const text of ['60.3925', '60 23.55 N', '60°23.550′N', '60 23 33 n', '+60.3925', '60,3925'])
    near(parseLatitude(text), 60.3925, 1e-9);
  near(parseLongitude('005°19.200′W'), -5.32, 1e-9);
  near(parseLongitude('-5.32'), -5.32, 1e-9);
  for (const text of ['', 'N', '91', '60 61 N', '-60 N', '60 E', '1e3', '60..2'])
    assert.ok(Number.isNaN(parseLatitude(text)), text);
  near(fromTo({ latitudeDeg: 60, longitudeDeg: 5 }, { latitudeDeg: 60, longitudeDeg: 5.1 }).deg, 90, 0.1);
});

test('tracks break where a ship is put elsewhere, and forget what a restored snapshot undid', () => {
  const tracks = new Tracks();
  const at = (s, lat) => tracks.take(s, [{ key: 'own-0', latitudeDeg: lat, longitudeDeg: 5 }]);
  for (let s = 0; s <= 60; s += 5) at(s, 60 + s * 1e-5);
  assert.equal(tracks.partsOf('own-0', 600).length, 1);
  assert.equal(tracks.partsOf('own-0', 600)[0].length, 7);
  assert.ok(tracks.partsOf('own-0', 25)[0].length <= 3);
  at(61, 60.2);
  assert.equal(tracks.partsOf('own-0', 600).length, 2);
  at(30, 60.0003);
  assert.equal(tracks.partsOf('own-0', 600).length, 1);
  assert.ok(tracks.partsOf('own-0', 600)[0].every(({ s }) => s <= 30));
});

test('an order goes to each ship: to own ships by their radar, to targets by their number', () => {
  const sent = [];
  const orders = new Orders((values, what, radar) => {
    sent.push([values, what, radar]);
    return sent.length;
  });
  const [own, , target] = new MockExercise().ships;
  orders.steer([{ ...own, radars: [4] }, target], { courseDeg: 10 });
  assert.deepEqual(sent[0], [{ courseDeg: 10 }, 'Fulmar, course and speed', 4]);
  assert.deepEqual(sent[1][0], { exercise: { target: { target: 0, courseDeg: 10 } } });
  orders.put([
    { ship: own, latitudeDeg: 1, longitudeDeg: 2 },
    { ship: target, latitudeDeg: 3, longitudeDeg: 4 },
  ]);
  assert.equal(sent[2][0].exercise.ownShip.latitudeDeg, 1);
  assert.deepEqual(sent[3][0].exercise.target, { target: 0, latitudeDeg: 3, longitudeDeg: 4 });
  orders.route([target], [{ latitudeDeg: 1, longitudeDeg: 2 }], NaN, 1);
  assert.deepEqual(sent[4][0].exercise.target.route, [{ lat: 1, lon: 2 }]);
});

test('the scenario that is saved names every ship once, and what it leaves out', () => {
  const exercise = new MockExercise();
  exercise.ships.push(
    { ...exercise.ships[3], number: 9 },
    { ...exercise.ships[3], number: 10, name: 'Gone', removed: true },
  );
  const { exercise: state } = decode({ exercise: exercise.state() });
  const { world } = decode({
    world: {
      seaState: 3,
      windFromDeg: 200,
      swellPeriodS: 9,
      currentKn: 1,
      depthM: 40,
      kFactor: 1.33,
      rain: [{ id: 1, latitudeDeg: 60, longitudeDeg: 5, radiusNm: 2, rateMmH: 4, kind: 3 }],
    },
  });
  const hello = {
    scenario: 'Two\nferries',
    radars: [{ radar: 0, name: 'X "1"', set: '25 kW X', spokesPerTurn: 512, cells: 512, bits: 8 }],
  };
  const text = scenarioYaml(state, world, hello, CONTROLS.artefacts);
  assert.match(text, /^# Two ferries, as it was at 1:01:01/);
  assert.match(text, /Left out/);
  assert.match(text, /name: "Lyngen 2"/);
  assert.doesNotMatch(text, /Gone/);
  assert.match(text, /ship_class: ferry/);
  assert.match(text, /route_end: back/);
  assert.match(text, /kind: squall_line/);
  assert.doesNotMatch(text, /wind_kn/, 'it follows the sea state');
  assert.doesNotMatch(text, /visibility_nm/, 'it is clear');
  assert.match(scenarioYaml(state, { ...world, visibilityNm: 0.5 }, hello, CONTROLS.artefacts), /^atmosphere: \{.*visibility_nm: 0.5\}$/m);
  assert.doesNotMatch(text, /NaN|undefined|null/);
});

test('names: own ships first, then selected ones, those that give way or come close, and the nearest', () => {
  const ship = (name, north, more = {}) => ({
    name, latitudeDeg: 60 + north / 60, longitudeDeg: 5, courseOverGroundDeg: 0, speedKn: 0, own: false, removed: false,
    givesWayNow: false, ...more,
  });
  const ships = [
    ship('far', 9), ship('near', -2), ship('chosen', 20), ship('gives way', 15, { givesWayNow: true }),
    ship('meets', 4, { courseOverGroundDeg: 180, speedKn: 20 }), ship('later', 12, { courseOverGroundDeg: 180, speedKn: 20 }),
    ship('own', 0, { own: true, speedKn: 10 }), ship('gone', 0.1, { removed: true }), ship('leaves', 3, { speedKn: 20 }),
  ];
  const order = byRank(ships, ({ name }) => name === 'chosen').map(({ name }) => name);
  assert.deepEqual(order, ['own', 'chosen', 'meets', 'gives way', 'gone', 'near', 'leaves', 'far', 'later']);
  assert.deepEqual(byRank([ships[0], ships[1]], () => false).map(({ name }) => name), ['far', 'near'], 'without own ships as listed');
});

test('names: none lies over another, and no lower rank moves or hides a higher one', () => {
  const random = seeded(5);
  const labels = Array.from({ length: 400 }, () => ({
    at: { x: 900 * random(), y: 600 * random() }, clear: 13 + 8 * random(), width: 30 + 90 * random(), height: 14,
  }));
  const boxes = placeNames(labels);
  const shown = boxes.filter(Boolean);
  for (const [i, a] of shown.entries())
    for (const b of shown.slice(i + 1))
      assert.ok(a.x >= b.x + b.width || b.x >= a.x + a.width || a.y >= b.y + b.height || b.y >= a.y + a.height);
  assert.ok(shown.length > 100 && shown.length < 400, `${shown.length} of 400 are shown`);
  for (const most of [1, 10, 100]) assert.deepEqual(placeNames(labels.slice(0, most)), boxes.slice(0, most));
  const one = { at: { x: 100, y: 100 }, clear: 13, width: 40, height: 14 };
  const five = placeNames([one, one, one, one, one]);
  assert.deepEqual(five.map((box) => box && [box.x, box.y]), [[113, 102], [113, 84], [47, 102], [47, 84], null]);
});
