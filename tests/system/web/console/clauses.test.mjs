// The clauses of a radar display (clients/web/CLAUSES.md), D1 to D9 and D13, where no other test proves them: measured on the
// screen of a real Chromium.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { capture, waitForScan } from '../browser.mjs';
import { beyond, frames, ink, layer, openClauses, pixel, ppi, runs, text, until } from '../clauses_kit.mjs';
import { eachTest } from '../each_test.mjs';
import { angleBetween, blobAt, place } from '../measure.mjs';
import { NM } from '../mock_scene.mjs';

let browser, server, page;
eachTest((b) => { browser = b; }, () => { const opened = { page, server }; page = server = null; return opened; });

async function open(options) {
  ({ server, page } = await openClauses(browser, options));
}
const showTab = (name) => page.evaluate((tab) => window.skerry.showTab(tab), name);
const pixelFor = (deg, m) => page.evaluate(([b, r]) => window.skerry.pixelFor(b, r), [deg, m]);
const near = (a, b, within, what = '') => assert.ok(Math.abs(a - b) <= within, `${what} ${a}, not ${b}`);
async function fill(name, value) {
  const field = page.getByLabel(name, { exact: true });
  await field.fill(value);
  await field.press('Tab');
}
async function setRange(nm) {
  await page.locator('#range').selectOption(String(nm));
  await page.waitForFunction((m) => Math.abs(window.skerry.ppi.rangeM - m) < 1, nm * NM);
}

// Separations that are usual, NM.
const SEPARATIONS = [[0.25, 0.05], [0.5, 0.1], [0.75, 0.125], [1.5, 0.25], [3, 0.5], [6, 1], [12, 2], [24, 4]];

test('range scales: rings stand where they say, and their separation is told, on every standard scale', async (t) => {
  await open({ kept: { 'skerry.picture': { afterglow: 0, headingLine: false } } });
  const offered = await page.locator('#range option').evaluateAll((all) => all.map((each) => Number(each.value)));
  const worst = { ringPart: 0, radiusPart: 0 };
  for (const [nm, separation] of SEPARATIONS) {
    assert.ok(offered.includes(nm), `${nm} NM is not offered`);
    await setRange(nm);
    await until(page, 'ring-spacing', String(separation));
    await until(page, 'range-now', String(nm));
    const png = await layer(page, 'graticule'), view = png.ppi;
    const { centre, radiusPx } = view;
    // South by a little west no number stands on a ring.
    const along = (deg) => runs(4, radiusPx * 1.1, 0.25, (r) => pixel(png, beyond(centre, deg, r))[3] > 45);
    const found = along(200).filter(({ middle }) => middle < radiusPx - 3);
    assert.equal(found.length, Math.round(nm / separation) - 1, `rings on ${nm} NM, and the edge`);
    assert.ok(found.length + 1 >= 2 && found.length + 1 <= 6);
    const bound = Math.max(0.01 * nm, 30 / NM);
    found.forEach(({ middle }, i) => {
      const off = Math.abs((middle / radiusPx) * nm - separation * (i + 1));
      worst.ringPart = Math.max(worst.ringPart, off / nm);
      assert.ok(off <= bound, `ring ${i + 1} on ${nm} NM is ${off} NM off`);
    });
    // The shown radius, by the rings' own scale, where the circle of the edge begins.
    const pxPerNm = found.at(-1).middle / (separation * found.length);
    for (const deg of [0, 90, 180, 270]) {
      const edge = along(deg).find(({ to }) => to > radiusPx - 3).from + 0.6;
      const part = edge / pxPerNm / nm - 1;
      worst.radiusPart = Math.max(worst.radiusPart, Math.abs(part));
      assert.ok(part >= -0.004 && part <= 0.08, `the radius on ${deg} of ${nm} NM is ${part * 100} % over`);
    }
    if (nm === 3) {
      // An echo of known range against the rings as drawn.
      await waitForScan(page);
      const shot = await capture(page);
      const blob = blobAt(shot, 190, 2500, 3, 200);
      const byRings = ((blob.rangeM / shot.rangeM) * radiusPx) / pxPerNm;
      assert.ok(Math.abs(byRings - 2500 / NM) <= bound, `${byRings} NM by the rings, is ${2500 / NM}`);
    }
  }
  t.diagnostic(`worst: a ring ${(100 * worst.ringPart).toFixed(2)} % of the scale, the radius ${(100 * worst.radiusPart).toFixed(2)} %`);
  assert.ok(offered.length > SEPARATIONS.length, 'others beside them');
  await page.keyboard.press('r');
  await page.waitForFunction(() => !document.querySelector('#rings').checked);
  const png = await layer(page, 'graticule'), { centre, radiusPx } = png.ppi;
  assert.equal(runs(4, radiusPx - 3, 0.25, (r) => pixel(png, beyond(centre, 200, r))[3] > 45).length, 0, 'rings are off');
  assert.equal(await text(page, 'ring-spacing'), '4', 'and their separation still stands there');
  assert.deepEqual(page.problems, []);
});

