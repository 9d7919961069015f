// The clauses of symbols, colours, default settings and keys (clients/web/CLAUSES.md), D8 to D12, and of targets, B8 and B11, where
// no other test proves them: measured on the screen of a real Chromium.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { PNG } from 'pngjs';
import { capture, waitForScan } from '../browser.mjs';
import { frames, hueOf, layer, openClauses, pixel, ppi, runs, text, until } from '../clauses_kit.mjs';
import { eachTest } from '../each_test.mjs';
import { angleBetween, place, placeOf } from '../measure.mjs';
import { NM } from '../mock_scene.mjs';
import { ais, alert, placeAt, target } from '../mock_targets.mjs';
import { apart, canvas, extent, isDrawn, listed, pixelOf, placeOnPage, plane, plus, rgba, show, targetState, waitFor } from '../targets_kit.mjs';

let browser, server, page;
eachTest((b) => { browser = b; }, () => { const opened = { page, server }; page = server = null; return opened; });

// 10 pixels a mm where symbols are measured.
async function open(list, options) {
  ({ server, page } = await openClauses(browser, { list, kept: { 'skerry.targets': { mmOf100px: 10, names: false } }, ...options }));
  await page.evaluate(() => window.skerry.showTab('targets'));
  await listed(page);
  await frames(page);
}
const near = (a, b, within, what = '') => assert.ok(Math.abs(a - b) <= within, `${what} ${a}, not ${b}`);
const lastOrder = (count) => waitFor(() => server.targetOrders.length >= count && server.targetOrders.at(-1), `order ${count} has not come`);
const isLine = ([r, g, b, a]) => (Math.max(r, g, b) * a) / 255 >= 110;
async function press(bearingDeg, rangeNm) {
  const at = await placeOnPage(page, pixelOf(await ppi(page), plane(bearingDeg, rangeNm)));
  await page.mouse.click(at.x, at.y);
}

test('symbols: selected, without heading, without CPA, known to radar and AIS', async () => {
  const still = { speedKn: 0, courseDeg: 0 };
  await open({
    targets: [target(1, 90, 3), target(5, 300, 4, 2, { name: 'Wader', mmsi: 205 })],
    ais: [ais(201, 200, 3, { isActivated: true }), ais(202, 150, 4, { isActivated: true, ...still, cpaNm: 2, tcpaMin: 5 }),
      ais(203, 240, 4.5, { isActivated: true, ...still }), ais(205, 301, 4, { isActivated: true, ...still, cpaNm: 2, target: 5, name: 'Wader' })],
  });
  // Selected: lines at the corners of a square, none in the middle of its sides.
  await press(90, 3);
  await page.waitForFunction(() => window.skerry.targets().selected.includes('t1'));
  await page.mouse.move(5, 5);
  let view = await ppi(page), png = await canvas(page);
  const square = pixelOf(view, plane(90, 3)), half = 10 * (3 + 2.5) / 2;
  for (const [x, y, wanted] of [[1, 1, true], [1, -1, true], [-1, 1, true], [-1, -1, true], [0, 1, false], [0, -1, false], [-1, 0, false]]) {
    assert.equal(isDrawn(png, { x: square.x + x * half, y: square.y + y * half }, 1.5), wanted, `at ${x}, ${y} of the square`);
  }
  // Neither heading nor COG: the apex to the top, however the picture is turned.
  const apexUp = async (what) => {
    view = await ppi(page);
    png = await canvas(page);
    const at = pixelOf(view, plane(200, 3)), box = extent(png, at.x, at.y, 36);
    near(box.width, 40, 5, what);
    near(box.height, 60, 5, what);
    const top = box.y - box.height / 2, row = runs(box.x - 25, box.x + 25, 0.5, (x) => isLine(rgba(png, x, top + 2)));
    assert.ok(row.length === 1 && Math.abs(row[0].middle - box.x) < 3 && row[0].length < 8, `${what}: ${JSON.stringify(row)}`);
  };
  await apexUp('north up');
  await page.keyboard.press('h');
  await until(page, 'orientation', 'H UP');
  await apexUp('head up');
  await page.keyboard.press('n');
  await until(page, 'orientation', 'N UP');
  // Dashed where no CPA can be had. Along both sides from the apex, northward.
  const gaps = (bearingDeg, rangeNm) => {
    const { x, y } = pixelOf(view, plane(bearingDeg, rangeNm));
    return [-1, 1].map((side) => runs(0.06, 0.94, 0.005, (k) => isDrawn(png, { x: x + side * 20 * k, y: y - 30 + 60 * k }, 0.5)).length - 1);
  };
  await frames(page);
  view = await ppi(page);
  png = await canvas(page);
  assert.deepEqual(gaps(150, 4), [0, 0], 'a CPA is known');
  assert.ok(gaps(240, 4.5).every((n) => n >= 3), `no CPA: ${gaps(240, 4.5)} gaps`);
  // What radar and AIS both know is one symbol: that of AIS, or by choice the radar's.
  const joined = async () => {
    const { shown } = await targetState(page);
    return shown.filter(({ key }) => key === 't5' || key === 'a205').map(({ kind, source }) => [kind, source]);
  };
  assert.deepEqual(await joined(), [['activated', 'AIS + radar']]);
  const box = async (bearingDeg, reach) => { const at = pixelOf(view, plane(bearingDeg, 4)); return extent(await canvas(page), at.x, at.y, reach); };
  const triangle = await box(301, 35);
  near(triangle.width, 40, 6, 'width of the triangle');
  near(triangle.height, 60, 6, 'height of the triangle');
  await page.locator('#target-joined').selectOption('radar');
  await waitFor(async () => (await joined())[0][1] === 'Radar + AIS', 'the radar\u2019s symbol');
  assert.equal((await joined())[0][0], 'tracked');
  const circle = await box(300, 20);
  near(circle.width, 30, 3, 'circle');
  near(circle.height, 30, 3, 'circle');
  assert.deepEqual(page.problems, []);
});

