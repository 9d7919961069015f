// Where things are: at every size the picture is as large as can be, nothing is cut off, nothing scrolls the page, and with a
// finger every control is a finger wide. No serious finding of axe-core.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { test } from 'node:test';
import { openConsole } from '../browser.mjs';
import { eachTest } from '../each_test.mjs';
import { openSmall } from '../hands_kit.mjs';
import { MockExercise } from '../mock_exercise.mjs';
import { MockServer } from '../mock_server.mjs';

const AXE = readFileSync(createRequire(import.meta.url).resolve('axe-core/axe.min.js'), 'utf8');
const RECORDER = { phase: 0, file: '', folder: '/recordings', fileBytes: 0, totalBytes: 0, seconds: 0, bytesPerSecond: 0, freeBytes: 80e9,
  spokes: 0, spokesLost: 0, marks: 0, problem: '', inputsOnly: false };

let browser, server, page;
eachTest((b) => { browser = b; }, () => { const opened = { page, server }; page = server = null; return opened; });
// With everything unfolded.
async function open(width, height, finger, options = {}) {
  ({ server, page } = await openSmall(browser, { query: '?instructor=1', server: { recorder: { ...RECORDER } },
    page: { viewport: { width, height }, hasTouch: finger, frameMs: 250 }, ...options }));
  await page.evaluate(() => { for (const each of document.querySelectorAll('details')) each.open = true; });
}

// What is wrong with the controls that are shown: outside their part of the panel, too small, text cut off, beneath another.
const faults = (least) => page.evaluate((px) => {
  const found = [];
  const screen = { left: 0, right: innerWidth };
  const shown = [...document.querySelectorAll('button, a[href], select, input, summary')].filter((each) => each.offsetParent && !each.closest('dialog, [hidden]'));
  for (const each of shown) {
    // A box that is drawn by its label is as large as that.
    const drawn = each.matches('[type=checkbox], [type=radio]') ? each.closest('label') : each;
    const box = drawn.getBoundingClientRect(), name = each.id || each.value || each.textContent;
    if (box.left < screen.left - 0.5 || box.right > screen.right + 0.5) found.push(`${name} is off the screen: ${box.left} to ${box.right}`);
    if (box.width < px - 0.5 || box.height < px - 0.5) found.push(`${name} is ${box.width.toFixed(1)} x ${box.height.toFixed(1)}`);
    if (drawn.scrollWidth > drawn.clientWidth + 1 && !drawn.matches('input, select')) found.push(`${name} is cut off`);
    if (each.matches('select')) {
      // What the list would be as wide as, with nothing but what it shows.
      const alone = each.cloneNode(false);
      alone.removeAttribute('id');
      alone.append(new Option(each.selectedOptions[0]?.text ?? ''));
      alone.style.cssText = 'position: absolute; width: max-content; height: auto; text-align: left';
      each.parentElement.append(alone);
      const needs = alone.getBoundingClientRect().width;
      alone.remove();
      if (needs > box.width + 0.5) found.push(`${name} shows "${each.selectedOptions[0]?.text}" cut off: ${needs} in ${box.width}`);
    }
  }
  return { found, count: shown.length };
}, least);

const scrolled = () => page.evaluate(() => [scrollX, scrollY, ...[document.documentElement, document.body, document.querySelector('#display, #chart-area, main')]
  .flatMap((each) => [each.scrollLeft, each.scrollTop])]);

async function checkLayout(width, height, finger) {
  // The shorter side of the screen, but for what the data in the corners need so that they cover nothing of the circle.
  await page.waitForFunction((side) => document.getElementById('ppi').clientWidth >= 0.97 * side, Math.min(width, height));
  for (const tab of ['Radar', 'Targets', 'Tools', 'Chart', 'Set-up']) {
    await page.getByRole('tab', { name: tab }).click();
    const { found, count } = await faults(finger ? 44 : 0);
    assert.deepEqual(found, [], `${tab} at ${width}x${height}`);
    assert.ok(count > 20, `${count} controls`);
    // In reach whatever the tab, without scrolling.
    for (const id of ['range-more', 'gain', 'sea', 'rain', 'transmit-off']) {
      const box = await page.locator(`#${id}`).evaluate((e) => (e.closest('.choice label') ?? e).getBoundingClientRect().toJSON());
      assert.ok(box.bottom <= height + 0.5 && box.top >= 0, `${id} in tab ${tab}: ${box.top} to ${box.bottom}`);
    }
  }
  const size = await page.evaluate(() => [document.documentElement.scrollWidth, document.documentElement.scrollHeight]);
  assert.deepEqual(size, [width, height]);
  assert.deepEqual(await page.evaluate(() => [...document.querySelectorAll('#panel, #always, #tab-sections')].map((e) => e.scrollWidth - e.clientWidth)), [0, 0, 0]);
}

