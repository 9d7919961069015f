// Recorder and playback in the console, in a real Chromium on the mock server.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { capture, openConsole, openTab, state, waitForScan } from '../browser.mjs';
import { eachTest } from '../each_test.mjs';
import { MockServer } from '../mock_server.mjs';

let browser, server, page;
eachTest((b) => { browser = b; }, () => { const opened = { page, server }; page = server = null; return opened; });

const recorder = () => ({ phase: 0, file: '', folder: '/recordings', fileBytes: 0, totalBytes: 0, seconds: 0, bytesPerSecond: 0,
  freeBytes: 80e9, spokes: 0, spokesLost: 0, marks: 0, problem: '', inputsOnly: false });
const playback = () => ({ file: 'harbour.mcap', beginUtcNs: 1790000000n.toString() + '000000000', lengthS: 3725, positionS: 60, playing: true,
  rate: 1, loop: false, marks: [{ positionS: 90, name: 'collision' }, { positionS: 1800, name: 'collision' }], currentTimestamps: false, problem: '' });

async function open(options = {}) {
  server = new MockServer({ rpm: 60, ...options });
  page = await openConsole(browser, await server.start());
  await page.waitForFunction(() => window.skerry.state().connection === 'live');
  if (options.recorder) await openTab(page, 'Set-up');
}

const text = (id) => page.locator(`#${id}`).textContent();
const asked = (kind) => server.received.filter((m) => m.kind === kind).map((m) => m[kind]);
const until = async (id, expected) => {
  await page.waitForFunction(([i, e]) => document.getElementById(i).textContent === e, [id, expected], { timeout: 10000 });
};

test('a server that records nothing and plays nothing shows neither', async () => {
  await open();
  await waitForScan(page);
  for (const id of ['recording', 'playback', 'playback-sign', 'record-sign']) assert.equal(await page.locator(`#${id}`).isVisible(), false, id);
  assert.deepEqual(page.problems, []);
});

test('the recorder is started, marked and stopped, and shows how it does', async () => {
  await open({ recorder: recorder() });
  await until('record-phase', 'Off');
  assert.equal(await page.locator('#record-mark').isDisabled(), true);
  await page.locator('#record').click();
  await until('record-phase', 'Recording');
  assert.equal(await text('record'), 'Stop');
  server.showStates({ recorder: { seconds: 3723.4, fileBytes: 1234567890, bytesPerSecond: 1.85e6, freeBytes: 64.2e9 } });
  await until('record-time', '1:02:03');
  assert.equal(await text('record-size'), '1.2 GB');
  assert.equal(await text('record-rate'), '1.9 MB/s');
  assert.equal(await text('record-free'), '64.2 GB');
  assert.equal(await text('record-file'), 'now.mcap');
  assert.equal(await text('record-sign'), 'Rec 1:02:03');
  assert.ok(await page.locator('#record-sign').isVisible());

  await page.locator('#record-mark').fill('Buoy passed');
  await page.locator('#record-mark').press('Enter');
  await until('record-marks', '1');
  await page.locator('#ppi').focus();
  await page.keyboard.press('m');
  await until('record-marks', '2');
  await page.locator('#record').click();
  await until('record-phase', 'Off');
  assert.deepEqual(asked('record').map(({ action, name }) => [action, name]), [[0, ''], [2, 'Buoy passed'], [2, ''], [1, '']]);
  assert.equal(await page.locator('#record-sign').isVisible(), false);
  assert.deepEqual(page.problems, []);
});

test('what is typed as a name of a mark is no key of the console', async () => {
  await open({ recorder: { ...recorder(), phase: 1 } });
  await until('record-phase', 'Recording');
  await page.locator('#record-mark').pressSequentially('sehr gut, k.');
  assert.equal(await page.locator('#record-mark').inputValue(), 'sehr gut, k.');
  assert.deepEqual(server.received.filter((m) => m.kind === 'set'), []);
});

test('a full disk is seen, with what was lost; and that it goes on', async () => {
  await open({ recorder: { ...recorder(), phase: 1 } });
  await until('record-phase', 'Recording');
  server.showStates({ recorder: { phase: 2, spokesLost: 4711, freeBytes: 0 } });
  await until('record-phase', 'Disk full');
  assert.match(await text('record-problem'), /disk is full: recording goes on when there is room/i);
  assert.equal(await text('record-sign'), 'Disk full');
  assert.ok(await page.locator('#record-sign').isVisible());
  assert.ok(await page.locator('#record-lost').evaluate((e) => e.classList.contains('bad')));
  server.showStates({ recorder: { phase: 1, freeBytes: 1e9 } });
  await until('record-phase', 'Recording');
  assert.equal(await page.locator('#record-problem').isVisible(), false);
  assert.equal(await text('record-lost'), '4711');
  server.showStates({ recorder: { phase: 3, problem: 'the folder is gone' } });
  await until('record-phase', 'Failed');
  assert.equal(await text('record-problem'), 'the folder is gone');
  assert.equal(await text('record'), 'Record');
});

