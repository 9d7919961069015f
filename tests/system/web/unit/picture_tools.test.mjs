// The picture's geometry, own ship's place in it, true trails and the measuring tools, without a browser.
import assert from 'node:assert/strict';
import { beforeEach, test } from 'node:test';
import { echoColours } from '../../../../clients/web/src/palette.js';
import { markAt } from '../../../../clients/web/src/picture/bearing_scale.js';
import { fitSide } from '../../../../clients/web/src/picture/fit.js';
import { OwnMotion, stabilisation } from '../../../../clients/web/src/picture/own_motion.js';
import { clampPlace, FARTHEST, lookAhead, resetPlace, sailed } from '../../../../clients/web/src/picture/own_place.js';
import { LAYERS, PictureSettings } from '../../../../clients/web/src/picture/picture_settings.js';
import { fromTo, placeAt } from '../../../../clients/web/src/picture/places.js';
import { standingOf, stabilisationText, trailText } from '../../../../clients/web/src/picture/standing.js';
import { timeToGo } from '../../../../clients/web/src/picture/status.js';
import { chord, grabbed, shapesOf } from '../../../../clients/web/src/picture/tool_geometry.js';
import { originFrom, Tools } from '../../../../clients/web/src/picture/tools.js';
import { SIDE, TrueTrails } from '../../../../clients/web/src/picture/true_trails.js';
import { addWedges } from '../../../../clients/web/src/ppi_renderer.js';
import { ScanStore } from '../../../../clients/web/src/scan_store.js';
import { VectorSettings } from '../../../../clients/web/src/targets/vector_settings.js';
import { ViewGeometry } from '../../../../clients/web/src/view_geometry.js';
import { random } from '../random.mjs';

const NM = 1852;
const units = (deg) => Math.round((((deg % 360) + 360) % 360) / 360 * 2 ** 32) % 2 ** 32;
const between = (a, b) => Math.abs(((a - b + 540) % 360) - 180);

let kept;
beforeEach(() => {
  kept = new Map();
  globalThis.localStorage = { getItem: (k) => kept.get(k) ?? null, setItem: (k, v) => kept.set(k, v) };
});

function randomView(r) {
  const view = new ViewGeometry(300 + r.below(1800), 30, 1);
  view.upDeg = r() * 360;
  view.rangeM = 200 + r() * 170000;
  const angle = r() * 2 * Math.PI, out = r() * FARTHEST;
  view.ownAt = { x: out * Math.sin(angle), y: out * Math.cos(angle) };
  return view;
}

test('off the centre, pixels and places are each other\'s inverse, and every ray meets the edge', () => {
  const r = random(11);
  let worst = 0;
  for (let i = 0; i < 2000; ++i) {
    const view = randomView(r);
    const bearing = r() * 360, rangeM = (0.01 + r()) * view.rangeM;
    const { x, y } = view.toPixel(bearing, rangeM);
    const back = view.fromPixel(x, y);
    assert.ok(between(back.bearingDeg, bearing) < 1e-6);
    assert.ok(Math.abs(back.rangeM - rangeM) < 1e-6 * view.rangeM);
    assert.equal(back.inside, Math.hypot(x - view.centre, y - view.centre) <= view.radius);
    const edgeM = (view.edgePx(bearing) / view.radius) * view.rangeM;
    const edge = view.toPixel(bearing, edgeM);
    worst = Math.max(worst, Math.abs(Math.hypot(edge.x - view.centre, edge.y - view.centre) - view.radius));
    // The scale's mark of that bearing stands there, too.
    const mark = markAt(view, bearing, view.upDeg);
    worst = Math.max(worst, Math.hypot(mark.x - edge.x, mark.y - edge.y));
  }
  assert.ok(worst < 1e-6, `${worst} px`);
});

