// The instructor's page in Chromium on the real server.  SKERRYD and SKERRY name the two programs.
import assert from 'node:assert/strict';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, afterEach, before, test } from 'node:test';
import { launch, openConsole, state, waitForScan } from './browser.mjs';
import { start, startSkerryd } from './displays/skerryd.mjs';

const SCENARIO = `name: Lesson
seed: 3
sea: {state: 0, wind_from_deg: 250, wind_kn: 12, current_set_deg: 90, current_kn: 1, depth_m: 35}
rain: [{position: {lat: 60.5, lon: 4.2}, radius_nm: 2, rate_mm_h: 8}]
own_ships:
  - {name: Tern, position: {lat: 60.36, lon: 4.6}, course_deg: 250, speed_kn: 9, ship_class: coaster,
     radars: [{name: X, spokes: 512, cells: 512, bits: 8, rpm: 24, range_nm: 6}]}
  - {name: Plain, position: {lat: 60.30, lon: 4.5}, course_deg: 90, speed_kn: 10,
     radars: [{name: Second, spokes: 512, cells: 512, bits: 8, rpm: 24, range_nm: 12}]}
targets:
  - {name: Lyngen, position: {lat: 60.39, lon: 4.62}, course_deg: 180, speed_kn: 0, length_m: 150, beam_m: 20}
`;

let folder,
  browser,
  server,
  pages = [];
before(async () => {
  folder = mkdtempSync(join(tmpdir(), 'skerry-lesson-'));
  writeFileSync(join(folder, 'lesson.yaml'), SCENARIO);
  browser = await launch();
  server = await startSkerryd(['--scenario', join(folder, 'lesson.yaml')]);
});
afterEach(async () => {
  for (const page of pages) await page.context().close();
  pages = [];
});
after(async () => {
  await browser?.close();
  await server?.child.end();
  if (folder) rmSync(folder, { recursive: true });
});

async function open(path = 'instructor', options = {}) {
  const page = await openConsole(browser, `http://127.0.0.1:${server.http}/${path}`, options);
  pages.push(page);
  if (path === 'instructor') await until(page, 's.exercise && s.coast.radiusNm > 0');
  return page;
}

// Waits until the condition holds of the page's state.
async function until(page, condition, argument) {
  const holds = new Function('s', 'value', `return ${condition}`);
  for (let i = 0; !holds(await state(page), argument); ++i) {
    if (i > 600) throw new Error(`never: ${condition}`);
    await page.waitForTimeout(25);
  }
}
const choose = async (page, name) => {
  await page.locator('#ship-list button', { hasText: name }).click();
  await page.waitForFunction((n) => document.getElementById('ship-name').textContent === n, name);
};
const ship = (name) => `s.exercise.ships.find((x) => x.name === '${name}')`;

test('the page is served by its name, with the exercise and the shore', async () => {
  for (const path of ['instructor', 'instructor.html', 'instructor/']) {
    const page = await openConsole(browser, `http://127.0.0.1:${server.http}/${path}`);
    pages.push(page);
    await until(page, 's.exercise && s.coast.points > 50');
    const { exercise, garbage } = await state(page);
    assert.deepEqual(
      exercise.ships.map(({ name }) => name),
      ['Tern', 'Plain', 'Lyngen'],
    );
    assert.equal(garbage, 0);
    assert.deepEqual(page.problems, []);
  }
});

test('freeze, pace, marks and weather reach the server, and every instructor sees who ordered what', async () => {
  const page = await open(),
    other = await open();
  await page.locator('#freeze').click();
  await until(other, 's.exercise.frozen');
  const { exercise } = await state(other);
  await other.waitForTimeout(1200);
  assert.equal((await state(other)).exercise.exerciseS, exercise.exerciseS);
  await page.locator('#freeze').click();
  await until(other, '!s.exercise.frozen && s.exercise.exerciseS > value', exercise.exerciseS);
  await page.locator('#to-exercise').click();
  await page.locator('[data-rate="5"]').click();
  await until(other, 's.exercise.rate === 5');
  await page.locator('[data-rate="1"]').click();
  await until(other, 's.exercise.rate === 1');
  await page.locator('#mark-text').fill('Pilot aboard');
  await page.locator('#mark-form button').click();
  await until(other, 's.exercise.marks.some(({ text }) => text === "Pilot aboard")');
  await page.locator('#to-weather').click();
  await page.locator('#weather-windKn').fill('31');
  await page.locator('#weather-windKn').press('Enter');
  await until(other, 's.world.windKn > 30.9 && s.world.windKn < 31.1');
  await page.locator('#weather-visibilityNm').fill('0.5');
  await page.locator('#weather-visibilityNm').press('Enter');
  await until(other, 's.world.visibilityNm === 0.5');
  await other.waitForFunction(() => document.getElementById('weather-visibilityNm').value === '0.5');
  await page.locator('#weather-visibilityNm').fill('30');
  await page.locator('#weather-visibilityNm').press('Enter');
  await until(other, 's.world.visibilityNm === undefined');
  await other.waitForFunction(() => document.getElementById('last-order').textContent.length > 5);
  assert.deepEqual([...page.problems, ...other.problems], []);
});

