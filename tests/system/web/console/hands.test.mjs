// The console by hand: keys and their dialog, two fingers, screens, set-ups by name, and whose console it is.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { test } from 'node:test';
import { openConsole } from '../browser.mjs';
import { eachTest } from '../each_test.mjs';
import { openSmall, setsOf, untilSet } from '../hands_kit.mjs';

let browser, server, page, url;
eachTest((b) => { browser = b; }, () => { const opened = { page, server }; page = server = null; return opened; }, { whole: true });
async function open(options) {
  ({ server, page, url } = await openSmall(browser, options));
}
const ready = (p = page) => p.waitForFunction(() => window.skerry && !document.documentElement.hasAttribute('data-off'));
const notice = (text) => page.locator('.notice', { hasText: text }).first().waitFor();
const tab = (name) => page.getByRole('tab', { name, exact: true }).click();

test('single keys do what MSC.192 wants of them, and nothing while text is typed', async () => {
  await open({ server: { settings: { sea: 30, rain: 10, gain: 50 } } });
  await page.keyboard.press('u');
  await notice('Set by itself: tune');
  server.radarSettings.tuneAuto = false;
  server.change({});
  await page.waitForFunction(() => !document.getElementById('tune').disabled);
  for (const [key, is] of [['g', (s) => s.gain === 51], ['Shift+G', (s) => s.gain === 50], ['w', (s) => s.sea === 31], ['Shift+W', (s) => s.sea === 30],
    ['f', (s) => s.rain === 11], ['Shift+F', (s) => s.rain === 10], ['u', (s) => s.tune === 51], ['Shift+U', (s) => s.tune === 50],
    ['+', (s) => s.rangeNm === 12], ['-', (s) => s.rangeNm === 6], ['s', (s) => s._transmit && !s.transmit]]) {
    await page.keyboard.press(key);
    await untilSet(server, is);
  }
  await page.locator('#alarm', { hasText: 'Standby' }).waitFor();
  for (const id of ['ebl', 'vrm']) {
    await page.keyboard.press(id[0]);
    await page.waitForFunction((box) => document.getElementById(box).checked, id);
  }
  const before = setsOf(server).length;
  await tab('Set-up');
  await page.locator('#setup-name').pressSequentially('gGsw+-f');
  await page.keyboard.press('ArrowLeft');
  assert.equal(await page.locator('#setup-name').inputValue(), 'gGsw+-f');
  await page.evaluate(() => new Promise((resolve) => setTimeout(resolve, 200)));
  assert.equal(setsOf(server).length, before);
});

test('after a key for it the arrows are the bearing line\u2019s, the range marker\u2019s and the cursor\u2019s, wherever the focus was', async () => {
  await open();
  const tools = () => page.evaluate(() => window.skerry.tools());
  const chosen = () => page.locator('[role=tab][aria-selected=true]').textContent();
  await tab('Targets');
  await page.keyboard.press('e');
  const { bearingDeg } = (await tools()).ebls[0];
  await page.keyboard.press('ArrowRight');
  assert.equal((await tools()).ebls[0].bearingDeg, bearingDeg + 1);
  await tab('Targets');
  await page.keyboard.press('v');
  const { rangeM } = (await tools()).vrms[0];
  await page.keyboard.press('ArrowUp');
  assert.ok((await tools()).vrms[0].rangeM > rangeM);
  // The focus goes on a tab while the arrows move the cursor: it may have them, until Escape ends the mode.
  await page.keyboard.press('Shift+C');
  await tab('Targets');
  await page.keyboard.press('Escape');
  await page.keyboard.press('Shift+ArrowLeft');
  assert.ok(Math.abs((await tools()).ebls[0].bearingDeg - bearingDeg - 0.9) < 1e-6);
  assert.equal(await chosen(), 'Targets');
  // A box that was ticked needs no arrows; fields and tabs do.
  await tab('Tools');
  await page.locator('label:has(#ebl2)').click();
  const second = (await tools()).ebls[1].bearingDeg;
  await page.keyboard.press('ArrowLeft');
  assert.equal((await tools()).ebls[1].bearingDeg, second - 1);
  await tab('Tools');
  await page.keyboard.press('ArrowRight');
  assert.equal(await chosen(), 'Chart');
  assert.deepEqual(page.problems, []);
});