test('a wedge seen from off the centre covers every pixel of the picture that its rows touch', () => {
  const r = random(12);
  const side = 400;
  const inTriangle = (px, py, t) => {
    const sign = (i, j) => (px - t[2 * j]) * (t[2 * i + 1] - t[2 * j + 1]) - (t[2 * i] - t[2 * j]) * (py - t[2 * j + 1]);
    const s = [sign(0, 1), sign(1, 2), sign(2, 0)];
    return s.every((v) => v >= -1e-6) || s.every((v) => v <= 1e-6);
  };
  for (let i = 0; i < 300; ++i) {
    const angle = r() * 2 * Math.PI, own = { x: 150 * r() * Math.sin(angle), y: 150 * r() * Math.cos(angle) };
    const from = r(), to = from + 0.0005 + r() * (i % 3 === 0 ? 0.99 : 0.02), up = r();
    const corners = [];
    addWedges(corners, from, to, up, side / 2, own);
    for (let k = 0; k < 50; ++k) {
      const a = (from + (to - from) * r() - up) * 2 * Math.PI, range = r() * 1.75 * side / 2;
      const px = own.x + range * Math.sin(a), py = own.y + range * Math.cos(a);
      if (Math.hypot(px, py) > side / 2) continue;
      let hit = false;
      for (let c = 0; c < corners.length && !hit; c += 6) hit = inTriangle(px, py, corners.slice(c, c + 6));
      assert.ok(hit, JSON.stringify({ from, to, up, own, px, py }));
    }
  }
});

test('own ship stands at most 75 % of the radius out', () => {
  assert.deepEqual(clampPlace({ x: 0.3, y: -0.4 }), { x: 0.3, y: -0.4, clamped: false });
  const far = clampPlace({ x: 3, y: 4 });
  assert.ok(far.clamped && Math.abs(Math.hypot(far.x, far.y) - 0.75) < 1e-12 && Math.abs(far.y / far.x - 4 / 3) < 1e-9);
  assert.deepEqual(clampPlace({ x: NaN, y: 0 }), { x: 0, y: 0, clamped: true });
});

test('true motion carries own ship over the picture, and begins anew with most view ahead', () => {
  // East at north up is to the right; with 090 up it is upwards.
  assert.deepEqual(sailed({ x: 0, y: 0 }, 500, 0, 0, 1000).at, { x: 0.5, y: 0 });
  const up = sailed({ x: 0, y: 0 }, 500, 0, 90, 1000).at;
  assert.ok(Math.abs(up.x) < 1e-12 && Math.abs(up.y - 0.5) < 1e-12);
  for (let course = 0; course < 360; course += 15) {
    const begin = resetPlace(course);
    const out = Math.hypot(begin.x, begin.y);
    assert.ok(out >= 0.5 && out <= 0.75);
    // Opposite to the course: the way to the edge ahead is the longest there is.
    const s = Math.sin(course * Math.PI / 180), c = Math.cos(course * Math.PI / 180);
    assert.ok(Math.abs(begin.x * s + begin.y * c + out) < 1e-9);
    let at = begin, steps = 0;
    for (; steps < 1000; ++steps) {
      const next = sailed(at, 10 * s, 10 * c, 0, 1000);
      at = next.at;
      if (next.reset) break;
    }
    assert.ok(Math.abs(Math.hypot(at.x, at.y) - 0.75) < 0.011, `${course}: ${JSON.stringify(at)}`);
  }
  assert.ok(lookAhead(0).y < -0.5 && lookAhead(90).x < -0.5);
});

