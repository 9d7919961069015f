// The chart under the picture, in a real Chromium on a server whose coast is known.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { capture, waitForScan } from '../browser.mjs';
import { alphaAt, chart, inked, layer, onScreen, open, openChart, page, pixelFor, server } from '../chart_kit.mjs';
import { leadingEdge } from '../measure.mjs';
import { CONTOURS, OWN } from '../mock_chart.mjs';
import { coastM, NM, TARGETS } from '../mock_scene.mjs';
import { direct, inverse } from '../vincenty.mjs';

const asked = () => server.received.filter((message) => message.kind === 'getChartObjects').map((message) => message.getChartObjects);
// Red, green and blue that a layer has most.
const isCoast = (r, g, b) => r > g && g > b && r > 60;

// Middle of the coast line on a bearing, in device pixels from own ship, sought within 12 of where the scene has it.
function lineOn(picture, ppi, deg, wantM) {
  const angle = ((deg - ppi.upDeg) * Math.PI) / 180, scale = (ppi.radiusPx / ppi.rangeM) * ppi.pixelRatio;
  let sum = 0, weight = 0;
  for (let r = wantM * scale - 12; r <= wantM * scale + 12; r += 0.25) {
    const x = ppi.centre.x * ppi.pixelRatio + r * Math.sin(angle), y = ppi.centre.y * ppi.pixelRatio - r * Math.cos(angle);
    const i = 4 * (Math.floor(y) * picture.width + Math.floor(x));
    if (!isCoast(...picture.data.subarray(i, i + 3))) continue;
    sum += r * picture.data[i + 3];
    weight += picture.data[i + 3];
  }
  return weight > 0 ? sum / weight : null;
}

for (const { name, options, viewport, headUp } of [
  { name: '6 NM, heading 37, head up', options: { headingDeg: 37 }, headUp: true },
  { name: '3 NM, a large screen', options: { headingDeg: 211.3, settings: { rangeNm: 3 } }, viewport: { viewport: { width: 1500, height: 1100 } } },
  { name: '12 NM, a small screen of two device pixels per pixel', options: { settings: { rangeNm: 12 } }, viewport: { deviceScaleFactor: 2, viewport: { width: 760, height: 480 } } },
]) {
  test(`the charted coast and marks stand on their echoes: ${name}`, async (t) => {
    await openChart({ spokes: 4096, cells: 1024, ...options }, viewport);
    if (headUp) await page.keyboard.press('h');
    await page.locator('#chart-contours').uncheck({ force: true });
    await page.locator('#chart-buoys').uncheck({ force: true });
    await waitForScan(page);
    const shot = await capture(page);
    const picture = await layer('chart');
    assert.equal(picture.width, shot.width);
    const worst = { echo: 0, exact: 0, places: 0 };
    for (let deg = 22; deg < 318; deg += 2.5) {
      const edgeM = coastM(deg);
      // Where the coast runs along the beam, a bearing's width is many pixels of range.
      const slope = edgeM === null ? Infinity : Math.abs((coastM(deg + 0.2) ?? Infinity) - (coastM(deg - 0.2) ?? Infinity)) / (edgeM * 0.4 * (Math.PI / 180));
      if (!(slope < 0.6) || edgeM > shot.rangeM * 0.95 || TARGETS.some((target) => Math.abs(target.bearingDeg - deg) < 4)) continue;
      const px = (m) => (m / shot.rangeM) * shot.radiusPx * shot.pixelRatio;
      const line = lineOn(picture, shot, deg, edgeM);
      assert.notEqual(line, null, `no chart on ${deg}`);
      worst.exact = Math.max(worst.exact, Math.abs(line - px(edgeM)) / shot.pixelRatio);
      worst.echo = Math.max(worst.echo, Math.abs(line - px(leadingEdge(shot, deg))) / shot.pixelRatio);
      worst.places += 1;
    }
    // The line's own width, and the edge of a pixel: half a pixel of the device each way.
    assert.ok(worst.places > 30, String(worst.places));
    assert.ok(worst.exact <= 1.5 && worst.echo <= 1.5, JSON.stringify(worst));

    await page.locator('#chart-coast').uncheck({ force: true });
    await page.locator('#chart-buoys').check({ force: true });
    const marks = await layer('chart');
    const { markPixels } = await chart();
    assert.equal(markPixels.length, TARGETS.length);
    let mark = 0;
    for (const [i, { bearingDeg, rangeM }] of TARGETS.entries()) {
      const want = await pixelFor(bearingDeg, rangeM);
      mark = Math.max(mark, Math.hypot(markPixels[i].x - want.x, markPixels[i].y - want.y));
      if (rangeM > shot.rangeM * 0.95) continue;
      let ink = 0;
      for (let dy = -3; dy <= 3; ++dy) for (let dx = -3; dx <= 3; ++dx) ink += alphaAt(marks, want.x * shot.pixelRatio + dx, want.y * shot.pixelRatio + dy) > 0 ? 1 : 0;
      assert.ok(ink >= 4, `no symbol on ${bearingDeg}`);
    }
    assert.ok(mark <= 1.5, String(mark));
    t.diagnostic(JSON.stringify({ ...worst, mark }));
    assert.deepEqual(page.problems, []);
  });
}

