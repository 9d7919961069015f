// Lines and marks of one's own, and the man overboard, in a real Chromium.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { test } from 'node:test';
import { waitForScan } from '../browser.mjs';
import { alphaAt, chart, inked, layer, onScreen, open, page, pixelFor, server } from '../chart_kit.mjs';
import { OWN } from '../mock_chart.mjs';
import { direct, inverse } from '../vincenty.mjs';

const mode = (name) => page.locator(`input[name=map-mode][value=${name}]`).check({ force: true });
async function openMap() {
  if (!(await page.locator('#map').evaluate((element) => element.open))) await page.locator('#map > summary').click();
}
const PLACES = [[40, 4000], [120, 6000], [200, 3000]];
async function checkPlaces(places, wanted) {
  const metresPerPixel = await page.evaluate(() => window.skerry.ppi.rangeM / window.skerry.ppi.radiusPx);
  assert.equal(places.length, wanted.length);
  for (const [i, [deg, m]] of wanted.entries()) {
    const off = inverse(direct(OWN, deg, m), places[i]).rangeM;
    assert.ok(off < 1.2 * metresPerPixel, `point ${i} is off by ${off / metresPerPixel} px`);
  }
}

test('a line is drawn by mouse and stays on the ground; no other tool hears of it', async () => {
  const url = await open({ headingDeg: 20 });
  await waitForScan(page);
  await page.keyboard.press('e');
  await page.keyboard.press('v');
  await page.waitForFunction(() => document.getElementById('ebl-true').textContent !== '\u2013');
  const eblBefore = await page.locator('#ebl-true').textContent();
  await openMap();
  await page.locator('#map-kind').selectOption('track');
  await page.locator('#map-text').fill('<i>Leg</i> 1');
  await mode('line');
  for (const [deg, m] of PLACES) {
    await page.mouse.click(...await onScreen(await pixelFor(deg, m)), { delay: 20 });
  }
  await page.keyboard.press('Enter');
  let { items } = await chart();
  assert.equal(items.length, 1);
  assert.deepEqual([items[0].type, items[0].kind, items[0].text], ['line', 'track', '<i>Leg</i> 1']);
  await checkPlaces(items[0].places, PLACES);
  assert.equal(await page.locator('#ebl-true').textContent(), eblBefore, 'the EBL was placed by a drawing press');
  assert.match(await page.locator('#map-items').textContent(), /Track · line of 3 · <i>Leg<\/i> 1/);
  // Drawn along its legs.
  const between = async () => {
    const [a, b] = (await chart()).itemPixels[0];
    const picture = await layer('map-lines');
    let ink = 0;
    for (let k = 1; k < 40; ++k) {
      const x = a.x + ((b.x - a.x) * k) / 40, y = a.y + ((b.y - a.y) * k) / 40;
      ink += [-1, 0, 1].some((d) => alphaAt(picture, x + d, y) > 0) ? 1 : 0;
    }
    return ink;
  };
  assert.ok(await between() > 20 && await between() < 39, 'a dashed line');
  // Own ship sails: the line stays where it is on the ground.
  server.at = direct(OWN, 90, 2000);
  await page.waitForFunction((lon) => Math.abs(window.skerry.chart().place.longitudeDeg - lon) < 1e-6, server.at.longitudeDeg);
  const { bearingDeg, rangeM } = inverse(server.at, items[0].places[1]);
  const want = await pixelFor(bearingDeg, rangeM);
  const is = (await chart()).itemPixels[0][1];
  assert.ok(Math.hypot(is.x - want.x, is.y - want.y) < 0.5);
  // Backspace, Escape, and a double click.
  server.at = OWN;
  await page.waitForFunction((lon) => Math.abs(window.skerry.chart().place.longitudeDeg - lon) < 1e-6, OWN.longitudeDeg);
  for (const [deg, m] of PLACES.slice(0, 2)) await page.mouse.click(...await onScreen(await pixelFor(deg, m)));
  await page.keyboard.press('Backspace');
  assert.equal((await chart()).draft.places.length, 1);
  await page.keyboard.press('Escape');
  assert.equal((await chart()).draft, null);
  assert.equal((await chart()).mode, 'line');
  await page.mouse.click(...await onScreen(await pixelFor(...PLACES[0])));
  await page.mouse.dblclick(...await onScreen(await pixelFor(...PLACES[1])));
  ({ items } = await chart());
  assert.equal(items.length, 2);
  await checkPlaces(items[1].places, PLACES.slice(0, 2));
  // Out of the mode a press is the markers' again.
  await page.keyboard.press('Escape');
  assert.equal((await chart()).mode, 'off');
  await page.mouse.click(...await onScreen(await pixelFor(300, 3000)));
  await page.waitForFunction((was) => document.getElementById('ebl-true').textContent !== was, eblBefore);
  assert.equal((await chart()).items.length, 2);
  // The switch hides them; the page that is loaded again has them.
  await page.locator('#chart-lines').uncheck({ force: true });
  assert.equal(inked(await layer('map-lines')), 0);
  await page.goto(url);
  await page.waitForFunction(() => window.skerry?.chart().items.length === 2);
  assert.deepEqual(page.problems, []);
});