test('the bearing scale: numbers and marks, true in north up and course up, relative in head up', async (t) => {
  await open({ context: { viewport: { width: 1280, height: 720 } } });
  const HEADING = 37, ECHO = 118;
  for (const [key, label, top] of [['n', 'N UP', 0], ['c', 'C UP', HEADING], ['h', 'H UP', 0]]) {
    await page.keyboard.press(key);
    await until(page, 'orientation', label);
    await frames(page);
    const { centre, radiusPx } = await ppi(page);
    const numbers = (await page.evaluate(() => window.written.graticule)).filter(({ x, y }) => Math.hypot(x - centre.x, y - centre.y) > radiusPx)
      .map((each) => ({ deg: Number(each.text), text: each.text, at: (Math.atan2(each.x - centre.x, centre.y - each.y) * 180 / Math.PI + 360) % 360 }));
    for (let deg = 0; deg < 360; deg += 30) {
      const number = numbers.find((each) => each.text === String(deg).padStart(3, '0'));
      assert.ok(number && angleBetween(number.at, deg - top) < 0.5, `${label}: ${deg} stands on ${number?.at}`);
    }
    // What the scale reads of an echo.
    await waitForScan(page);
    const shot = await capture(page);
    const blob = blobAt(shot, ECHO, 1500, 3, 300);
    const on = blob.bearingDeg - shot.upDeg;
    const beside = numbers.reduce((best, each) => (angleBetween(each.at, on) < angleBetween(best.at, on) ? each : best));
    const reads = beside.deg + ((on - beside.at + 540) % 360) - 180;
    assert.ok(angleBetween(reads, label === 'H UP' ? ECHO - HEADING : ECHO) < 1, `${label}: an echo reads ${reads}`);
    const png = await layer(page, 'graticule');
    const length = (deg) => {
      let px = 0;
      while (px < 14 && ink(png, beyond(centre, deg - top, radiusPx + 2 + px))[3] > 60) px += 0.5;
      return px;
    };
    const lengths = { ten: [], five: [], one: [] };
    for (let deg = 0; deg < 360; ++deg) lengths[deg % 10 === 0 ? 'ten' : deg % 5 === 0 ? 'five' : 'one'].push(length(deg));
    const [ten, five, one] = Object.values(lengths).map((all) => [Math.min(...all), Math.max(...all)]);
    t.diagnostic(`${label}: marks of 10, 5 and 1 deg are ${ten.join(' to ')}, ${five.join(' to ')} and ${one.join(' to ')} px long`);
    assert.ok(one[0] > 0 && five[0] > one[1] && ten[0] > five[1], JSON.stringify({ ten, five, one }));
  }
});

