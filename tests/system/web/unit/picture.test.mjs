// The polar memory, the counters and the numbers, without a browser.
import assert from 'node:assert/strict';
import { readdirSync, readFileSync } from 'node:fs';
import { test } from 'node:test';
import * as format from '../../../../clients/web/src/format.js';
import { echoColours, PALETTES } from '../../../../clients/web/src/palette.js';
import { RowLook } from '../../../../clients/web/src/picture/row_look.js';
import { addWedges } from '../../../../clients/web/src/ppi_renderer.js';
import { sectorsOf, sectorsText } from '../../../../clients/web/src/receiver_controls.js';
import { ScanStore, ScanTracker } from '../../../../clients/web/src/scan_store.js';
import { GapCounter, LossCounter, Rate, TurnRate } from '../../../../clients/web/src/stream_stats.js';
import { ringsFor, ViewGeometry } from '../../../../clients/web/src/view_geometry.js';
import { WEB } from '../mock_server.mjs';
import { random } from '../random.mjs';

const units = (deg) => Math.round((deg / 360) * 2 ** 32) % 2 ** 32;
const spoke = (values) => ({ sequence: 0, scan: 0, index: 0, spokesPerTurn: 256, bits: 8, cellCount: 4, cellSizeM: 10,
                             heading: 0, cells: Uint8Array.of(1, 2, 3, 200), ...values });
const row = (store, r) => [...store.cells.subarray(r * store.cols * 2, (r + 1) * store.cols * 2)].filter((_, i) => i % 2 === 0);
const trail = (store, r) => [...store.cells.subarray(r * store.cols * 2, (r + 1) * store.cols * 2)].filter((_, i) => i % 2 === 1);
const painted = (store) => [...Array(store.rows).keys()].filter((r) => store.meta[r * 4 + 1] > 0);

test('the file list names every file of the console and no other', () => {
  const there = [...readdirSync(WEB).filter((n) => /\.(html|css|svg)$/.test(n)), ...readdirSync(`${WEB}languages`).map((n) => `languages/${n}`),
                 ...readdirSync(`${WEB}src`, { recursive: true }).filter((n) => n.endsWith('.js')).map((n) => `src/${n}`)].sort();
  assert.deepEqual(readFileSync(`${WEB}files.txt`, 'utf8').split('\n').filter(Boolean).sort(), there);
});

test('a spoke lies in the row of its true bearing', () => {
  const store = new ScanStore();
  store.put(spoke({ index: 64, heading: units(90) }), 1, false);
  assert.deepEqual(painted(store), [128]);
  assert.deepEqual(row(store, 128), [1, 2, 3, 200]);
  store.put(spoke({ index: 255, heading: units(359.9) }), 1, false);  // 358.49 deg: row 254.93
  assert.deepEqual(painted(store), [128, 255]);
  store.put(spoke({ index: 255, heading: units(1.2) }), 1, false);    // 359.79 deg: row 255.85, that is north
  assert.deepEqual(painted(store), [0, 128, 255]);
});

test('four bits fill the scale, the low nibble nearer', () => {
  const store = new ScanStore();
  store.put(spoke({ bits: 4, cellCount: 5, cells: Uint8Array.of(0xf0, 0x21, 0x08) }), 1, false);
  assert.deepEqual(row(store, 0), [0, 255, 17, 34, 136]);
});

test('a turning ship leaves no gap, a lost spoke does', () => {
  const store = new ScanStore();
  store.put(spoke({ index: 10 }), 1, false);
  store.put(spoke({ index: 11, heading: units(360 / 256) }), 1, true);
  assert.deepEqual(painted(store), [10, 11, 12]);
  store.put(spoke({ index: 14, heading: units(360 / 256) }), 1, false);
  assert.deepEqual(painted(store), [10, 11, 12, 15]);
  store.put(spoke({ index: 15, heading: units(90) }), 1, true);  // a jump of the compass paints nothing between
  assert.deepEqual(painted(store), [10, 11, 12, 15, 79]);
});

test('spokes that share a row keep the stronger echo', () => {
  const store = new ScanStore(128);
  store.put(spoke({ index: 20, cells: Uint8Array.of(9, 0, 0, 50) }), 1, false);
  store.put(spoke({ index: 21, cells: Uint8Array.of(1, 7, 0, 60) }), 1, true);
  const shared = painted(store)[0];
  store.put(spoke({ index: 22, cells: Uint8Array.of(0, 0, 1, 0) }), 1, true);
  const rows = painted(store).map((r) => row(store, r));
  assert.equal(store.rows, 128);
  assert.ok(rows.some((r) => r[1] === 7 && r[3] === 60), JSON.stringify({ shared, rows }));
});