test('layers are switched one by one, dimmed, and remembered', async () => {
  const url = await open();
  await waitForScan(page);
  assert.equal(asked().length, 0, 'the radar begins without its chart');
  assert.equal(inked(await layer('chart')), 0);
  await page.keyboard.press('j');
  await page.waitForFunction(() => window.skerry.chart().drawn > 0);
  assert.equal(await page.locator('#chart-note').textContent(), 'mock · not for navigation');
  const all = inked(await layer('chart'));
  // A depth contour is on its range, and gone with its switch; the same of the other layers.
  const contourInk = async () => {
    const picture = await layer('chart');
    let ink = 0;
    for (let deg = 105; deg < 195; deg += 1) {
      for (const { rangeM } of CONTOURS) {
        const { x, y } = await pixelFor(deg, rangeM);
        ink += [-1, 0, 1].some((dx) => [-1, 0, 1].some((dy) => alphaAt(picture, x + dx, y + dy) > 0)) ? 1 : 0;
      }
    }
    return ink;
  };
  assert.ok(await contourInk() > 170, 'of 180 places');
  let before = all;
  for (const id of ['chart-contours', 'chart-buoys']) {
    await page.locator(`#${id}`).uncheck({ force: true });
    const ink = inked(await layer('chart'));
    assert.ok(ink < before - 50, `${id}: ${ink} of ${before}`);
    before = ink;
  }
  assert.ok(await contourInk() < 20);
  const brightness = ({ data }) => { let sum = 0; for (let i = 0; i < data.length; i += 4) sum += (data[i] + data[i + 1] + data[i + 2]) * data[i + 3]; return sum / 255; };
  const day = brightness(await layer('chart'));
  await page.keyboard.press('p');
  const dusk = brightness(await layer('chart'));
  await page.keyboard.press('p');
  const night = brightness(await layer('chart'));
  assert.ok(dusk < 0.85 * day && night < 0.7 * dusk, JSON.stringify([day, dusk, night]));
  await page.locator('#chart-brilliance').fill('30');
  assert.equal(await page.evaluate(() => getComputedStyle(document.getElementById('chart')).opacity), '0.3');
  await page.goto(url);
  await page.waitForFunction(() => window.skerry?.chart().drawn > 0);
  await page.evaluate(() => window.skerry.showTab('chart'));
  assert.equal(await page.locator('#chart-buoys').isChecked(), false);
  assert.equal(await page.locator('#chart-brilliance-value').textContent(), '30');
  await page.locator('#chart-coast').uncheck({ force: true });
  assert.equal(inked(await layer('chart')), 0);
});

test('the chart is asked for anew once own ship has gone a third of it, and for another range', async () => {
  await openChart();
  const [first] = asked();
  assert.ok(Math.abs(first.radiusNm - 9.3) < 1e-9 && first.toleranceM > 5 && first.toleranceM < 60);
  server.at = direct(OWN, 200, 2.5 * NM);
  await page.waitForFunction((lat) => Math.abs(window.skerry.chart().place.latitudeDeg - lat) < 1e-6, server.at.latitudeDeg);
  // The coast has moved in the picture, and stands where the geodesic from her new place has it.
  const want = inverse(server.at, direct(OWN, TARGETS[3].bearingDeg, TARGETS[3].rangeM));
  const { markPixels } = await chart();
  const at = await pixelFor(want.bearingDeg, want.rangeM);
  assert.ok(Math.hypot(markPixels[3].x - at.x, markPixels[3].y - at.y) < 0.5);
  assert.equal(asked().length, 1);
  server.at = direct(OWN, 200, 3.8 * NM);
  await page.waitForFunction((lat) => Math.abs(window.skerry.chart().place.latitudeDeg - lat) < 1e-6, server.at.latitudeDeg);
  for (let i = 0; i < 400 && asked().length < 2; ++i) await page.evaluate(() => new Promise(requestAnimationFrame));
  assert.equal(asked().length, 2);
  assert.ok(inverse(server.at, asked()[1]).rangeM < 0.5 * NM);
  await page.keyboard.press('+');
  await page.waitForFunction(() => window.skerry.chart().chart.radiusNm > 18);
  assert.equal(asked().length, 3);
});