test('EBL and VRM: their numbers, steps, dashes, tick and sign, and the range kept over scales', async () => {
  await open({ kept: { 'skerry.picture': { afterglow: 0, headingLine: false } } });
  for (const key of ['e', 'v', 'Shift+E', 'Shift+V']) await page.keyboard.press(key);
  await page.waitForFunction(() => window.skerry.tools().active === 1);
  await until(page, 'ebl-true', '045.0°');
  await until(page, 'ebl2-true', '315.0°');
  // Tenths of a degree; a thousandth of the range is below a hundredth of a mile.
  await page.keyboard.press('Shift+ArrowRight');
  await until(page, 'ebl2-true', '315.1°');
  const before = parseFloat(await text(page, 'vrm2-range'));
  await page.keyboard.press('Shift+ArrowUp');
  await page.waitForFunction((was) => parseFloat(document.querySelector('#vrm2-range').textContent) > was, before);
  near(parseFloat(await text(page, 'vrm2-range')) - before, 0.006, 0.0011, 'a step of the VRM, NM');
  await page.keyboard.press('Shift+ArrowLeft');
  const sign = (id) => page.locator(`#${id} .tag`).evaluate((tag) => [getComputedStyle(tag, '::before').content, getComputedStyle(tag, '::after').content]);
  for (const id of ['ebl2-box', 'vrm2-box']) assert.deepEqual(await sign(id), ['"> "', '" <"']);
  for (const id of ['ebl-box', 'vrm-box']) assert.deepEqual(await sign(id), ['none', 'none']);

  await showTab('tools');
  await fill('Range of VRM 1', '1.23');
  await until(page, 'vrm-range', '1.230 NM');
  await page.mouse.move(5, 5);
  const font = Math.max(10, Math.min(20, (await ppi(page)).side / 62));
  // Dashes along both bearing lines, beyond VRM 1 and short of VRM 2.
  const dashes = async (deg) => {
    const png = await layer(page, 'marks'), { centre, radiusPx } = png.ppi;
    return runs(0.26 * radiusPx, 0.7 * radiusPx, 0.25, (r) => pixel(png, beyond(centre, deg, r))[3] > 90).slice(1, -1).map(({ length }) => length);
  };
  const one = await dashes(45), two = await dashes(315);
  assert.ok(one.length > 5 && two.length > 5);
  assert.ok(Math.max(...one) / Math.min(...one) < 1.7, `EBL 1 has dashes of one length: ${one}`);
  assert.ok(Math.max(...two) / Math.min(...two) > 2.5, `EBL 2 has long and short ones: ${two}`);
  // The tick across EBL 1: solid, where the dashes of its range circle are not, on whatever bearing.
  const across = (png, centre, deg, r) => runs(-0.42 * font, 0.42 * font, 0.5, (s) => ink(png, beyond(beyond(centre, deg, r), deg + 90, s))[3] > 60);
  for (const deg of [45, 47.3, 52.8, 61.1]) {
    await fill('Bearing of EBL 1', String(deg));
    await page.waitForFunction((d) => window.skerry.tools().ebls[0].bearingDeg === d, deg);
    const png = await layer(page, 'marks'), { centre, radiusPx } = png.ppi;
    assert.equal(across(png, centre, deg, (1.23 / 6) * radiusPx).length, 1, `the tick on ${deg} has gaps`);
    assert.ok(across(png, centre, deg, (2.5 / 6) * radiusPx).every(({ length }) => length < 0.65 * font), 'a tick elsewhere');
  }
  for (const nm of [3, 12, 1.5, 6]) {
    await setRange(nm);
    assert.equal(await text(page, 'vrm-range'), '1.230 NM');
    const png = await layer(page, 'marks'), { centre, radiusPx } = png.ppi;
    const drawn = (m) => Array.from({ length: 120 }, (_, i) => pixel(png, beyond(centre, 100 + i, (m / nm) * radiusPx))[3] > 60).filter(Boolean).length;
    assert.ok(drawn(1.23) > 50, `VRM 1 on ${nm} NM: ${drawn(1.23)} of 120 places`);
    assert.ok(drawn(1.23 + 0.03 * nm) < 20, 'and not beside it');
  }
  assert.deepEqual(page.problems, []);
});

