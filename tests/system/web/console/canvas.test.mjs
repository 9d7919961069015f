// The picture that the processor draws (ppi_canvas.js): as WebGL2's, on the same spokes; and the console without
// WebGL2.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { PNG } from 'pngjs';
import { capture, openConsole, state, waitForScan } from '../browser.mjs';
import { openBench } from '../canvas_kit.mjs';
import { eachTest } from '../each_test.mjs';
import { angleBetween, blobAt, echoPixels, leadingEdge } from '../measure.mjs';
import { coastM, NM, TARGETS } from '../mock_scene.mjs';
import { MockServer } from '../mock_server.mjs';

let browser, server, page;
eachTest((b) => { browser = b; }, () => { const opened = { page, server }; page = server = null; return opened; });

// A pixel counts as another one when a colour is more than MOST of 255 off. Of all pixels at most MOST_PART may be:
// those at whose very edge a cell begins, which single and double precision may put on either side.
const MOST = 3, MOST_PART = 0.002;
const TURN = [0, 720, 100];

// [name, steps of canvas_kit.mjs, least part of the pixels that is lit]
const LOOKS = [
  ['a turn of spokes by day', [{ put: TURN }]],
  ['dusk', [{ palette: 'dusk', put: TURN }]],
  ['night', [{ palette: 'night', put: TURN }], 0.01],
  ['levels', [{ colours: 'levels', put: TURN }]],
  ['green, dimmed', [{ colours: 'green', echo: 0.6, put: TURN }]],
  ['approaching', [{ doppler: 1, put: TURN }]],
  ['receding', [{ doppler: 2, put: TURN }]],
  ['head up', [{ upDeg: 137.3, put: TURN }]],
  ['turned after it was drawn', [{ put: TURN }, { upDeg: 41 }]],
  ['a shorter range, before new spokes', [{ put: TURN }, { rangeM: 3 * NM }]],
  ['a longer range', [{ put: TURN }, { rangeM: 12 * NM }], 0.01],
  ['off-centre', [{ ownAt: { x: -0.3, y: 0.55 }, jumps: 1, put: TURN }]],
  ['put elsewhere', [{ put: TURN }, { ownAt: { x: 0.75, y: 0 }, jumps: 1 }]],
  ['sailing in true motion', [{ put: TURN }, ...[1, 2, 3, 4].map((k) => ({ ownAt: { x: 0.01 * k, y: 0.003 * k }, put: [180 * k, 180, 100 + k] }))]],
  ['faded over a turn', [{ put: TURN, afterglow: 1 }, { nowS: 102 }]],
  ['half gone', [{ put: [0, 400, 94] }, { put: [400, 320, 100] }], 0.01],
  ['the sweep', [{ put: TURN, sweepRow: 250 }]],
  ['relative trails', [{ trailS: 60, put: TURN }, { put: [0, 720, 110, 0.2], nowS: 110 }], 0.02],
  ['true trails', [{ trailS: 60, trueTrails: true, put: TURN }, { put: [0, 720, 110, 0.2], nowS: 110 }], 0.02],
  ['true trails that fade', [{ trailS: 60, trueTrails: true, put: TURN }, { put: [0, 720, 130, 0.2], nowS: 130 }, { nowS: 131 }], 0.01],
  ['another size', [{ put: TURN }, { side: 333 }]],
];

test('on the same spokes the picture is WebGL2\u2019s', async (t) => {
  server = new MockServer();
  page = await openBench(browser, await server.start());
  const wrong = [];
  for (const [name, steps, least = 0.03] of LOOKS) {
    const found = await page.evaluate(([s, most]) => window.apart(window.paint('webgl2', s), window.paint('2d', s), most), [steps, MOST]);
    const part = found.off / found.pixels;
    t.diagnostic(`${name}: ${(100 * part).toFixed(3)} % of the pixels are others, the rest at most ${found.worst} of 255 off`);
    if (part > MOST_PART || found.lit < least * found.pixels) wrong.push(`${name}: ${JSON.stringify(found)}`);
  }
  assert.deepEqual(wrong, []);
});