test('vectors: dashes, ticks, arrowheads, one to sixty minutes for radar and AIS alike', async (t) => {
  const west = { courseDeg: 270, speedKn: 10, relativeCourseDeg: 270, relativeSpeedKn: 10, cpaNm: 3, tcpaMin: 5 };
  const past = [1, 2, 3].map((i) => ({ ...placeAt(100, i * 2000), rangeM: i * 1500, bearingDeg: 200 }));
  await open({ targets: [target(1, 90, 3, 2, { ...west, past })], ais: [ais(201, 60, 3, { ...west, isActivated: true })] }, { kept: { 'skerry.targets': { mmOf100px: 20, names: false } } });
  const view = await ppi(page);
  const line = async (key) => { await page.waitForFunction((k) => window.skerry.targets().vectors.some((each) => each.key === k), key); return (await targetState(page)).vectors.find((each) => each.key === key).points; };
  // Along the vector, clear of the symbol and of its end.
  let [from, to] = await line('t1'), png = await canvas(page);
  const parts = runs(to.x + 4, from.x - 14, 0.5, (x) => isLine(rgba(png, x, from.y))).slice(1, -1);
  const dashes = parts.map(({ length }) => length), gaps = parts.slice(1).map((part, i) => part.from - parts[i].to - 0.5);
  const rows = runs(-4, 4, 0.25, (dy) => isLine(rgba(png, parts[0].middle, from.y + dy)));
  t.diagnostic(`dashes ${Math.min(...dashes)} to ${Math.max(...dashes)} px, gaps ${Math.min(...gaps)} to ${Math.max(...gaps)} px, line ${rows[0].length} px wide`);
  assert.ok(parts.length >= 2 && dashes.every((px) => px >= 4 && px <= 9), 'short dashes');
  for (const gap of gaps) near(gap, 3, 1.3, 'a gap is two line widths of 1.5 px');
  // Ticks at whole minutes, if wanted; the first is in the symbol.
  const ticks = async () => {
    png = await canvas(page);
    return [2, 3, 4, 5].map((minute) => [-2.5, 2.5].every((dy) => isDrawn(png, { x: from.x + ((to.x - from.x) * minute) / 6, y: from.y + dy }, 1)));
  };
  assert.deepEqual(await ticks(), Array(4).fill(false));
  await page.locator('#vector-ticks + span').click();
  await page.mouse.move(5, 5);
  await waitFor(async () => !(await ticks()).includes(false), 'no ticks');
  await page.locator('#vector-ticks + span').click();
  // Arrowheads of own ship's vector, due north: two over ground, one through the water. Each has its arm 3 px beside the line.
  const heads = async () => {
    const own = (await line('own')).at(-1), drawn = await canvas(page);
    return runs(-2, 22, 0.25, (down) => isLine(rgba(drawn, own.x + 3, own.y + down))).length;
  };
  assert.equal(await heads(), 2);
  await show(server, page, { stabilisation: 1, stabilisedBy: 'gyro and log' });
  assert.equal(await heads(), 1);

  // Relative past positions stay as they are in either stabilisation.
  await page.keyboard.press('t');
  await page.keyboard.press('d');
  const dots = async () => {
    await frames(page);
    const drawn = await canvas(page);
    return past.map(({ bearingDeg, rangeM }) => { const at = pixelOf(view, plane(bearingDeg, rangeM / NM)), dot = extent(drawn, at.x, at.y, 6); return dot && [dot.x, dot.y, dot.width]; });
  };
  await waitFor(async () => !(await dots()).includes(null), 'no past positions');
  const water = await dots();
  await show(server, page, { stabilisation: 0, stabilisedBy: 'GNSS' });
  assert.deepEqual(await dots(), water);
  await page.keyboard.press('t');
  await page.keyboard.press('d');

  // The same minutes for both, from 1 to 60.
  const ends = async (minutes) => {
    const all = await Promise.all(['t1', 'a201'].map(line));
    assert.deepEqual(await text(page, 'vector-sign'), `VECT T ${minutes} min`);
    const wanted = ((10 * minutes) / 60) * NM * (view.radiusPx / view.rangeM);
    for (const [a, b] of all) near(apart(a, b), wanted, 1.5, `${minutes} min`);
    return all;
  };
  for (let i = 0; i < 6; ++i) await page.keyboard.press('[');
  await until(page, 'vector-sign', 'VECT T 1 min');
  await frames(page);
  await ends(1);
  for (let i = 0; i < 12; ++i) await page.keyboard.press(']');
  await until(page, 'vector-sign', 'VECT T 60 min');
  await frames(page);
  await ends(60);
  for (let i = 0; i < 6; ++i) await page.keyboard.press('[');
  await until(page, 'vector-sign', 'VECT T 10 min');
  await frames(page);
  for (const [, end] of await ends(10)) {
    png = await canvas(page);
    assert.ok(isDrawn(png, { x: end.x + 4, y: end.y }, 4) && !isDrawn(png, { x: end.x - 8, y: end.y }, 3), 'it is drawn to its end');
  }

  // After a change of range all is there within four turns.
  const { scan } = await page.evaluate(() => window.skerry.state());
  await page.locator('#range').selectOption('12');
  await page.waitForFunction(() => Math.abs(window.skerry.ppi.rangeM - 12 * 1852) < 1);
  await frames(page);
  const wide = await ppi(page);
  assert.ok(apart((await line('t1'))[0], pixelOf(wide, plane(90, 3))) < 2);
  assert.ok(isDrawn(await canvas(page), pixelOf(wide, plane(90, 3)), 9));
  const turns = (await page.evaluate(() => window.skerry.state())).scan - scan;
  assert.ok(turns <= 4, `${turns} turns`);
  assert.deepEqual(page.problems, []);
});