test('points and lines are drawn by finger, and dragged', async () => {
  await open({}, { hasTouch: true, viewport: { width: 1280, height: 800 } });
  await waitForScan(page);
  await openMap();
  const sizes = await page.locator('#chart-panel').evaluate((panel) => [...panel.querySelectorAll('button, .toggles span, .choice span, select')]
    .filter((each) => each.checkVisibility()).map((each) => { const { width, height } = each.getBoundingClientRect(); return [each.id || each.textContent, width, height]; }));
  if (await page.evaluate(() => matchMedia('(pointer: coarse)').matches)) for (const [name, width, height] of sizes) assert.ok(width >= 44 && height >= 44, `${name} is ${width} by ${height}`);
  await mode('point');
  const tap = async (deg, m) => page.touchscreen.tap(...await onScreen(await pixelFor(deg, m)));
  await tap(30, 5000);
  await mode('line');
  for (const [deg, m] of PLACES) await tap(deg, m);
  await page.locator('#map-finish').click();
  let { items } = await chart();
  assert.deepEqual(items.map(({ type }) => type), ['point', 'line']);
  await checkPlaces(items[0].places, [[30, 5000]]);
  await checkPlaces(items[1].places, PLACES);
  await mode('edit');
  await page.mouse.move(...await onScreen(await pixelFor(...PLACES[1])));
  await page.mouse.down();
  await page.mouse.move(...await onScreen(await pixelFor(140, 5000)), { steps: 4 });
  await page.mouse.up();
  ({ items } = await chart());
  await checkPlaces(items[1].places, [PLACES[0], [140, 5000], PLACES[2]]);
  await checkPlaces(items[0].places, [[30, 5000]]);
  const kept = JSON.parse(JSON.parse(await page.evaluate(() => localStorage.getItem('skerry.maps'))).maps['My map']);
  assert.ok(Math.abs(kept.features[1].geometry.coordinates[1][1] - items[1].places[1].latitudeDeg) < 1e-6, 'kept as it was let go');
  // What was dragged is selected: its fields show it, and Delete takes it away.
  await page.waitForFunction(() => /60°/.test(document.getElementById('map-latitude').value));
  await page.keyboard.press('Delete');
  assert.deepEqual((await chart()).items.map(({ type }) => type), ['point']);
  await page.locator('#map-items').getByRole('button', { name: /^Delete/ }).click();
  assert.equal((await chart()).items.length, 0);
  assert.deepEqual(page.problems, []);
});