test('only what has changed is painted, and it looks as one that is painted anew', async (t) => {
  server = new MockServer();
  page = await openBench(browser, await server.start());
  const parts = Array.from({ length: 24 }, (_, k) => ({ put: [30 * k, 30, 97 + k / 8], nowS: 97 + k / 8, sweepRow: 30 * k + 29 }));
  for (const [name, more] of [['fading', { afterglow: 1 }], ['off-centre', { ownAt: { x: 0.4, y: -0.3 } }], ['true trails', { trailS: 300, trueTrails: true }]]) {
    const { found, boxes } = await page.evaluate(([steps, extra, most]) => {
      const original = CanvasRenderingContext2D.prototype.putImageData;
      let pixels = 0, calls = 0;
      CanvasRenderingContext2D.prototype.putImageData = function (image, ...at) {
        calls += 1;
        pixels += at.length > 2 ? at[4] * at[5] : image.width * image.height;
        return original.call(this, image, ...at);
      };
      const first = { put: [0, 720, 96], nowS: 96.9, ...extra };
      const kept = window.paint('2d', [first, ...steps]), put = { pixels, calls };
      CanvasRenderingContext2D.prototype.putImageData = original;
      // Another range for one picture: then all of it is new.
      const anew = window.paint('2d', [first, ...steps, { rangeM: 5000 }, { rangeM: first.rangeM ?? 6 * 1852 }]);
      return { found: window.apart(kept, anew, most), boxes: put };
    }, [parts, more, 10]);
    const all = found.pixels * (parts.length + 1);
    t.diagnostic(`${name}: ${found.off} pixels more than 10 of 255 beside, the rest at most ${found.worst}; ${(100 * boxes.pixels / all).toFixed(0)} % of the pixels were put`);
    assert.ok(found.off <= MOST_PART * found.pixels, `${name}: ${JSON.stringify(found)}`);
    assert.ok(name === 'fading' || boxes.pixels < 0.6 * all, `${name}: ${JSON.stringify(boxes)}`);
  }
  // Nothing new: nothing is put.
  const idle = await page.evaluate(() => {
    const original = CanvasRenderingContext2D.prototype.putImageData;
    let calls = 0;
    CanvasRenderingContext2D.prototype.putImageData = function (...args) { calls += 1; return original.apply(this, args); };
    window.paint('2d', [{ put: [0, 720, 99] }, {}, {}, {}]);
    CanvasRenderingContext2D.prototype.putImageData = original;
    return calls;
  });
  assert.equal(idle, 1);
});

// Both renderers ask disc.js what stays, so neither tells on the other here.
test('what was painted before a change of the view looks as what is painted after it', async () => {
  server = new MockServer();
  page = await openBench(browser, await server.start());
  for (const change of [{ rangeM: 3 * NM }, { rangeM: 12 * NM }, { ownAt: { x: 0.75, y: 0 }, jumps: 1 }, { upDeg: 41 }, { palette: 'dusk' }, { colours: 'levels' }]) {
    const found = await page.evaluate(([before, after, most]) => window.apart(window.paint('2d', before), window.paint('2d', after), most),
                                      [[{ put: TURN }, change], [{ ...change, put: TURN }], MOST]);
    assert.equal(found.off, 0, JSON.stringify({ change, found }));
  }
});

// A console in a browser that has no WebGL2.
async function open(options = {}, query = '') {
  server = new MockServer({ rpm: 60, spokes: 1024, cells: 512, headingDeg: 37, ...options });
  const context = await browser.newContext({ viewport: { width: 1280, height: 800 } });
  await context.addInitScript(() => {
    const original = HTMLCanvasElement.prototype.getContext;
    HTMLCanvasElement.prototype.getContext = function (kind, ...rest) { return kind === 'webgl2' ? null : original.call(this, kind, ...rest); };
  });
  page = await context.newPage();
  page.problems = [];
  page.on('pageerror', (error) => page.problems.push(String(error)));
  await page.goto(await server.start() + query);
  await page.waitForFunction(() => window.skerry !== undefined);
  await page.locator('#afterglow').fill('0');
  await page.locator('#afterglow').blur();  // Page Up is not the slider's
  await waitForScan(page);
}

