// The instructor's page in a real Chromium, on a mock exercise: every control, by mouse, touch and keys.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { after, afterEach, before, test } from 'node:test';
import { launch, openConsole, state } from '../browser.mjs';
import { openInstructor } from '../instructor_kit.mjs';
import { CONTROLS } from '../mock_server.mjs';

let browser, kit;
before(async () => { browser = await launch(); });
after(() => browser?.close());
afterEach(async () => {
  await kit?.page.context().close();
  await kit?.server.stop();
  kit = null;
});

const near = (a, b, by) => assert.ok(Math.abs(a - b) <= by, `${a} is not ${b}`);
const MINUTE = 1 / 60;

test('the exercise is shown: clock, ships, coast; and nothing goes wrong', async () => {
  kit = await openInstructor(browser);
  const { page, server, until } = kit;
  assert.match(await page.locator('#exercise-time').textContent(), /^1:0[1-3]:\d\d$/);
  assert.equal(await page.locator('#ship-list button').count(), 5);
  assert.equal((await state(page)).coast.points, 11);
  const { subscribe } = server.received[0];
  assert.deepEqual([subscribe.exerciseHz, subscribe.noSpokes], [2, true]);
  await page.locator('#ship-filter').fill('tug');
  assert.deepEqual(await page.locator('#ship-list button').allTextContents(), ['Tug ÅseSART']);
  await page.locator('#ship-filter').fill('');
  // A far place has a coast of its own; a small move has not.
  const asked = server.exercise.coastAsked.length;
  await page.locator('#chart').focus();
  await page.keyboard.press('ArrowRight');
  await page.waitForTimeout(500);
  assert.equal(server.exercise.coastAsked.length, asked);
  for (let i = 0; i < 6; ++i) await page.locator('#zoom-out').click();
  await page.waitForFunction((n) => window.skerry.state().coast.radiusNm > n, server.exercise.coastAsked[0].radiusNm + 1);
  await until("s.garbage === 0");
  assert.deepEqual(page.problems, []);
});

test('ships are selected by click, by the list and in groups; each gets the order', async () => {
  kit = await openInstructor(browser);
  const { page, choose, until, orders, sets, pixel } = kit;
  const at = await pixel('Lyngen');
  await page.mouse.click(at.x + 9, at.y + 9);
  await until("s.selection.join() === 'target-3'");
  assert.equal(await page.locator('#ship-name').textContent(), 'Lyngen');
  await page.mouse.click(at.x + 40, at.y + 60);
  await until('s.selection.length === 0');
  await choose('target-3');
  const ferry = await pixel('Ferry');
  await page.keyboard.down('Shift');
  await page.mouse.click(ferry.x, ferry.y);
  await page.keyboard.up('Shift');
  await until("s.selection.join() === 'target-3,target-0'");
  await page.locator('#group').click();
  await choose('own-0');
  await until('s.selection.length === 3');
  await page.locator('#order-course').fill('135');
  await page.locator('#order-speed').fill('8.5');
  await page.locator('#order-form button').click();
  await until('s.exercise.ships.find((x) => x.name === "Ferry").orderedCourseDeg === 135');
  const targets = orders().map(({ target }) => [target.target, target.courseDeg, target.speedKn]);
  assert.deepEqual(targets, [[3, 135, 8.5], [0, 135, 8.5]]);
  const own = sets().find((set) => !set.exercise);
  assert.deepEqual([own.radar, own.courseDeg, own.speedKn], [0, 135, 8.5]);
  assert.ok(sets().every((set) => set.instructor), 'each Set is an instructor\'s');
  await choose('target-0');
  await until('s.selection.length === 2');
  await page.keyboard.press('Escape');
  await until('s.selection.length === 0');
  assert.deepEqual(page.problems, []);
});

