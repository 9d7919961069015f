// The console in German: no English is left over, everything has its room at every size, and the choice of a language is kept.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { openConsole } from '../browser.mjs';
import { eachTest } from '../each_test.mjs';
import { openSmall } from '../hands_kit.mjs';
import { faultsOfPage, speaker, textsOfPage } from '../language_kit.mjs';
import { MockServer } from '../mock_server.mjs';
import { ais, alert, target, targetList } from '../mock_targets.mjs';

let browser, server, page;
eachTest((b) => { browser = b; }, () => { const opened = { page, server }; page = server = null; return opened; });

const MOTION = { courseDeg: 90, speedKn: 8, relativeCourseDeg: 120, relativeSpeedKn: 14, cpaNm: 0.3, tcpaMin: 6 };
const TRIAL = { order: { courseDeg: 20, speedKn: 10, delayMin: 1, turnRateDegMin: 0, accelerationKnMin: 0 }, beginsS: 30, outcomes: [{ target: 1, cpaNm: 2, tcpaMin: 7, isDangerous: false }] };
const LIST = {
  tracked: 2, aisLeftOut: 2,
  zones: [{ number: 1, kind: 0, innerNm: 1, outerNm: 2, fromDeg: 10, toDeg: 60, relative: true }, { number: 2, kind: 1, innerNm: 1, outerNm: 2, fromDeg: 0, toDeg: 0, relative: false }],
  targets: [target(1, 90, 3, 2, { ...MOTION, isDangerous: true }), target(2, 10, 2, 0), target(3, 200, 4, 3, { isReference: true }), target(4, 300, 4, 4)],
  ais: [ais(211000001, 45, 2, { name: 'FULMAR', courseDeg: 30, speedKn: 5 }), ais(211000002, 150, 2, { name: 'GANNET', isActivated: true, isLost: true })],
  alerts: [alert(3044, 1, 2), alert(3052, 4, 1, { state: 2, title: 'Lost target', text: 'Target 4', escalations: 2 }), alert(3043, 1, 0, { category: 'C', title: 'Capacity', text: 'nearly full' })],
};
const RECORDER = { phase: 1, file: 'a.skerry', folder: '/recordings', fileBytes: 5e6, totalBytes: 5e6, seconds: 12, bytesPerSecond: 4e5, freeBytes: 80e9,
  spokes: 100, spokesLost: 0, marks: 1, problem: '', inputsOnly: true };
// Names, the server's words, and the languages in themselves.
const OUTSIDE = ['Fulmar', 'Gannet', 'X-band', 'FULMAR', 'GANNET', 'mock', 'closed form', 'CPA/TCPA', 'Lost target', 'Capacity', 'nearly full', 'Target 1: near', 'Target 4',
  'GNSS', '/recordings/a.skerry', 'a.skerry', 'GeoJSON', 'English', 'Deutsch'];
const isGerman = speaker('de', OUTSIDE);
const TABS = ['radar', 'targets', 'tools', 'chart', 'set-up'];

async function openGerman(width, height, finger, trial) {
  ({ server, page } = await openSmall(browser, { query: '?lang=de&instructor=1',
    server: { recorder: RECORDER, targets: targetList({ ...LIST, trial }), ownShipMore: { noWind: true } }, page: { viewport: { width, height }, hasTouch: finger } }));
  page.lacking = [];
  page.on('console', (message) => { if (message.text().includes('lacks')) page.lacking.push(message.text()); });
  await page.waitForFunction(() => window.skerry.targets().shown.length > 3);
  await page.evaluate((keys) => {
    for (const each of document.querySelectorAll('details')) each.open = true;
    for (const id of ['ebl2', 'vrm2', ...keys]) document.getElementById(id).click();
  }, ['list-t1', 'list-t3', 'list-a211000002']);
  await page.waitForFunction(() => document.querySelectorAll('#target-data thead th').length === 3);
}