test('a number typed for one parallel line is entered for it, and is not in the field of the next', async () => {
  await open();
  await tab('Tools');
  await page.locator('#parallel > summary').click();
  const field = page.getByLabel('Bearing of the line', { exact: true });
  for (const [how, typed] of [['click', '123'], ['dispatchEvent', '217']]) {
    await page.locator('.line-choice button').nth(0).click();
    await field.click({ clickCount: 3 });
    await page.keyboard.type(typed);
    // As browsers of tablets do it: the focus stays in the field.
    await page.locator('.line-choice button').nth(1)[how](...(how === 'click' ? [] : ['click']));
    assert.equal(await field.inputValue(), '0.0', how);
    const { lines } = await page.evaluate(() => window.skerry.tools());
    assert.deepEqual(lines.slice(0, 2).map(({ bearingDeg }) => bearingDeg), [Number(typed), 0], how);
  }
  assert.deepEqual(page.problems, []);
});

test('keys are listed from their table and changed, a conflict is told, and they come back', async () => {
  await open();
  await page.keyboard.press('?');
  await page.locator('#help').waitFor();
  const key = (id) => page.locator(`.key[data-action=${id}]`);
  const news = () => page.locator('.key-news').textContent();
  assert.ok(await page.locator('.key').count() >= 27);
  await key('rings').click();
  await page.keyboard.press('g');
  assert.match(await news(), /^G is the key for: more gain\. Press it again to take it/);
  await page.keyboard.press('y');
  assert.match(await news(), /^Y: range rings/);
  assert.match(await key('rings').textContent(), /^Y/);
  await key('vrm').click();
  await page.keyboard.press('e');
  await page.keyboard.press('e');
  assert.equal(await key('ebl').textContent(), 'none');
  await page.keyboard.press('Escape');
  await page.locator('#help').waitFor({ state: 'hidden' });
  await page.reload();
  await ready();
  await page.keyboard.press('y');
  assert.equal(await page.locator('#rings').isChecked(), false, 'kept');
  await page.keyboard.press('r');
  assert.equal(await page.locator('#rings').isChecked(), false, 'R is free');
  await page.keyboard.press('e');
  await page.waitForFunction(() => document.getElementById('vrm').checked);
  assert.equal(await page.locator('#ebl').isChecked(), false);
  await page.locator('#help-open').click();
  await page.getByRole('button', { name: 'All as delivered' }).click();
  assert.match(await key('rings').textContent(), /^R/);
  await page.getByRole('button', { name: 'Close' }).click();
  await page.keyboard.press('r');
  assert.equal(await page.locator('#rings').isChecked(), true);
  assert.deepEqual(page.problems, []);
});

test('two fingers that part or close change the range by steps, and those that move together do not', async () => {
  await open({ page: { hasTouch: true, viewport: { width: 820, height: 1180 } } });
  const session = await page.context().newCDPSession(page);
  const touch = (type, ...points) => session.send('Input.dispatchTouchEvent', { type, touchPoints: points.map(([x, y], id) => ({ x, y, id })) });
  const pinch = async (from, to) => {
    await touch('touchStart', [410 - from, 410], [410 + from, 410]);
    for (let i = 1; i <= 5; ++i) { const r = from + ((to - from) * i) / 5; await touch('touchMove', [410 - r, 410], [410 + r, 410]); }
    await touch('touchEnd');
  };
  await pinch(60, 100);  // 1.67 times
  await untilSet(server, (set) => set.rangeNm === 3);
  await pinch(100, 60);
  await untilSet(server, (set) => set.rangeNm === 6);
  const before = setsOf(server).length;
  await pinch(100, 125);
  await touch('touchStart', [300, 300], [500, 300]);
  for (let i = 1; i <= 4; ++i) await touch('touchMove', [300 + 50 * i, 300 + 40 * i], [500 + 50 * i, 300 + 40 * i]);
  await touch('touchEnd');
  await page.evaluate(() => new Promise((resolve) => setTimeout(resolve, 250)));
  assert.equal(setsOf(server).length, before);
});

