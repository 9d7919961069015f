// The conning page in Chromium on the real server: two own ships of a class, one without.
// SKERRYD and SKERRY name the two programs.
import assert from 'node:assert/strict';
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, afterEach, before, test } from 'node:test';
import { launch, openConsole, state } from './browser.mjs';
import { skerry, start, startSkerryd } from './displays/skerryd.mjs';

const SCENARIO = `name: Con
seed: 3
sea: {state: 1, wind_from_deg: 250, wind_kn: 12, current_set_deg: 90, current_kn: 1, depth_m: 35}
own_ships:
  - {name: Tern, position: {lat: 60.36, lon: 4.2}, course_deg: 20, speed_kn: 9, ship_class: coaster,
     route: [{lat: 60.50, lon: 4.3}, {lat: 60.55, lon: 4.5}],
     radars: [{name: X, spokes: 512, cells: 512, bits: 8, rpm: 24, range_nm: 6}, {name: S, spokes: 512, cells: 512, bits: 8, rpm: 24, range_nm: 6}]}
  - {name: Gannet, position: {lat: 60.20, lon: 4.1}, course_deg: 5, speed_kn: 12, ship_class: vlcc,
     radars: [{name: Far, spokes: 512, cells: 512, bits: 8, rpm: 24, range_nm: 12}]}
  - {name: Plain, position: {lat: 60.10, lon: 4.0}, course_deg: 90, speed_kn: 10,
     radars: [{name: Third, spokes: 512, cells: 512, bits: 8, rpm: 24, range_nm: 12}]}
`;
const COASTER = 0, VLCC = 2, PLAIN = 3;
const SIZES = [[1280, 800], [1180, 820], [820, 1180], [390, 844]];

let folder, scenario, browser, server, pages = [];