test('parallel lines: six, each by itself, and turning with own ship', async () => {
  await open({ kept: { 'skerry.picture': { afterglow: 0, headingLine: false } } });
  await showTab('tools');
  await page.locator('#parallel > summary').click();
  const offsets = [0.8, -0.8, 1.6, -1.6, 2.4, -2.4];
  for (const [n, nm] of offsets.entries()) {
    await page.getByRole('button', { name: `Line ${n + 1}`, exact: true }).first().click();
    await page.locator('#line-on').click();
    await fill('Bearing of the line', '20');
    await fill('Offset of the line, to port negative', String(nm));
  }
  await until(page, 'lines-on', '1 2 3 4 5 6');
  // Where a line must be: `along` miles ahead of abeam, `off` to starboard, of a bearing.
  const drawn = async (bearing) => {
    const png = await layer(page, 'marks'), { own, radiusPx } = png.ppi;
    return offsets.map((off) => [1, -1.4].every((along) => {
      const at = beyond(beyond(own, bearing, (along / 6) * radiusPx), bearing + 90, (off / 6) * radiusPx);
      return ink(png, at)[3] > 100;
    }));
  };
  await page.mouse.move(5, 5);
  assert.deepEqual(await drawn(20), Array(6).fill(true));
  for (const n of [0, 5]) {
    await page.getByRole('button', { name: `Line ${n + 1}`, exact: true }).first().click();
    await page.locator('#line-on').click();
    await page.mouse.move(5, 5);
    assert.deepEqual(await drawn(20), offsets.map((_, i) => i !== n), `without line ${n + 1}`);
    await page.locator('#line-on').click();
  }
  // Relative: 20 deg is 343 from the bow.
  await page.locator('#line-frame').click();
  await page.waitForFunction(() => window.skerry.tools().lines[5].frame === 'relative');
  server.headingDeg = 67;
  await page.waitForFunction(() => Math.abs(window.skerry.state().headingDeg - 67) < 0.01);
  await page.mouse.move(5, 5);
  assert.deepEqual((await drawn(50))[5], true, 'it turned with own ship');
  assert.deepEqual((await drawn(20)).slice(0, 5), Array(5).fill(true), 'the others keep their bearing');
  await page.keyboard.press('Shift+i');
  await until(page, 'lines-on', '1 2 3 4 5 6 hidden');
  assert.ok(!(await drawn(20)).includes(true));
});

test('all that must stand on the screen does, in each tab', async () => {
  await open({ settings: { gain: 61, sea: 12, rain: 7, interferenceRejection: 20 }, context: { viewport: { width: 1280, height: 720 } } });
  const wanted = {
    'latitude-short': '60°23.550′N', 'longitude-short': '005°19.398′E', 'heading-short': '037.0', 'speed-short': '11.9',
    'range-now': '6', 'ring-spacing': '1', orientation: 'N UP', motion: 'RM', stabilisation: 'GND · position',
    'vector-sign': 'VECT T 6 min', 'stabilisation-sign': 'STAB G GNSS', 'limits-sign': 'CPA 1 NM TCPA 12 min', 'trail-state': 'off',
    'gain-short': '61', 'sea-short': '12', 'rain-short': '7', 'ir-short': '20', 'scanner-short': 'TX', 'view-short': 'shared view',
  };
  await until(page, 'gain-short', '61');
  await until(page, 'limits-sign', wanted['limits-sign']);
  const shown = () => page.evaluate((ids) => {
    const circle = document.querySelector('#ppi').getBoundingClientRect(), { centre, radiusPx } = window.skerry.ppi;
    const middle = { x: circle.x + centre.x, y: circle.y + centre.y };
    return Object.fromEntries(ids.map((id) => {
      const each = document.getElementById(id), b = each.getBoundingClientRect();
      const dx = Math.max(b.left - middle.x, 0, middle.x - b.right), dy = Math.max(b.top - middle.y, 0, middle.y - b.bottom);
      const seen = each.checkVisibility() && b.width > 0 && b.left >= 0 && b.top >= 0 && b.right <= innerWidth && b.bottom <= innerHeight;
      return [id, !seen ? 'not seen' : Math.hypot(dx, dy) < radiusPx ? 'over the picture' : each.textContent];
    }));
  }, Object.keys(wanted));
  for (const tab of ['radar', 'targets', 'tools', 'chart', 'set-up']) {
    await showTab(tab);
    assert.deepEqual(await shown(), wanted, tab);
  }
  await page.keyboard.press('z');
  await page.waitForFunction(() => document.body.hasAttribute('data-alone'));
  assert.deepEqual(await shown(), wanted, 'over the whole screen');
  await page.keyboard.press('z');
  // The words of the receiver, and the mode beside the range.
  assert.match(await page.locator('#receiver-short').textContent(), /GAIN\s+61\s+SEA\s+12\s+RAIN\s+7\s+IR\s+20/);
  const [range, mode] = [await page.locator('#range-now').boundingBox(), await page.locator('#motion').boundingBox()];
  assert.ok(Math.abs(mode.y - range.y) < 90 && Math.abs(mode.x - range.x) < 90, JSON.stringify({ range, mode }));
  server.radarSettings.standby = true;
  server.change({});
  await until(page, 'scanner-short', 'STBY');
  server.radarSettings.standby = false;
  server.change({});
  await showTab('radar');
  await page.locator('input[name=view][value=own] + span').click();
  await until(page, 'view-short', 'own view');
  assert.deepEqual(page.problems, []);
});