test('what a target can be ordered: resume, remove, giving way, end, SART, AIS, put', async () => {
  kit = await openInstructor(browser);
  const { page, choose, next, until } = kit;
  await choose('target-0');
  assert.equal(await page.locator('#resume').isDisabled(), true);
  await page.locator('#order-course').fill('10');
  const { courseDeg, speedKn } = await next('target', () => page.locator('#order-course').press('Enter'));
  assert.deepEqual([courseDeg, speedKn], [10, undefined]);
  await until('s.exercise.ships[2].onCourse');
  assert.equal((await next('target', () => page.locator('#resume').click())).resume, true);
  assert.equal((await next('target', () => page.locator('#remove').click())).removed, true);
  await page.waitForFunction(() => document.getElementById('remove').textContent === 'Put back');
  assert.equal((await next('target', () => page.locator('#remove').click())).removed, false);
  assert.equal((await next('target', () => page.locator('#gives-way').selectOption({ label: 'Late' }))).givesWay, 2);
  assert.equal((await next('target', () => page.locator('#end-now').selectOption({ label: 'Vanish' }))).routeEnd, 3);
  assert.equal((await next('target', () => page.locator('label:has(#sart)').click())).sart, true);
  assert.equal((await next('target', () => page.locator('label:has(#ais-off)').click())).aisOff, true);
  await until('s.exercise.ships[2].sart && s.exercise.ships[2].aisOff');
  assert.equal((await next('target', () => page.locator('label:has(#sart)').click())).sart, false);
  await page.locator('#ais-heading').fill('15');
  await page.locator('#ais-position').fill('300');
  const ais = await next('target', () => page.locator('#ais-form button').click());
  assert.deepEqual([ais.aisHeadingErrorDeg, ais.aisPositionErrorM], [15, 300]);
  await page.locator('#put-read').click();
  assert.match(await page.locator('#put-latitude').inputValue(), /^60°\d\d\.\d{3}′N$/);
  await page.locator('#put-latitude').fill('60 24.0 N');
  await page.locator('#put-longitude').fill('5.05');
  const put = await next('target', () => page.locator('#put-form button[type=submit]').click());
  near(put.latitudeDeg, 60.4, 1e-9);
  near(put.longitudeDeg, 5.05, 1e-9);
  // What is no position is refused here.
  await page.locator('#put-latitude').fill('ninety');
  await page.locator('#put-longitude').fill('5');
  await page.locator('#put-form button[type=submit]').click();
  assert.match(await page.locator('#notices').textContent(), /A position is like/);
  // What is being typed is not for the ship that is selected next.
  await page.locator('#order-course').fill('77');
  await choose('target-3');
  await until("s.selection.join() === 'target-3'");
  assert.equal(await page.locator('#order-course').inputValue(), '');
  assert.deepEqual(page.problems, []);
});

test('own ships are ordered by their radar, put, and seen', async () => {
  kit = await openInstructor(browser);
  const { page, choose, next, until, sets, server } = kit;
  await choose('own-0');
  await page.locator('#con-rudder').fill('-20');
  await page.locator('#con-engine').fill('60');
  await page.locator('#con-form button').click();
  while (!sets().some((set) => set.con)) await page.waitForTimeout(20);
  const { con } = sets().find((set) => set.con);
  assert.deepEqual([con.rudderDeg, con.enginePercent, con._steering], [-20, 60, undefined]);
  await page.locator('#put-latitude').fill('60.41');
  await page.locator('#put-longitude').fill('5.01');
  await page.locator('#put-heading').fill('90');
  const put = await next('ownShip', () => page.locator('#put-form button[type=submit]').click());
  assert.deepEqual([put.ownShip ?? 0, put.latitudeDeg, put.longitudeDeg, put.headingDeg, put.speedKn], [0, 60.41, 5.01, 90, undefined]);
  await choose('own-1');
  assert.equal(await page.locator('#con-form').isVisible(), false, 'she has no class');
  server.views.set(5, { ...server.settings });
  await page.locator('#see-console').click();
  const frame = () => page.frames().find((each) => /watch/.test(each.url()));
  await page.waitForFunction(() => document.getElementById('trainee-frame').src.includes('radar=1'));
  await page.waitForFunction(() => [...document.getElementById('trainee-view').options].some((option) => option.text === 'View 5'));
  await page.locator('#trainee-view').selectOption({ label: 'View 5' });
  await page.waitForFunction(() => document.getElementById('trainee-frame').src.includes('view=5'));
  await frame().waitForFunction(() => window.skerry?.state().received > 0);
  const watched = await frame().evaluate(() => window.skerry.state());
  assert.deepEqual([watched.radar, watched.view], [1, 5]);
  // It watches: nothing that is pressed in it is an order.
  const before = sets().length;
  await frame().locator('#ppi').focus();
  for (const key of ['+', '-', 's', 'g']) await page.keyboard.press(key);
  await page.waitForTimeout(400);
  assert.equal(sets().length, before);
  assert.equal(await frame().locator('#panel').isVisible(), false);
  const wide = () => page.locator('#trainee').evaluate((element) => element.clientWidth);
  const was = await wide();
  await page.locator('#splitter').focus();
  await page.keyboard.press('ArrowRight');
  await page.waitForFunction((w) => document.getElementById('trainee').clientWidth < w, was);
  const { x, y, height } = await page.locator('#splitter').boundingBox();
  await page.mouse.move(x + 7, y + height / 2);
  await page.mouse.down();
  await page.mouse.move(x + 107, y + height / 2, { steps: 4 });
  await page.mouse.up();
  await page.waitForFunction((w) => document.getElementById('trainee').clientWidth < w - 100, was);
  await page.locator('#trainee-close').click();
  await until('s.drawn > 0');
  assert.equal(await page.locator('#trainee').isVisible(), false);
  assert.deepEqual(page.problems, []);
});

