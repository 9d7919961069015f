// The chart's reckoning, without a browser: the plane against exact geodesics, requests, positions as typed, maps as files.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { MARK } from '../../../../clients/web/src/chart/chart_wire.js';
import { LoadedChart, significance } from '../../../../clients/web/src/chart/chart_objects.js';
import { layPlane, reachOf } from '../../../../clients/web/src/chart/chart_painter.js';
import { ChartRequest } from '../../../../clients/web/src/chart/chart_request.js';
import { bearingRange, LocalPlane, placeAt } from '../../../../clients/web/src/chart/earth.js';
import { fromGeoJson, MapFileError, MOST_BYTES, toGeoJson } from '../../../../clients/web/src/chart/geojson.js';
import { cleanText, MapItems, MOST_ITEMS, MOST_PLACES } from '../../../../clients/web/src/chart/map_items.js';
import { isName, MapStore } from '../../../../clients/web/src/chart/map_store.js';
import { OwnPosition } from '../../../../clients/web/src/chart/own_position.js';
import { parsePosition } from '../../../../clients/web/src/chart/position_text.js';
import { colourOf } from '../../../../clients/web/src/chart/symbols.js';
import { position } from '../../../../clients/web/src/format.js';
import { decodeFrames, encodeGetChartObjects } from '../../../../clients/web/src/messages.js';
import { NAUTICAL_MILE_M as NM, ViewGeometry } from '../../../../clients/web/src/view_geometry.js';
import { chartAt, OWN } from '../mock_chart.mjs';
import { ClientMessage, ServerMessage } from '../mock_server.mjs';
import { random as seeded } from '../random.mjs';
import { direct, inverse } from '../vincenty.mjs';

const near = (a, b, by, what = '') => assert.ok(Math.abs(a - b) <= by, `${what} ${a} is not ${b}`);
const turn = (a, b) => Math.abs(((a - b + 540) % 360) - 180);

test('the slow reference is right: Vincenty\u2019s own geodesic, and there and back', () => {
  // Flinders Peak to Buninyong, Geoscience Australia, on GRS80, which is WGS-84's to 0.1 mm.
  const flinders = { latitudeDeg: -(37 + 57 / 60 + 3.7203 / 3600), longitudeDeg: 144 + 25 / 60 + 29.5244 / 3600 };
  const buninyong = { latitudeDeg: -(37 + 39 / 60 + 10.1561 / 3600), longitudeDeg: 143 + 55 / 60 + 35.3839 / 3600 };
  const { bearingDeg, rangeM } = inverse(flinders, buninyong);
  near(rangeM, 54972.271, 0.001);
  near(bearingDeg, 306 + 52 / 60 + 5.373 / 3600, 1e-6);
  const back = direct(flinders, bearingDeg, rangeM);
  near(back.latitudeDeg, buninyong.latitudeDeg, 1e-9);
  near(back.longitudeDeg, buninyong.longitudeDeg, 1e-9);
});