test('orientation, motion and stabilisation are called by their names, and so is what is lost', () => {
  const ship = { speedKn: 10 };
  const picture = { orientation: 'north', courseDeg: 40, motion: 'relative', stabilised: 'ground', trailS: 0, trailMode: 'relative' };
  const of = (values, now = {}) => standingOf({ ...picture, ...values }, { headingDeg: 25, bowDeg: 25, ship, ...now });
  const names = ({ label, motionLabel, upDeg, scaleUpDeg, trailMode }) => [label, motionLabel, upDeg, scaleUpDeg, trailMode];
  assert.deepEqual(names(of({})), ['N UP', 'RM', 0, 0, 'off']);
  assert.deepEqual(names(of({ orientation: 'course', trailS: 60 })), ['C UP', 'RM(R)', 40, 40, 'relative']);
  assert.deepEqual(names(of({ orientation: 'head', trailS: 60, trailMode: 'true' })), ['H UP', 'RM(T)', 25, 0, 'true']);
  assert.deepEqual(names(of({ motion: 'true', trailS: 60 })), ['N UP', 'TM', 0, 0, 'true'], 'true motion has true trails only');
  assert.deepEqual(names(of({ motion: 'true', orientation: 'head' })), ['H UP', 'RM', 25, 0, 'off'], 'no true motion with the bow up');
  assert.deepEqual(names(of({ motion: 'true', orientation: 'course', trailS: 60 }, { headingDeg: null })),
    ['H UP · heading lost', 'RM(R)', 25, 0, 'relative']);
  const text = (chosen, flags, heading = true) => stabilisationText(stabilisation(chosen, { ...ship, ...flags }, heading));
  assert.equal(text('ground', {}), 'GND · position');
  assert.equal(text('water', {}), 'WATER · log, heading');
  assert.equal(text('ground', { noPosition: true }), 'WATER · log, heading · position lost');
  assert.equal(text('water', { noLog: true }), 'GND · position · log lost');
  assert.equal(text('water', {}, false), 'GND · position · heading lost');
  assert.equal(text('ground', { noPosition: true, noLog: true }), 'NO STAB · position lost');
  assert.equal(of({ motion: 'true' }, { ship: { noPosition: true, noLog: true } }).isTrue, false);
  assert.deepEqual([trailText('off', 0), trailText('true', 360), trailText('relative', 15), trailText('true', -1)],
    ['off', 'T 6 min', 'R 15 s', 'T permanent']);
});

test('own ship moves as her position or her log say, and a jump of the position is no motion', () => {
  const start = { latitudeDeg: 60, longitudeDeg: 5 };
  const at = (s, eastM, northM, heading = 0) => ({ utcNs: s * 1e9, heading: units(heading), ...placeAt(start, Math.atan2(eastM, northM) * 180 / Math.PI, Math.hypot(eastM, northM)) });
  const ground = new OwnMotion();
  for (let s = 0; s <= 10; ++s) ground.take(at(s, 5 * s, -3 * s), 'ground', NaN);
  assert.ok(Math.abs(ground.eastM - 50) < 0.01 && Math.abs(ground.northM + 30) < 0.01);
  ground.take(at(11, 5000, 0), 'ground', NaN);
  assert.ok(Math.abs(ground.eastM - 50) < 0.01);
  assert.equal(ground.jumps, 1);
  ground.take(at(12, 5005, 0), 'ground', NaN);
  assert.ok(Math.abs(ground.eastM - 55) < 0.01);
  const water = new OwnMotion();
  for (let s = 0; s <= 100; ++s) water.take(at(s, 0, 0, 90), 'water', 18);
  assert.ok(Math.abs(water.eastM - NM / 2) < 0.1 && Math.abs(water.northM) < 0.1);
  water.take(at(5, 0, 0, 90), 'water', 18);  // a playback goes back
  assert.ok(Math.abs(water.eastM - NM / 2) < 0.1);
});