test('the picture has the screen by a key, a window of its own, and a second one beside it', async () => {
  await open({ page: { viewport: { width: 1000, height: 800 } } });
  const side = () => page.locator('#ppi').evaluate((e) => e.clientWidth);
  const small = await side();
  await page.keyboard.press('z');
  await page.waitForFunction((s) => document.body.hasAttribute('data-alone') && document.getElementById('ppi').clientWidth > s, small);
  assert.equal(await page.locator('#panel').isVisible(), false);
  await page.locator('#full-screen-end').click();
  await page.locator('#panel').waitFor();
  await tab('Set-up');
  const [popped] = await Promise.all([page.waitForEvent('popup'), page.locator('#pop-out').click()]);
  await popped.waitForFunction(() => window.skerry?.state().received > 0);
  assert.equal(await popped.locator('#panel').isVisible(), false);
  await popped.close();

  await page.locator('#beside').selectOption('0');
  const frame = page.frameLocator('#second');
  await frame.locator('#range-now', { hasText: /^6$/ }).waitFor();  // while it builds itself its buttons still move
  await frame.locator('#range-less').click();
  await untilSet(server, (set) => set.view > 0 && set.rangeNm === 3);
  await frame.locator('#range-now', { hasText: /^3$/ }).waitFor();
  assert.equal(await page.locator('#range-now').textContent(), '6', 'two ranges side by side');
  const [one, two] = [await page.locator('#display').boundingBox(), await page.locator('#second').boundingBox()];
  assert.ok(Math.abs(one.width - two.width) < 2 && Math.abs(two.x - one.x - one.width) < 2);
  assert.match(page.url(), /beside=0/);
  await page.reload();
  await ready();
  await page.frameLocator('#second').locator('#range-more').waitFor();
  await page.locator('#beside').selectOption('1');
  await page.frameLocator('#second').locator('#link[data-state=live]').waitFor({ state: 'attached' });
  assert.ok(server.received.some((m) => m.kind === 'subscribe' && m.subscribe.radar === 1 && m.subscribe.newView));
  await page.locator('#beside').selectOption('');
  assert.equal(await page.locator('#second').count(), 0);
  assert.deepEqual(page.problems, []);
});

test('a set-up is kept by name, used, saved to a file and read from one', async () => {
  await open();
  await tab('Set-up');
  assert.equal(await page.locator('#setup-load').isDisabled(), true);
  const fill = (id, value) => page.locator(`#${id}`).fill(String(value));
  await fill('gain', 61);
  await page.waitForFunction(() => window.skerry.settings().gain === 61);
  await page.locator('#palette').click();
  await fill('setup-name', 'Harbour <b>night</b>');
  await page.locator('#setup-form button').click();
  await notice('Set-up kept in this browser: Harbour <b>night</b>');
  await page.locator('#palette').click();
  await fill('gain', 20);
  await page.waitForFunction(() => window.skerry.settings().gain === 20);
  await page.reload();
  await ready();
  await page.locator('#setup-load').click();
  await notice('Set-up in force');
  await page.waitForFunction(() => window.skerry.settings().gain === 61 && document.documentElement.dataset.palette === 'dusk');
  const [download] = await Promise.all([page.waitForEvent('download'), page.locator('#setup-download').click()]);
  assert.equal(download.suggestedFilename(), 'harbour-b-night-b.json');
  const text = readFileSync(await download.path(), 'utf8');
  assert.equal(JSON.parse(text).parts.receiver.gain, 61);
  await page.locator('#setup-delete').click();
  assert.equal(await page.locator('#setup-load').isDisabled(), true);
  await page.locator('#setup-file').setInputFiles({ name: 'photo.json', mimeType: 'application/json', buffer: Buffer.from('{"a": 1}') });
  await notice('photo.json: the file is no set-up of this console');
  await page.locator('#setup-file').setInputFiles({ name: 'own.json', mimeType: 'application/json', buffer: Buffer.from(text) });
  await page.waitForFunction(() => document.querySelector('#setup-list').value === 'browser:Harbour <b>night</b>');
  assert.deepEqual(page.problems, []);
});