test('Doppler classes lie in the row of their spoke, and go with the next without', () => {
  const store = new ScanStore();
  store.put(spoke({ index: 3 }), 1, false);
  assert.equal(store.doppler, null, 'nobody has any: no memory is spent');
  const generation = store.generation;
  store.put(spoke({ index: 4, cellCount: 4, doppler: Uint8Array.of(0x81) }), 1, false);
  assert.ok(store.generation > generation, 'the renderer has to make room');
  assert.deepEqual([...store.doppler.subarray(3, 6)], [0, 0x81, 0]);
  store.put(spoke({ index: 5, heading: units(360 / 256), doppler: Uint8Array.of(0x02) }), 1, true);
  assert.deepEqual([...store.doppler.subarray(4, 7)], [0x81, 0x02, 0x02], 'a row that a turning ship skips');
  store.put(spoke({ index: 4 }), 2, false);
  assert.equal(store.doppler[4], 0);
  store.clear();
  assert.ok(store.doppler.every((byte) => byte === 0));
});

test('blanked sectors are read as they are written', () => {
  assert.deepEqual(sectorsOf(' 350-10, 120.5 - 150 '), [{ fromDeg: 350, toDeg: 10 }, { fromDeg: 120.5, toDeg: 150 }]);
  assert.deepEqual(sectorsOf(''), []);
  for (const wrong of ['10', '10-', 'a-b', '-5-10', '0-361', '1-2,2-3,3-4,4-5,5-6', '1-2 3-4']) assert.equal(sectorsOf(wrong), null, wrong);
  assert.equal(sectorsText(sectorsOf('350-10,120-150')), '350-10, 120-150');
});

test('every row keeps the cell size it was painted with', () => {
  const store = new ScanStore();
  store.put(spoke({ index: 3, cellSizeM: 10 }), 1, false);
  store.put(spoke({ index: 4, cellSizeM: 20 }), 1, true);
  assert.deepEqual([store.meta[13], store.meta[17]], [10, 20]);
});

test('a trail fades with time and moves to a new range with its echo', () => {
  const store = new ScanStore();
  store.trailS = 10;
  const cells = (...v) => Uint8Array.from(v);
  store.put(spoke({ cells: cells(0, 0, 200, 0) }), 0, false);
  assert.deepEqual(trail(store, 0), [0, 0, 255, 0]);
  store.put(spoke({ cells: cells(0, 0, 0, 0) }), 5, false);
  assert.deepEqual(trail(store, 0), [0, 0, 255 - 128, 0]);
  store.put(spoke({ cells: cells(0, 0, 0, 0), cellSizeM: 20 }), 5, false);
  assert.deepEqual(trail(store, 0), [0, 127, 0, 0]);
  store.put(spoke({ cells: cells(0, 0, 0, 0), cellSizeM: 20 }), 20, false);
  assert.deepEqual(trail(store, 0), [0, 0, 0, 0]);
});

test('a trail shows as soon as its echo has gone, also where it does not fade', () => {
  for (const trailS of [360, 1800, -1]) {
    const store = new ScanStore();
    store.trailS = trailS;
    store.put(spoke({ cells: Uint8Array.from([0, 0, 200, 0]) }), 0, false);
    for (const nowS of [0.5, 1]) {
      store.put(spoke({ cells: Uint8Array.from([0, 0, 30, 0]) }), nowS, false);
      // 255 is an echo's own place, where no trail is drawn.
      assert.ok(trail(store, 0)[2] >= 252 && trail(store, 0)[2] < 255, `${trailS} s: ${trail(store, 0)}`);
    }
  }
});

test('painted rows are told once, in runs', () => {
  const store = new ScanStore();
  for (const index of [250, 251, 252, 3, 4, 255]) store.put(spoke({ index }), 1, false);
  assert.deepEqual(store.takeDirtyRuns(), [[3, 2], [250, 3], [255, 1]]);
  assert.deepEqual(store.takeDirtyRuns(), []);
});

test('a turn is whole only with all its spokes', () => {
  const scans = new ScanTracker();
  const turn = (scan, skip) => {
    for (let index = 0; index < 256; ++index) if (index !== skip) scans.take(spoke({ scan, index }));
  };
  turn(1, 7);
  assert.equal(scans.last, null);
  turn(2);
  assert.equal(scans.last.scan, 2);
  turn(3, 255);
  turn(4, 0);
  assert.equal(scans.last.scan, 2);
});

