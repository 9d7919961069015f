// Who did what, on the instructor's page: the tab Log, on a mock audit.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { after, afterEach, before, test } from 'node:test';
import { launch } from '../browser.mjs';
import { openInstructor } from '../instructor_kit.mjs';

const AXE = readFileSync(createRequire(import.meta.url).resolve('axe-core/axe.min.js'), 'utf8');

let browser, kit;
before(async () => { browser = await launch(); });
after(() => browser?.close());
afterEach(async () => {
  await kit?.page.context().close();
  await kit?.server.stop();
  kit = null;
});

const FROM = 'console 192.0.2.5:4711';
const change = (n, more = {}) => ({
  n, utc: `2026-11-29T12:00:${String(n % 60).padStart(2, '0')}.000Z`, kind: 'change', who: 'Anna, trainee of Frida', from: FROM,
  what: 'radar 0 view 0: gain', before: String(n), after: String(n + 1), ...more,
});
const FEW = [
  { n: 1, utc: '2026-11-29T11:59:59.000Z', kind: 'server', what: 'skerryd begins' },
  change(2),
  change(3, { times: 7 }),
  { n: 4, utc: '2026-11-29T12:00:04.000Z', kind: 'refusal', from: 'HTTP 192.0.2.9:80', what: 'sign in: no user has this name and password' },
  { n: 5, utc: '2026-11-29T12:00:05.000Z', kind: 'request', who: 'Ben, instructor', from: FROM, what: 'record { action: STOP }', result: 'ok' },
];

async function open(audit, options = {}) {
  kit = await openInstructor(browser, { server: { audit, ...options.server }, page: options.page });
  const list = kit.page.locator('#log-list li');
  const rows = async (n) => {
    await kit.page.waitForFunction((count) => document.querySelectorAll('#log-list li').length === count, n);
    return list.evaluateAll((items) => items.map((item) => [...item.children].slice(1).map((part) => part.textContent).join(' | ')));
  };
  return { ...kit, audit: kit.server.audit, list, rows };
}

test('the newest entry comes first, and what comes while one looks is put on top', async () => {
  const { page, audit, rows } = await open({ entries: [...FEW] });
  assert.equal(audit.asked, undefined, 'nobody asks while nobody looks');
  await page.locator('#to-log').click();
  assert.deepEqual(await rows(5), [
    'Order | Ben, instructor | record { action: STOP } · ok from console 192.0.2.5:4711',
    'Refused | not signed in | sign in: no user has this name and password from HTTP 192.0.2.9:80',
    'Change | Anna, trainee of Frida | radar 0 view 0: gain: 3 → 4 (7 changes) from console 192.0.2.5:4711',
    'Change | Anna, trainee of Frida | radar 0 view 0: gain: 2 → 3 from console 192.0.2.5:4711',
    'Server | the server | skerryd begins',
  ]);
  assert.equal(await page.locator('#log-count').textContent(), '5 entries');
  audit.entries.push(change(6));
  assert.match((await rows(6))[0], /gain: 6 → 7 from/);
  assert.equal(audit.asked.at(-1).last, '200');
  assert.ok(audit.asked.some(({ after }) => after === '5'), 'only what is new is asked for');
  await page.locator('#to-ships').click();
  await page.waitForTimeout(100);
  const asked = audit.asked.length;
  await page.waitForTimeout(2200);
  assert.equal(audit.asked.length, asked, 'nobody asks after one has looked away');
  assert.deepEqual(page.problems, []);
});

test('it is bounded, and begins anew where more came than one answer holds or the server is another', async () => {
  const many = (from, count) => Array.from({ length: count }, (_, i) => change(from + i));
  const { page, audit, rows } = await open({ entries: many(1, 150) });
  await page.keyboard.press('5');
  await rows(150);
  audit.entries.push(...many(151, 120));
  assert.match((await rows(200))[0], /gain: 270 → 271 from/);
  assert.equal(await page.locator('#log-count').textContent(), 'the newest 200');
  audit.entries.push(...many(271, 900));
  await page.waitForFunction(() => document.querySelector('#log-list p').textContent.includes('1170 → 1171 '));
  assert.match((await rows(200)).at(-1), /gain: 971 → 972 from/, 'without a hole');
  audit.entries = FEW.slice(0, 2);
  await rows(2);
  assert.deepEqual(page.problems, []);
});