// Runs look() with each dialog of the console.
async function withDialogs(look) {
  for (const [id, tab, open] of [['help', 'radar', '#help-open'], ['defaults-ask', 'radar', '#defaults'], ['screen-size', 'targets', '#screen-size-open'], ['cancel-all-question', 'targets', '#cancel-all']]) {
    await page.evaluate(([name, button]) => { window.skerry.showTab(name); document.querySelector(button).click(); }, [tab, open]);
    await look(id);
    await page.evaluate((dialog) => document.getElementById(dialog).close('no'), id);
  }
  await page.evaluate(() => { const box = document.getElementById('is-instructor'); if (box.checked) box.click(); box.click(); });
  await look('instructor-ask');
  await page.evaluate(() => document.getElementById('instructor-ask').close('yes'));
}

const isEnglishLeft = async (where) => assert.deepEqual((await textsOfPage(page)).filter((text) => !isGerman(text)), [], where);

test('in German no text of any tab, dialog or mode is English', async () => {
  assert.ok(isGerman('Nord oben') && isGerman('22:13 UTC · Kategorie A · 2× gesteigert') && isGerman('1.5 NM'));
  for (const text of ['North up', 'Nord up', 'Regen heavy', 'Lost']) assert.ok(!isGerman(text), text);
  await openGerman(1280, 720, false, TRIAL);
  assert.deepEqual(await page.evaluate(() => [document.documentElement.lang, document.title, document.getElementById('language').value]), ['de', 'Skerry-Radar', 'de']);
  assert.equal(await page.getByRole('tab', { name: 'Ziele' }).isVisible(), true);
  assert.equal(await page.getByRole('button', { name: 'Größerer Bereich' }).getAttribute('title'), 'Größerer Bereich (+)');
  for (const tab of TABS) {
    await page.evaluate((name) => window.skerry.showTab(name), tab);
    await isEnglishLeft(tab);
  }
  await withDialogs(isEnglishLeft);
  // What is said when something is done.
  for (const [what, press] of [['off-centre', ['o']], ['MOB', ['o', 'o']], ['modes', ['b', 'Shift+a', 'Escape', 'Shift+I', 'p', 'x', 'l']], ['notices', ['Home', 'q', 'Shift+q', ',', 'm', 'Delete']]]) {
    for (const key of press) await page.keyboard.press(key);
    await isEnglishLeft(what);
  }
  await page.evaluate(() => {
    document.getElementById('map-position').requestSubmit();       // positions that are refused
    document.querySelector('input[name=motion][value=true]').click();
    document.querySelector('input[name=orientation][value=head]').click();
    document.querySelector('#zone-form').requestSubmit();
    document.querySelector('.key[data-action=gain-more], #help-open').click();
  });
  await isEnglishLeft('refusals');
  server.settings.standby = true;
  server.change({ gain: 40 });
  await server.stop();
  await page.waitForFunction(() => document.getElementById('alarm').textContent === 'Verbindung verloren');
  await isEnglishLeft('without the server');
  assert.deepEqual(page.lacking, [], 'entries that are lacking');
});

test('in German nothing is cut off, off the screen or on another at any size', async () => {
  const faults = [];
  for (const [finger, trial, sizes] of [[false, null, [[1280, 720], [820, 1180]]], [true, TRIAL, [[820, 1180], [390, 844]]]]) {
    await openGerman(...sizes[0], finger, trial);
    for (const [width, height] of sizes) {
      await page.setViewportSize({ width, height });
      await page.waitForFunction((side) => document.getElementById('ppi').clientWidth >= side - 1, Math.min(width, height) * 0.8);
      const check = async (where) => {
        for (const fault of await faultsOfPage(page)) faults.push(`${where} at ${width}x${height}${finger ? ' by finger' : ''}: ${fault}`);
      };
      for (const tab of TABS) {
        await page.evaluate((name) => window.skerry.showTab(name), tab);
        await check(tab);
      }
      await withDialogs(check);
    }
    // What has no room is found.
    await page.evaluate(() => {
      window.skerry.showTab('radar');
      document.getElementById('latitude').style.cssText = 'position: relative; left: 5rem';
      document.getElementById('off-centre').style.cssText = 'min-width: 0; max-width: 2rem';
      document.querySelector('label:has(#gain) span').textContent = 'Wievielverstärkungsregelungsbezeichnung';
    });
    const found = (await faultsOfPage(page)).join('\n');
    assert.match(found, /latitude .* lies on longitude/);
    assert.match(found, /Wievielverstärkung.* lies on|gain has no length/);
    assert.match(found, /off-centre "Dezentriert" is cut off/);
    await page.context().close();
    await server.stop();
  }
  assert.deepEqual(faults, []);
});

