// The console when something goes wrong: the graphics, a script, the link, the server, a value, a name.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { PNG } from 'pngjs';
import { capture, openConsole, state, waitForScan } from '../browser.mjs';
import { eachTest } from '../each_test.mjs';
import { openSmall, restart, setsOf, SMALL, untilSet } from '../hands_kit.mjs';
import { MockServer } from '../mock_server.mjs';
import { targetList } from '../mock_targets.mjs';
import { waitFor } from '../targets_kit.mjs';

let browser, server, page;
eachTest((b) => { browser = b; }, () => { const opened = { page, server }; page = server = null; return opened; });
async function open(options) {
  ({ server, page } = await openSmall(browser, options));
}
const notice = (text) => page.locator('.notice', { hasText: text }).first().waitFor();
const setSlider = (id, value) => page.locator(`#${id}`).fill(String(value));
const isOff = (id) => page.locator(`#${id}`).evaluate((e) => e.closest('[inert]') !== null);
const untilOff = (id, off) => page.waitForFunction(([i, o]) => (document.getElementById(i).closest('[inert]') !== null) === o, [id, off], { timeout: 10000 });

// Mean of red, green and blue in the middle of the picture.
async function middle() {
  const box = await page.locator('#ppi').boundingBox();
  const png = PNG.sync.read(await page.screenshot({ clip: { x: box.x + box.width * 0.3, y: box.y + box.height * 0.55, width: 100, height: 100 } }));
  return png.data.reduce((sum, v, i) => (i % 4 < 3 ? sum + v : sum), 0) / (png.data.length * 0.75);
}

test('a server that stood still is told, though no spoke is lost; standby is no standstill', async () => {
  await open();
  await waitForScan(page);
  await page.evaluate(() => window.skerry.showTab('set-up'));
  const gaps = page.locator('#gaps');
  assert.equal(await gaps.textContent(), '0');
  server.stoodStillS += 10.4;
  await notice('No spokes were made for 10.4 s');
  await page.locator('#gaps', { hasText: '1, 10.4 s in all' }).waitFor();
  assert.equal(await page.locator('#lost').textContent(), '0');
  const change = async (standby) => { server.radarSettings.standby = standby; server.change({}); await page.waitForFunction((s) => window.skerry.state().standby === s, standby); };
  await change(true);
  server.stoodStillS += 30;
  await change(false);
  await waitForScan(page);
  assert.equal(await gaps.textContent(), '1, 10.4 s in all');
});

test('lost graphics are told over a dark picture, and it comes back by itself', async () => {
  await open();
  await waitForScan(page);
  await page.evaluate(() => {
    window.lose = document.querySelector('#echoes').getContext('webgl2').getExtension('WEBGL_lose_context');
    window.lose.loseContext();
  });
  await page.locator('#alarm', { hasText: 'taken the graphics away' }).waitFor();
  assert.ok(await middle() < 60, `dark, not ${await middle()}`);
  assert.equal(await isOff('gain'), false);
  await page.evaluate(() => window.lose.restoreContext());
  await page.locator('#alarm').waitFor({ state: 'hidden' });
  await waitForScan(page);
  assert.equal(await page.locator('#echoes').evaluate((canvas) => getComputedStyle(canvas).visibility), 'visible');
  assert.deepEqual(page.problems, []);
});

test('what was kept of the picture looks as one that is drawn anew', async (t) => {
  await open();
  await page.locator('#afterglow').fill('50');
  await waitForScan(page);
  // Time stands still.
  const { scan } = await state(page);
  await page.evaluate((last) => window.skerry.holdAfter(last), scan);
  await page.waitForFunction((last) => window.skerry.state().newestScan > last + 1, scan);
  const kept = await capture(page);
  for (let i = 0; i < 3; ++i) {
    await page.keyboard.press('p');
    await page.evaluate(() => window.skerry.drawn(2));
  }
  const anew = await capture(page);
  let worst = 0;
  kept.data.forEach((byte, i) => { worst = Math.max(worst, Math.abs(byte - anew.data[i])); });
  t.diagnostic(`at most ${worst} of 255 apart`);
  assert.ok(worst <= 8, `${worst} of 255`);
});