test('positions are typed, and a wrong one is refused beside its field', async () => {
  await open();
  await openMap();
  await page.locator('#map-latitude').fill('60 75 N');
  await page.locator('#map-longitude').fill('5 20');
  await page.locator('#map-add').click();
  assert.match(await page.locator('#map-latitude-wrong').textContent(), /minutes are 60 or more; expected .* 60 23\.550 N/);
  assert.match(await page.locator('#map-longitude-wrong').textContent(), /E or W is missing/);
  assert.equal(await page.locator('#map-latitude').getAttribute('aria-invalid'), 'true');
  assert.equal((await chart()).items.length, 0);
  await page.locator('#map-latitude').fill('60 23.7 N');
  await page.locator('#map-longitude').fill('005 20.5 E');
  await page.locator('#map-longitude').press('Enter');
  assert.equal(await page.locator('#map-latitude-wrong').isVisible(), false);
  let [item] = (await chart()).items;
  assert.ok(inverse(item.places[0], { latitudeDeg: 60.395, longitudeDeg: 5 + 20.5 / 60 }).rangeM < 0.01);
  // Chosen in the list, it is changed.
  await page.locator('#map-items button').first().click();
  await page.locator('#map-text').fill('Rock');
  await page.locator('#map-kind').selectOption('danger');
  await page.locator('#map-latitude').fill('60 23.8 N');
  await page.locator('#map-change').click();
  [item] = (await chart()).items;
  assert.deepEqual([item.text, item.kind], ['Rock', 'danger']);
  assert.ok(Math.abs(item.places[0].latitudeDeg - (60 + 23.8 / 60)) < 1e-7);
  // A line by keyboard alone.
  await mode('line');
  for (const latitude of ['60 24 N', '60 25 N']) {
    await page.locator('#map-latitude').fill(latitude);
    await page.locator('#map-latitude').press('Enter');
  }
  await page.locator('#map-finish').click();
  assert.equal((await chart()).items[1].places.length, 2);
});

test('maps go out and come in as files; a hostile one is refused with its reason', async () => {
  await open();
  await openMap();
  const give = (name, text) => page.locator('#map-file').setInputFiles({ name, mimeType: 'application/geo+json', buffer: Buffer.from(text) });
  const collection = (features) => JSON.stringify({ type: 'FeatureCollection', features });
  const point = (text, coordinates = [5.3, 60.4]) => ({ type: 'Feature', properties: { kind: 'note', text }, geometry: { type: 'Point', coordinates } });
  await give('Trip <b>.geojson', collection([point('<img src=x onerror="window.bad=1">')]));
  await page.waitForFunction(() => window.skerry.chart().items.length === 1);
  assert.equal(await page.locator('#map-name').inputValue(), 'Trip <b>');
  assert.equal(await page.evaluate(() => window.bad), undefined);
  assert.equal(await page.locator('#map-items img').count(), 0);
  for (const [name, text, why] of [
    ['a.geojson', '{', /it is not JSON/], ['b.geojson', collection([point('x', [5, 95])]), /feature 1: latitude 95/], ['c.geojson', ' '.repeat(1100000), /larger than 1 MB/],
    ['d.geojson', collection([point('x', [null, 60])]), /numbers only/],
  ]) {
    await give(name, text);
    await page.waitForFunction((file) => document.getElementById('notices').textContent.includes(file), name);
    assert.match(await page.locator('#notices').textContent(), why);
    assert.equal((await chart()).items.length, 1, 'what was there stays');
  }
  const [download] = await Promise.all([page.waitForEvent('download'), page.locator('#map-export').click()]);
  assert.equal(download.suggestedFilename(), 'Trip _b_.geojson');
  const file = JSON.parse(readFileSync(await download.path(), 'utf8'));
  assert.deepEqual(file.features[0].geometry, { type: 'Point', coordinates: [5.3, 60.4] });
  // By name: another map, and back.
  await page.locator('#map-save-name').fill('Second');
  await page.locator('#map-save button').click();
  await page.locator('#map-items').getByRole('button', { name: /^Delete/ }).click();
  assert.equal((await chart()).items.length, 0);
  await page.locator('#map-name').selectOption('Trip <b>');
  assert.equal((await chart()).items.length, 1);
  await page.locator('#map-remove').click();
  await page.locator('#map-remove').click();
  assert.deepEqual(await page.locator('#map-name option').allTextContents(), ['Second']);
  assert.deepEqual(page.problems, []);
});