// A world with own ship at (east, north) and one echo of `targets`, as spokes of a whole turn.
function turn(trails, store, nowS, own, headingDeg, targets, rangeM = 6000) {
  const cellCount = 500, spokesPerTurn = 2048, motion = { eastM: own.x, northM: own.y, jumps: 0 };
  for (let index = 0; index < spokesPerTurn; ++index) {
    const cells = new Uint8Array(cellCount);
    const bearing = ((index * 360) / spokesPerTurn + headingDeg) % 360;
    for (const t of targets) {
      const east = t.x - own.x, north = t.y - own.y;
      if (between(Math.atan2(east, north) * 180 / Math.PI + 360, bearing) > 0.3) continue;
      const c = Math.floor(Math.hypot(east, north) / (rangeM / cellCount));
      cells.fill(200, Math.max(0, c - 1), c + 2);
    }
    const spoke = { sequence: 0, scan: 0, index, spokesPerTurn, bits: 8, cellCount, cellSizeM: rangeM / cellCount, heading: units(headingDeg), cells };
    trails.put(spoke, nowS, motion);
    store.put(spoke, nowS, index > 0);
  }
}

// How far apart marked cells are, metres; and where their middle lies on the earth.
function extent(trails) {
  const cells = [];
  trails.cells.forEach((tick, at) => { if (tick > 0) cells.push([at % SIDE, Math.floor(at / SIDE)]); });
  const span = (axis) => (Math.max(...cells.map((c) => c[axis])) - Math.min(...cells.map((c) => c[axis])) + 1) * trails.cellM;
  return { cells: cells.length, eastM: span(0), northM: span(1) };
}
const trailRows = (store) => [...Array(store.rows).keys()].filter((row) =>
  store.cells.subarray(row * store.cols * 2, (row + 1) * store.cols * 2).some((v, i) => i % 2 === 1 && v > 0));

test('what lies still leaves no true trail while own ship sails and turns; what moves does; relative trails are the other way', () => {
  const buoy = { x: 2000, y: 1000 };
  const sail = (target, velocity) => {
    const trails = new TrueTrails(), store = new ScanStore();
    trails.setRange(6000);
    store.trailS = 3600;
    for (let k = 0; k < 12; ++k) {
      const s = k * 25;
      turn(trails, store, s, { x: 0, y: 5 * s }, k * 20, [{ x: target.x + velocity.x * s, y: target.y + velocity.y * s }]);
    }
    return { ...extent(trails), rows: trailRows(store).length, trails };
  };
  const still = sail(buoy, { x: 0, y: 0 });
  assert.ok(still.eastM < 130 && still.northM < 130, JSON.stringify({ ...still, trails: 0 }));
  const beside = sail(buoy, { x: 0, y: 5 });
  assert.ok(Math.abs(beside.northM - 5 * 275) < 150 && beside.eastM < 130, JSON.stringify({ ...beside, trails: 0 }));
  assert.ok(still.rows > 3 * beside.rows, `relative trails: ${still.rows} rows of what lies still, ${beside.rows} of what keeps its bearing`);
});

test('true trails outlive a change of range, fade by their length, and those that stay do not fade', () => {
  const trails = new TrueTrails(), store = new ScanStore();
  trails.setRange(6000);
  turn(trails, store, 100, { x: 0, y: 0 }, 0, [{ x: 1500, y: 0 }]);
  const before = extent(trails);
  trails.setRange(12000);
  assert.ok(extent(trails).cells > 0);
  trails.setRange(6000);
  const after = extent(trails);
  assert.ok(Math.abs(after.eastM - before.eastM) < 3 * trails.cellM, JSON.stringify({ before, after }));
  const look = trails.look(130, 60);
  assert.ok(Math.abs(look.nowTick - trails.tick(130)) < 1.01);
  assert.equal(look.lifeTicks, 120);
  assert.ok(trails.look(130, -1).lifeTicks < 0);
  // Nine hours later old ticks are still told from none.
  const marked = trails.cells.filter((t) => t > 0).length;
  trails.tick(100 + 9 * 3600);
  assert.equal(trails.cells.filter((t) => t > 0).length, marked);
});