before(async () => {
  folder = mkdtempSync(join(tmpdir(), 'skerry-con-'));
  scenario = join(folder, 'con.yaml');
  writeFileSync(scenario, SCENARIO);
  browser = await launch();
  server = await startSkerryd(['--scenario', scenario]);
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

const set = (...args) => skerry(['set', '--port', String(server.tcp), ...args]);

async function open(radar = COASTER, options = {}, at = server) {
  const page = await openConsole(browser, `http://127.0.0.1:${at.http}/conning?radar=${radar}`, options);
  pages.push(page);
  await page.waitForFunction(() => document.body.dataset.fresh === 'true');
  return page;
}

// Waits until the condition holds of ConState and OwnShip, and gives both.  It is made here: the page's policy lets
// nobody make code of text in it.
async function until(page, condition, argument) {
  const holds = new Function('con', 'ship', 'value', `return ${condition}`);
  for (let i = 0; i < 1200; ++i) {
    const now = await state(page);
    if (now.ship && holds(now.con, now.ship, argument ?? null)) return now;
    await page.waitForTimeout(25);
  }
  throw new Error(`never: ${condition}`);
}

const text = (page, id) => page.locator(`#${id}`).textContent();
const box = (page, selector) => page.locator(selector).boundingBox();

// Where a lever's handle stands for a value.
async function placeOn(page, selector, part, vertical = false) {
  const { x, y, width, height } = await box(page, `${selector} .lever`);
  const handle = await box(page, `${selector} .handle`);
  const pad = (vertical ? handle.height : handle.width) / 2;
  return vertical ? { x: x + width / 2, y: y + height - pad - part * (height - 2 * pad) } : { x: x + pad + part * (width - 2 * pad), y: y + height * 0.6 };
}

async function steady(page) {
  await page.locator('[data-rudder=midships]').click();
  await until(page, 'con.steering === 0 && con.rudderOrderDeg === 0');
}

test('the page is served by its name, with or without a slash, and keeps its question', async () => {
  for (const [target, path] of [['/conning', '/conning'], ['/conning.html', '/conning.html'], ['/conning/', '/conning']]) {
    const page = await openConsole(browser, `http://127.0.0.1:${server.http}${target}?radar=${VLCC}`);
    pages.push(page);
    await page.waitForFunction(() => window.skerry.state().fresh);
    assert.equal(new URL(page.url()).pathname, path);
    assert.equal(await page.locator('#radar option:checked').textContent(), 'Gannet');
    assert.deepEqual(page.problems, []);
  }
});

test('radar and con lead to each other, and keep the ship', async () => {
  const page = await open(VLCC);
  await page.locator('#radar-page').click();
  await page.waitForFunction(() => window.skerry?.settings?.());
  assert.equal((await state(page)).radar, VLCC);
  await page.locator('#con-page').click();
  await page.waitForFunction(() => window.skerry?.state().fresh);
  assert.equal((await state(page)).ship.name, 'Gannet');
  assert.deepEqual(await page.locator('#radar option').allTextContents(), ['Tern', 'Gannet', 'Plain']);
  await page.locator('#radar').selectOption({ label: 'Tern' });
  await until(page, 'ship.name === "Tern"');
  assert.match(page.url(), /radar=0$/);
  assert.deepEqual(page.problems, []);
});

test('own ship comes five times a second, and nothing that costs', async (t) => {
  const page = await open(COASTER);
  const before = await state(page);
  await page.evaluate(() => { window.seen = new Set(); setInterval(() => window.seen.add(window.skerry.state().ship?.utcNs), 20); });
  await page.waitForTimeout(4000);
  const seen = await page.evaluate(() => window.seen.size), bytes = (await state(page)).bytes - before.bytes;
  t.diagnostic(`${seen} in 4 s, ${bytes} bytes`);
  assert.ok(seen >= 15 && seen <= 24, `${seen} own ships in 4 s`);
  assert.ok(bytes < 4 * 6000, `${bytes} bytes in 4 s`);
  const status = await (await fetch(`http://127.0.0.1:${server.http}/status`)).json();
  const client = status.clients.find((c) => c.transport === 'websocket');
  assert.equal(Number(client.spokes_sent), 0);
  assert.equal((await state(page)).garbage, 0);
});

test('by mouse: wheel, telegraph and lever, and the ship follows', async () => {
  const page = await open(COASTER);
  await steady(page);
  const heading = (await state(page)).ship.headingDeg;
  const at = await placeOn(page, '#wheel', (20 + 35) / 70), middle = await placeOn(page, '#wheel', 0.5);
  await page.mouse.move(middle.x, middle.y);
  await page.mouse.down();
  await page.mouse.move(at.x, at.y, { steps: 5 });
  await page.mouse.up();
  await until(page, 'Math.abs(con.rudderOrderDeg - 20) <= 1');
  await until(page, 'Math.abs(con.rudderDeg - con.rudderOrderDeg) < 0.1');
  assert.match(await page.locator('#rudder-gauge .value').first().textContent(), /^(19|20|21)\.0 S$/);
  const turned = await until(page, '((ship.headingDeg - value + 540) % 360) - 180 > 3', heading);
  assert.ok(turned.ship.rateOfTurnDegMin > 0, 'to starboard');
  assert.match(await text(page, 'turn'), /S$/);
  for (const [selector, deg] of [['hard-port', -35], ['midships', 0]]) {
    await page.locator(`[data-rudder=${selector}]`).click();
    await until(page, 'con.rudderOrderDeg === value', deg);
  }
  for (const [step, deg] of [[-5, -5], [-1, -6], [1, -5], [5, 0]]) {
    await page.locator(`[data-rudder-step="${step}"]`).click();
    await until(page, 'con.rudderOrderDeg === value', deg);
  }

  await page.locator('[data-percent="25"]').click();
  await until(page, 'con.enginePercent === 25 && !con.keepsSpeed');
  const { con: { shaftRpm } } = await state(page);
  await until(page, 'con.shaftRpm < value - 10', shaftRpm);  // a heavy shaft
  assert.equal(await page.locator('[data-percent="25"]').getAttribute('aria-pressed'), 'true');
  const told = await page.evaluate(() => [document.getElementById('shaft').textContent, window.skerry.state().con.shaftRpm]);
  assert.ok(Math.abs(Number(told[0]) - told[1]) <= 3, String(told));
  const astern = await placeOn(page, '#engine-lever', 0.3, true);
  await page.mouse.click(astern.x, astern.y);
  await until(page, 'Math.abs(con.enginePercent + 40) <= 1');
  assert.match(await text(page, 'engine-order'), /^(39|40|41) % astern$/);
  await page.locator('[data-engine-step="5"]').click();
  await until(page, 'Math.abs(con.enginePercent + 35) <= 1');
  await page.locator('[data-percent="75"]').click();
  await until(page, 'con.enginePercent === 75');

  const bow = await placeOn(page, '#bow-thruster', 0.75);
  await page.mouse.click(bow.x, bow.y);
  await until(page, 'con.bowThrusterPercent === 50');
  assert.equal(await text(page, 'bow-value'), '50 % S');
  await page.locator('[data-thruster=bow]').click();
  await until(page, 'con.bowThrusterPercent === 0');
  assert.deepEqual(page.problems, []);
});

test('by keyboard: wheel, engine, modes, and fields that are typed in keep their keys', async () => {
  const page = await open(COASTER);
  await steady(page);
  for (const [key, deg] of [['ArrowRight', 1], ['Shift+ArrowRight', 6], ['ArrowLeft', 5], ['Shift+ArrowLeft', 0], ['ArrowLeft', -1]]) {
    await page.keyboard.press(key);
    await until(page, 'con.rudderOrderDeg === value', deg);
  }
  await page.keyboard.press(' ');
  await until(page, 'con.rudderOrderDeg === 0');
  for (const [key, percent] of [['s', 0], ['ArrowUp', 5], ['PageUp', 25], ['PageUp', 50], ['ArrowDown', 45], ['PageDown', 25]]) {
    await page.keyboard.press(key);
    await until(page, 'con.enginePercent === value', percent);
  }
  await page.keyboard.press('a');
  const kept = await until(page, 'con.steering === 1');
  await page.keyboard.press('.');
  await until(page, 'Math.abs(((con.headingOrderDeg - value + 540) % 360) - 180 - 1) < 1e-6', kept.con.headingOrderDeg);
  await page.keyboard.press('<');
  await until(page, 'Math.abs(((con.headingOrderDeg - value + 540) % 360) - 180 + 9) < 1e-6', kept.con.headingOrderDeg);
  await page.keyboard.press('h');
  await until(page, 'con.steering === 0');

  // Levers, reached by Tab, have keys of their own; a button so reached is pressed by Space.
  await page.locator('#engine-lever .lever').focus();
  await page.keyboard.press('ArrowUp');
  await until(page, 'con.enginePercent === 26');
  await steady(page);
  await page.locator('#wheel .lever').focus();
  await page.keyboard.press('PageUp');
  await until(page, 'con.rudderOrderDeg === 5');
  await page.locator('[data-rudder=hard-port]').focus();
  await page.keyboard.press('Tab');
  await page.keyboard.press('Tab');
  await page.keyboard.press(' ');  // 1 deg to port
  await until(page, 'con.rudderOrderDeg === 4');
  // In a field the arrows and letters are the field's.
  await page.locator('#heading-entry').focus();
  await page.keyboard.type('12s');
  await page.keyboard.press('ArrowLeft');
  await page.waitForTimeout(500);
  assert.equal((await state(page)).con.enginePercent, 26);
  await page.keyboard.press('Enter');
  await until(page, 'con.steering === 1 && con.headingOrderDeg === 12');
  assert.ok(await page.locator('#heading-entry').evaluate((field) => field.value === '' && !field.matches(':user-invalid')), 'the field is empty, and not marked as wrong');
  await page.keyboard.press('?');
  assert.equal(await page.locator('#help').isVisible(), true);
  await page.keyboard.press('Escape');
  assert.deepEqual(page.problems, []);
});

test('by touch: taps and drags are orders, a swipe that scrolls is none', async () => {
  const page = await open(COASTER, { viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true });
  const finger = await page.context().newCDPSession(page);
  const touch = (type, at) => finger.send('Input.dispatchTouchEvent', { type, touchPoints: at ? [at] : [] });
  await page.locator('[data-rudder=midships]').scrollIntoViewIfNeeded();
  await page.locator('[data-rudder=midships]').tap();
  await until(page, 'con.steering === 0 && con.rudderOrderDeg === 0');
  const tap = await placeOn(page, '#wheel', (35 - 14) / 70);
  await page.touchscreen.tap(tap.x, tap.y);
  const order = (await until(page, 'Math.abs(con.rudderOrderDeg + 14) <= 1')).con.rudderOrderDeg;
  await until(page, 'con.rudderDeg < -10');
  // Across the wheel: the page scrolls, the rudder stays.
  const before = await page.evaluate(() => scrollY);
  await touch('touchStart', { x: tap.x + 80, y: tap.y });
  for (let i = 1; i <= 8; ++i) await touch('touchMove', { x: tap.x + 80, y: tap.y - 20 * i });
  await touch('touchEnd');
  await page.waitForTimeout(600);
  assert.notEqual(await page.evaluate(() => scrollY), before, 'it scrolls');
  assert.equal((await state(page)).con.rudderOrderDeg, order);
  // Along the engine lever: an order, and the page stays.
  await page.locator('#engine-lever').scrollIntoViewIfNeeded();
  const from = await placeOn(page, '#engine-lever', 0.5, true), to = await placeOn(page, '#engine-lever', 0.7, true);
  const at = await page.evaluate(() => scrollY);
  await touch('touchStart', from);
  for (let i = 1; i <= 8; ++i) await touch('touchMove', { x: from.x, y: from.y + ((to.y - from.y) * i) / 8 });
  await touch('touchEnd');
  await until(page, 'Math.abs(con.enginePercent - 40) <= 1');
  assert.equal(await page.evaluate(() => scrollY), at, 'the page does not jump');
  await page.locator('[data-percent="75"]').tap();
  await until(page, 'con.enginePercent === 75');
  assert.deepEqual(page.problems, []);
});

test('the autopilot: heading, speed, rate of turn, track', async () => {
  const page = await open(COASTER);
  await steady(page);
  assert.equal(await text(page, 'heading-order'), '–');
  assert.equal(await page.locator('[data-heading-step="10"]').isDisabled(), true);
  await page.locator('#heading-entry').fill('200');
  await page.locator('#heading-form button').click();
  await until(page, 'con.steering === 1 && con.headingOrderDeg === 200');
  for (const step of [10, 10, 1, -1, -10]) await page.locator(`[data-heading-step="${step}"]`).click();
  await until(page, 'Math.abs(con.headingOrderDeg - 210) < 1e-6');
  await page.waitForFunction(() => document.getElementById('heading-order').textContent === '210.0');
  await page.locator('#speed-entry').fill('7.5');
  await page.locator('#speed-entry').press('Enter');
  await until(page, 'con.keepsSpeed && Math.abs(ship.orderedSpeedKn - 7.5) < 1e-6');
  await page.waitForFunction(() => document.getElementById('engine-mode').textContent === 'keeps 7.5 kn');
  await page.locator('#rate-entry').fill('40');
  await page.locator('#rate-entry').press('Enter');
  await until(page, 'con.turnRateDegMin === 40');
  await page.locator('#rate-entry').fill('9999');
  await page.locator('#rate-entry').press('Enter');
  await page.waitForTimeout(300);
  assert.equal((await state(page)).con.turnRateDegMin, 40, 'out of range');
  await page.locator('[data-steering="2"]').click();
  await until(page, 'con.steering === 2 && con.waypoint === 1');
  assert.equal(await text(page, 'waypoint'), '1 of 2');
  assert.match(await text(page, 'waypoint-distance'), /NM$/);
  assert.match(await text(page, 'cross-track'), / m( [PS])?$/);
  await page.locator('[data-steering="0"]').click();
  await until(page, 'con.steering === 0');
  const vlcc = await open(VLCC);
  assert.equal(await vlcc.locator('[data-steering="2"]').isDisabled(), true, 'she has no route');
  assert.equal(await vlcc.locator('#thrusters').isVisible(), false);
  assert.equal(await page.locator('#bow-thruster').isVisible(), true);
  assert.equal(await page.locator('#stern-thruster').isVisible(), false);
});

test('one has the con, the other is told who; it is given away, taken, overruled, and free when its page is closed', async () => {
  const one = await open(COASTER), two = await open(1);  // another radar of the same ship
  await one.waitForFunction(() => window.skerry.state().holder === 'free');
  assert.equal(await text(one, 'holder-text'), 'Nobody has the con');
  await one.locator('#take').click();
  await one.waitForFunction(() => window.skerry.state().holder === 'ours');
  assert.equal(await text(one, 'holder-text'), 'You have the con');
  await two.waitForFunction(() => window.skerry.state().holder === 'theirs');
  const { you } = await state(one);
  assert.match(you, /^console 127\.0\.0\.1:\d+$/);
  assert.equal(await text(two, 'holder-text'), you);
  assert.equal(await two.locator('[data-rudder=hard-port]').isDisabled(), true);
  assert.equal(await two.locator('#heading-entry').isDisabled(), true);
  const before = (await state(two)).con.rudderOrderDeg;
  await two.keyboard.press('ArrowLeft');
  const middle = await placeOn(two, '#wheel', 0.1);
  await two.mouse.click(middle.x, middle.y);
  await two.waitForTimeout(500);
  assert.equal((await state(two)).con.steering === 0 && (await state(two)).con.rudderOrderDeg !== before, false);
  await two.locator('#take').click();
  await two.locator('.notice', { hasText: `${you} has the con of Tern; ask for it to be given away, or take it as instructor` }).waitFor();

  await one.keyboard.press('c');
  await two.waitForFunction(() => window.skerry.state().holder === 'free');
  await two.locator('#take').click();
  await one.waitForFunction(() => window.skerry.state().holder === 'theirs');
  await two.locator('[data-rudder="hard-starboard"]').click();
  await until(two, 'con.rudderOrderDeg === 35');
  // The instructor's orders are obeyed all the same.
  await one.locator('.switch').click();
  await one.waitForFunction(() => window.skerry.state().hindered === '');
  await one.locator('[data-rudder=midships]').click();
  await until(one, 'con.rudderOrderDeg === 0');
  await one.locator('#take').click();
  await one.waitForFunction(() => window.skerry.state().holder === 'ours');
  await one.close();
  await two.waitForFunction(() => window.skerry.state().holder === 'free', null, { timeout: 15000 });
  assert.deepEqual(two.problems, []);
});

test('the visibility is told by eye, and clear weather is clear', async () => {
  for (const radar of [COASTER, PLAIN]) {
    const page = await open(radar);
    await page.waitForFunction(() => document.getElementById('visibility').textContent === 'clear');
    await set('--instructor', '--visibility', '0.5');
    await page.waitForFunction(() => document.getElementById('visibility').textContent === '0.5 NM');
    await set('--instructor', '--visibility', '30');
    await page.waitForFunction(() => document.getElementById('visibility').textContent === 'clear');
    await assert.rejects(set('--instructor', '--visibility', '0.01'), /0.02 to 30 NM/);
    assert.deepEqual(page.problems, []);
  }
});

test('what the instructor has locked is disabled and marked', async () => {
  const page = await open(COASTER);
  await steady(page);
  await set('--instructor', '--lock', 'course_deg');
  try {
    await page.locator('#helm fieldset.locked').waitFor();
    assert.equal(await page.locator('[data-rudder=hard-port]').isDisabled(), true);
    assert.equal(await page.locator('[data-percent="100"]').isDisabled(), false);
    await page.keyboard.press('ArrowLeft');
    await page.locator('.notice', { hasText: 'Locked by the instructor' }).waitFor();
    await assert.rejects(set('--rudder', '10'), /locked by the instructor/);
  } finally {
    await set('--instructor', '--unlock', 'course_deg');
  }
  await page.waitForFunction(() => !document.querySelector('#helm fieldset').disabled);
});

test('a ship without a class says so, and takes course and speed', async () => {
  const page = await open(PLAIN);
  assert.match(await text(page, 'classless'), /has no class/);
  for (const id of ['engine', 'helm', 'autopilot', 'wind', 'thrusters']) assert.equal(await page.locator(`#${id}`).isVisible(), false, id);
  assert.equal(await page.locator('#take').isDisabled(), true);
  await page.locator('#course-entry').fill('123.5');
  await page.locator('#course-entry').press('Enter');
  await until(page, 'ship.orderedCourseDeg === 123.5');
  await page.locator('#plain-speed-entry').fill('4');
  await page.locator('#plain-speed-form button').click();
  await until(page, 'Math.abs(ship.orderedSpeedKn - 4) < 1e-9');
  await page.waitForFunction(() => document.getElementById('ordered-course').textContent === '123.5');
  for (const key of ['ArrowLeft', ' ', 's', 'PageUp', '.']) await page.keyboard.press(key);
  await page.waitForTimeout(300);
  assert.equal(await page.locator('.notice').count(), 0);
  assert.deepEqual(page.problems, []);
});

test('at every size nothing is cut off, nothing scrolls sideways, targets are large and stay where they are', async (t) => {
  for (const [width, height] of SIZES) {
    for (const radar of [COASTER, VLCC, PLAIN]) {
      const name = `${width}x${height}, radar ${radar}`;
      const page = await open(radar, { viewport: { width, height }, hasTouch: true });
      const look = () => page.evaluate(() => {
        const seen = [...document.querySelectorAll('button, .button, select, .lever, .panel input, .switch span, .panel h2, .panel dt, svg')].filter((e) => e.checkVisibility());
        return {
          wide: document.documentElement.scrollWidth - innerWidth, tall: document.documentElement.scrollHeight - innerHeight,
          boxes: seen.map((e) => { const b = e.getBoundingClientRect(); return [e.id || e.textContent || e.tagName, Math.round(b.x), Math.round(b.y + (e.closest('#bar') ? 0 : scrollY)), Math.round(b.width), Math.round(b.height)]; }),
          small: seen.filter((e) => !e.matches('h2, dt, svg, #telegraph button') && Math.min(e.offsetWidth, e.offsetHeight) < 44).map((e) => `${e.id || e.textContent} ${e.offsetWidth}x${e.offsetHeight}`),
          low: [...document.querySelectorAll('#telegraph button')].filter((e) => e.checkVisibility() && e.offsetHeight < 44).length,
          cut: [...document.querySelectorAll('.panel, .panel dl > div, .panel h2, .panel p, .panel button, .rows')].filter((e) => e.checkVisibility() && (e.scrollWidth > e.clientWidth + 1 || (e.matches('.panel') && e.scrollHeight > e.clientHeight + 1)))
            .map((e) => `${e.id || e.textContent.trim().slice(0, 40)}: ${e.scrollWidth} in ${e.clientWidth}, ${e.scrollHeight} in ${e.clientHeight}`),
        };
      });
      const first = await look();
      assert.ok(first.wide <= 0, `${name}: scrolls sideways by ${first.wide}`);
      if (width > 400) assert.ok(first.tall <= 0, `${name}: scrolls by ${first.tall}`);
      assert.deepEqual(first.small, [], name);
      assert.equal(first.low, 0, name);
      assert.deepEqual(first.cut, [], name);
      if (radar !== PLAIN) {
        await page.locator('[data-rudder=hard-starboard]').click();
        await page.locator('[data-percent="-100"]').click();
        await until(page, 'Math.abs(ship.rateOfTurnDegMin) > 4 || con.rudderDeg > 20');
        await page.locator('#take').click();
        await page.waitForFunction(() => window.skerry.state().holder === 'ours');
        await page.waitForTimeout(1000);
        await page.locator('#take').click();
        await page.waitForFunction(() => window.skerry.state().holder === 'free');
        assert.deepEqual((await look()).cut, [], `${name}, turning`);
        assert.deepEqual((await look()).boxes.map((b) => b.slice(1)), first.boxes.map((b) => b.slice(1)), `${name}: something has moved`);
        await page.locator('[data-percent="75"]').click();
        await steady(page);
      }
      assert.deepEqual(page.problems, []);
      t.diagnostic(name);
      await page.context().close();
      pages = pages.filter((p) => p !== page);
    }
  }
});

test('the palettes are those of the console, and are kept', async () => {
  const page = await open(COASTER);
  const palette = () => page.evaluate(() => document.documentElement.dataset.palette);
  const shown = [await palette()];
  for (let i = 0; i < 3; ++i) { await page.keyboard.press('p'); shown.push(await palette()); }
  assert.deepEqual(shown, ['day', 'dusk', 'night', 'day']);
  await page.locator('#palette').click();
  await page.goto(`http://127.0.0.1:${server.http}/`);
  await page.waitForFunction(() => window.skerry !== undefined);
  assert.equal(await palette(), 'dusk');
});

test('a server that is gone leaves no number that could be taken for true, and comes back', async () => {
  let own = await startSkerryd(['--scenario', scenario]);
  try {
    const page = await open(COASTER, {}, own);
    await page.locator('#take').click();
    await page.waitForFunction(() => window.skerry.state().holder === 'ours');
    const { http, tcp } = own;
    await own.child.end();
    await page.locator('#alarm', { hasText: 'Connection lost' }).waitFor();
    await page.waitForTimeout(400);
    const numbers = await page.evaluate(() => [...document.querySelectorAll('.panel output, #utc')].filter((e) => /\d/.test(e.textContent)).map((e) => `${e.id} ${e.textContent}`));
    assert.deepEqual(numbers, []);
    const hidden = await page.evaluate(() => [...document.querySelectorAll('.turns, .lever .handle, .needle-line, .order-mark, #turn-gauge .needle')].filter((e) => getComputedStyle(e).visibility !== 'hidden').map((e) => e.outerHTML.slice(0, 60)));
    assert.deepEqual(hidden, []);
    assert.equal(await page.locator('#compass .heading').textContent(), '–');
    assert.equal(await page.locator('[data-rudder=hard-port]').isDisabled(), true);
    await page.keyboard.press('ArrowLeft');
    await page.locator('.notice', { hasText: 'No orders' }).waitFor();
    assert.notEqual(await page.locator('#link-text').textContent(), 'Connected');

    own = await start(process.env.SKERRYD, ['--scenario', scenario, '--http-port', String(http), '--tcp-port', String(tcp), '--no-udp', '--no-cat240',
      '--print-ports'], (said) => /tcp \d+ http \d+/.test(said) && {});
    await page.waitForFunction(() => window.skerry.state().fresh && window.skerry.state().holder === 'free', null, { timeout: 30000 });
    assert.equal(await page.locator('#alarm').isVisible(), false);
    assert.match(await page.locator('#compass .heading').textContent(), /^\d{3}\.\d$/);
  } finally {
    await own.child.end();
  }
});