test('a damaged map is told, and neither it nor the open one is written over', async () => {
  await open();
  await openMap();
  await page.locator('#map-latitude').fill('60 23.0 N');
  await page.locator('#map-longitude').fill('005 19.0 E');
  await page.locator('#map-add').click();
  await page.waitForFunction(() => window.skerry.chart().items.length === 1);
  const kept = () => page.evaluate(() => JSON.parse(localStorage.getItem('skerry.maps')));
  const before = await kept();
  await page.evaluate((all) => { localStorage.setItem('skerry.maps', JSON.stringify({ ...all, maps: { ...all.maps, Broken: '{"type": "Feat' } })); }, before);
  await page.reload();
  await page.waitForFunction(() => window.skerry?.chart().items.length === 1);
  await page.evaluate(() => window.skerry.showTab('chart'));
  await openMap();
  await page.locator('#map-name').selectOption('Broken');
  await page.locator('.notice', { hasText: 'Broken' }).waitFor();
  const { current } = before;
  assert.equal(await page.locator('#map-name').inputValue(), current, 'what was open stays open');
  assert.deepEqual([(await kept()).maps.Broken, (await kept()).maps[current]], ['{"type": "Feat', before.maps[current]]);
  // Open last, and damaged since.
  await page.evaluate((name) => { const all = JSON.parse(localStorage.getItem('skerry.maps')); localStorage.setItem('skerry.maps', JSON.stringify({ ...all, current: name })); }, 'Broken');
  await page.reload();
  await page.locator('.notice', { hasText: 'Broken' }).waitFor();
  await page.waitForFunction(() => window.skerry.chart().place !== null);
  await page.keyboard.press('x');
  await page.waitForFunction(() => window.skerry.chart().items.length === 1);
  assert.equal((await kept()).maps.Broken, '{"type": "Feat');
});

test('a man overboard is marked by one key, stays in sight, and is cancelled by two presses', async () => {
  const url = await open({ ownShipMore: { utcNs: 1.79577e18 } });
  await waitForScan(page);
  assert.equal(await page.locator('#mob').isVisible(), false);
  await page.keyboard.press('o');
  assert.equal(await page.locator('#mob').isVisible(), true);
  const { mob } = await chart();
  assert.ok(inverse(mob, OWN).rangeM < 1);
  server.at = direct(OWN, 30, 1000);
  await page.waitForFunction(() => document.getElementById('mob-range').textContent === '0.540 NM');
  assert.equal(await page.locator('#mob-bearing').textContent(), '210.0°');
  assert.match(await page.locator('#mob-since').textContent(), /^0:\d\d$/);
  const at = await pixelFor(210, 1000);
  const picture = await layer('map-lines');
  assert.ok([-9, 9].every((d) => [-1, 0, 1].some((e) => alphaAt(picture, at.x + d + e, at.y) > 0)), 'its ring');
  await page.keyboard.press('o');
  assert.deepEqual((await chart()).mob, mob, 'a second press moves nothing');
  // Far out of the picture it is pointed at.
  server.at = direct(OWN, 30, 15000);
  await page.waitForFunction(() => document.getElementById('mob-range').textContent === '8.099 NM');
  const edge = await page.evaluate(() => { const { rangeM, radiusPx } = window.skerry.ppi; return window.skerry.pixelFor(210, rangeM * (1 - 12 / radiusPx)); });
  assert.ok(alphaAt(await layer('map-lines'), edge.x, edge.y) > 200, 'an arrow at the edge');
  await page.goto(url);
  await page.waitForFunction(() => window.skerry && !document.getElementById('mob').hidden);
  await page.evaluate(() => window.skerry.showTab('chart'));
  assert.deepEqual((await chart()).mob, mob, 'a page that is loaded again still has him');
  await page.locator('#mob-cancel').click();
  assert.equal(await page.locator('#mob-cancel').textContent(), 'Press again to cancel');
  assert.equal(await page.locator('#mob').isVisible(), true);
  await page.locator('#mob-cancel').click();
  assert.equal(await page.locator('#mob').isVisible(), false);
  assert.equal(inked(await layer('map-lines')), 0);
  await page.locator('#mob-mark').click();
  assert.equal(await page.locator('#mob').isVisible(), true);
});

test('an event is marked with place and time; without a position nothing is', async () => {
  await open({ ownShipMore: { utcNs: 1.79577e18 } });
  await page.waitForFunction(() => window.skerry.chart().place);
  await page.keyboard.press('x');
  const [item] = (await chart()).items;
  assert.equal(item.kind, 'event');
  assert.ok(inverse(item.places[0], OWN).rangeM < 1);
  assert.ok(Math.abs(Date.parse(item.utc) - 1.79577e12) < 20000, item.utc);
  server.untold = true;
  await page.waitForFunction(() => window.skerry.chart().place === null);
  await page.locator('#event-mark').click();
  await page.keyboard.press('o');
  assert.match(await page.locator('#notices').textContent(), /Man overboard was not marked.*event was not marked/s);
  assert.equal((await chart()).items.length, 1);
  assert.equal((await chart()).mob, null);
});