test('a server without a chart is told so, and is asked for none', async () => {
  await open({ chart: null });
  await page.keyboard.press('j');
  await waitForScan(page);
  assert.equal(await page.locator('#chart-note').textContent(), 'this server tells no chart');
  assert.equal(asked().length, 0);
});

test('the mark under the cursor is named, as text', async () => {
  await openChart();
  for (const [i, words] of [[1, /^Starboard 2 · starboard hand · Fl G 4s · 118\.0° 0\.810 NM$/], [4, /^Wreck · wreck · 4\.2 m · 265\.0°/], [5, /^<b>Safe<\/b> · safe water/]]) {
    await page.mouse.move(...await onScreen(await pixelFor(TARGETS[i].bearingDeg, TARGETS[i].rangeM)));
    await page.waitForFunction((name) => document.getElementById('chart-nearest').textContent.startsWith(name), ['', 'Starboard', '', '', 'Wreck', '<b>'][i]);
    assert.match(await page.locator('#chart-nearest').textContent(), words);
  }
});

test('a chart of 20 000 points costs a turning ship below 2 ms a frame', async (t) => {
  await open();
  const { median, worst, points, drawn } = await page.evaluate(async () => {
    const { LoadedChart } = await import('/src/chart/chart_objects.js');
    const { ChartPainter } = await import('/src/chart/chart_painter.js');
    const { placeAt } = await import('/src/chart/earth.js');
    const { CHART_COLOURS } = await import('/src/chart/chart_colours.js');
    const { ViewGeometry } = await import('/src/view_geometry.js');
    const lines = [];
    for (let k = 0; k < 40; ++k) {
      const coded = [Math.round((k - 20) * 4000), -100000];
      for (let i = 1; i < 500; ++i) coded.push(Math.round(400 * Math.sin(i * 2.1 + k)), Math.round(400 + 300 * Math.cos(i * 1.7)));
      lines.push({ kind: k % 2, depthM: 10, points: coded });
    }
    const marks = Array.from({ length: 200 }, (_, i) => ({ kind: i % 18, longitude: 1000 * (i - 100), latitude: 700 * ((i * 37) % 200 - 100), colours: [3], name: '', light: 'Fl', racon: false, fixed: false }));
    const chart = new LoadedChart({ latitudeDeg: 60, longitudeDeg: 5, radiusNm: 9, lines, marks, chart: 'made' });
    const canvas = document.createElement('canvas');
    const painter = new ChartPainter(canvas);
    const view = Object.assign(new ViewGeometry(800, 40, 1), { rangeM: 6 * 1852 });
    const look = { paletteName: 'day', colours: CHART_COLOURS.day, coast: true, contours: true, buoys: true };
    const times = [];
    for (let frame = 0; frame < 120; ++frame) {
      view.upDeg = frame * 0.3;
      const place = placeAt({ latitudeDeg: 60, longitudeDeg: 5 }, 90, frame * 1.5);
      const began = performance.now();
      painter.draw(view, chart, place, look);
      if (frame >= 20) times.push(performance.now() - began);
      if (frame % 10 === 9) await new Promise(requestAnimationFrame);
    }
    times.sort((a, b) => a - b);
    return { median: times[50], worst: times[94], points: chart.points, drawn: chart.paths.points };
  });
  t.diagnostic(`median ${median.toFixed(2)} ms, 95 % ${worst.toFixed(2)} ms; ${drawn} of ${points} points drawn`);
  assert.equal(points, 20000);
  assert.ok(drawn > 5000);
  assert.ok(median < 2, `${median} ms`);
});
