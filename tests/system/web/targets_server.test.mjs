// Targets of the real server in the console, against the truth of the exercise.
// SKERRYD and SKERRY name the two programs.
import assert from 'node:assert/strict';
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { launch, openConsole, waitForScan } from './browser.mjs';
import { skerry, startSkerryd } from './displays/skerryd.mjs';
import { angleBetween } from './measure.mjs';
import { NM } from './mock_scene.mjs';
import { WEB } from './mock_server.mjs';
import { placeOnPage, targetState } from './targets_kit.mjs';

// Three ships of known motion in the open North Sea, and one that lies.
const SCENARIO = `
name: Known motions
seed: 5
sea: {state: 1, wind_from_deg: 250, wind_kn: 5, depth_m: 60}
own_ships:
  - name: Sirius
    ship_class: coaster
    position: {lat: 56.3000, lon: 4.2000}
    course_deg: 0
    speed_kn: 12
    radars: [{name: Sirius X, range_nm: 6}]
targets:
  - {name: Adhara, ship_class: container, position: {lat: 56.3600, lon: 4.2900}, course_deg: 270, speed_kn: 14, gives_way: never}
  - {name: Bellatrix, ship_class: product_tanker, position: {lat: 56.3300, lon: 4.1200}, course_deg: 20, speed_kn: 9, gives_way: never}
  - {name: Capella, ship_class: coaster, position: {lat: 56.3550, lon: 4.2080}, course_deg: 5, speed_kn: 6, gives_way: never}
`;
const NAMES = ['Adhara', 'Bellatrix', 'Capella'];
// Three minutes of tracking, and room for a busy machine.
const TRACKED_MS = 300000;

let folder, browser, server, page;
before(async () => {
  folder = mkdtempSync(join(tmpdir(), 'skerry-targets-'));
  const file = join(folder, 'known.yaml');
  writeFileSync(file, SCENARIO);
  server = await startSkerryd(['--scenario', file, '--web-root', WEB]);
  browser = await launch();
});
after(async () => {
  await browser?.close();
  await server?.child.end();
  if (folder) rmSync(folder, { recursive: true });
});

// The ships as the exercise has them, with range and bearing from own ship: on a plane, good to 0.01 NM here.
async function truth() {
  const { ships } = JSON.parse(await skerry(['exercise', 'show', '--port', String(server.tcp), '--json']));
  const own = ships.find((ship) => ship.own);
  return NAMES.map((name) => {
    const ship = ships.find((each) => each.name === name);
    const north = (ship.latitude_deg - own.latitude_deg) * 60.13;
    const east = (ship.longitude_deg - own.longitude_deg) * 60.13 * Math.cos((own.latitude_deg * Math.PI) / 180);
    return { name, rangeNm: Math.hypot(north, east), bearingDeg: (Math.atan2(east, north) * 180 / Math.PI + 360) % 360,
             courseDeg: ship.course_over_ground_deg, speedKn: ship.speed_kn };
  });
}

test('ships are acquired by presses on their echoes, and their data are those of the exercise', { timeout: TRACKED_MS + 120000 }, async (t) => {
  page = await openConsole(browser, `http://127.0.0.1:${server.http}/`);
  await page.evaluate(() => window.skerry.showTab('targets'));
  await page.waitForFunction(() => window.skerry.targets().list !== null, null, { timeout: 60000 });
  await page.locator('#targets-rules summary').click();
  await page.locator('#rule-acquire').selectOption('0');
  await page.waitForFunction(() => window.skerry.targets().list.rules.acquire === 0);
  // The radar's numbers, not those of AIS.
  await page.locator('#target-ais + span').click();
  await waitForScan(page);
  for (const name of NAMES) {
    const before = (await targetState(page)).list.targets.length;
    // An echo must have been seen in two turns.
    for (let tries = 0; tries < 12; ++tries) {
      if ((await page.locator('#acquire').getAttribute('aria-pressed')) !== 'true') await page.locator('#acquire').click();
      const ship = (await truth()).find((each) => each.name === name);
      const at = await placeOnPage(page, await page.evaluate(([deg, m]) => window.skerry.pixelFor(deg, m), [ship.bearingDeg, ship.rangeNm * NM]));
      const { scan } = await page.evaluate(() => window.skerry.state());
      await page.mouse.click(at.x, at.y);
      await page.waitForFunction(([n, s]) => window.skerry.targets().list.targets.length > n || window.skerry.state().scan > s + 1, [before, scan], { timeout: 30000 });
      if ((await targetState(page)).list.targets.length > before) break;
    }
    assert.equal((await targetState(page)).list.targets.length, before + 1, `${name} was not acquired`);
  }
  assert.ok((await targetState(page)).list.targets.every((target) => target.byHand));

  await page.waitForFunction((n) => window.skerry.targets().list.targets.filter(({ state }) => state === 2).length === n, NAMES.length, { timeout: TRACKED_MS });
  const worst = { nm: 0, deg: 0, courseDeg: 0, kn: 0 };
  const symbols = (await targetState(page)).shown;
  for (const key of symbols.map((shown) => shown.key)) await page.locator(`#list-${key}`).click();
  const cells = (label) => page.locator('#target-data tbody tr', { has: page.locator('th', { hasText: new RegExp(`^${label}`) }) }).locator('td').allTextContents();
  const ships = await truth();
  const [ranges, bearings, courses, speeds, states, sources] = await Promise.all(['Range', 'Bearing', 'Course', 'Speed', 'State', 'Source'].map(cells));
  assert.ok(sources.every((source) => source.startsWith('Radar')), sources.join());
  assert.deepEqual(states, NAMES.map(() => 'TRACKED'));
  for (const ship of ships) {
    // Ships are miles apart: the nearest is she.
    const off = ranges.map((range, i) => Math.hypot(Number(range) - ship.rangeNm, (angleBetween(Number(bearings[i]), ship.bearingDeg) * Math.PI / 180) * ship.rangeNm));
    const i = off.indexOf(Math.min(...off));
    worst.nm = Math.max(worst.nm, off[i]);
    worst.deg = Math.max(worst.deg, angleBetween(Number(bearings[i]), ship.bearingDeg));
    worst.courseDeg = Math.max(worst.courseDeg, angleBetween(Number(courses[i]), ship.courseDeg));
    worst.kn = Math.max(worst.kn, Math.abs(Number(speeds[i]) - ship.speedKn));
  }
  t.diagnostic(`worst: ${JSON.stringify(worst, (_, v) => (typeof v === 'number' ? Number(v.toFixed(3)) : v))}`);
  assert.ok(worst.nm <= 0.1, 'place');
  assert.ok(worst.deg <= 2, 'bearing');
  assert.ok(worst.courseDeg <= 5, 'course');
  assert.ok(worst.kn <= 1, 'speed');

  // A number at the symbol of each; and what is cancelled goes.
  await page.locator('#cancel-all').click();
  await page.locator('#cancel-all-question-yes').click();
  await page.waitForFunction(() => window.skerry.targets().list.targets.length === 0, null, { timeout: 20000 });
  assert.deepEqual(page.problems, []);
});