test('as own ship sails on, the square forgets what is out of reach, and only that', () => {
  const trails = new TrueTrails(), store = new ScanStore();
  trails.setRange(6000);
  turn(trails, store, 1, { x: 0, y: 0 }, 0, [{ x: -3000, y: 0 }, { x: 3000, y: 0 }]);
  const all = extent(trails).cells;
  turn(trails, store, 2, { x: 7400, y: 0 }, 0, []);   // reach is 10500 m
  assert.ok(extent(trails).cells === all, 'both within reach');
  turn(trails, store, 3, { x: 7900, y: 0 }, 0, []);
  const one = extent(trails).cells;
  assert.ok(one > 0 && one < all * 0.7, `${one} of ${all}`);
  turn(trails, store, 4, { x: 40000, y: 0 }, 0, []);
  assert.ok(!trails.cells.some((t) => t > 0));
});

test('a relative trail of half an hour lasts half an hour, and one that stays stays', () => {
  const store = new ScanStore();
  const spoke = (cells) => ({ sequence: 0, scan: 0, index: 0, spokesPerTurn: 256, bits: 8, cellCount: 1, cellSizeM: 10, heading: 0, cells: Uint8Array.of(cells) });
  store.trailS = 1800;
  store.put(spoke(200), 0, false);
  for (let s = 2.5; s <= 900; s += 2.5) store.put(spoke(0), s, false);
  assert.ok(Math.abs(store.cells[1] - 127) <= 1, String(store.cells[1]));
  for (let s = 902.5; s <= 1810; s += 2.5) store.put(spoke(0), s, false);
  assert.equal(store.cells[1], 0);
  store.trailS = -1;
  store.put(spoke(200), 2000, false);
  for (let s = 2002.5; s <= 9000; s += 2.5) store.put(spoke(0), s, false);
  assert.equal(store.cells[1], 254);
});

test('places on earth agree with WGS84, there and back', () => {
  // A minute of latitude at 60 N is 1856.9 m, one of longitude at 60 N 930.0 m.
  assert.ok(Math.abs(fromTo({ latitudeDeg: 60, longitudeDeg: 5 }, { latitudeDeg: 60 + 1 / 60, longitudeDeg: 5 }).rangeM - 1856.9) < 0.5);
  assert.ok(Math.abs(fromTo({ latitudeDeg: 60, longitudeDeg: 5 }, { latitudeDeg: 60, longitudeDeg: 5 + 1 / 60 }).rangeM - 930.0) < 0.5);
  const r = random(13);
  for (let i = 0; i < 500; ++i) {
    const from = { latitudeDeg: -70 + 140 * r(), longitudeDeg: -180 + 360 * r() }, bearing = 360 * r(), rangeM = 100 + 40000 * r();
    const back = fromTo(from, placeAt(from, bearing, rangeM));
    assert.ok(Math.abs(back.rangeM - rangeM) < 0.001 * rangeM && between(back.bearingDeg, bearing) < 0.06, JSON.stringify({ from, bearing, rangeM, back }));
  }
});

test('a parallel line lies abeam at its distance, on its bearing, cut where it says', () => {
  const view = new ViewGeometry(600, 30, 1);
  Object.assign(view, { rangeM: 6000, upDeg: 30, ownAt: { x: 0.3, y: -0.2 } });
  const tools = new Tools();
  Object.assign(tools.lines[0], { on: true, bearingDeg: 75, offsetM: -900, fromM: -500, toM: 2500 });
  const [line] = shapesOf(tools, view, { bowDeg: 0, ownPlace: null }).lines;
  const expected = (along) => {
    const r = Math.hypot(900, along), bearing = 75 + Math.atan2(-900, along) * 180 / Math.PI;
    return view.toPixel(bearing, r);
  };
  for (const [end, along] of [[line.from, -500], [line.to, 2500]]) {
    const e = expected(along);
    assert.ok(Math.hypot(end.x - e.x, end.y - e.y) < 1e-6, JSON.stringify({ end, e }));
  }
  // Without ends it goes from edge to edge.
  Object.assign(tools.lines[0], { fromM: null, toM: null });
  const [whole] = shapesOf(tools, view, { bowDeg: 0, ownPlace: null }).lines;
  for (const end of [whole.from, whole.to]) assert.ok(Math.abs(Math.hypot(end.x - 300, end.y - 300) - view.radius) < 1e-6);
  // A relative one turns with own ship.
  Object.assign(tools.lines[0], { frame: 'relative', bearingDeg: 75 });
  const [turned] = shapesOf(tools, view, { bowDeg: 15, ownPlace: null }).lines;
  assert.ok(Math.abs(turned.way.x * whole.way.x + turned.way.y * whole.way.y - Math.cos(15 * Math.PI / 180)) < 1e-9);
  tools.areLinesOn = false;
  assert.equal(shapesOf(tools, view, { bowDeg: 0, ownPlace: null }).lines.length, 0);
});