test('a browser that cannot draw at all says why, and controls and numbers work', async () => {
  server = new MockServer({ ...SMALL, headingDeg: 37 });
  const url = await server.start();
  const context = await browser.newContext();
  await context.addInitScript(() => {
    const original = HTMLCanvasElement.prototype.getContext;
    HTMLCanvasElement.prototype.getContext = function (kind, ...rest) { return kind === 'webgl2' || this.id === 'echoes' ? null : original.call(this, kind, ...rest); };
  });
  page = await context.newPage();
  await page.goto(url);
  await page.locator('#alarm', { hasText: 'cannot draw the radar picture: there is no 2D canvas' }).waitFor();
  await page.waitForFunction(() => document.getElementById('heading').textContent === '037.0');
  await setSlider('gain', 63);
  await untilSet(server, (set) => set.gain === 63);
  await page.keyboard.press('-');
  await untilSet(server, (set) => set.rangeNm === 3);
  await page.waitForFunction(() => window.skerry.state().received > 500);
});

test('a fault of a script is told once, whatever comes after it, and offers to reload', async () => {
  await open();
  await page.evaluate(() => { for (let i = 0; i < 200; ++i) setTimeout(() => { throw new Error(`the drawing <b>failed</b> ${i}`); }); });
  const bar = page.locator('#script-error');
  await bar.waitFor();
  assert.match(await bar.locator('p').textContent(), /the drawing <b>failed<\/b> 0\. What is shown may be wrong/);
  await page.waitForFunction(() => /199 more/.test(document.querySelector('#script-error').textContent));
  assert.equal(await page.locator('#script-error').count(), 1);
  await bar.getByRole('button', { name: 'Close' }).click();
  await page.evaluate(() => { Promise.reject(new TypeError('promised in vain')); });
  await page.locator('#script-error', { hasText: 'promised in vain' }).waitFor();
  await page.locator('#script-error').getByRole('button', { name: 'Reload' }).click();
  await bar.waitFor({ state: 'detached' });
});

test('controls are off while the server is not there and while nothing is known of the radar, and come back with the focus', async () => {
  await open();
  await page.locator('#gain').focus();
  const { port } = server;
  await server.stop();
  await untilOff('gain', true);
  for (const id of ['range', 'transmit-off', 'radar', 'pulse', 'order-course']) assert.equal(await isOff(id), true, id);
  assert.equal(await isOff('afterglow'), false, 'what needs no server goes on');
  await page.keyboard.press('+');
  await notice('Not connected');
  // A server that greets, but tells nothing of the radar.
  server = new MockServer({ ...SMALL, port, refuse: null });
  const told = server.views;
  server.views = new Map();
  await server.start();
  await page.waitForFunction(() => window.skerry.state().connection === 'live');
  await untilOff('radar', false);
  assert.equal(await isOff('gain'), true);
  server.views = told;
  await page.locator('#radar').selectOption('1');
  await untilOff('gain', false);
  assert.equal(await page.evaluate(() => document.activeElement.id !== ''), true);
});

test('the focus is where it was after a break', async () => {
  await open();
  await page.locator('#gain').focus();
  server = await restart(server);
  await page.waitForFunction(() => document.documentElement.hasAttribute('data-off'));
  await page.waitForFunction(() => !document.documentElement.hasAttribute('data-off'), null, { timeout: 10000 });
  assert.equal(await page.evaluate(() => document.activeElement.id), 'gain');
});

test('the console is back within 2 s of the server, with its own view and zones as they were', async (t) => {
  const zone = { number: 2, kind: 1, innerNm: 1, outerNm: 2.5, fromDeg: 30, toDeg: 90, relative: false };
  await open({ server: { targets: targetList({ plots: 500 }) } });
  await page.locator('input[name=view][value=own] + span').click();
  await page.waitForFunction(() => window.skerry.settings()?.view === 1);
  await setSlider('gain', 41);
  await page.locator('#range').selectOption('1.5');
  await page.locator('#doppler').selectOption('1');
  await page.keyboard.press('e');
  await page.waitForFunction(() => { const s = window.skerry.settings(); return s.gain === 41 && s.rangeNm === 1.5 && s.doppler === 1; });
  server.showTargets({ zones: [zone] });
  await page.waitForFunction(() => window.skerry.targets().list.zones.length === 1);
  await server.stop();
  // Long enough that the page has tried some times.
  const { port } = server;
  await page.waitForFunction(() => document.querySelector('#link').dataset.state === 'waiting');
  await page.evaluate(() => new Promise((resolve) => setTimeout(resolve, 6000)));
  server = new MockServer({ ...SMALL, port, targets: targetList({ plots: 3 }) });
  await server.start();
  const backMs = Date.now();
  await page.waitForFunction(() => window.skerry.state().connection === 'live', null, { polling: 20 });
  const tookMs = Date.now() - backMs;
  t.diagnostic(`connected ${tookMs} ms after the server's return`);
  assert.ok(tookMs < 2300, `${tookMs} ms`);
  await page.waitForFunction(() => { const s = window.skerry.settings(); return s?.view === 1 && s.gain === 41 && s.rangeNm === 1.5 && s.doppler === 1; });
  assert.deepEqual([server.settings.gain, server.settings.rangeNm], [50, 6], 'the shared view is as it was');
  await waitFor(() => server.targetOrders.length > 0, 'the zones have not come back');
  assert.equal(server.targetOrders.length, 1);
  assert.deepEqual(server.targetOrders[0].zones.map((each) => ({ relative: false, ...each })), [zone]);
  assert.ok(await page.locator('#ebl').isChecked());
});