test('an own ship is put elsewhere, and undo takes her back', async () => {
  const page = await open();
  await page.locator('#freeze').click();
  await until(page, 's.exercise.frozen');
  await choose(page, 'Plain');
  const was = (await state(page)).exercise.ships[1];
  await page.locator('#put-latitude').fill('60 20.0 N');
  await page.locator('#put-longitude').fill('4.45');
  await page.locator('#put-form button[type=submit]').click();
  await until(page, `Math.abs(${ship('Plain')}.longitudeDeg - 4.45) < 1e-4 && s.exercise.canUndo !== ''`);
  await page.waitForFunction(() => !document.getElementById('undo').disabled);
  await page.locator('#undo').click();
  await until(page, `Math.abs(${ship('Plain')}.latitudeDeg - value) < 1e-4`, was.latitudeDeg);
  await page.locator('#freeze').click();
  await until(page, '!s.exercise.frozen');
  assert.deepEqual(page.problems, []);
});

test('the log says who did what, as it is done', async () => {
  const page = await open(),
    other = await open();
  await other.keyboard.press('5');
  await page.locator('#to-exercise').click();
  await page.locator('#mark-text').fill('Kept in the log');
  await page.locator('#mark-form button').click();
  const newest = other.locator('#log-list li', { hasText: 'Kept in the log' });
  await newest.waitFor();
  assert.match(await newest.textContent(), /^\d\d:\d\d:\d\dChangeon the server's own host, admin.*from console 127\.0\.0\.1:/);
  await other.locator('#log-kind').selectOption('server');
  await other.waitForFunction(() => document.querySelectorAll('#log-list li').length === 1);
  assert.match(await other.locator('#log-list').textContent(), /begins: scenario Lesson/);
  assert.match(await other.locator('#log-count').textContent(), /memory alone/);
  assert.deepEqual([...page.problems, ...other.problems], []);
});

test("the con shows the instructor's text", async () => {
  const page = await open(),
    con = await open('conning?radar=1');
  await page.locator('#to-exercise').click();
  await page.locator('#text-to').selectOption({ label: 'Plain' });
  await page.locator('#text-text').fill('Reduce to 5 knots');
  await page.locator('#text-form button').click();
  await con.waitForFunction(() => document.getElementById('message-text').textContent === 'Reduce to 5 knots');
  await con.locator('#message-read').click();
  assert.equal(await con.locator('#message').isVisible(), false);
  assert.deepEqual([...page.problems, ...con.problems], []);
});

// Metres north and east from a ship to a place.
const wayTo = (from, lat, lon) => {
  const north = (lat - from.latitudeDeg) * 60 * 1852;
  return { north, east: (lon - from.longitudeDeg) * 60 * 1852 * Math.cos((from.latitudeDeg * Math.PI) / 180) };
};

// The strongest echo that the console shows within 250 m of a place.
async function echoAt(console, ship, lat, lon) {
  const { north, east } = wayTo(ship, lat, lon);
  return console.evaluate(
    ([n, e]) => {
      const { rows, cols, cells, meta } = window.skerry.readPolar();
      const bytes = (text) => Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
      const levels = bytes(cells),
        spokes = new Float32Array(bytes(meta).buffer);
      let strongest = 0;
      for (let row = 0; row < rows; ++row) {
        const bearing = ((row + 0.5) / rows) * 2 * Math.PI,
          cellM = spokes[(row * spokes.length) / rows + 1];
        for (let cell = 0; cell < cols && cellM > 0; ++cell) {
          const range = (cell + 0.5) * cellM;
          const off = Math.hypot(range * Math.cos(bearing) - n, range * Math.sin(bearing) - e);
          if (off < 250) strongest = Math.max(strongest, levels[2 * (row * cols + cell)]);
        }
      }
      return strongest;
    },
    [north, east],
  );
}

test('a target sails the route that an instructor draws, and a console sees her echo there within a turn', async () => {
  const page = await open();
  const there = { lat: 60.405, lon: 4.67 };
  const was = (await state(page)).exercise.ships[2];
  await choose(page, 'Lyngen');
  await page.keyboard.press('r');
  const at = await page.evaluate(([lat, lon]) => window.skerry.pixelOf(lat, lon), [there.lat, there.lon]);
  await page.mouse.click(at.x, at.y);
  await until(page, 's.waypoints.length === 1');
  const { latitudeDeg, longitudeDeg } = (await state(page)).waypoints[0];
  const drawn = { lat: latitudeDeg, lon: longitudeDeg };
  assert.ok(Math.abs(drawn.lat - there.lat) < 0.002 && Math.abs(drawn.lon - there.lon) < 0.004, JSON.stringify(drawn));
  await page.locator('#route-speed').fill('18');
  await page.locator('#route-done').click();
  await until(page, `${ship('Lyngen')}.route.length === 1`);
  await page.locator('#to-exercise').click();
  await page.locator('[data-rate="20"]').click();
  await until(page, `(${ship('Lyngen')}.longitudeDeg - value) * 54800 > 900`, was.longitudeDeg);
  await page.locator('#freeze').click();
  await until(page, 's.exercise.frozen');
  const { exercise } = await state(page);
  const lyngen = exercise.ships[2],
    tern = exercise.ships[0];
  const left = wayTo(lyngen, drawn.lat, drawn.lon);
  const bearing = (Math.atan2(left.east, left.north) * 180) / Math.PI;
  assert.ok(Math.abs(lyngen.headingDeg - bearing) < 20, `heads ${lyngen.headingDeg}, the waypoint bears ${bearing}`);
  const console = await open('?radar=0');
  await waitForScan(console);
  assert.ok((await echoAt(console, tern, lyngen.latitudeDeg, lyngen.longitudeDeg)) > 100);
  assert.ok((await echoAt(console, tern, was.latitudeDeg, was.longitudeDeg)) < 100, 'where she was');
  await page.locator('[data-rate="1"]').click();
  await page.locator('#freeze').click();
  await until(page, '!s.exercise.frozen && s.exercise.rate === 1');
  assert.deepEqual([...page.problems, ...console.problems], []);
});

test('a gyro that fails is seen by the console and not by the instructor', async () => {
  const page = await open(),
    console = await open('?radar=1');
  await choose(page, 'Plain');
  await until(console, 's.headingDeg !== null');
  const told = (s) => s.exercise.ships[1].headingDeg;
  const before = await state(page);
  assert.ok(Math.abs((await state(console)).headingDeg - told(before)) < 1);
  await page.locator('#to-faults').click();
  await page.locator('#fault-gyroBiasDeg').fill('12');
  await page.locator('#fault-gyroBiasDeg').press('Enter');
  await until(console, 'Math.abs(s.headingDeg - value) < 1', told(before) + 12);
  // The instructor sees the error, and the truth.
  await until(page, 'Math.abs(s.exercise.ships[1].gyroErrorDeg - 12) < 0.1');
  assert.ok(Math.abs(told(await state(page)) - told(before)) < 1);
  await page.locator('label:has(#fault-gyroLost)').click();
  await console.waitForFunction(() => document.getElementById('heading').textContent === '–');
  await page.locator('#faults-none').click();
  await until(console, 's.headingDeg !== null && Math.abs(s.headingDeg - value) < 1', told(before));
  assert.deepEqual([...page.problems, ...console.problems], []);
});

test('what is saved loads', async () => {
  const page = await open();
  const [download] = await Promise.all([page.waitForEvent('download'), page.locator('#save').click()]);
  const file = join(folder, 'saved.yaml');
  await download.saveAs(file);
  const said = await new Promise((resolve) => {
    start(process.env.SKERRYD, ['--check', '--scenario', file], () => null).catch((error) => resolve(error.message));
  });
  assert.match(said, /ended with 0/, `${said}\n${readFileSync(file, 'utf8')}`);
});