test('dragging moves the chart; only with Move in hand a ship, and all that are selected go along', async () => {
  kit = await openInstructor(browser, { exercise: { frozen: true } });
  const { page, pixel, until, orders, choose, ordered } = kit;
  const drag = async (from, dx, dy) => {
    await page.mouse.move(from.x, from.y);
    await page.mouse.down();
    await page.mouse.move(from.x + dx / 2, from.y + dy / 2);
    await page.mouse.move(from.x + dx, from.y + dy);
    await page.mouse.up();
  };
  const before = await page.evaluate(() => window.skerry.view());
  const at = await pixel('Lyngen');
  await drag(at, 60, -40);
  const moved = await pixel('Lyngen');
  near(moved.x, at.x + 60, 0.5);
  near(moved.y, at.y - 40, 0.5);
  assert.equal(orders().length, 0);
  assert.equal((await page.evaluate(() => window.skerry.view())).metresPerPixel.toFixed(1), before.metresPerPixel.toFixed(1));

  await page.locator('[data-tool-button=move]').click();
  await choose('own-0');
  await page.locator('#group').click();
  await drag(await pixel('Lyngen'), 30, -50);
  const target = await ordered(1, 'target');
  const own = await ordered(0, 'ownShip');
  assert.equal(target.target, 3);
  near(own.latitudeDeg - 60.39, target.latitudeDeg - 60.36, 1e-9);
  near(own.longitudeDeg - 5.1, target.longitudeDeg - 5.05, 1e-9);
  const there = await page.evaluate(([lat, lon]) => window.skerry.pixelOf(lat, lon), [target.latitudeDeg, target.longitudeDeg]);
  near(there.x, moved.x + 30, 0.5);
  near(there.y, moved.y - 50, 0.5);
  // Beside a ship it is the water that is dragged.
  const { latitudeDeg } = await page.evaluate(() => window.skerry.view());
  await drag({ x: there.x + 60, y: there.y + 60 }, 0, 50);
  await page.waitForFunction((lat) => window.skerry.view().latitudeDeg !== lat, latitudeDeg);
  assert.equal(orders().length, 2);
  await page.keyboard.press('Escape');
  await until("s.tool === 'look'");
  // The wheel keeps what is under it.
  const fulmar = await pixel('Fulmar');
  await page.mouse.move(fulmar.x, fulmar.y);
  await page.mouse.wheel(0, -500);
  await page.waitForFunction((mpp) => window.skerry.view().metresPerPixel < mpp / 1.5, before.metresPerPixel);
  const zoomed = await pixel('Fulmar');
  near(zoomed.x, fulmar.x, 2);  // the wheel tells whole pixels
  near(zoomed.y, fulmar.y, 2);
  assert.deepEqual(page.problems, []);
});