test('a refused value says so beside its control for some seconds, and as a notice', async () => {
  await open();
  server.refuse = { code: 2, text: 'gain is 0 to 42 <i>today</i>' };
  await setSlider('gain', 90);
  await notice('gain is 0 to 42 <i>today</i>');
  const note = page.locator('#gain').locator('xpath=ancestor::*[following-sibling::p[contains(@class, "refusal")]][1]/following-sibling::p[contains(@class, "refusal")][1]');
  assert.equal(await note.textContent(), 'refused: gain is 0 to 42 <i>today</i>');
  const [row, beside] = [await page.locator('#gain').boundingBox(), await note.boundingBox()];
  assert.ok(beside.y >= row.y && beside.y - row.y - row.height < 30, 'under the slider');
  assert.equal(await page.locator('#gain').inputValue(), '50');
  await page.locator('#order-course').fill('123');
  await page.locator('#orders button').click();
  await page.locator('#orders + .refusal').waitFor();
  assert.equal(await page.locator('#order-course').inputValue(), '123', 'an order is not typed twice');
  await page.waitForFunction(() => !document.querySelector('p.refusal'), null, { timeout: 12000 });
});

test('a range beyond what there is says why nothing follows', async () => {
  await open();
  await page.locator('input[name=view][value=own] + span').click();
  await page.waitForFunction(() => window.skerry.settings()?.view === 1);
  const before = setsOf(server).length;
  await page.locator('#range-more').click({ force: true });  // aria-disabled, and says why
  await notice('Own views reach as far as the radar\u2019s range, 6 NM');
  await page.keyboard.press('+');
  await notice('6 NM (2×)');
  assert.equal(setsOf(server).length, before);
  server.change({ rangeNm: 96 });
  await page.locator('input[name=view][value=shared] + span').click();
  await page.waitForFunction(() => window.skerry.settings()?.view === 0 && document.getElementById('range').value === '96');
  await page.locator('#range-more').click({ force: true });  // aria-disabled, and says why
  await notice('96 NM is the longest range');
});

test('another server is told: its protocol, its version, its scenario, its radars', async () => {
  await open();
  await page.locator('#radar').selectOption('1');
  await page.waitForFunction(() => window.skerry.state().radar === 1);
  const problem = page.locator('#server-problem');
  server = await restart(server, { ships: ['Skua'], helloMore: { scenario: 'Dover', protocolVersion: 2 } });
  await problem.getByText('This server is newer than this page: it speaks version 2').waitFor();
  await notice('Another scenario: Dover');
  await notice('Radar 1 is there no more: Skua is shown');
  await page.waitForFunction(() => window.skerry.state().radar === 0 && window.skerry.settings() !== null);
  server = await restart(server, { helloMore: { protocolVersion: 0 } });
  await problem.getByText('This server is older than this page: it speaks version 0').waitFor();
  server = await restart(server, { helloMore: { server: 'mock 2.0' } });
  await problem.getByText('The server is now mock 2.0; this page is of mock 1.0').waitFor();
  await problem.getByRole('button').click();
  await page.waitForFunction(() => window.skerry && document.querySelector('#server').textContent.includes('mock 2.0'));
  assert.equal(await problem.isVisible(), false);
});

test('a server that is open to others without a guard is told by an open padlock', async () => {
  const warning = 'Not secure: this server is open to other hosts without users.';
  await open({ server: { helloMore: { warning } } });
  const sign = page.locator('#insecure');
  await sign.waitFor();
  assert.equal(await sign.getAttribute('title'), warning);
  await page.locator('#link').getByText('Connected').waitFor();  // which it leaves as it is
  const [lamp, box] = [await page.locator('#link').boundingBox(), await sign.boundingBox()];
  assert.ok(box.x >= lamp.x && box.x + box.width <= lamp.x + lamp.width, 'it is within its place');
  server = await restart(server, { helloMore: {} });
  await sign.waitFor({ state: 'detached' });
});