test('a hand takes what is within its reach, the nearest first, and both where a marker and its circle cross', () => {
  const view = new ViewGeometry(600, 30, 1);
  Object.assign(view, { rangeM: 6000 });
  const tools = new Tools();
  Object.assign(tools.ebls[0], { on: true, bearingDeg: 90 });
  Object.assign(tools.vrms[0], { on: true, rangeM: 3000 });
  Object.assign(tools.vrms[1], { on: true, rangeM: 3300 });
  const shapes = shapesOf(tools, view, { bowDeg: 0, ownPlace: null });
  const px = (rangeM) => 300 + (rangeM / 6000) * view.radius;
  assert.deepEqual(grabbed(shapes, { x: px(1500), y: 311 }, 12), { ebl: 0, vrm: null, line: null });
  assert.deepEqual(grabbed(shapes, { x: px(1500), y: 313 }, 12), { ebl: null, vrm: null, line: null });
  assert.deepEqual(grabbed(shapes, { x: px(1500), y: 313 }, 22), { ebl: 0, vrm: null, line: null });
  assert.deepEqual(grabbed(shapes, { x: px(3000), y: 300 }, 12), { ebl: 0, vrm: 0, line: null });
  assert.deepEqual(grabbed(shapes, { x: 300, y: 300 - (px(3260) - 300) }, 12), { ebl: null, vrm: 1, line: null });
  assert.deepEqual(grabbed(shapes, { x: 302, y: 302 }, 12), { ebl: null, vrm: null, line: null }, 'where all bearings meet');
  assert.equal(chord(view, { x: 900, y: 0 }, { x: 0, y: 1 }), null);
});

test('an origin on earth stays there, one off own ship goes with her', () => {
  const own = { latitudeDeg: 60, longitudeDeg: 5 }, mark = placeAt(own, 40, 2000);
  const from = originFrom(mark, own);
  assert.ok(Math.abs(from.rangeM - 2000) < 1 && between(from.bearingDeg, 40) < 0.05);
  const later = originFrom(mark, placeAt(own, 40, 500));
  assert.ok(Math.abs(later.rangeM - 1500) < 2);
  assert.deepEqual(originFrom({ bearingDeg: 10, rangeM: 700 }, null), { bearingDeg: 10, rangeM: 700 });
  assert.equal(originFrom(mark, null), null);
});