test('the plane has the bearings and ranges of the geodesics, also away from its anchor', (t) => {
  const worst = { rangeM: 0, deg: 0, awayM: 0, awayDeg: 0, backM: 0, part: 0 };
  for (const latitudeDeg of [-72, -33, 0, 12, 47.3, 60.4, 78]) {
    for (const longitudeDeg of [5.3, 179.95, -179.99]) {
      const anchor = { latitudeDeg, longitudeDeg };
      const plane = new LocalPlane(anchor);
      for (let deg = 0; deg < 360; deg += 15) {
        for (const nm of [0.1, 1, 6, 24]) {
          const to = direct(anchor, deg, nm * NM);
          const found = bearingRange(anchor, to);
          worst.rangeM = Math.max(worst.rangeM, Math.abs(found.rangeM - nm * NM));
          worst.deg = Math.max(worst.deg, turn(found.bearingDeg, deg));
          worst.part = Math.max(worst.part, Math.abs(found.rangeM / (nm * NM) - 1));
          const { east, north } = plane.toPlane(to.latitudeDeg, to.longitudeDeg);
          worst.backM = Math.max(worst.backM, inverse(to, plane.fromPlane(east, north)).rangeM);
          // Own ship 5 km from the anchor, as a view lays it.
          const own = direct(anchor, deg + 130, 5000);
          const view = Object.assign(new ViewGeometry(800, 30, 1), { rangeM: 24 * NM, upDeg: 33 });
          const lie = layPlane(plane, own, view);
          const exact = inverse(own, to);
          const px = lie.toPixel(east, north), at = view.fromPixel(px.x, px.y);
          worst.awayM = Math.max(worst.awayM, Math.abs(at.rangeM - exact.rangeM));
          if (nm > 5) worst.awayDeg = Math.max(worst.awayDeg, turn(at.bearingDeg, exact.bearingDeg));
        }
      }
    }
  }
  t.diagnostic(JSON.stringify(worst));
  assert.ok(worst.part < 1e-3, '0.1 % of the range');
  assert.ok(worst.rangeM < 0.001 && worst.deg < 1e-5);
  assert.ok(worst.awayM < 0.01 && worst.awayDeg < 1e-3);
  assert.ok(worst.backM < 0.002);
});

test('a canvas transform and pixels are one lie', () => {
  const view = Object.assign(new ViewGeometry(640, 30, 1), { rangeM: 3 * NM, upDeg: 211 });
  const plane = new LocalPlane(OWN);
  const lie = layPlane(plane, direct(OWN, 70, 900), view);
  const [a, b, c, d, e, f] = lie.transform(2);
  const { x, y } = lie.toPixel(1234, -987);
  near(a * 1234 + c * 987 + e, 2 * x, 1e-6);
  near(b * 1234 + d * 987 + f, 2 * y, 1e-6);
  const { bearingDeg, rangeM } = inverse(direct(OWN, 70, 900), plane.fromPlane(1234, -987));
  const want = view.toPixel(bearingDeg, rangeM);
  near(x, want.x, 0.01);
  near(y, want.y, 0.01);
  near(reachOf(view), 3 * NM, 1e-6);
});

test('messages are what protobuf reads and wrote', () => {
  const place = { latitudeDeg: 60.4, longitudeDeg: -5.3, radiusNm: 9, toleranceM: 2.5 };
  const sent = ClientMessage.toObject(ClientMessage.decodeDelimited(encodeGetChartObjects(7, place)));
  assert.deepEqual(sent, { request: 7, getChartObjects: place });
  const answer = chartAt({ ...OWN, radiusNm: 9, toleranceM: 0 });
  Object.assign(answer, { coastOnly: true, marksLeftOut: 4, linesLeftOut: 7 });
  answer.marks[0] = { kind: 3, longitude: -5, latitude: 7, fixed: true, shape: 2, colours: [3, 1], name: 'Ä', light: 'Fl', racon: true, depthM: 0 };
  let got;
  decodeFrames(new Uint8Array(ServerMessage.encodeDelimited(ServerMessage.fromObject({ chartObjects: answer })).finish()), (m) => { got = m.chartObjects; });
  assert.equal(got.coastOnly, true);
  assert.deepEqual([got.marksLeftOut, got.linesLeftOut], [4, 7]);
  assert.deepEqual({ ...got.marks[0] }, answer.marks[0]);
  assert.equal(got.marks[1].depthM, undefined, 'absent is not 0');
  assert.deepEqual(got.lines.map(({ points }) => points), answer.lines.map(({ points }) => points));
  answer.lines[2].depthM = NaN;
  assert.throws(() => decodeFrames(new Uint8Array(ServerMessage.encodeDelimited(ServerMessage.fromObject({ chartObjects: answer })).finish()), () => {}), /out_of_range/);
});