test('hostile names and a wrong clock change neither the page nor its layout', async () => {
  const names = ['<img src=x onerror="window.hit=1"><script>window.hit=1</script>', 'x'.repeat(10240), '\u202egnol si eman siht\u202c \u05e9\u05dc\u05d5\u05dd'];
  server = new MockServer({ ...SMALL, ships: names, helloMore: { scenario: `\u202e${'y'.repeat(10240)}`, server: '<b>mock</b>' } });
  const url = await server.start();
  for (const [path, width] of [['', 1280], ['', 390], ['conning', 1280]]) {
    const context = await browser.newContext({ viewport: { width, height: 844 } });
    page = await context.newPage();
    await page.addInitScript(() => { const now = Date.now; Date.now = () => now() - 40 * 365 * 86400e3; });
    await page.goto(url + path);
    await page.waitForFunction(() => window.skerry && document.querySelector('#radar').options.length === 3);
    const seen = await page.evaluate(() => ({
      hit: window.hit, wide: document.documentElement.scrollWidth, made: document.querySelectorAll('img, option script, b').length,
      options: [...document.querySelectorAll('#radar option')].map((option) => option.textContent),
    }));
    assert.equal(seen.hit, undefined);
    assert.equal(seen.wide, width);
    if (path === '') {
      assert.ok(seen.options.every((text) => [...text].length <= 62 && !text.includes('\u202e')), JSON.stringify(seen.options));
      assert.ok(seen.options[0].startsWith('<img src=x'), 'text, as it is');
      assert.ok((await page.locator('#server').textContent()).length < 130);
      await page.waitForFunction(() => window.skerry.lastScan() !== null);
      assert.equal((await state(page)).connection, 'live');
      if (width === 1280) {
        server.refuse = { code: 2, text: `\u202e${'z'.repeat(10240)}` };
        await setSlider('gain', 20);
        await page.locator('.notice').first().waitFor();
        assert.ok((await page.locator('.notice').first().boundingBox()).height < 140);
        server.refuse = null;
      }
    }
    if (path !== 'conning') await context.close();
  }
});

test('who has a token says so before anything else, and asks anew for what was refused without', async () => {
  server = new MockServer({ ...SMALL, mayLook: (token) => token === 'geheim' });
  page = await openConsole(browser, await server.start());
  await page.locator('#token').waitFor();
  const seen = server.received.length;
  await page.locator('#token').fill('geheim');
  await page.locator('#token').press('Tab');
  await page.waitForFunction(() => window.skerry.settings()?.gain === 50);
  assert.deepEqual(server.received.slice(seen, seen + 2).map((m) => m.kind), ['signIn', 'subscribe']);
});

const ANNA = { users: { Anna: { password: 'correct horse', role: 'instructor' } }, mayLook: (token) => token === 'of Anna' };

test('who has no token signs in by name and password, sees who she is, and signs out', async () => {
  server = new MockServer({ ...SMALL, ...ANNA });
  page = await openConsole(browser, await server.start());
  const name = page.getByLabel('Name', { exact: true }), password = page.getByLabel('Password', { exact: true }), go = page.getByRole('button', { name: 'Sign in' });
  await name.fill('Anna');
  await password.fill('incorrect');
  await go.click();
  await page.getByText('No user has this name and password').waitFor();
  server.loginStatus = 429;
  await go.click();
  await page.getByText('Too many sign-ins from this host').waitFor();
  await password.fill('correct horse');
  await password.press('Enter');
  await page.locator('#signed-in', { hasText: 'Anna \u00b7 instructor \u00b7 until' }).waitFor();
  assert.equal(await go.isVisible(), false);
  assert.equal(await page.locator('#token').isVisible(), false);
  await waitForScan(page);
  // The tab knows her after a reload, too.
  await page.reload();
  await page.locator('#signed-in', { hasText: 'Anna' }).waitFor();
  await waitForScan(page);
  await page.getByRole('button', { name: 'Sign out' }).click();
  await go.waitFor();
  // What she was allowed does not go on: the link is a new one, and has been refused.
  await waitFor(() => server.clients.size === 1 && [...server.clients].every(({ radar, token }) => radar === null && !token), 'nobody looks any more');
  assert.deepEqual(server.logins.filter(({ method }) => method === 'DELETE').map(({ bearer }) => bearer), ['Anna']);
  assert.equal(await page.evaluate(() => sessionStorage.getItem('skerry.token')), '');
  assert.equal(await password.inputValue(), '');
});