test('what is lost is a dash with a word, and after a break nothing of the server looks like now', async () => {
  await open();
  const ids = ['heading-short', 'heading', 'speed-short', 'speed', 'latitude-short', 'longitude-short', 'latitude'];
  server.ownShipMore = { noHeading: true, noLog: true, noPosition: true };
  await page.locator('#sensor-sign', { hasText: 'No heading, position, log' }).waitFor();
  for (const id of ids) assert.equal(await text(page, id), '–', id);
  await until(page, 'orientation', 'H UP · heading lost');
  server.ownShipMore = {};
  await page.locator('#sensor-sign').waitFor({ state: 'hidden' });
  for (const id of ids) assert.notEqual(await text(page, id), '–', `${id} comes back`);
  const opacity = () => page.evaluate(() => ['gain-short', 'sea-short', 'heading-short', 'latitude-short', 'scanner-short', 'clock']
    .map((id) => getComputedStyle(document.getElementById(id).closest('[data-live]')).opacity));
  assert.deepEqual(await opacity(), Array(6).fill('1'));
  await server.stop();
  await page.locator('#alarm', { hasText: 'Connection lost' }).waitFor();
  assert.deepEqual(await opacity(), Array(6).fill('0.4'));
  await page.locator('#targets-stale', { hasText: 'Targets not updated' }).waitFor();
  await until(page, 'stabilisation-sign', 'STAB –');
  await server.start();
  await page.locator('#alarm').waitFor({ state: 'hidden' });
  await page.waitForFunction(() => getComputedStyle(document.getElementById('gain-short').closest('[data-live]')).opacity === '1');
});