test('a loaded chart has its lines and marks where the geodesics are', () => {
  const circle = { ...direct(OWN, 200, 3000), radiusNm: 9, toleranceM: 0 };
  const message = chartAt(circle);
  const loaded = new LoadedChart({ ...message, marks: message.marks.map((mark) => ({ colours: [], ...mark })) });
  assert.equal(loaded.layAbout(OWN), true);
  assert.equal(loaded.layAbout(direct(OWN, 10, 4900)), false, 'the plane still serves');
  for (const { plane, kind, depthM } of loaded.lines.filter((line) => line.kind === 1)) {
    assert.equal(kind, 1);
    for (let i = 0; i < plane.length; i += 2) near(Math.hypot(plane[i], plane[i + 1]), depthM === 5 ? 1800 : 2200, 0.3);
  }
  near(Math.hypot(loaded.marks[0].east, loaded.marks[0].north), 900, 0.3);
  assert.equal(loaded.layAbout(direct(OWN, 10, 6000)), true);
  near(Math.hypot(loaded.marks[0].east, loaded.marks[0].north), inverse(direct(OWN, 10, 6000), direct(OWN, 5, 900)).rangeM, 0.3);
});

test('what is left of a line is within the tolerance', () => {
  const random = seeded(4);
  const plane = new Float64Array(4000);
  for (let i = 2; i < plane.length; i += 2) { plane[i] = plane[i - 2] + 5 + 20 * random(); plane[i + 1] = plane[i - 1] + 60 * (random() - 0.5); }
  const counts = significance(plane);
  assert.equal(counts[0], Infinity);
  let before = counts.length + 1;
  for (const tolerance of [1, 10, 100]) {
    const kept = [...counts.keys()].filter((i) => counts[i] > tolerance);
    for (let k = 1; k < kept.length; ++k) {
      const [a, b] = [kept[k - 1], kept[k]];
      const [wx, wy] = [plane[2 * b] - plane[2 * a], plane[2 * b + 1] - plane[2 * a + 1]];
      for (let i = a; i <= b; ++i) {
        const [px, py] = [plane[2 * i] - plane[2 * a], plane[2 * i + 1] - plane[2 * a + 1]];
        const along = Math.max(0, Math.min(1, (px * wx + py * wy) / (wx * wx + wy * wy)));
        assert.ok(Math.hypot(px - along * wx, py - along * wy) <= tolerance + 1e-9);
      }
    }
    assert.ok(kept.length < before);
    before = kept.length;
  }
  assert.deepEqual([...significance(new Float64Array(0))], []);
});

test('the chart is asked for anew after a third of its radius, and for another range', () => {
  let now = 0, asked = [];
  const request = new ChartRequest((circle) => { asked.push(circle); return asked.length; }, () => now);
  const look = (place, nm) => request.look(place, nm * NM, nm * NM / 370);
  look(OWN, 6);
  assert.equal(asked.length, 1);
  near(asked[0].radiusNm, 9.3, 1e-9);
  assert.ok(bearingRange(OWN, asked[0]).rangeM < (9.3 / 20) * NM);
  look(OWN, 6);
  assert.equal(asked.length, 1, 'one at a time');
  assert.equal(request.take({ ...asked[0] }), true);
  assert.equal(request.take({ ...asked[0] }), false, 'not asked for');
  const circle = asked[0];
  look(direct(circle, 80, 3.05 * NM), 6);
  assert.equal(asked.length, 1);
  look(direct(circle, 80, 3.2 * NM), 6);
  assert.equal(asked.length, 2);
  request.take({ ...asked[1] });
  look(direct(circle, 80, 3.2 * NM), 12);
  assert.equal(asked.length, 3, 'a longer range');
  request.take({ ...asked[2] });
  look(direct(circle, 80, 3.2 * NM), 3);
  assert.equal(asked.length, 4, 'a finer one');
  assert.equal(request.takeReply({ request: 99, code: 4 }), false);
  assert.equal(request.takeReply({ request: 4, code: 4 }), true);
  look(OWN, 3);
  assert.equal(asked.length, 4, 'a refusal is waited for');
  now += 5001;
  look(OWN, 3);
  assert.equal(asked.length, 5);
  now += 8001;
  look(OWN, 3);
  assert.equal(asked.length, 6, 'no answer came');
  // Beyond the longest radius nothing is asked again and again.
  const far = ChartRequest.needed(OWN, 96 * NM, 400, null);
  assert.equal(far.radiusNm, 60);
  assert.equal(ChartRequest.needed(OWN, 96 * NM, 400, far), null);
  for (const longitudeDeg of [179.999, -179.999]) {
    const { latitudeDeg, ...rest } = ChartRequest.needed({ latitudeDeg: 89.999, longitudeDeg }, 24 * NM, 100, null);
    assert.ok(latitudeDeg <= 90 && Math.abs(rest.longitudeDeg) <= 180);
  }
});