test('a set-up is kept on the server, where another console uses and deletes it; a refusal is told', async () => {
  await open({ server: { setups: new Map([['<img src=x onerror=alert(1)>', '{"kind": "photo"}']]) } });
  const fill = (id, value) => page.locator(`#${id}`).fill(String(value));
  await tab('Set-up');
  await fill('gain', 61);
  await page.waitForFunction(() => window.skerry.settings().gain === 61);
  await fill('setup-name', 'Nacht \u00e4/../%');
  await page.locator('#setup-form button').click();
  await notice('Set-up kept on the server: Nacht \u00e4/../%');
  assert.equal(JSON.parse(server.setups.get('Nacht \u00e4/../%')).parts.receiver.gain, 61);
  await page.locator('#setup-where').selectOption('browser');
  await fill('setup-name', 'mine');
  await page.locator('#setup-form button').click();
  await notice('Set-up kept in this browser: mine');
  await fill('gain', 20);
  await page.waitForFunction(() => window.skerry.settings().gain === 20);

  await page.locator('#setup-where').selectOption('server');
  const kept = () => JSON.parse(server.setups.get('Nacht \u00e4/../%')).parts.receiver.gain;
  await fill('setup-name', 'Nacht \u00e4/../%');
  await page.locator('#setup-form button').click();
  await notice('once more replaces it');
  assert.deepEqual([kept(), await page.locator('#setup-name').inputValue()], [61, 'Nacht \u00e4/../%']);
  await page.locator('#setup-form button').click();
  await page.waitForFunction(() => document.querySelector('#setup-name').value === '');
  assert.equal(kept(), 20);
  await fill('gain', 30);
  await page.waitForFunction(() => window.skerry.settings().gain === 30);

  const other = await openConsole(browser, url);
  await other.getByRole('tab', { name: 'Set-up', exact: true }).click();
  assert.deepEqual(await other.locator('#setup-list option').allTextContents(), ['<img src=x onerror=alert(1)>', 'Nacht \u00e4/../%']);
  await other.locator('#setup-load').click();
  await other.locator('.notice', { hasText: 'the file is no set-up of this console' }).waitFor();
  await other.locator('#setup-list').selectOption({ label: 'Nacht \u00e4/../%' });
  await other.locator('#setup-load').click();
  await untilSet(server, (set) => set.view === 0 && set.gain === 20 && setsOf(server).at(-1) === set);
  server.refuse = { code: 4, text: 'to delete a set-up is for trainee' };
  await other.locator('#setup-delete').click();
  await other.locator('.notice', { hasText: 'to delete a set-up is for trainee' }).waitFor();
  server.refuse = null;
  await other.locator('#setup-delete').click();
  await other.waitForFunction(() => document.querySelectorAll('#setup-list option').length === 1);
  assert.equal(server.setups.size, 1);
  await other.context().close();
});

test('what instructors have is shown only where the console is said to be theirs; an exam is told', async () => {
  await open();
  await tab('Set-up');
  const part = page.locator('#instructor-part');
  assert.equal(await part.isVisible(), false);
  await page.locator('#is-instructor + span').click();
  await page.getByRole('button', { name: 'No', exact: true }).click();
  assert.deepEqual([await part.isVisible(), await page.locator('#is-instructor').isChecked()], [false, false]);
  await page.locator('#is-instructor + span').click();
  await page.getByRole('button', { name: 'Yes, the instructor\u2019s' }).click();
  await part.waitFor();
  await page.reload();
  await ready();
  await page.locator('#instructor > summary').click();
  await page.locator('#lock-all').click();
  await page.locator('#exam-sign').waitFor();
  assert.equal(await page.locator('#exam-sign').textContent(), 'Exam: set by the instructor');
  assert.equal(setsOf(server).at(-1).instructor, true);
  await page.locator('#lock-gain + span').click();
  await page.locator('#exam-sign').waitFor({ state: 'hidden' });
  await page.locator('#is-instructor + span').click();
  await part.waitFor({ state: 'hidden' });
  await page.waitForFunction(() => document.getElementById('sea').disabled && !document.getElementById('gain').disabled);
  await page.reload();
  await ready();
  assert.equal(await part.isVisible(), false);
  await page.goto(`${url}?instructor=1`);
  await ready();
  await part.waitFor();
});