test('by day, dusk and night: a dark background, echoes of one hue, red for danger alone', async (t) => {
  const calm = [target(1, 60, 4.5), target(2, 150, 3)];
  const motion = { courseDeg: 270, speedKn: 12, relativeCourseDeg: 225, relativeSpeedKn: 17, cpaNm: 2, tcpaMin: 10 };
  await open({ targets: calm, ais: [ais(201, 170, 4, { isActivated: true, ...motion })] }, { kept: { 'skerry.targets': { mmOf100px: 20 }, 'skerry.picture': { afterglow: 0 } } });
  await page.keyboard.press('e');
  await page.keyboard.press('v');
  const trial = { order: { courseDeg: 90, speedKn: 10, delayMin: 2, turnRateDegMin: 0, accelerationKnMin: 0 }, beginsS: 120, outcomes: [] };
  const reds = async (least) => {
    await frames(page);
    const png = PNG.sync.read(await page.screenshot());
    let count = 0;
    for (let i = 0; i < png.data.length; i += 4) if (png.data[i] >= least && png.data[i] > 2.2 * png.data[i + 1] && png.data[i] > 2 * png.data[i + 2]) count += 1;
    return count;
  };
  const seen = {};
  for (const palette of ['day', 'dusk', 'night']) {
    await page.waitForFunction((name) => document.documentElement.dataset.palette === name, palette);
    // Land of the scene, strong and weak, and open sea without any echo.
    const hues = [], tones = [], sea = [];
    for (const gain of [35, 50]) {
      server.change({ gain });
      await waitForScan(page);
      await waitForScan(page);
      const shot = await capture(page), strengths = [];
      for (let y = 0; y < shot.width; y += 2) {
        for (let x = 0; x < shot.width; x += 2) {
          const { bearingDeg, rangeM } = placeOf(shot, x + 0.5, y + 0.5);
          const p = [...shot.data.subarray(4 * (y * shot.width + x), 4 * (y * shot.width + x) + 3)];
          if (rangeM > 5200 && rangeM < 5800 && bearingDeg > 225 && bearingDeg < 300 && Math.max(...p) > 40) { hues.push(hueOf(p)); strengths.push(Math.max(...p)); }
          if (rangeM > 2000 && rangeM < 10000 && bearingDeg > 150 && bearingDeg < 180) sea.push(Math.max(...p));
        }
      }
      tones.push(strengths.toSorted((a, b) => a - b)[strengths.length >> 1]);
    }
    assert.ok(hues.length > 200, `${hues.length} pixels of land`);
    assert.ok(tones[1] > tones[0] + 12, `${palette}: a strong echo ${tones[1]}, a weak one ${tones[0]}`);
    const middle = hues.toSorted((a, b) => a - b)[hues.length >> 1];
    const spread = Math.max(...hues.map((hue) => angleBetween(hue, middle)));
    const darkest = sea.toSorted((a, b) => a - b)[sea.length >> 1];
    const back = await page.evaluate(() => getComputedStyle(document.body).backgroundColor.match(/\d+/g).slice(0, 3).map(Number));
    assert.ok(spread < 12, `${palette}: echoes of hues ${middle} +- ${spread}`);
    assert.ok(darkest < 64 && Math.max(...back) < 64, `${palette}: sea ${darkest}, page ${back}`);
    // Targets, bearing lines and trails are of another hue, own ship's vector of none.
    const marks = await layer(page, 'target-marks'), view = marks.ppi;
    const at = pixelOf(view, plane(60, 4.5)), symbol = pixel(marks, { x: at.x, y: at.y - 7.5 });
    assert.ok(symbol[3] > 100 && angleBetween(hueOf(symbol), middle) > 60 && symbol[2] > symbol[0] + 30, `${palette}: targets ${symbol}, echoes of hue ${middle}`);
    const [own] = (await targetState(page)).vectors.filter(({ key }) => key === 'own');
    const white = runs(16, 60, 0.5, (up) => isLine(pixel(marks, { x: own.points[0].x, y: own.points[0].y - up }))).map(({ middle: up }) => pixel(marks, { x: own.points[0].x, y: own.points[0].y - up }));
    assert.ok(white.length > 0 && white.every(([r, g, b]) => Math.max(r, g, b) - Math.min(r, g, b) < 24), `${palette}: own vector ${white}`);
    assert.ok(symbol[1] > symbol[0], `${palette}: targets are light blue`);
    // Nothing is red, until something is dangerous; by night echoes are a darker red.
    const least = palette === 'night' ? 165 : 90;
    await show(server, page, { targets: calm, alerts: [], trial, testTargets: true });
    const before = await reds(least);
    assert.equal(before, 0, `${palette}: ${before} red pixels and no danger`);
    await show(server, page, { targets: [calm[0], target(2, 150, 3, 2, { isDangerous: true, ...motion })], alerts: [alert(3044, 2, 2, { state: 2 })], trial: null, testTargets: false });
    const after = await reds(least);
    assert.ok(after > 40, `${palette}: ${after} red pixels of what is dangerous`);
    seen[palette] = middle;
    t.diagnostic(`${palette}: echoes of hue ${middle.toFixed(0)} +- ${spread.toFixed(1)}, tones ${tones.join()}, sea ${darkest}, ${after} red pixels of danger`);
    await show(server, page, { targets: calm, alerts: [] });
    await page.keyboard.press('p');
  }
  assert.ok(angleBetween(seen.day, seen.dusk) > 8 && angleBetween(seen.dusk, seen.night) > 8, JSON.stringify(seen));
  // A trail, where echoes are gone, is of one colour and none of theirs.
  await page.locator('#trails').evaluate((list) => { list.value = '360'; list.dispatchEvent(new Event('change')); });
  await waitForScan(page);
  server.change({ gain: 5 });
  await waitForScan(page);
  await waitForScan(page);
  const shot = await capture(page), trail = place(shot, 190, 2500);
  const p = [...shot.data.subarray(4 * (Math.floor(trail.y) * shot.width + Math.floor(trail.x)), 4 * (Math.floor(trail.y) * shot.width + Math.floor(trail.x)) + 3)];
  assert.ok(p[2] > p[0] + 40 && angleBetween(hueOf(p), seen.day) > 60, `trail ${p}`);
  assert.deepEqual(page.problems, []);
});