test('a recorder that refuses says why, and asks for the token', async () => {
  await open({ recorder: recorder(), refuse: { code: 4, text: 'a token is needed' } });
  await until('record-phase', 'Off');
  await page.locator('#record').click();
  await page.locator('.notice', { hasText: 'a token is needed' }).waitFor();
  await page.locator('#token').fill('secret');
  await page.locator('#token').blur();
  server.refuse = null;
  await page.locator('#record').click();
  await until('record-phase', 'Recording');
  assert.equal(asked('record').at(-1).token, 'secret');
});

test('a playback is told from a radar at a glance, and its radar takes no orders', async () => {
  await open({ playback: playback() });
  await until('playback-sign', 'Playback');
  assert.ok(await page.locator('#playback-sign').isVisible());
  assert.equal(await text('playback-file'), 'harbour.mcap');
  assert.equal(await text('playback-length'), '1:02:05');
  assert.match(await text('playback-clock'), /^2026-09-21 1[0-9]:\d\d:\d\d UTC$/);
  for (const id of ['orders', 'gain', 'range', 'transmit-off', 'seaState']) {
    assert.ok(await page.locator(`#${id}`).evaluate((e) => e.closest('[inert]') !== null), id);
  }
  assert.deepEqual(page.problems, []);
});

test('a playback is paused, sought, stepped, looped and played at another rate', async () => {
  await open({ playback: playback() });
  await until('playback-play', 'Pause');
  await page.locator('#playback-play').click();
  await until('playback-sign', 'Playback · paused');
  assert.equal(await text('playback-play'), 'Play');
  await page.locator('#playback-forward').click();
  await page.waitForFunction(() => window.skerry.playback().positionS === 61);
  await page.keyboard.press(',');
  await page.waitForFunction(() => window.skerry.playback().positionS === 60);
  await page.locator('#playback-position').fill('600');
  await page.waitForFunction(() => window.skerry.playback().positionS === 600);
  await until('playback-at', '10:00');
  await page.locator('#playback-mark').selectOption({ index: 2 });
  await page.waitForFunction(() => window.skerry.playback().positionS === 1800);
  await page.locator('#playback-rate').selectOption('10');
  await page.waitForFunction(() => window.skerry.playback().rate === 10);
  await page.locator('#playback-loop').check({ force: true });
  await page.waitForFunction(() => window.skerry.playback().loop);
  await page.keyboard.press('k');
  await until('playback-sign', 'Playback 10×');
  // Between two states the clock goes on, ten times as fast.
  await page.waitForFunction(() => document.getElementById('playback-at').textContent > '30:04');
  server.showStates({ playback: { rate: 3, positionS: 5, problem: 'byte 4711: a chunk is damaged' } });
  await until('playback-sign', 'Playback 3×');
  assert.equal(await page.locator('#playback-rate').inputValue(), '3');
  assert.equal(await text('playback-problem'), 'byte 4711: a chunk is damaged');
  assert.deepEqual(asked('playback').map((m) => ({ ...m, token: undefined })).map((m) => JSON.parse(JSON.stringify(m))), [
    { playing: false }, { stepTurns: 1 }, { stepTurns: -1 }, { positionS: 600 }, { positionS: 1800 }, { rate: 10 }, { loop: true }, { playing: true },
  ]);
  assert.deepEqual(page.problems, []);
});

test('a picture that is paused neither fades nor is called lost', async () => {
  await open({ playback: playback() });
  await waitForScan(page);
  await page.locator('#playback-play').click();
  await until('playback-sign', 'Playback · paused');
  const brightness = async () => {
    const { data } = await capture(page);
    return data.reduce((sum, v) => sum + v, 0);
  };
  await page.waitForFunction((n) => window.skerry.state().frames > n + 5, (await state(page)).frames);
  const first = await brightness();
  await page.waitForTimeout(3000);
  assert.equal(await brightness(), first);
  assert.equal(await page.locator('#alarm').isVisible(), false);
});

test('a server that comes back as a radar is no playback any more', async () => {
  await open({ playback: playback() });
  await until('playback-sign', 'Playback');
  const { port } = server;
  await server.stop();
  server = new MockServer({ rpm: 60, port });
  await server.start();
  await page.waitForFunction(() => window.skerry.state().connection === 'live' && window.skerry.playback() === null, null, { timeout: 20000 });
  assert.equal(await page.locator('#playback-sign').isVisible(), false);
  await page.waitForFunction(() => document.querySelectorAll(':is([data-live-radar], [data-needs-server])[inert]').length === 0);
});
