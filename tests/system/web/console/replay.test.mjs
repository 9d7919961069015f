// A recording in the instructor's page, in a real Chromium on the mock server: touch, pointer and keys.
import assert from 'node:assert/strict';
import { after, afterEach, before, test } from 'node:test';
import { launch, state } from '../browser.mjs';
import { openInstructor } from '../instructor_kit.mjs';

let browser, kit;
before(async () => { browser = await launch(); });
after(() => browser?.close());
afterEach(async () => {
  await kit?.page.context().close();
  await kit?.server.stop();
  kit = null;
});

const MARKS = [
  { positionS: 300, text: 'Pilot aboard', kind: 'mark' },
  { positionS: 1800, text: 'Fulmar and Ferry', kind: 'collision' },
  { positionS: 3000, text: 'Fulmar', kind: 'grounding' },
];

async function open({ playback = {}, viewport = { width: 1180, height: 820 } } = {}) {
  kit = await openInstructor(browser, {
    exercise: { playedMarks: MARKS },
    server: { playback: { file: 'harbour.mcap', beginUtcNs: '1790000000000000000', lengthS: 3600, positionS: 600,
      playing: false, rate: 1, loop: false, marks: [], truth: true, ...playback } },
    page: { viewport, hasTouch: true },
  });
  await kit.until('s.playback !== null');
  return kit;
}
const asked = () => kit.server.received.filter((m) => m.kind === 'playback').map((m) => m.playback);
const at = (positionS) => kit.until('Math.abs(s.playback.positionS - value) < 1', positionS);
const text = (id) => kit.page.locator(`#${id}`).textContent();

test('every control is a finger wide, within the screen, and beside no other', async () => {
  for (const viewport of [{ width: 1180, height: 820 }, { width: 820, height: 1180 }, { width: 1920, height: 1080 }]) {
    const { page } = await open({ viewport });
    const boxes = await page.evaluate(() =>
      [...document.querySelectorAll('#playback :is(button, select, input[type=range], .switch)')]
        .filter((each) => each.offsetParent)
        .map((each) => { const { x, y, width, height } = each.getBoundingClientRect(); return { id: each.id, x, y, width, height }; }));
    assert.equal(boxes.length, 9);
    for (const { id, x, y, width, height } of boxes) {
      assert.ok(width >= 44 && height >= 44, `${id}: ${width} x ${height}`);
      assert.ok(x >= 0 && y >= 0 && x + width <= viewport.width && y + height <= viewport.height, id);
    }
    for (const a of boxes) {
      for (const b of boxes) {
        const apart = a === b || a.x + a.width <= b.x + 0.5 || b.x + b.width <= a.x + 0.5 || a.y + a.height <= b.y + 0.5 || b.y + b.height <= a.y + 0.5;
        assert.ok(apart, `${a.id} lies over ${b.id}`);
      }
    }
    assert.deepEqual(page.problems, []);
    await page.context().close();
    await kit.server.stop();
  }
  kit = null;
});

test('what changes the world is not there, and keys for it say why', async () => {
  const { page } = await open();
  await kit.choose('target-0');
  for (const id of ['freeze', 'undo', 'order-form', 'put-form', 'ais-form', 'resume']) {
    assert.equal(await page.locator(`#${id}`).isVisible(), false, id);
  }
  for (const tool of ['move', 'target', 'route', 'rain']) {
    assert.equal(await page.locator(`[data-tool-button=${tool}]`).isVisible(), false, tool);
  }
  await page.locator('#to-exercise').click();
  for (const id of ['snapshot-form', 'text-form', 'mark-form', 'rate']) assert.equal(await page.locator(`#${id}`).isVisible(), false, id);
  assert.ok(await page.locator('#mark-list li').first().isVisible());
  for (const key of ['f', 'n', 'm']) {
    await page.keyboard.press(key);
    await page.locator('.notice', { hasText: 'A recording is played' }).waitFor();
  }
  assert.equal((await state(page)).tool, 'look');
  assert.deepEqual(kit.sets(), []);
});