test('a new target is made where the chart is clicked, with its form\'s values', async () => {
  kit = await openInstructor(browser);
  const { page, next, middle, until } = kit;
  await page.locator('[data-tool-button=target]').click();
  await page.locator('#new-class').selectOption('vlcc');
  await page.locator('#new-name').fill('Big Åse');
  await page.locator('#new-course').fill('200');
  await page.locator('#new-speed').fill('12');
  await page.locator('#new-gives-way').selectOption({ label: 'Early' });
  const { x, y } = await middle();
  const made = await next('newTarget', () => page.mouse.click(x + 50, y + 20));
  const at = await page.evaluate(([lat, lon]) => window.skerry.pixelOf(lat, lon), [made.latitudeDeg, made.longitudeDeg]);
  near(at.x, x + 50, 0.01);
  assert.deepEqual([made.name, made.shipClass, made.courseDeg, made.speedKn, made.givesWay], ['Big Åse', 'vlcc', 200, 12, 1]);
  await until('s.exercise.ships.some((x) => x.name === "Big Åse")');
  const second = await next('newTarget', () => page.locator('#tool-target [data-at-centre]').click());
  assert.equal(second.name, undefined, 'the next has a name of its own');
  await page.locator('#new-speed').fill('101');
  await page.mouse.click(x + 80, y);
  await page.waitForTimeout(200);
  assert.equal(kit.orders().length, 2, 'out of range');
  await page.locator('#tool-target [data-cancel]').click();
  await until("s.tool === 'look'");
  assert.deepEqual(page.problems, []);
});

test('a route is drawn by clicks; Done, Enter and a double click send it, Escape does not', async () => {
  kit = await openInstructor(browser);
  const { page, choose, next, middle, until, orders } = kit;
  await page.keyboard.press('r');
  assert.match(await page.locator('#notices').textContent(), /Select a target first/);
  await choose('target-3');
  const { x, y } = await middle();
  const clicks = [[-60, 120], [0, 60], [90, 140]];
  const draw = async () => { for (const [dx, dy] of clicks) { await page.mouse.click(x + dx, y + dy); await page.waitForTimeout(30); } };
  await page.keyboard.press('r');
  await draw();
  await until('s.waypoints.length === 3');
  await page.keyboard.press('Backspace');
  await until('s.waypoints.length === 2');
  await page.keyboard.press('Escape');
  await until("s.tool === 'look' && s.waypoints.length === 0");
  assert.equal(orders().length, 0);

  await page.locator('[data-tool-button=route]').click();
  await draw();
  await page.locator('#route-speed').fill('9');
  await page.locator('#route-end').selectOption({ label: 'Back' });
  const sent = await next('target', () => page.locator('#route-done').click());
  assert.equal(sent.route.length, 3);
  assert.deepEqual([sent.target, sent.routeEnd, sent.route[0].speedKn, sent.route[1].speedKn], [3, 1, 9, undefined]);
  const at = await page.evaluate(([lat, lon]) => window.skerry.pixelOf(lat, lon), [sent.route[2].lat, sent.route[2].lon]);
  near(at.x, x + 90, 0.5);

  await choose('target-4');
  await page.keyboard.press('r');
  await page.mouse.click(x - 60, y + 100);
  const twice = await next('target', () => page.mouse.dblclick(x + 40, y + 120));
  assert.equal(twice.route.length, 2);
  assert.equal(twice.target, 4);
  // By keys alone: the cross in the middle.
  await page.keyboard.press('r');
  await page.locator('#chart').focus();
  await page.keyboard.press(' ');
  await page.keyboard.press('ArrowUp');
  await page.keyboard.press(' ');
  const typed = await next('target', () => page.keyboard.press('Enter'));
  assert.equal(typed.route.length, 2);
  assert.ok(typed.route[1].lat > typed.route[0].lat + MINUTE / 10);
  assert.deepEqual(page.problems, []);
});