test('default settings set all that they should, after a question', async () => {
  await open({ targets: [target(1, 90, 3)] }, { settings: { rangeNm: 3, gainAuto: false, seaAuto: false }, kept: { 'skerry.targets': { relative: true, minutes: 20, past: true, ais: false },
    'skerry.chart': { on: true }, 'skerry.picture': { orientation: 'head', trailS: 0, rings: true, afterglow: 0 } } });
  server.radarSettings.tuneAuto = false;
  server.change({});
  await page.keyboard.press('Shift+i');
  await page.locator('#lines-box').waitFor();
  await until(page, 'vector-sign', 'VECT R 20 min');
  await page.waitForFunction(() => window.skerry.settings().tuneAuto === false && document.querySelector('#chart-on').checked);
  await page.evaluate(() => window.skerry.showTab('radar'));
  const asked = server.received.filter(({ kind }) => kind === 'set' || kind === 'targetOrder').length;
  await page.locator('#defaults').click();
  await page.locator('#defaults-ask button[value=no]').click();
  assert.equal(await text(page, 'orientation'), 'H UP');
  assert.equal(server.received.filter(({ kind }) => kind === 'set' || kind === 'targetOrder').length, asked, 'nothing without the confirmation');
  await page.locator('#defaults').click();
  await page.locator('#defaults-ask button[value=yes]').click();
  const { rules } = await lastOrder(1);
  assert.deepEqual({ ...rules }, { ...rules, acquire: 0, cpaNm: 2, tcpaMin: 12, associate: true, lostWarnings: true, stabilisation: 0 });
  await page.waitForFunction(() => { const s = window.skerry.settings(); return s.rangeNm === 6 && s.gainAuto && s.seaAuto && s.tuneAuto; });
  await until(page, 'vector-sign', 'VECT T 6 min');
  await until(page, 'orientation', 'N UP');
  await until(page, 'motion', 'TM');
  await until(page, 'trail-state', 'T 6 min');
  assert.deepEqual(await page.evaluate(() => ['target-past', 'target-ais', 'chart-on', 'rings', 'heading-line', 'ebl', 'vrm', 'ebl2', 'vrm2'].map((id) => document.getElementById(id).checked)),
    [false, true, false, false, true, true, true, false, false]);
  assert.equal(await page.locator('#lines-box').isHidden(), true);
  // Most view ahead: own ship on the far side of her course, 037.
  const { own, centre, radiusPx } = await ppi(page);
  near(Math.hypot(own.x - centre.x, own.y - centre.y) / radiusPx, 0.7, 0.02, 'out');
  assert.ok(angleBetween(Math.atan2(own.x - centre.x, centre.y - own.y) * 180 / Math.PI, 217) < 2);
  // What the instructor has locked stays.
  server.locked = ['gain_auto', 'tune_auto'];
  server.radarSettings.tuneAuto = false;
  server.change({ gainAuto: false, rangeNm: 12 });
  await page.waitForFunction(() => window.skerry.settings().locked.length === 2 && window.skerry.settings().rangeNm === 12);
  await page.locator('#defaults').click();
  await page.locator('#defaults-ask button[value=yes]').click();
  await page.waitForFunction(() => window.skerry.settings().rangeNm === 6);
  assert.deepEqual([server.settings.gainAuto, server.radarSettings.tuneAuto], [false, false]);
  assert.deepEqual(page.problems, []);
});