for (const [device, finger, sizes] of [['a mouse', false, [[1280, 720], [1920, 1080], [2560, 1440], [3840, 2160], [820, 1180]]],
  ['a finger', true, [[820, 1180], [1180, 820], [390, 844]]]]) {
  test(`with ${device} the picture is as large as can be, and nothing is cut off, off the screen or too small`, async () => {
    await open(...sizes[0], finger);
    assert.equal(await page.evaluate(() => matchMedia('(pointer: coarse)').matches), finger);
    for (const [width, height] of sizes) {
      await page.setViewportSize({ width, height });
      await checkLayout(width, height, finger);
    }
    assert.deepEqual(page.problems, []);
  });
}

test('what is said over the picture covers nothing of the bearing scale', async () => {
  await open(1280, 800, false, { server: { recorder: { ...RECORDER, phase: 1 }, ownShipMore: { noHeading: true } } });
  await page.locator('#sensor-sign').waitFor();
  await page.evaluate(() => {
    // Those of a plotter and of an exam, as they would stand.
    for (const [id, words] of [['exam-sign', null], ['target-problem', 'Heading is lost: no targets are acquired']]) {
      const sign = document.getElementById(id), shown = sign.cloneNode(true);
      Object.assign(shown, { hidden: false, textContent: words ?? sign.textContent });
      sign.id = `real-${id}`;
      sign.after(shown);
    }
  });
  await page.keyboard.press('Shift+C');
  await page.locator('#picture-mode').waitFor();
  for (const [width, height] of [[1280, 800], [1280, 720], [1920, 1080], [3840, 2160], [820, 1180], [390, 844]]) {
    await page.setViewportSize({ width, height });
    await page.evaluate(() => window.skerry.drawn(3));
    const found = await page.evaluate(() => {
      const ppi = document.getElementById('ppi').getBoundingClientRect(), { radiusPx, side } = window.skerry.ppi;
      const x = ppi.left + side / 2, y = ppi.top + side / 2, font = Math.max(10, Math.min(20, side / 62));
      return [document.getElementById('picture-mode'), ...document.querySelectorAll('#signs p')].filter((each) => each.checkVisibility()).map((each) => {
        const box = each.getBoundingClientRect();
        const near = Math.hypot(Math.max(box.left - x, 0, x - box.right), Math.max(box.top - y, 0, y - box.bottom));
        const far = Math.hypot(Math.max(x - box.left, box.right - x), Math.max(y - box.top, box.bottom - y));
        // From the circle to the outer edge of the numbers.
        return { text: each.textContent, beside: near - radiusPx - 2.6 * font, inside: radiusPx - far, left: box.left };
      });
    });
    assert.equal(found.length, 5, `${found.map(({ text }) => text)}`);
    for (const { text, beside, inside, left } of found) {
      assert.ok((beside >= 0 || inside >= 0) && left >= 0, `${text} at ${width}x${height}: ${beside} px beside the scale, ${inside} within it`);
    }
  }
});

test('on a telephone the panel takes more of the screen when it is asked to', async () => {
  await open(390, 844, true);
  const height = () => page.locator('#tab-sections').evaluate((e) => e.clientHeight);
  const before = await height();
  await page.locator('#sheet').tap();
  await page.waitForFunction((h) => document.getElementById('tab-sections').clientHeight > h + 120, before);
  await page.locator('#sheet').tap();
  await page.waitForFunction((h) => document.getElementById('tab-sections').clientHeight === h, before);
});

test('no click and no focus on any control scrolls the page', async () => {
  for (const [width, height] of [[1280, 720], [820, 1180], [390, 844]]) {
    await open(width, height, false);
    await page.getByRole('tab', { name: 'Set-up' }).click();
    for (const id of ['lock-range', 'lock-world', 'sideLobes', 'antennaMotion']) {
      await page.locator(`#${id} + span`).click();
      assert.deepEqual(await scrolled(), Array(8).fill(0), `${id} at ${width}x${height}`);
    }
    for (const tab of ['Radar', 'Targets', 'Tools', 'Chart', 'Set-up']) {
      await page.getByRole('tab', { name: tab }).click();
      await everyControl(`${tab} at ${width}x${height}`);
    }
    await page.context().close();
    await server.stop();
  }
  server = new MockServer({ rpm: 24, spokes: 512, cells: 256, exercise: new MockExercise({}) });
  const url = await server.start();
  for (const path of ['conning', 'instructor']) {
    page = await openConsole(browser, url + path, { viewport: { width: 1280, height: 720 } });
    await page.waitForFunction(() => window.skerry.state().connection === 'live');
    for (const label of await page.locator('label.switch:visible, .toggles label:visible').all()) {
      await label.click();
      assert.deepEqual(await scrolled(), Array(8).fill(0), path);
    }
    await everyControl(path);
    if (path === 'conning') await page.context().close();
  }
});