// Every target and the coast where they are; `least` of the targets lie within the circle.
function checkPlaces(shot, least) {
  const cellM = Math.max(shot.rangeM / shot.radiusPx, 6 * NM / 512);
  let seen = 0;
  for (const { bearingDeg, rangeM } of TARGETS) {
    const angle = (bearingDeg - shot.upDeg) * Math.PI / 180, r = (rangeM / shot.rangeM) * shot.radiusPx;
    if (Math.hypot(shot.own.x - shot.centre.x + r * Math.sin(angle), shot.own.y - shot.centre.y - r * Math.cos(angle)) > 0.95 * shot.radiusPx) continue;
    const blob = blobAt(shot, bearingDeg, rangeM, 3, 450);
    assert.ok(blob && angleBetween(blob.bearingDeg, bearingDeg) <= 1 && Math.abs(blob.rangeM - rangeM) <= 3 * cellM, JSON.stringify({ bearingDeg, rangeM, blob }));
    seen += 1;
  }
  assert.ok(seen >= least, `${seen} targets`);
  for (const deg of [40, 60, 80]) {
    const found = leadingEdge(shot, deg, 2000);
    assert.ok(found !== null && Math.abs(found - coastM(deg)) <= 3 * cellM, `the coast on ${deg}: ${found}, not ${coastM(deg)}`);
  }
}

const colourAt = async (shot, bearingDeg, rangeM) => {
  const { x, y } = await page.evaluate(([deg, m]) => window.skerry.pixelFor(deg, m), [bearingDeg, rangeM]);
  const i = 4 * (Math.floor(y) * shot.width + Math.floor(x));
  return [...shot.data.subarray(i, i + 3)];
};

test('without WebGL2 it is told once and the console has its picture: ranges, orientations, own ship elsewhere', async () => {
  await open();
  await page.locator('.notice', { hasText: 'Drawn without WebGL: this browser has no WebGL2' }).waitFor();
  assert.equal(await page.locator('.notice', { hasText: 'Drawn without WebGL' }).count(), 1);
  assert.equal(await page.locator('#alarm').isVisible(), false);
  assert.equal(await page.evaluate(() => window.skerry.renderer()), '2d');
  checkPlaces(await capture(page), 6);
  await page.keyboard.press('h');
  await page.waitForFunction(() => Math.abs(window.skerry.ppi.upDeg - 37) < 0.01);
  checkPlaces(await capture(page), 6);
  server.headingDeg = 95;
  await page.waitForFunction(() => Math.abs(window.skerry.ppi.upDeg - 95) < 0.01);
  await waitForScan(page);  // what the antenna jumped over has its spokes again
  checkPlaces(await capture(page), 6);
  server.change({ rangeNm: 3 });
  await page.waitForFunction(() => Math.abs(window.skerry.ppi.rangeM - 5556) < 1);
  await waitForScan(page);
  checkPlaces(await capture(page), 4);
  await page.keyboard.press('n');
  server.change({ rangeNm: 6 });
  await page.keyboard.press('PageUp');
  await page.waitForFunction(() => { const { own, centre, rangeM } = window.skerry.ppi; return Math.hypot(own.x - centre.x, own.y - centre.y) > 20 && Math.abs(rangeM - 11112) < 1; });
  await waitForScan(page);
  checkPlaces(await capture(page), 4);
  assert.deepEqual(page.problems, []);
});

test('what is painted by the processor is what is seen on the screen, in the colours of day, dusk and night', async () => {
  await open();
  const bounds = await page.locator('#ppi').boundingBox();
  for (const [palette, is] of [['day', ([r, g, b]) => r > 150 && g > 0.85 * r && b < 110], ['dusk', ([r, g, b]) => r > 150 && g < 0.85 * r && g > 0.5 * r && b < 90],
    ['night', ([r, g, b]) => r > 60 && r < 140 && g < 20 && b < 20]]) {
    if (palette !== 'day') await page.keyboard.press('p');
    const shot = await capture(page);
    const inside = coastM(60) + 700, colour = await colourAt(shot, 60, inside);
    assert.ok(is(colour), `${palette}: ${colour}`);
    await page.evaluate(() => window.skerry.drawn(2));
    const { x, y } = await page.evaluate((m) => window.skerry.pixelFor(60, m), inside);
    const png = PNG.sync.read(await page.screenshot({ clip: { x: Math.floor(bounds.x + x), y: Math.floor(bounds.y + y), width: 1, height: 1 } }));
    png.data.subarray(0, 3).forEach((v, c) => assert.ok(Math.abs(v - colour[c]) <= 12, `${palette}: on the screen ${[...png.data.subarray(0, 3)]}, painted ${colour}`));
  }
});