test('who and kind choose; by keys alone', async () => {
  const { page, audit, rows } = await open({ entries: [...FEW] });
  await page.locator('#to-exercise').focus();
  await page.keyboard.press('ArrowRight');
  await rows(5);
  await page.keyboard.press('Tab');
  assert.equal(await page.evaluate(() => document.activeElement.id), 'log-who');
  await page.keyboard.type('aNNa');
  assert.equal((await rows(2)).every((row) => row.includes('Anna')), true);
  await page.keyboard.press('Tab');
  assert.equal(await page.evaluate(() => document.activeElement.id), 'log-kind');
  await page.locator('#log-kind').selectOption({ label: 'Refusals' });
  await rows(0);
  await page.locator('#log-who').fill('192.0.2.9');
  await rows(1);
  assert.deepEqual([audit.asked.at(-1).who, audit.asked.at(-1).kind], ['192.0.2.9', 'refusal']);
  await page.locator('#log-kind').focus();
  await page.keyboard.press('Tab');
  assert.equal(await page.evaluate(() => document.activeElement.id), 'log-list', 'the list is scrolled by keys');
  assert.deepEqual(page.problems, []);
});

test('who may not is told so once, and not asked for again until she is another', async () => {
  const text = 'to see who did what is for instructor or admin';
  const { page, audit, rows } = await open({ entries: [...FEW], refuse: { status: 403, text } });
  await page.keyboard.press('5');
  await page.waitForFunction((words) => document.getElementById('log-problem').textContent === words, text);
  await page.waitForTimeout(2200);
  assert.equal(audit.asked.length, 1);
  delete audit.refuse;
  await page.evaluate(() => document.getElementById('help').showModal());
  await page.evaluate(() => { document.getElementById('access').hidden = false; });
  await page.locator('#token').fill('skerry_mate');
  await page.locator('#token').press('Tab');
  await page.keyboard.press('Escape');
  await rows(5);
  assert.equal(audit.asked.at(-1).bearer, 'Bearer skerry_mate');
  assert.equal(await page.locator('#log-problem').textContent(), '');
});

test('what is kept in memory alone, or waits for a disk, is said; and text from outside is text', async () => {
  const { page, audit, rows, server } = await open({ entries: [change(1, { what: '<b id=evil>x</b>', who: '<img src=x>' })], hasFile: false });
  await page.keyboard.press('5');
  assert.match((await rows(1))[0], /<img src=x> .*<b id=evil>x<\/b>/);
  assert.equal(await page.locator('#evil').count(), 0);
  assert.equal(await page.locator('#log-count').textContent(), '1 entry, in memory alone (no --audit)');
  const says = (words) => page.waitForFunction((w) => document.getElementById('log-problem').textContent.includes(w), words);
  Object.assign(audit, { hasFile: true, unwritten: 12 });
  await says('The disk takes nothing: 12 wait');
  audit.entries.push(change(2, { what: 'exercise', before: undefined, after: 'mark: "x"' }), change(3, { what: 'lock', before: 'gain', after: undefined }));
  assert.deepEqual((await rows(3)).slice(0, 2).map((row) => row.split(' | ')[2].split(' from ')[0]), ['lock: gain → nothing', 'exercise: mark: "x"']);
  server.audit = null;
  await says('This server keeps no audit');
  assert.deepEqual(page.problems.filter((problem) => !/404/.test(problem)), []);
});

for (const [width, height] of [[1280, 720], [820, 1180]]) {
  test(`at ${width}x${height} nothing is cut off, and axe-core finds nothing serious`, async () => {
    const { page, rows } = await open({ entries: [...FEW, ...Array.from({ length: 40 }, (_, i) => change(6 + i))] },
      { page: { viewport: { width, height } } });
    await page.keyboard.press('5');
    await rows(45);
    const wide = await page.evaluate(() => [...document.querySelectorAll('#tabs button, #log-list li *, #tab-log .filter *')]
      .filter((part) => part.scrollWidth > part.clientWidth + 1 && getComputedStyle(part).display !== 'inline').map((part) => part.outerHTML.slice(0, 80)));
    assert.deepEqual(wide.filter((html) => !html.includes('unseen')), []);
    await page.evaluate(AXE);
    const found = await page.evaluate(async () => (await window.axe.run('#panel')).violations
      .filter(({ impact }) => ['serious', 'critical'].includes(impact)).map(({ id, nodes }) => `${id}: ${nodes[0].html}`));
    assert.deepEqual(found, []);
    if (process.env.PICTURES) await page.screenshot({ path: `${process.env.PICTURES}/log-${width}.png` });
  });
}