test('own ship is where the newest message has her, and goes on between', () => {
  const position = new OwnPosition();
  const ship = { latitudeDeg: 60, longitudeDeg: 5, speedOverGroundKn: 36, courseOverGroundDeg: 90 };
  assert.equal(position.place({ spoke: null, lastSpokeS: -Infinity, ownShip: null }, 0), null);
  assert.deepEqual(position.place({ spoke: null, lastSpokeS: -Infinity, ownShip: ship }, 10), { latitudeDeg: 60, longitudeDeg: 5 });
  const after = (s, pace) => position.place({ spoke: null, lastSpokeS: -Infinity, ownShip: ship }, 10 + s, pace);
  near(inverse(ship, after(5)).rangeM, 36 * NM / 3600 * 5, 0.1);
  near(inverse(ship, after(5)).bearingDeg, 90, 0.01);
  near(inverse(ship, after(5, 4)).rangeM, 36 * NM / 3600 * 20, 0.1);
  assert.deepEqual(after(5, 0), { latitudeDeg: 60, longitudeDeg: 5 }, 'a frozen exercise');
  near(inverse(ship, after(500)).rangeM, 36 * NM / 3600 * 10, 0.1, 'no further than ten seconds');
  const spoke = { latitudeDeg: 60.01, longitudeDeg: 5 };
  const now = position.place({ spoke, lastSpokeS: 12, ownShip: ship }, 12.5);
  near(inverse(spoke, now).rangeM, 36 * NM / 3600 * 0.5, 0.05);
  assert.deepEqual(position.place({ spoke: { latitudeDeg: 0, longitudeDeg: 0 }, lastSpokeS: 13, ownShip: { ...ship, noMotion: true } }, 13.5), { latitudeDeg: 60, longitudeDeg: 5 });
  assert.equal(position.place({ spoke, lastSpokeS: 14, ownShip: { ...ship, noPosition: true } }, 14), null);
});

test('positions are read as a mariner writes them, or refused with what was expected', () => {
  for (const [text, axis, deg] of [
    ['60 23.550 N', 'latitude', 60.3925], ['60°23.550′N', 'latitude', 60.3925], ['n60.3925', 'latitude', 60.3925], ['60 23 33 S', 'latitude', -60.3925],
    ['005 19.398 E', 'longitude', 5.3233], ['5-19,398w', 'longitude', -5.3233], ['180 W', 'longitude', -180], ['0 0.0 S', 'latitude', 0], ['90N', 'latitude', 90],
    ['60° 23\' 33" N', 'latitude', 60.3925],
  ]) {
    const found = parsePosition(text, axis);
    assert.equal(found.wrong, undefined, `${text}: ${found.wrong}`);
    near(found.deg, deg, 1e-9, text);
  }
  for (const [text, axis, why] of [
    ['', 'latitude', /nothing is entered/], ['60 23.5', 'latitude', /N or S is missing/], ['60 23.5 E', 'latitude', /E is no latitude/], ['60 60 N', 'latitude', /minutes are 60/],
    ['90 0.001 N', 'latitude', /above 90/], ['181 E', 'longitude', /above 180/], ['N 60 23 N', 'latitude', /cannot be read/], ['sixty N', 'latitude', /cannot be read/],
    ['-60 23 N', 'latitude', /cannot be read/], ['60.5 30 N', 'latitude', /fraction have no minutes/], ['1e2 N', 'latitude', /cannot be read/], ['60 23.5 30 N', 'latitude', /no seconds/],
    ['60 23 75 N', 'latitude', /seconds are 60/],
  ]) {
    const { wrong } = parsePosition(text, axis);
    assert.match(wrong ?? 'taken', why, text);
    assert.match(wrong, axis === 'latitude' ? /such as 60 23\.550 N/ : /such as 005 19\.398 E/);
  }
  const random = seeded(11);
  for (let i = 0; i < 500; ++i) {
    const deg = (random() - 0.5) * 360;
    near(parsePosition(position(deg, 'E', 'W', 3), 'longitude').deg, deg, 1e-5);
  }
});