test('without WebGL2 too: Doppler classes, trails, a sector that fades, and nothing in standby', async () => {
  await open({ rpm: 40, headingDeg: 0, doppler: (deg) => (deg < 150 ? 1 : deg > 200 ? 2 : 0) });
  let shot = await capture(page);
  const [near, away] = [await colourAt(shot, 60, coastM(60) + 700), await colourAt(shot, 260, coastM(260) + 700)];
  assert.ok(near[0] > near[2] + 80 && away[2] > away[0] + 80, `approaching ${near}, receding ${away}`);
  await page.locator('#trails').selectOption('360');
  await waitForScan(page);
  server.change({ gain: 5 });
  await waitForScan(page);
  await page.evaluate(() => window.skerry.holdAfter(window.skerry.state().scan - 1));
  for (const mode of ['relative', 'true']) {
    await page.locator(`input[name=trail-mode][value=${mode}] + span`).click();
    shot = await capture(page);
    const [on, beside] = [await colourAt(shot, 190, 2500), await colourAt(shot, 150, 2500)];
    assert.ok(on[2] > beside[2] + 40, `${mode} trails: ${on} on one, ${beside} beside it`);
  }
  await page.evaluate(() => window.skerry.holdAfter(null));
  await page.locator('#trails').selectOption('0');
  server.change({ gain: 50 });
  await waitForScan(page);
  // A sector of which nothing comes any more goes out.
  server.silent = [[30, 90]];
  const turns = (await state(page)).scan + 4;
  await page.waitForFunction((scan) => window.skerry.state().scan > scan, turns);
  shot = await capture(page);
  const [gone, stays] = [await colourAt(shot, 60, coastM(60) + 700), await colourAt(shot, 260, coastM(260) + 700)];
  assert.ok(Math.max(...gone) < 60 && Math.max(...stays) > 120, `${gone} where nothing comes, ${stays} elsewhere`);
  Object.assign(server.radarSettings, { standby: true });
  server.change({});
  await page.locator('#alarm', { hasText: 'Standby' }).waitFor();
  shot = await capture(page);
  assert.equal(echoPixels(shot), 0);
  assert.ok(Math.max(...await colourAt(shot, 260, coastM(260) + 700)) < 60);
  assert.deepEqual(page.problems, []);
});

test('graphics that were lost and do not come back: the processor draws on, and that is told', async () => {
  server = new MockServer({ rpm: 60, spokes: 1024, cells: 512, headingDeg: 37 });
  page = await openConsole(browser, await server.start());
  await page.locator('#afterglow').fill('0');
  await waitForScan(page);
  assert.equal(await page.evaluate(() => window.skerry.renderer()), 'webgl2');
  await page.evaluate(() => document.querySelector('#echoes').getContext('webgl2').getExtension('WEBGL_lose_context').loseContext());
  await page.locator('#alarm', { hasText: 'taken the graphics away' }).waitFor();
  await page.locator('.notice', { hasText: 'Drawn without WebGL: the browser has taken the graphics away' }).waitFor();
  await page.locator('#alarm').waitFor({ state: 'hidden' });
  assert.equal(await page.evaluate(() => window.skerry.renderer()), '2d');
  await waitForScan(page);
  checkPlaces(await capture(page), 6);
  assert.deepEqual(page.problems, []);
});

test('who asks for it in the address has the 2D canvas', async () => {
  server = new MockServer({ rpm: 60, spokes: 512, cells: 256 });
  page = await openConsole(browser, `${await server.start()}?canvas=2d`);
  await page.locator('.notice', { hasText: 'as the address of this page asks' }).waitFor();
  assert.equal(await page.evaluate(() => window.skerry.renderer()), '2d');
});