test('a gap is more than a second of the antenna without spokes', () => {
  const gaps = new GapCounter();
  const take = (s, missed = 0) => gaps.take(s * 1e9, missed);
  assert.deepEqual([take(100), take(100.9), take(101), take(111.5)], [0, 0, 0, 10.5]);
  gaps.restart();
  assert.equal(take(200), 0, 'standby');
  assert.equal(take(150, null), 0, 'a server that started again');
  assert.equal(take(152), 2);
  assert.deepEqual([gaps.gaps, gaps.seconds], [2, 12.5]);
  assert.equal(take(155, 7), 0, 'how long a spoke takes is not known');
});

test('what was lost on the way is no gap, and hides none', () => {
  const spokeS = 1 / 1638;
  for (const missed of [0, 1, 200, 1638, 16380]) {
    for (const gapS of [0, 0.9, 2.5]) {
      const gaps = new GapCounter();
      for (let n = 0; n < 500; ++n) assert.equal(gaps.take((100 + (n + 0.3 * Math.sin(n)) * spokeS) * 1e9, n === 0 ? null : 0), 0);
      const told = gaps.take((100 + (500 + missed) * spokeS + gapS) * 1e9, missed);
      assert.ok(gapS > 2 ? Math.abs(told - gapS) < 0.02 + missed * spokeS * 0.05 : told === 0, `${missed} missed, ${gapS} s: ${told}`);
    }
  }
});

test('loss is what the sequence numbers leave out', () => {
  const loss = new LossCounter();
  for (const n of [100, 101, 102, 110, 111]) loss.take(n);
  assert.deepEqual([loss.received, loss.lost, loss.restarts], [5, 7, 0]);
  assert.equal(loss.take(112), 0);
  assert.equal(loss.take(114), 1);
  assert.equal(loss.take(0), null, 'the server has started again');
  assert.deepEqual([loss.lost, loss.restarts], [8, 1]);
  loss.restart();
  assert.equal(loss.take(5000), null);
  assert.equal(loss.lost, 8);
});

test('rates are slopes, and fall silent', () => {
  const rate = new Rate(2);
  for (let t = 0; t <= 10; t += 0.01) rate.add(t, t * 1638);
  assert.ok(Math.abs(rate.perSecond() - 1638) < 1);
  assert.ok(rate.samples.length < 25);
  assert.ok(rate.perSecond(11) < 1200);
  assert.equal(rate.perSecond(13), 0);
  const turns = new TurnRate();
  for (let n = 0; n < 4096 * 3; n += 16) {
    turns.take({ scan: Math.floor(n / 4096), index: n % 4096, spokesPerTurn: 4096, utcNs: 1.7e18 + (n / 4096) * 2.5e9 });
  }
  assert.ok(Math.abs(turns.rpm() - 24) < 0.01, String(turns.rpm()));
});

test('pixels and places are each other\'s inverse', () => {
  const r = random(3);
  for (let i = 0; i < 1000; ++i) {
    const view = new ViewGeometry(300 + r.below(1800), 30, 1);
    view.upDeg = r() * 360;
    view.rangeM = 200 + r() * 170000;
    const bearing = r() * 360, range = (0.01 + 0.98 * r()) * view.rangeM;
    const { x, y } = view.toPixel(bearing, range);
    const back = view.fromPixel(x, y);
    assert.ok(Math.abs(((back.bearingDeg - bearing + 540) % 360) - 180) < 1e-6);
    assert.ok(Math.abs(back.rangeM - range) < 1e-6 * view.rangeM);
    assert.ok(back.inside);
  }
  const view = new ViewGeometry(220, 10, 2);
  view.rangeM = 1000;
  assert.deepEqual(view.toPixel(0, 1000), { x: 110, y: 10 });
  view.upDeg = 90;
  assert.ok(Math.abs(view.toPixel(180, 500).x - 160) < 1e-9);
});