const ITEMS = [
  { type: 'line', kind: 'track', text: 'Ä leg', utc: '', places: [{ latitudeDeg: 60, longitudeDeg: 5 }, { latitudeDeg: 60.1, longitudeDeg: -179.5 }] },
  { type: 'point', kind: 'event', text: '<img src=x>', utc: '2026-11-27T10:15:00.250Z', places: [{ latitudeDeg: -1.2345678, longitudeDeg: 180 }] },
];

test('a map is the same after its file, and any GeoJSON of points and lines is taken', () => {
  assert.deepEqual(fromGeoJson(toGeoJson('m', ITEMS)), ITEMS);
  const plain = { type: 'FeatureCollection', features: [{ type: 'Feature', properties: null, geometry: { type: 'Point', coordinates: [5, 60, 12] } }] };
  assert.deepEqual(fromGeoJson(JSON.stringify(plain)), [{ type: 'point', kind: 'note', text: '', utc: '', places: [{ latitudeDeg: 60, longitudeDeg: 5 }] }]);
});

test('files that are none are refused, each with its reason', () => {
  const feature = (geometry, properties = {}) => JSON.stringify({ type: 'FeatureCollection', features: [{ type: 'Feature', properties, geometry }] });
  const point = (coordinates, properties) => feature({ type: 'Point', coordinates }, properties);
  for (const [text, why] of [
    ['', /not JSON/], ['{', /not JSON/], ['null', /FeatureCollection/], ['[]', /FeatureCollection/], ['{"type":"FeatureCollection"}', /no list/],
    [' '.repeat(MOST_BYTES + 1), /larger than 1 MB/], ['{"type":"FeatureCollection","features":[null]}', /feature 1: expected an object of type Feature/],
    [feature(null), /no geometry/], [feature({ type: 'Polygon', coordinates: [] }), /Polygon.*expected Point or LineString/], [feature({ type: 7 }), /geometry 7/],
    [point([5]), /\[longitude, latitude\]/], [point('5,60'), /\[longitude, latitude\]/], [point([5, '60']), /numbers only/], [point([null, 60]), /numbers only/],
    ['{"type":"FeatureCollection","features":[{"type":"Feature","geometry":{"type":"Point","coordinates":[1e999,60]}}]}', /numbers only/],
    [point([5, 91]), /latitude 91/], [point([181, 0]), /longitude 181/], [point([NaN, 0]), /numbers only/],
    [feature({ type: 'LineString', coordinates: [[5, 60]] }), /two points/], [feature({ type: 'LineString', coordinates: [[5, 60], [5, {}]] }), /feature 1, point 2/],
    [point([5, 60], { kind: '__proto__' }), /kind "__proto__"; expected note/], [point([5, 60], { kind: ['note'] }), /kind/], [point([5, 60], { text: { a: 1 } }), /no text/],
    [point([5, 60], { utc: 'now' }), /utc "now"/], [point([5, 60], []), /properties/],
    [JSON.stringify({ type: 'FeatureCollection', features: Array(MOST_ITEMS + 1).fill(0) }), /at most 500/],
    [feature({ type: 'LineString', coordinates: Array(MOST_PLACES + 1).fill([5, 60]) }), /more than 5000/],
  ]) {
    assert.throws(() => fromGeoJson(text), (error) => error instanceof MapFileError && why.test(error.message), `${text.slice(0, 120)}: ${why}`);
  }
  assert.throws(() => fromGeoJson(undefined), MapFileError);
  // Anything at all: taken whole, or a MapFileError.
  const random = seeded(3), good = toGeoJson('m', ITEMS);
  for (let i = 0; i < 3000; ++i) {
    const at = Math.floor(random() * good.length);
    const text = good.slice(0, at) + String.fromCharCode(32 + Math.floor(random() * 95)) + good.slice(at + Math.floor(random() * 3));
    try {
      for (const item of fromGeoJson(text)) for (const { latitudeDeg, longitudeDeg } of item.places) assert.ok(Math.abs(latitudeDeg) <= 90 && Math.abs(longitudeDeg) <= 180);
    } catch (error) {
      assert.ok(error instanceof MapFileError, String(error));
    }
  }
});