test('a trainee signs in by the code of her class, and is aboard her ship', async () => {
  server = new MockServer({ ...SMALL, classCode: '123456', mayLook: (token) => token === 'of Kim' });
  page = await openConsole(browser, await server.start());
  const name = page.getByLabel('Name', { exact: true }), code = page.getByLabel('Class code', { exact: true }), go = page.getByRole('button', { name: 'Sign in' });
  await name.fill('Kim');
  assert.equal(await page.locator('#sign-in-password').isVisible(), false);
  await code.fill('654321');
  await go.click();
  await page.getByText('No class has this code now').waitFor();
  await code.fill('123 456');
  await code.press('Enter');
  await page.locator('#signed-in', { hasText: 'Kim (class) \u00b7 trainee \u00b7 Gannet' }).waitFor();
  await waitForScan(page);
  assert.equal((await state(page)).radar, 1);
  await page.reload();
  await page.locator('#signed-in', { hasText: 'Kim' }).waitFor();
  await page.waitForFunction(() => window.skerry.state().radar === 1 && window.skerry.settings() !== null);
});

test('on the con page, too, a trainee is aboard her ship', async () => {
  server = new MockServer({ ...SMALL, classCode: '123456', mayLook: (token) => token === 'of Kim' });
  const url = await server.start();
  page = await (await browser.newContext()).newPage();
  await page.goto(`${url}conning`);
  await page.locator('#sign-in-name').fill('Kim');
  await page.locator('#sign-in-code').fill('123456');
  await page.locator('#sign-in').click();
  await page.locator('#signed-in', { hasText: 'Kim (class)' }).waitFor();
  await page.waitForFunction(() => window.skerry.state().radar === 1 && window.skerry.state().ship?.radar === 1);
  assert.equal(server.received.findLast(({ kind }) => kind === 'subscribe').subscribe.radar, 1);
});

test('who has a password needs no class code, and the other way round', async () => {
  server = new MockServer({ ...SMALL, ...ANNA, classCode: '123456' });
  page = await openConsole(browser, await server.start());
  const required = () => page.evaluate(() => ['name', 'password', 'code'].map((each) => document.getElementById(`sign-in-${each}`).required));
  await page.locator('#sign-in-code').waitFor();
  assert.deepEqual(await required(), [true, true, true]);
  await page.locator('#sign-in-code').fill('1');
  assert.deepEqual(await required(), [true, false, true]);
  await page.locator('#sign-in-code').fill('');
  await page.locator('#sign-in-name').fill('Anna');
  await page.locator('#sign-in-password').fill('correct horse');
  assert.deepEqual(await required(), [true, true, false]);
  await page.locator('#sign-in').click();
  await page.locator('#signed-in', { hasText: 'Anna' }).waitFor();
});

test('a browser that keeps no cookie has a token in its tab', async () => {
  server = new MockServer({ ...SMALL, ...ANNA, losesCookies: true });
  page = await openConsole(browser, await server.start());
  await page.locator('#sign-in-name').fill('Anna');
  await page.locator('#sign-in-password').fill('correct horse');
  await page.locator('#sign-in').click();
  await page.locator('#signed-in', { hasText: 'Anna' }).waitFor();
  await waitForScan(page);
  assert.equal(await page.evaluate(() => sessionStorage.getItem('skerry.token')), 'of Anna');
  assert.deepEqual(server.logins.filter(({ method }) => method === 'POST').map(({ body }) => JSON.parse(body).cookie), [true, undefined]);
});

test('whose session has ended is asked again', async () => {
  server = new MockServer({ ...SMALL, ...ANNA });
  page = await openConsole(browser, await server.start());
  await page.locator('#sign-in-name').fill('Anna');
  await page.locator('#sign-in-password').fill('correct horse');
  await page.locator('#sign-in').click();
  await page.locator('#signed-in', { hasText: 'Anna' }).waitFor();
  // A server that knows her no more, as after its restart.
  server = await restart(server, { users: { Tom: { password: 'battery staple', role: 'trainee' } }, mayLook: (token) => token === 'of Tom' });
  await page.locator('#sign-in').waitFor();
  assert.equal(await page.locator('#signed-in').isVisible(), false);
});

for (const path of ['instructor', 'conning']) {
  test(`the page ${path} asks for name and password, too`, async () => {
    server = new MockServer({ ...SMALL, ...ANNA });
    const url = await server.start();
    page = await (await browser.newContext()).newPage();
    await page.goto(url + path);
    await page.locator('#sign-in-name').fill('Anna');
    await page.locator('#sign-in-password').fill('correct horse');
    await page.getByRole('button', { name: 'Sign in' }).click();
    await page.locator('#signed-in', { hasText: 'Anna' }).waitFor();
  });
}