test('weather: each field is an order, rain comes and goes', async () => {
  kit = await openInstructor(browser);
  const { page, sets, until, middle } = kit;
  await page.locator('#to-weather').click();
  const worlds = () => sets().filter((set) => set.world).map((set) => set.world);
  const values = { seaState: 4, depthM: 25, windFromDeg: 250, windKn: 30, swellFromDeg: 260, swellHeightM: 2, swellPeriodS: 9, currentSetDeg: 45, currentKn: 2.5, visibilityNm: 0.5 };
  for (const [name, value] of Object.entries(values)) {
    await page.locator(`#weather-${name}`).fill(String(value));
    await page.locator(`#weather-${name}`).press('Enter');
    await until(`s.world.${name} === value`, value);
    assert.equal(worlds().at(-1)[name], value);
  }
  assert.equal(worlds().length, 10);
  await page.locator('#weather-seaState').fill('9');
  await page.locator('#weather-seaState').press('Enter');
  assert.equal(await page.locator('#weather-seaState').inputValue(), '4', 'out of range');
  assert.equal(await page.locator('#notices li').first().textContent(), 'Sea state: a number from 0 to 6, not 9');
  await page.locator('#rain-tool').click();
  await page.locator('#rain-radius').fill('1.5');
  await page.locator('#rain-rate').fill('20');
  await page.locator('#rain-kind').selectOption({ label: 'Showers' });
  const { x, y } = await middle();
  await page.mouse.click(x + 30, y + 100);
  await until('s.world.rain.length === 1');
  const [cell] = worlds().at(-1).rain;
  assert.deepEqual([cell.id, cell.radiusNm, cell.rateMmH, cell.kind], [0, 1.5, 20, 2]);
  await page.locator('#tool-rain [data-at-centre]').click();
  await until('s.world.rain.length === 2');
  await page.keyboard.press('Escape');
  await page.locator('#rain-list button').first().click();
  await until('s.world.rain.length === 1');
  await page.locator('#rain-clear').click();
  for (let i = 0; i < 500 && !worlds().at(-1).removeAllRain; ++i) await page.waitForTimeout(20);
  assert.equal(worlds().at(-1).removeAllRain, true);
  assert.deepEqual(page.problems, []);
});

test('faults: every field of the schema, one by one, of the selected own ship alone', async () => {
  kit = await openInstructor(browser);
  const { page, choose, next, until } = kit;
  await page.locator('#to-faults').click();
  assert.equal(await page.locator('#fault-area').isVisible(), false);
  await page.locator('#to-ships').click();
  await choose('own-1');
  await page.locator('#to-faults').click();
  assert.equal(await page.locator('#fault-table input').count(), CONTROLS.faults.length);
  for (const { name, field, type, max } of CONTROLS.faults) {
    const value = type === 'switch' ? true : max / 2;
    const fault = await next('fault', async () => {
      if (type === 'switch') await page.locator(`label:has(#fault-${name})`).click();
      else { await page.locator(`#fault-${name}`).fill(String(value)); await page.locator(`#fault-${name}`).press('Enter'); }
    });
    assert.equal(fault.ownShip, 1);
    assert.deepEqual(fault.change, [field]);
    assert.deepEqual(fault.faults, { [name]: value });
  }
  await until('s.exercise.ships[1].faults.blackout && !s.exercise.ships[0].faults.blackout');
  assert.equal(await page.locator('#fault-blackout').isChecked(), true);
  const none = await next('fault', () => page.locator('#faults-none').click());
  assert.deepEqual(none.change ?? [], []);
  await page.waitForFunction(() => !document.getElementById('fault-blackout').checked && document.getElementById('fault-gyroBiasDeg').value === '0');
  assert.deepEqual(page.problems, []);
});