test('maps are kept by name, and what others wrote there does no harm', () => {
  const storage = { kept: {}, getItem(key) { return this.kept[key] ?? null; }, setItem(key, value) { this.kept[key] = value; } };
  const store = new MapStore(storage);
  assert.deepEqual(store.load(store.current), []);
  store.save('Fjord', ITEMS);
  store.save('Other', []);
  const again = new MapStore(storage);
  assert.equal(again.current, 'Other');
  assert.deepEqual(again.names, ['Fjord', 'Other']);
  assert.deepEqual(again.load('Fjord'), ITEMS);
  store.save('Third', []);  // by another page meanwhile
  again.save('Fjord', ITEMS);
  assert.deepEqual(new MapStore(storage).names, ['Fjord', 'Other', 'Third']);
  again.remove('Third');
  again.remove('Fjord');
  assert.deepEqual(new MapStore(storage).names, ['Other']);
  for (const text of ['{', 'null', '7', '{"maps":7}', '{"maps":{"toString":"x","a":7," ":"y"},"current":{}}', '{"maps":null,"current":"__proto__"}']) {
    storage.kept['skerry.maps'] = text;
    const read = new MapStore(storage);
    assert.deepEqual(read.names, ['My map'], text);
    assert.deepEqual(read.load('My map'), []);
  }
  storage.kept['skerry.maps'] = '{"maps":{"Broken":"{"},"current":"Broken"}';
  assert.throws(() => new MapStore(storage).load('Broken'), MapFileError);
  assert.equal(isName('__proto__') || isName('') || isName('x'.repeat(61)) || isName(7), false);
  const full = new MapStore({ getItem: () => null, setItem() { throw new Error('full'); } });
  assert.equal(full.save('a', []), false);
});

test('a map has bounds, and texts are plain', () => {
  let changes = 0;
  const items = new MapItems(() => { changes += 1; });
  const line = items.add({ ...ITEMS[0], text: ' a\u0000b\nc\u2028 ' });
  assert.equal(line.text, 'a b c');
  assert.equal(cleanText('\u{1f6a2}'.repeat(100)), '\u{1f6a2}'.repeat(80));
  items.change(line.id, { text: 'x', kind: 'danger' });
  assert.equal(items.find(line.id).text, 'x');
  items.remove(line.id);
  assert.equal(items.find(line.id), null);
  assert.equal(changes, 3);
  for (let i = 0; i < MOST_ITEMS; ++i) assert.ok(items.add(ITEMS[1]));
  assert.equal(items.add(ITEMS[1]), null);
  assert.match(items.refusal(1), /at most 500/);
});

test('the colour that tells most is a mark\u2019s', () => {
  assert.equal(colourOf({ kind: MARK.LATERAL_PORT, colours: [4] }), 'green');
  assert.equal(colourOf({ kind: MARK.PREFERRED_PORT, colours: [4, 3, 4] }), 'green');
  assert.equal(colourOf({ kind: MARK.SAFE_WATER, colours: [1, 3] }), 'red');
  assert.equal(colourOf({ kind: MARK.CARDINAL_EAST, colours: [2, 6, 2] }), 'yellow');
  assert.equal(colourOf({ kind: MARK.SPECIAL, colours: [] }), 'yellow');
  assert.equal(colourOf({ kind: 99, colours: [200] }), 'plain');
});