test('a wedge covers every pixel whose square its rows touch', () => {
  const r = random(4);
  const side = 400;
  const inTriangle = (px, py, t) => {
    const sign = (i, j) => (px - t[2 * j]) * (t[2 * i + 1] - t[2 * j + 1]) - (t[2 * i] - t[2 * j]) * (py - t[2 * j + 1]);
    const s = [sign(0, 1), sign(1, 2), sign(2, 0)];
    return s.every((v) => v >= -1e-6) || s.every((v) => v <= 1e-6);
  };
  for (let i = 0; i < 300; ++i) {
    const from = r(), to = from + 0.0005 + r() * (i % 3 === 0 ? 0.99 : 0.02), up = r();
    const corners = [];
    addWedges(corners, from, to, up, side / 2);
    for (let k = 0; k < 50; ++k) {
      const angle = (from + (to - from) * r() - up) * 2 * Math.PI, range = r() * side / 2;
      // The centre of a pixel whose square holds that place.
      const px = range * Math.sin(angle) + r() - 0.5, py = range * Math.cos(angle) + r() - 0.5;
      let hit = false;
      for (let c = 0; c < corners.length && !hit; c += 6) hit = inTriangle(px, py, corners.slice(c, c + 6));
      assert.ok(hit, JSON.stringify({ from, to, up, px, py }));
    }
  }
});

test('rings divide their range evenly, the last on the edge', () => {
  for (const nm of [0.125, 0.25, 0.5, 0.75, 1.5, 3, 6, 12, 24, 48, 72, 96]) {
    const { spacingNm, count } = ringsFor(nm);
    assert.ok(Math.abs(spacingNm * count - nm) < 1e-9);
    assert.ok(count >= 3 && count <= 6);
  }
});

test('stronger echoes are brighter and more opaque', () => {
  for (const name of ['yellow', 'green']) {
    const colours = echoColours(name);
    for (let v = 1; v < 256; ++v) {
      assert.ok(colours[4 * v + 3] >= colours[4 * v - 1]);
      assert.ok(colours[4 * v + 1] >= colours[4 * v - 3]);
    }
    assert.equal(colours[3], 0);
    assert.equal(colours[1023], 255);
  }
});

test('no row looks otherwise than it was painted, but by 2 %, and few are painted anew', () => {
  const rows = 720, turnS = 2.5, meta = new Float32Array(rows * 4), rowLook = new RowLook();
  rowLook.resize(rows);
  const painted = new Uint8Array(rows * 4);
  let worst = 0, drawn = 0, offered = 0, row = 0;
  for (let n = 0; n < 250; ++n) {
    const nowS = n / 12, swept = [];
    // Then there is no video: all goes out.
    for (; n < 150 && row / rows < nowS / turnS; ++row) {
      meta.set([nowS, 10, 4, 0], (row % rows) * 4);
      swept.push([row % rows, 1]);
    }
    rowLook.update(meta, { nowS, turnS, afterglow: 0.25, sweepRow: n < 150 ? (row - 1 + rows) % rows : -1 });
    for (const [first, count] of rowLook.take(swept, n === 0)) {
      painted.set(rowLook.bytes.subarray(4 * first, 4 * (first + count)), 4 * first);
      drawn += count;
    }
    offered += rows;
    for (const [r] of swept) assert.deepEqual(painted.slice(4 * r, 4 * r + 4), rowLook.bytes.slice(4 * r, 4 * r + 4));
    rowLook.bytes.forEach((byte, i) => { worst = Math.max(worst, Math.abs(byte - painted[i])); });
  }
  assert.ok(worst <= 6, `${worst} of 255`);
  assert.ok(drawn < 0.6 * offered, `${drawn} of ${offered} rows`);
  assert.equal(Math.max(...painted.filter((_, i) => i % 4 < 2)), 0, 'what is missing has gone out');
});

test('around the circle the picture has the page\u2019s own colour', () => {
  const css = readFileSync(`${WEB}common.css`, 'utf8');
  const found = [...css.matchAll(/--back: #([0-9a-f]{6})/g)].map(([, hex]) => [0, 2, 4].map((at) => parseInt(hex.slice(at, at + 2), 16) / 255));
  assert.deepEqual(found, [PALETTES.day.back, PALETTES.dusk.back, PALETTES.night.back]);
});

test('numbers read as on a ship', () => {
  assert.equal(format.bearing(359.96), '000.0');
  assert.equal(format.bearing(-0.04), '000.0');
  assert.equal(format.bearing(7.25, 0), '007');
  assert.equal(format.position(60.3925, 'N', 'S', 2), '60°23.550′N');
  assert.equal(format.position(-5.9999999, 'E', 'W', 3), '006°00.000′W');
  assert.equal(format.position(NaN, 'E', 'W', 3), '–');
  assert.equal(format.rateOfTurn(-12.34), '12.3 port');
  assert.equal(format.rateOfTurn(0.01), '0.0');
  assert.equal(format.distance(926), '0.500 NM');
  assert.equal(format.count(1638.4), '1\u202f638');
});