test('the exercise: freeze, pace, snapshot, restore, undo, marks and texts', async () => {
  kit = await openInstructor(browser);
  const { page, next, until, choose } = kit;
  assert.equal((await next('clock', () => page.locator('#freeze').click())).frozen, true);
  await page.waitForFunction(() => document.getElementById('exercise-pace').textContent === 'Frozen');
  await page.locator('#to-exercise').click();
  assert.equal((await next('clock', () => page.locator('[data-rate="10"]').click())).rate, 10);
  await page.locator('#rate').fill('0.1');
  assert.equal((await next('clock', () => page.locator('#rate').press('Enter'))).rate, 0.1);
  await page.locator('#rate').fill('21');
  await page.locator('#rate').press('Enter');
  await page.locator('#snapshot-name').fill('Before the turn');
  assert.equal(await next('snapshot', () => page.locator('#snapshot-form button').click()), 'Before the turn');
  assert.match(await next('snapshot', () => page.locator('#snapshot-form button').click()), /^At 1:0/, 'a name of its own');
  await until('s.exercise.snapshots.length === 2');
  await page.keyboard.press('1');
  await page.locator('#to-ships').click();
  await choose('target-3');
  await page.locator('#order-speed').fill('3');
  await next('target', () => page.locator('#order-form button').click());
  await until('s.exercise.canUndo !== ""');
  await page.locator('#to-exercise').click();
  await page.waitForFunction(() => /Lyngen/.test(document.getElementById('undo-what').textContent));
  assert.equal(await next('undo', () => page.locator('#undo').click()), true);
  await until('s.exercise.ships[3].speedKn === 11');
  await page.waitForFunction(() => document.getElementById('undo').disabled);
  const restore = page.locator('#snapshot-list button').last();
  await restore.click();
  assert.equal(await restore.textContent(), 'Sure?');
  assert.equal(await next('restore', () => restore.click()), 'Before the turn');
  await page.locator('#mark-text').fill('Pilot aboard');
  assert.equal(await next('mark', () => page.locator('#mark-text').press('Enter')), 'Pilot aboard');
  await page.waitForFunction(() => document.querySelector('#mark-list li span').textContent === 'Pilot aboard');
  await page.locator('#text-text').fill('Reduce speed');
  assert.deepEqual(await next('text', () => page.locator('#text-form button').click()), { text: 'Reduce speed' });
  await page.locator('#text-to').selectOption({ label: 'Gannet' });
  await page.locator('#text-text').fill('You too');
  assert.deepEqual(await next('text', () => page.locator('#text-form button').click()), { ownShip: 1, text: 'You too' });
  assert.equal(await page.locator('#last-order').textContent(), 'instructor 127.0.0.1:5: text');
  assert.deepEqual(page.problems, []);
});

test('a refusal is told in plain words, with what was refused; a token is asked for', async () => {
  kit = await openInstructor(browser);
  const { page, choose, server } = kit;
  server.exercise.take = () => 'speed 40 kn: a coaster makes at most 14 kn';
  await choose('target-3');
  await page.locator('#order-speed').fill('40');
  await page.locator('#order-form button').click();
  await page.waitForFunction(() => document.getElementById('notices').textContent === 'Lyngen, course and speed: speed 40 kn: a coaster makes at most 14 kn');
  server.exercise.take = () => 'needs the control token';
  await page.keyboard.press('f');
  await page.locator('#token').waitFor();
  assert.equal(await page.locator('#help').isVisible(), true);
  await page.locator('#token').fill('secret');
  await page.locator('#token').press('Tab');
  const token = () => server.received.filter((m) => m.kind === 'subscribe').at(-1).subscribe.token;
  for (let i = 0; i < 500 && token() !== 'secret'; ++i) await page.waitForTimeout(20);
  assert.equal(token(), 'secret');
  assert.deepEqual(page.problems, []);
});

test('a lost server is told, and comes back', async () => {
  kit = await openInstructor(browser);
  const { page, server, until } = kit;
  await server.stop();
  await page.waitForFunction(() => document.getElementById('alarm').textContent === 'Connection lost' && !document.getElementById('alarm').hidden);
  await server.start();
  await page.waitForFunction(() => document.body.dataset.fresh === 'true', null, { timeout: 20000 });
  await until('s.coast.points === 11');
  server.exercise = null;
  await page.waitForFunction(() => document.getElementById('alarm').textContent === 'No news of the exercise', null, { timeout: 20000 });
});