test('trails are back within two turns after a change of range and a reset of true motion', async (t) => {
  await open({ headingDeg: 0 });
  const lengths = await page.locator('#trails option').evaluateAll((all) => all.map((each) => Number(each.value)));
  assert.ok(lengths.length >= 8 && lengths.includes(0) && lengths.includes(-1));
  await page.locator('#trails').selectOption('-1');
  await until(page, 'trail-state', 'R permanent');
  await waitForScan(page);
  server.change({ gain: 5 });   // no echo is strong any more: what is seen is the trail
  await waitForScan(page);
  await waitForScan(page);
  // Whether the trail of the echo on 190, at 2500 m, stands out of the sea beside it, with no spoke drawn that is of more than two
  // turns after `change`.
  const back = async (what, change) => {
    await page.evaluate(() => window.skerry.holdAfter(window.skerry.state().scan + 2));
    await change();
    const shot = await capture(page);
    // The echo is a few pixels: the bluest within one of its place.
    const at = ({ x, y }) => Math.max(...[-1, 0, 1].flatMap((dy) => [-1, 0, 1].map((dx) => shot.data[4 * (Math.floor(y + dy) * shot.width + Math.floor(x + dx)) + 2])));
    const over = at(place(shot, 190, 2500)) - at(place(shot, 176, 2500));
    t.diagnostic(`${what}: ${over} above the sea`);
    assert.ok(over > 40, `${what}: ${over} above the sea`);
    await page.evaluate(() => window.skerry.holdAfter(null));
  };
  const pressed = async (key, id, wanted) => { await page.keyboard.press(key); await until(page, id, wanted); };
  const mode = async (name, id, wanted) => { await page.locator(`input[name=trail-mode][value=${name}] + span`).click(); await until(page, id, wanted); };
  await back('permanent', async () => {});
  await back('6 min', async () => { await page.locator('#trails').selectOption('360'); await until(page, 'trail-state', 'R 6 min'); });
  for (const nm of [3, 6]) await back(`relative, ${nm} NM`, () => setRange(nm));
  await back('true', () => mode('true', 'trail-state', 'T 6 min'));
  for (const nm of [3, 6]) await back(`true, ${nm} NM`, () => setRange(nm));
  await page.locator('#ppi').focus();
  await back('true motion', () => pressed('Shift+t', 'motion', 'TM'));
  for (let i = 0; i < 2; ++i) {
    // Elsewhere, then back by the reset.
    await page.keyboard.press('Home');
    await page.waitForFunction(() => window.skerry.ppi.own.x === window.skerry.ppi.centre.x);
    await back('after a reset', async () => {
      await page.keyboard.press('End');
      await page.waitForFunction(() => window.skerry.ppi.own.x !== window.skerry.ppi.centre.x);
    });
  }
  await back('relative motion', () => pressed('Shift+t', 'motion', 'RM(T)'));
  await back('a turn of own ship', async () => {
    server.headingDeg = 75;
    await page.waitForFunction(() => Math.abs(window.skerry.state().headingDeg - 75) < 0.01);
  });
  for (const [key, label] of [['c', 'C UP'], ['h', 'H UP'], ['n', 'N UP']]) await back(label, () => pressed(key, 'orientation', label));
  await back('relative again', () => mode('relative', 'motion', 'RM(R)'));
});

test('the heading line is solid from own ship to the edge, in each mode', async () => {
  await open();
  const HEADING = 37;
  const check = async (what) => {
    const png = await layer(page, 'marks'), { own, centre, radiusPx, upDeg } = png.ppi;
    const deg = HEADING - upDeg, a = (deg * Math.PI) / 180;
    const ox = own.x - centre.x, oy = own.y - centre.y, along = -(ox * Math.sin(a) - oy * Math.cos(a));
    const edge = along + Math.sqrt(along ** 2 + radiusPx ** 2 - ox ** 2 - oy ** 2);
    const isLine = (r) => { const [red, , blue, alpha] = ink(png, beyond(own, deg, r)); return alpha > 100 && red > blue + 40; };
    const [run, ...more] = runs(8, edge + 6, 0.5, isLine);
    if (!run) assert.fail(`${what}: it is not there: ${JSON.stringify({ own, centre, radiusPx, upDeg, edge, ...(await page.evaluate(() => window.skerry.state())) })}`);
    assert.equal(more.length, 0, `${what}: it has gaps`);
    assert.ok(run.from === 8 && run.to >= edge - 1.5 && run.to <= edge + 2, `${what}: from ${run.from} to ${run.to} of ${edge} px`);
  };
  for (const [keys, label] of [[['n'], 'N UP'], [['c'], 'C UP'], [['h'], 'H UP'], [['n', 'PageUp'], 'N UP'], [['Shift+t'], 'N UP']]) {
    for (const key of keys) await page.keyboard.press(key);
    await until(page, 'orientation', label);
    await check(`${label} ${keys.join()}`);
  }
  await until(page, 'motion', 'TM');
  assert.deepEqual(page.problems, []);
});