test('single keys for acquiring, AIS, alerts and the light', async () => {
  await open({ targets: [target(1, 90, 3)], ais: [ais(201, 200, 3, { isActivated: true, courseDeg: 0, speedKn: 0, cpaNm: 2 })], alerts: [alert(3044, 1, 2)] });
  const view = await ppi(page);
  const at = pixelOf(view, plane(200, 3));
  assert.ok(isDrawn(await canvas(page), at, 35));
  await page.keyboard.press('i');
  await waitFor(async () => !isDrawn(await canvas(page), at, 35), 'AIS is off');
  await page.keyboard.press('i');
  await waitFor(async () => isDrawn(await canvas(page), at, 35), 'AIS is on');
  await page.keyboard.press('q');
  assert.deepEqual((await lastOrder(1)).acknowledge.map(({ number, instance }) => [number, instance]), [[3044, 1]]);
  const cursor = await placeOnPage(page, pixelOf(view, plane(250, 4.5)));
  await page.mouse.move(cursor.x, cursor.y);
  await page.keyboard.press('a');
  const { acquire } = await lastOrder(2);
  near(acquire.bearingDeg, 250, 0.6);
  near(acquire.rangeNm, 4.5, 0.03);
  // The light: the text beside the picture, and the picture, darker at each press; then day again.
  const light = async () => {
    await frames(page);
    const scale = pixel(await layer(page, 'graticule'), { x: view.centre.x, y: view.centre.y - view.radiusPx - 4 });
    return [scale, await page.locator('#range-now').evaluate((e) => getComputedStyle(e).color.match(/\d+/g).map(Number))].map((c) => Math.max(...c.slice(0, 3)));
  };
  const levels = [];
  for (const palette of ['day', 'dusk', 'night', 'day']) {
    await page.waitForFunction((name) => document.documentElement.dataset.palette === name, palette);
    levels.push(await light());
    await page.keyboard.press('p');
  }
  const [day, dusk, night, again] = levels;
  for (const i of [0, 1]) assert.ok(day[i] > dusk[i] && dusk[i] > night[i] && again[i] === day[i], JSON.stringify(levels));
  assert.deepEqual(page.problems, []);
});