test('the exercise is saved as a scenario file', async () => {
  kit = await openInstructor(browser);
  const [download] = await Promise.all([kit.page.waitForEvent('download'), kit.page.locator('#save').click()]);
  assert.match(download.suggestedFilename(), /^closed-form-1-01-\d\d\.yaml$/);
  const text = readFileSync(await download.path(), 'utf8');
  assert.match(text, /own_ships:\n {2}- name: "Fulmar"/);
  assert.match(text, /artefacts: \{/);
  assert.deepEqual(kit.page.problems, []);
});

for (const [width, height] of [[1180, 820], [820, 1180]]) {
  test(`by touch at ${width} x ${height}: taps select, one finger pans, two zoom, Move drags, and the page stays`, async () => {
    kit = await openInstructor(browser, { exercise: { frozen: true }, page: { viewport: { width, height }, hasTouch: true, isMobile: true } });
    const { page, pixel, until, ordered, orders } = kit;
    const finger = await page.context().newCDPSession(page);
    // It rests before it lifts: after a finger that lifts in full flight Chromium makes no click of the next tap.
    const touch = async (type, ...points) => {
      if (type === 'touchEnd') await page.waitForTimeout(150);
      await finger.send('Input.dispatchTouchEvent', { type, touchPoints: points });
    };
    const small = await page.evaluate(() => [...document.querySelectorAll('button, select, .button, input[type=number], input[type=text]')]
      .filter((element) => element.offsetParent && element.getBoundingClientRect().height < 39.5).map((element) => element.id || element.textContent));
    assert.deepEqual(small, []);
    let at = await pixel('Fulmar');
    await page.touchscreen.tap(at.x + 15, at.y + 10);
    await until("s.selection.join() === 'own-0'");
    await touch('touchStart', at);
    for (let i = 1; i <= 5; ++i) await touch('touchMove', { x: at.x + 10 * i, y: at.y + 6 * i });
    await touch('touchEnd');
    const panned = await pixel('Fulmar');
    near(panned.x, at.x + 50, 1);
    assert.equal(orders().length, 0);
    const { metresPerPixel } = await page.evaluate(() => window.skerry.view());
    await touch('touchStart', { x: at.x - 30, y: at.y, id: 1 }, { x: at.x + 30, y: at.y, id: 2 });
    for (let i = 1; i <= 5; ++i) await touch('touchMove', { x: at.x - 30 - 6 * i, y: at.y, id: 1 }, { x: at.x + 30 + 6 * i, y: at.y, id: 2 });
    await touch('touchEnd');
    near((await page.evaluate(() => window.skerry.view())).metresPerPixel, metresPerPixel / 2, metresPerPixel * 0.02);
    await page.locator('#fit').tap();
    await page.locator('[data-tool-button=move]').tap();
    at = await pixel('Fulmar');
    await touch('touchStart', at);
    for (let i = 1; i <= 5; ++i) await touch('touchMove', { x: at.x + 8 * i, y: at.y });
    await touch('touchEnd');
    const put = await ordered(0, 'ownShip');
    const there = await page.evaluate(([lat, lon]) => window.skerry.pixelOf(lat, lon), [put.latitudeDeg, put.longitudeDeg]);
    near(there.x, at.x + 40, 1);
    for (const tab of ['weather', 'faults', 'exercise', 'ships']) {
      await page.locator(`#to-${tab}`).tap();
      await page.locator(`#tab-${tab}`).waitFor();  // the click comes after the tap
    }
    const { scrollX, scrollY, scrollWidth, scrollHeight } = await page.evaluate(() => ({ scrollX, scrollY, scrollWidth: document.documentElement.scrollWidth, scrollHeight: document.documentElement.scrollHeight }));
    assert.deepEqual([scrollX, scrollY, scrollWidth, scrollHeight], [0, 0, width, height]);
    assert.deepEqual(page.problems, []);
  });
}

test('the console and the con say which sensors tell nothing, and the con shows the instructor\'s text until it is read', async () => {
  kit = await openInstructor(browser, { server: { ownShipMore: { noHeading: true, noPosition: true, noLog: true, noWind: true, text: 'Pilot at noon', texts: 2 } } });
  const { server, url } = kit;
  const radar = await openConsole(browser, url);
  await radar.waitForFunction(() => document.getElementById('sensor-sign').textContent === 'No heading, position, log, wind');
  for (const id of ['heading', 'latitude', 'speed']) assert.equal(await radar.locator(`#${id}`).textContent(), '–', id);
  await radar.context().close();
  const con = await openConsole(browser, `${url}conning`);
  await con.waitForFunction(() => document.getElementById('sensors').textContent === 'No heading, position, log, wind');
  for (const id of ['latitude', 'stw', 'sog']) assert.equal(await con.locator(`#${id}`).textContent(), id === 'sog' ? '0.0' : '–', id);
  assert.equal(await con.locator('#message-text').textContent(), 'Pilot at noon');
  await con.locator('#message-read').click();
  assert.equal(await con.locator('#message').isVisible(), false);
  await con.waitForTimeout(1300);
  assert.equal(await con.locator('#message').isVisible(), false);
  Object.assign(server.ownShipMore, { text: 'Now', texts: 3 });
  await con.waitForFunction(() => !document.getElementById('message').hidden && document.getElementById('message-text').textContent === 'Now');
  assert.deepEqual(con.problems, []);
  await con.context().close();
});