test('the time line is sought by touch and by keys', async () => {
  const { page } = await open();
  const box = await page.locator('#playback-position').boundingBox();
  await page.touchscreen.tap(box.x + box.width / 2, box.y + box.height / 2);
  await kit.until('Math.abs(s.playback.positionS - 1800) < 60');
  const { positionS } = (await state(page)).playback;
  await page.locator('#playback-position').focus();
  await page.keyboard.press('ArrowRight');
  await at(positionS + 5);
  await page.keyboard.press('Shift+ArrowLeft');
  await at(positionS - 55);
  await page.keyboard.press('PageUp');
  await at(positionS + 305);
  await page.keyboard.press('End');
  await at(3600);
  await page.keyboard.press('ArrowRight');
  await at(3600);
  await page.keyboard.press('Home');
  await at(0);
  await page.mouse.move(box.x + 20, box.y + box.height / 2);
  await page.mouse.down();
  await page.mouse.move(box.x + box.width / 4, box.y + box.height / 2, { steps: 5 });
  await page.mouse.up();
  await kit.until('Math.abs(s.playback.positionS - 900) < 60');
  for (const each of asked()) assert.ok(each.positionS >= 0 && each.positionS <= 3600);
  assert.deepEqual(page.problems, []);
});

test('marks and mishaps are jumped to, one by one or by name', async () => {
  const { page } = await open();
  assert.deepEqual(await page.locator('#replay-ticks i').evaluateAll((all) => all.map((each) => each.dataset.kind)),
    ['mark', 'collision', 'grounding']);
  await page.locator('#replay-after').tap();
  await at(1800);
  await page.keyboard.press(']');
  await at(3000);
  await page.locator('#replay-after').tap();
  await page.locator('.notice', { hasText: 'no mark after' }).waitFor();
  await page.locator('#replay-before').tap();
  await at(1800);
  await page.keyboard.press('[');
  await at(300);
  await page.locator('#replay-mark').selectOption({ label: '50:00  Grounding: Fulmar' });
  await at(3000);
});

test('it is played, paused and hurried', async () => {
  const { page } = await open();
  await page.locator('#playback-play').tap();
  await kit.until('s.playback.playing');
  assert.equal(await text('playback-play'), 'Pause');
  await page.keyboard.press('k');
  await kit.until('!s.playback.playing');
  assert.equal(await text('playback-sign'), 'Playback · paused');
  for (const rate of ['0.1', '20']) {
    await page.locator('#playback-rate').selectOption(rate);
    await kit.until('s.playback.rate === value', Number(rate));
  }
});

test('who else moves it is told, what we do ourselves is not', async () => {
  const { page, server } = await open({ playback: { orders: 4 } });
  const playback = server.playback;
  await page.locator('#replay-after').tap();
  await at(1800);
  server.showStates({ playback: { orders: 5, lastBy: 'console 127.0.0.1:5' } });
  await kit.until('s.playback.orders === 5');
  assert.equal(await page.locator('.notice').count(), 0);
  server.showStates({ playback: { ...playback, orders: 6, positionS: 120, lastBy: 'console 127.0.0.1:9' } });
  await page.locator('.notice', { hasText: 'moved by console 127.0.0.1:9: 2:00' }).waitFor();
});

test('a seek back takes the future out of the tracks, one forward leaves a gap', async () => {
  const { page, server } = await open({ playback: { playing: true } });
  const track = async () => (await state(page)).tracks.find(({ key }) => key === 'own-0');
  for (const exerciseS of [4000, 4020, 4040]) {
    server.exercise.exerciseS = exerciseS;
    server.showExercise();
    await kit.until('s.exercise.exerciseS >= value', exerciseS);
  }
  assert.ok((await track()).toS >= 4040);
  server.exercise.exerciseS = 4010;
  server.showExercise();
  await kit.until('s.exercise.exerciseS >= 4010 && s.exercise.exerciseS < 4020');
  const { fromS, toS, parts } = await track();
  assert.ok(fromS < 4000 && toS < 4020, `${fromS} to ${toS}`);
  server.exercise.exerciseS = 4300;
  server.showExercise();
  await kit.until('s.exercise.exerciseS >= 4300');
  assert.equal((await track()).parts, parts + 1);
});

test('a recording without truth says so', async () => {
  const { page } = await open({ playback: { truth: false } });
  await page.locator('#alarm', { hasText: 'holds no truth' }).waitFor();
});