const words = () => page.evaluate(() => ({ lang: document.documentElement.lang, tab: document.getElementById('tab-targets').textContent, asked: new URLSearchParams(location.search).get('lang') }));
const notice = (text) => page.locator('#notices', { hasText: text }).waitFor();
const loaded = (lang) => page.waitForFunction((code) => window.skerry !== undefined && document.documentElement.lang === code, lang);

test('the language is chosen by the address, in the tab Set-up, and by the browser; one that is unknown is English', async () => {
  let url;
  ({ server, page, url } = await openSmall(browser, { query: '?lang=de' }));
  assert.deepEqual(await words(), { lang: 'de', tab: 'Ziele', asked: 'de' });
  const files = [];
  page.on('request', (request) => { if (request.url().includes('/languages/')) files.push(request.url()); });
  await page.getByRole('tab', { name: 'Setup' }).click();
  await page.getByLabel('Sprache').selectOption({ label: 'English' });
  await loaded('en');
  assert.deepEqual(await words(), { lang: 'en', tab: 'Targets', asked: null });
  assert.deepEqual(files, [], 'English needs no file');
  await page.reload();
  await loaded('en');
  await page.getByLabel('Language').selectOption('de');
  await loaded('de');
  assert.deepEqual(await words(), { lang: 'de', tab: 'Ziele', asked: null });
  assert.equal(files.length, 1);
  await page.goto(`${url}?lang=en`);
  await loaded('en');
  await page.goto(`${url}?lang=xx`);  // what was chosen last
  await loaded('de');
  await notice('Diese Konsole hat keine Sprache xx');
  assert.deepEqual(page.problems, []);
  await page.context().close();
  page = await openConsole(browser, `${url}?lang=xx`);
  await notice('This console has no language xx');
  assert.deepEqual(await words(), { lang: 'en', tab: 'Targets', asked: 'xx' });
  await page.context().close();
  page = await openConsole(browser, url, { locale: 'de-AT' });
  assert.deepEqual(await words(), { lang: 'de', tab: 'Ziele', asked: null });
});

test('a file that is broken, missing or lacks entries leaves English, and the console works', async () => {
  server = new MockServer({ rpm: 60, spokes: 512, cells: 256 });
  const url = await server.start();
  for (const [answer, tab, lang] of [[{ body: '{ "Targets": ' }, 'Targets', 'en'], [{ status: 404 }, 'Targets', 'en'],
    [{ body: '{ "Targets": "Ziele", "Radar": 7, "Chart": null }' }, 'Ziele', 'de']]) {
    const context = await browser.newContext();
    page = await context.newPage();
    const told = [];
    page.on('console', (message) => told.push(`${message.type()} ${message.text()}`));
    page.on('pageerror', (error) => told.push(`error ${error}`));
    await page.route('**/languages/de.json', (route) => route.fulfill({ contentType: 'application/json', ...answer }));
    await page.goto(`${url}?lang=de`);
    await loaded(lang);
    await page.waitForFunction(() => window.skerry.state().received > 0);
    assert.equal((await words()).tab, tab, answer.body);
    if (lang === 'en') await notice('The file of this language cannot be read, the page is in English');
    else assert.ok(told.includes('info languages/de.json lacks: Chart') && told.includes('info languages/de.json lacks: Radar'), told.slice(0, 5).join('\n'));
    assert.equal(await page.getByRole('tab', { name: 'Chart' }).isVisible(), true);
    assert.deepEqual(told.filter((text) => text.startsWith('error') && !text.includes('Failed to load resource')), []);
    await context.close();
  }
});