// The focus scrolls its target into sight: only parts that scroll may do so.
async function everyControl(where) {
  const moved = await page.evaluate(() => {
    const found = [];
    for (const each of document.querySelectorAll('button, a[href], select, input, summary, [tabindex]')) {
      if (!each.checkVisibility()) continue;
      each.focus();
      const parts = [document.scrollingElement, document.body, document.querySelector('#display, #chart-area, main'), document.querySelector('#panel header, header')];
      for (const part of parts) if (part.scrollTop || part.scrollLeft) found.push(`${each.id || each.textContent}: ${part.id || part.localName} by ${part.scrollTop}`);
    }
    return found;
  });
  assert.deepEqual(moved, [], where);
}

test('tabs are moved through by keys, are kept, and sections without a tab are in the last', async () => {
  await open(1280, 720, false);
  const tab = (name) => page.getByRole('tab', { name, exact: true });
  await tab('Radar').click();
  await page.keyboard.press('ArrowRight');
  assert.equal(await tab('Targets').getAttribute('aria-selected'), 'true');
  await page.keyboard.press('ArrowRight');
  assert.equal(await tab('Tools').getAttribute('aria-selected'), 'true');
  assert.equal(await page.evaluate(() => document.activeElement.id), 'tab-tools');
  assert.equal(await page.locator('#measure').isVisible(), true);
  assert.equal(await page.locator('#pulse').isVisible(), false);
  await page.keyboard.press('End');
  assert.equal(await tab('Set-up').getAttribute('aria-selected'), 'true');
  await page.keyboard.press('ArrowRight');
  assert.equal(await tab('Radar').getAttribute('aria-selected'), 'true');
  await page.keyboard.press('ArrowLeft');
  await page.reload();
  await page.waitForFunction(() => window.skerry !== undefined);
  assert.equal(await tab('Set-up').getAttribute('aria-selected'), 'true');
  const made = await page.evaluate(async () => {
    const { Tabs } = await import('./src/panel/tabs.js');
    const list = document.createElement('div'), place = document.createElement('div');
    for (const name of [undefined, 'targets', 'nonsense', 'set-up', 'radar']) {
      const section = document.createElement('section');
      if (name) section.dataset.tab = name;
      section.textContent = name ?? 'none';
      place.append(section);
    }
    new Tabs(list, place);
    return [...place.children].map((panel) => [panel.id, ...[...panel.children].map((section) => section.textContent)]);
  });
  assert.deepEqual(made, [['sections-radar', 'radar'], ['sections-targets', 'targets'], ['sections-set-up', 'none', 'nonsense', 'set-up']]);
});

test('axe-core finds nothing serious on the console, the con and the instructor\u2019s page', async (t) => {
  server = new MockServer({ rpm: 24, spokes: 512, cells: 256, recorder: { ...RECORDER }, exercise: new MockExercise({}) });
  const url = await server.start();
  for (const [width, height] of [[1280, 800], [820, 1180]]) {
    for (const path of ['?instructor=1', 'conning', 'instructor']) {
      page = await openConsole(browser, url + path, { viewport: { width, height } });
      await page.waitForFunction(() => window.skerry.state().connection === 'live');
      if (path.startsWith('?')) await page.waitForFunction(() => !document.documentElement.hasAttribute('data-off'));
      await page.evaluate(AXE);
      for (const tab of path.startsWith('?') ? ['Radar', 'Targets', 'Tools', 'Chart', 'Set-up'] : [null]) {
        if (tab) await page.getByRole('tab', { name: tab }).click();
        await page.evaluate(() => { for (const each of document.querySelectorAll('details')) each.open = true; });
        const found = await page.evaluate(async () => (await window.axe.run()).violations
          .map(({ id, impact, nodes }) => ({ id, impact, at: nodes.map(({ target, failureSummary }) => `${target.join(' ')} ${failureSummary?.split('\n')[1]}`).slice(0, 8) })));
        const serious = found.filter(({ impact }) => ['serious', 'critical'].includes(impact));
        t.diagnostic(`${path} ${tab ?? ''} ${width}: ${found.map(({ id, impact }) => `${id} (${impact})`).join(', ') || 'nothing'}`);
        assert.deepEqual(serious, [], `${path} ${tab ?? ''} at ${width}x${height}`);
      }
      if (!(path === 'instructor' && width === 820)) await page.context().close();
    }
  }
});