test('what is stored and is none of ours is ignored, value by value', () => {
  kept.set('skerry.picture', JSON.stringify({
    palette: 'pink', orientation: 'course', courseDeg: 1e9, ownX: 'x', ownY: 0.5, trailS: 7, trailMode: 'true', rings: 'yes', headUp: true,
    brilliance: { echo: 0, rings: 50 }, constructor: 'evil', extra: 1,
  }));
  const picture = new PictureSettings();
  assert.deepEqual([picture.palette, picture.orientation, picture.courseDeg, picture.ownX, picture.ownY, picture.trailS, picture.trailMode, picture.rings],
    ['day', 'course', 0, 0, 0.5, 0, 'true', true]);
  assert.deepEqual(Object.keys(picture.brilliance), Object.keys(LAYERS));
  assert.ok(Object.values(picture.brilliance).every((v) => v === 100));
  assert.equal(picture.extra, undefined);
  picture.change({ rings: false, ownX: 5 });
  assert.deepEqual([new PictureSettings().rings, new PictureSettings().ownX], [false, 0]);

  for (const wrong of ['{', '[]', '7', 'null', '"x"', JSON.stringify({ ebls: 5, vrms: [{ on: 1, rangeM: -4 }], lines: [null, { offsetM: 1e12 }], active: 9 }),
    JSON.stringify({ ebls: [{ bearingDeg: 360, origin: { latitudeDeg: 91, longitudeDeg: 0 } }, { origin: { bearingDeg: 5 } }] })]) {
    kept.set('skerry.tools', wrong);
    kept.set('skerry.picture', wrong);
    assert.deepEqual(JSON.parse(JSON.stringify(new Tools())), JSON.parse(JSON.stringify((kept.clear(), new Tools()))), wrong);
    assert.equal(new PictureSettings().palette, 'day');
  }
  kept.set('skerry.targets', '{"mmOf100px": 20}');
  assert.equal(new VectorSettings().pxPerMm, 5);
  kept.set('skerry.targets', '{"mmOf100px": -3}');
  assert.ok(Math.abs(1 / new VectorSettings().pxPerMm - 0.264583) < 1e-5);
});

test('tools are kept as they were', () => {
  const tools = new Tools();
  tools.set('ebls', 1, { on: true, bearingDeg: 123.4, frame: 'relative', origin: { latitudeDeg: 60, longitudeDeg: 5 } });
  tools.set('vrms', 1, { on: true, rangeM: 5000 });
  tools.set('lines', 3, { on: true, bearingDeg: 7, offsetM: -800, fromM: null, toM: 900 });
  tools.activate(1);
  const again = new Tools();
  assert.deepEqual([again.ebls[1], again.vrms[1], again.lines[3], again.active], [tools.ebls[1], tools.vrms[1], tools.lines[3], 1]);
});

test('the picture gives way to the data in its corners', () => {
  const margin = (side) => Math.max(24, side / 20);
  assert.equal(fitSide(1000, 800, [], margin), 800);
  const boxes = [{ width: 200, height: 160 }, { width: 150, height: 100 }];
  const side = fitSide(700, 700, boxes, margin);
  assert.ok(side < 700 && side > 500, String(side));
  const reach = Math.hypot(350 - 200, 350 - 160);
  assert.ok(side / 2 - margin(side) <= reach);
});

test('echoes are red at night alone, and then far darker than an alarm', () => {
  const luminance = ([r, g, b]) => [r, g, b].map((v) => ((v / 255 + 0.055) / 1.055) ** 2.4).reduce((sum, v, i) => sum + v * [0.2126, 0.7152, 0.0722][i], 0);
  for (const [name, palette] of [['basic', 'day'], ['basic', 'dusk'], ['yellow'], ['green'], ['amber'], ['levels']]) {
    const colours = echoColours(name, palette);
    for (let v = 48; v < 256; ++v) {
      const [r, g, b] = colours.subarray(4 * v, 4 * v + 3);
      assert.ok(!(r > 1.9 * g && r > 1.9 * b), `${name} ${palette} ${v}: ${[r, g, b]}`);
    }
  }
  const night = echoColours('basic', 'night');
  assert.ok(night[4 * 200] > 4 * night[4 * 200 + 1]);
  const alarm = luminance([0xc2, 0x3c, 0x30]);   // --alarm of the night palette, common.css
  for (let v = 0; v < 256; ++v) assert.ok(luminance(night.subarray(4 * v, 4 * v + 3)) * 2 < alarm, String(v));
});

test('time to go is range by speed', () => {
  assert.equal(timeToGo(2 * NM, 12), '10:00');
  assert.equal(timeToGo(2 * NM, 0), '–');
  assert.equal(timeToGo(2 * NM, NaN), '–');
});