test('limits and zones may be what makers allow, and no more', async () => {
  await open({ targets: [target(1, 90, 3)] });
  await page.locator('#targets-rules summary').click();
  let orders = 0;
  for (const [name, good, bad] of [['cpaNm', [0.1, 9.9], 10.1], ['tcpaMin', [1, 99], 100], ['pastIntervalS', [15, 30, 60, 120, 240, 360], 14], ['furthestNm', [32], 49], ['capacity', [200, 150], 201]]) {
    const field = page.locator(`#rule-${name}`);
    for (const value of good) {
      await field.fill(String(value));
      await page.keyboard.press('Tab');
      near((await lastOrder(++orders)).rules[name], value, 1e-9, name);
    }
    await field.fill(String(bad));
    await page.keyboard.press('Tab');
    assert.equal(await page.locator(`#rule-${name}-refusal`).isVisible(), true, `${name} ${bad}`);
    await field.fill(String(good[0]));
    await page.keyboard.press('Tab');
    await lastOrder(++orders);
  }
  await page.locator('#targets-zones summary').click();
  for (let n = 1; n <= 2; ++n) {
    for (const [name, value] of [['innerNm', 0.5], ['outerNm', 32], ['fromDeg', 40 * n], ['toDeg', 40 * n + 20]]) await page.locator(`#zone-${name}`).fill(String(value));
    await page.locator('#zone-add').click();
    const [zone] = (await lastOrder(++orders)).zones;
    assert.deepEqual([zone.number, zone.innerNm, zone.outerNm], [n, 0.5, 32]);
    await show(server, page, { zones: [...server.targets.zones, { number: n, kind: 0, innerNm: 0.5, outerNm: 32, fromDeg: 40 * n, toDeg: 40 * n + 20 }] });
  }
  assert.equal(await page.locator('#zone-list li').count(), 2);
  assert.equal(server.targetOrders.length, orders);
  assert.deepEqual(page.problems, []);
});
