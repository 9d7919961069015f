// The console in a real Chromium, on a server whose picture is known in closed form.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { PNG } from 'pngjs';
import { capture, openConsole, openTab, state, waitForScan } from '../browser.mjs';
import { eachTest } from '../each_test.mjs';
import { angleBetween, blobAt, echoPixels, leadingEdge, placeOf, isEcho } from '../measure.mjs';
import { coastM, LAND_DEPTH_M, NM, TARGETS } from '../mock_scene.mjs';
import { CONTROLS, MockServer, ServerMessage } from '../mock_server.mjs';
import { random } from '../random.mjs';

let browser, server, page;
eachTest((b) => { browser = b; }, () => { const opened = { page, server }; page = server = null; return opened; });

// Turns are a second long, unless a test is about their length.
async function open(options = {}, viewport, query = '') {
  server = new MockServer({ rpm: 60, ...options });
  const url = await server.start();
  page = await openConsole(browser, url + query, viewport);
  return url;
}

async function setSlider(id, value) {
  await page.locator(`#${id}`).fill(String(value));
}

// Even brightness, so that pixels can be told echo or not wherever the sweep is.
async function openFlat(options, viewport, query) {
  await open(options, viewport, query);
  await setSlider('afterglow', 0);
  await waitForScan(page);
}

// Every coast and target of the scene stands where it should; nothing else does. Gives the worst errors.
function checkPicture(shot) {
  const onePercentM = shot.rangeM / 100;
  const worst = { edgeM: 0, targetDeg: 0, targetM: 0, edges: 0, targets: 0 };
  for (let deg = 0; deg < 360; deg += 1.5) {
    const edge = coastM(deg);
    const near = TARGETS.some((t) => angleBetween(t.bearingDeg, deg) < 4);
    if (near || edge === null || edge > shot.rangeM * 0.97) continue;
    // Within a degree the coast is somewhere between these.
    const around = [-1, -0.5, 0, 0.5, 1].map((d) => coastM(deg + d)).filter((m) => m !== null);
    if (around.length < 5) continue;
    const seen = leadingEdge(shot, deg);
    assert.notEqual(seen, null, `no coast on ${deg}`);
    const off = Math.max(Math.min(...around) - seen, seen - Math.max(...around), 0);
    worst.edgeM = Math.max(worst.edgeM, Math.abs(seen - edge));
    worst.edges += 1;
    assert.ok(off <= onePercentM, `coast on ${deg} at ${seen} m, is at ${edge} m`);
  }
  for (const target of TARGETS) {
    if (target.rangeM > shot.rangeM * 0.95) continue;
    const blob = blobAt(shot, target.bearingDeg, target.rangeM, 3, Math.max(200, 4 * onePercentM));
    assert.ok(blob, `no target on ${target.bearingDeg}`);
    const deg = angleBetween(blob.bearingDeg, target.bearingDeg), m = Math.abs(blob.rangeM - target.rangeM);
    worst.targetDeg = Math.max(worst.targetDeg, deg);
    worst.targetM = Math.max(worst.targetM, m);
    worst.targets += 1;
    assert.ok(deg <= 1 && m <= onePercentM, `target ${JSON.stringify(target)} at ${JSON.stringify(blob)}`);
  }
  let stray = 0;
  for (let y = 0; y < shot.width; ++y) {
    for (let x = 0; x < shot.width; ++x) {
      if (!isEcho(shot, x + 0.5, y + 0.5)) continue;
      const { bearingDeg, rangeM } = placeOf(shot, x + 0.5, y + 0.5);
      // Across, a pixel near the centre is many degrees wide.
      const tolDeg = 1 + Math.min(90, 1.5 * (shot.rangeM / shot.radiusPx / shot.pixelRatio / Math.max(rangeM, 1)) * 180 / Math.PI);
      const land = [-tolDeg, -tolDeg / 2, 0, tolDeg / 2, tolDeg].some((d) => {
        const edge = coastM((bearingDeg + d + 360) % 360);
        return edge !== null && rangeM > edge - onePercentM - 60 && rangeM < edge + LAND_DEPTH_M + 560 + onePercentM;
      });
      const target = TARGETS.some((t) => angleBetween(t.bearingDeg, bearingDeg) < 0.8 + tolDeg && Math.abs(t.rangeM - rangeM) < 60 + onePercentM);
      if (!land && !target) stray += 1;
    }
  }
  assert.equal(stray, 0, `${stray} echo pixels where nothing is`);
  return worst;
}

const report = (t, worst) => t.diagnostic(`worst: ${JSON.stringify(worst, (_, v) => (typeof v === 'number' ? Number(v.toFixed(3)) : v))}`);

for (const { name, options, headUp, viewport } of [
  { name: 'north up at 6 NM, heading 000', options: {} },
  { name: 'north up at 6 NM, heading 211.3', options: { headingDeg: 211.3 } },
  { name: 'head up at 6 NM, heading 37', options: { headingDeg: 37 }, headUp: true },
  { name: 'head up at 3 NM, heading 304.7', options: { headingDeg: 304.7, settings: { rangeNm: 3 } }, headUp: true },
  { name: 'north up at 1.5 NM', options: { headingDeg: 20, settings: { rangeNm: 1.5 } } },
  { name: 'north up at 12 NM, 60 rpm', options: { rpm: 60, settings: { rangeNm: 12 } } },
  { name: 'four bits, 1024 spokes of 256 cells', options: { bits: 4, spokes: 1024, cells: 256, headingDeg: 100 } },
  { name: 'a screen of two device pixels per pixel', options: { headingDeg: 10 }, viewport: { deviceScaleFactor: 2, viewport: { width: 900, height: 600 } } },
]) {
  test(`coast and targets stand in their places: ${name}`, async (t) => {
    await openFlat(options, viewport);
    if (headUp) {
      await page.keyboard.press('h');
      await waitForScan(page);
    }
    const shot = await capture(page);
    if (headUp) assert.ok(angleBetween(shot.upDeg, options.headingDeg) < 1e-3);
    else assert.equal(shot.upDeg, 0);
    report(t, checkPicture(shot));
    assert.deepEqual(page.problems, []);
  });
}

test('the largest format is drawn, 8192 spokes of 4096 cells', async (t) => {
  await openFlat({ spokes: 8192, cells: 4096, rpm: 12, headingDeg: 66 });
  report(t, checkPicture(await capture(page)));
  const { framesPerSecond, spokesPerSecond, lost } = await state(page);
  t.diagnostic(`${framesPerSecond?.toFixed(1)} frames/s, ${spokesPerSecond?.toFixed(0)} spokes/s, ${lost} lost`);
});

test('what the operator sees is what was measured', async () => {
  await openFlat({ headingDeg: 37 });
  const shot = await capture(page);
  const box = await page.locator('#ppi').boundingBox();
  const png = PNG.sync.read(await page.screenshot());
  for (const target of TARGETS.filter((t) => t.rangeM < shot.rangeM)) {
    const { x, y } = await page.evaluate(([b, m]) => window.skerry.pixelFor(b, m), [target.bearingDeg, target.rangeM]);
    const i = 4 * (Math.floor(box.y + y) * png.width + Math.floor(box.x + x));
    const [r, g, b] = png.data.subarray(i, i + 3);
    assert.ok(r > 130 && g > 110 && b < 120, `target ${target.bearingDeg}: ${[r, g, b]}`);
  }
});

test('a turning ship keeps its coast in place, without gaps', async (t) => {
  await openFlat({ headingDeg: 350 });
  const ship = server;
  const turn = setInterval(() => { ship.headingDeg = (ship.headingDeg + 0.12) % 360; }, 40);  // 3 deg/s
  t.after(() => clearInterval(turn));
  await waitForScan(page);
  await waitForScan(page);
  const shot = await capture(page);
  report(t, checkPicture(shot));
  const unpainted = await page.evaluate(() => {
    const { meta } = window.skerry.readPolar();
    const floats = new Float32Array(Uint8Array.from(atob(meta), (c) => c.charCodeAt(0)).buffer);
    return floats.filter((v, i) => i % 4 === 1 && v === 0).length;
  });
  assert.equal(unpainted, 0);
});

test('the range buttons and keys ask the server, and the picture follows', async (t) => {
  await openFlat({ headingDeg: 37 });
  const before = checkPicture(await capture(page));
  await page.locator('#range-more').click();
  await page.waitForFunction(() => window.skerry.settings().rangeNm === 12);
  assert.ok(server.received.some((m) => m.kind === 'set' && m.set.rangeNm === 12));
  await waitForScan(page);
  const far = await capture(page);
  assert.equal(far.rangeM, 12 * NM);
  checkPicture(far);
  await page.keyboard.press('-');
  await page.keyboard.press('-');
  await page.waitForFunction(() => window.skerry.settings().rangeNm === 3);
  await waitForScan(page);
  checkPicture(await capture(page));
  report(t, before);
});

test('after a change of range the old rows are drawn at their own range', async (t) => {
  await openFlat({ headingDeg: 37 });
  const { scan } = await page.evaluate(() => window.skerry.lastScan());
  await page.evaluate((n) => window.skerry.holdAfter(n), scan + 1);
  await page.waitForFunction((n) => window.skerry.lastScan().scan === n, scan + 1);
  server.change({ rangeNm: 12 });
  await page.waitForFunction(() => window.skerry.settings().rangeNm === 12);
  const shot = await capture(page);
  assert.equal(shot.rangeM, 12 * NM);
  // Beyond 6 NM nothing was seen: the picture is that of 6 NM, half as large.
  assert.equal(leadingEdge(shot, 265, 6 * NM + 300), null);
  for (const deg of [30, 60, 90, 230, 300]) {
    assert.ok(Math.abs(leadingEdge(shot, deg) - coastM(deg)) < 12 * NM / 100, String(deg));
  }
  for (const target of TARGETS) {
    const blob = blobAt(shot, target.bearingDeg, target.rangeM, 3, 500);
    assert.ok(angleBetween(blob.bearingDeg, target.bearingDeg) < 1);
    assert.ok(Math.abs(blob.rangeM - target.rangeM) < 12 * NM / 100);
  }
  t.diagnostic(`${echoPixels(shot)} echo pixels`);
});

test('gain, sea and rain ask the server, and the picture follows', async () => {
  await openFlat({});
  const full = echoPixels(await capture(page));
  assert.ok(full > 5000, `${full} echo pixels`);
  await setSlider('gain', 12);
  await page.waitForFunction(() => window.skerry.settings().gain === 12);
  await setSlider('sea', 77);
  await setSlider('rain', 5);
  await page.waitForFunction(() => window.skerry.settings().sea === 77 && window.skerry.settings().rain === 5);
  await waitForScan(page);
  assert.equal(echoPixels(await capture(page)), 0);
  await setSlider('gain', 50);
  await page.waitForFunction(() => window.skerry.settings().gain === 50);
  await waitForScan(page);
  const again = echoPixels(await capture(page));
  assert.ok(Math.abs(again - full) < full * 0.02, `${again} after ${full}`);
});

test('standby darkens the picture and says so, and transmit brings it back', async () => {
  await openFlat({});
  await page.locator('#ppi').focus();
  await page.keyboard.press('s');
  await page.locator('#alarm', { hasText: 'Standby' }).waitFor();
  assert.equal(server.received.at(-1).set.transmit, false);
  assert.equal(echoPixels(await capture(page)), 0);
  assert.equal((await state(page)).standby, true);
  await page.keyboard.press('s');
  await page.locator('#alarm').waitFor({ state: 'hidden' });
  await waitForScan(page);
  const { lost, restarts } = await state(page);
  assert.deepEqual([lost, restarts], [0, 0]);
  checkPicture(await capture(page));
});

test('a view of one’s own has its own gain and range, and the shared one keeps its', async () => {
  await openFlat({});
  await page.locator('input[name=view][value=own] + span').click();
  await page.waitForFunction(() => window.skerry.settings()?.view === 1);
  assert.equal(await page.locator('#range option[value="12"]').evaluate((option) => option.disabled), true, 'no farther than the radar');
  await setSlider('gain', 40);
  await page.locator('#range').selectOption('3');
  await page.waitForFunction(() => window.skerry.settings().gain === 40 && window.skerry.settings().rangeNm === 3);
  assert.deepEqual([server.settings.gain, server.settings.rangeNm], [50, 6]);
  await waitForScan(page);
  checkPicture(await capture(page));
  await page.locator('input[name=view][value=shared] + span').click();
  await page.waitForFunction(() => window.skerry.settings()?.view === 0 && window.skerry.settings().gain === 50);
  assert.deepEqual(page.problems, []);
});

test('every control of receiver and transmitter reaches the server', async () => {
  await openFlat({});
  await page.locator('details.more summary').click();
  for (const [id, value] of [['interferenceRejection', 40], ['echoStretch', 30], ['integration', 20]]) await setSlider(id, value);
  for (const id of ['seaAuto', 'stretchBearing', 'tuneAuto']) await page.locator(`#${id} + span`).click();
  await page.locator('#pulse').selectOption('3');
  await page.locator('#decimation').selectOption('1');
  await page.waitForFunction(() => {
    const s = window.skerry.settings();
    return s.interferenceRejection === 40 && s.echoStretch === 30 && s.integration === 20 && s.seaAuto && s.stretchBearing &&
      !s.tuneAuto && s.pulse === 3 && s.decimation === 1;
  });
  await setSlider('tune', 61);
  await page.waitForFunction(() => window.skerry.settings().tune === 61);
});

test('the controls that displays have reach the server too', async () => {
  await openFlat({});
  await page.locator('details.more summary').click();
  await page.locator('details.antenna summary').click();
  for (const [id, value] of [['sideLobeSuppression', 41], ['noiseRejection', 42], ['targetSeparation', 43], ['targetBoost', 44]]) {
    await setSlider(id, value);
  }
  for (const id of ['gainAuto', 'sideLobeAuto']) await page.locator(`#${id} + span`).click();
  await page.locator('#mode').selectOption('2');
  await page.locator('#doppler').selectOption('1');
  for (const [id, value] of [['dopplerThresholdMps', 3.5], ['rotationRpm', 36], ['bearingAlignmentDeg', -12], ['antennaHeightM', 33],
    ['blankedSectors', '350-10, 120-150']]) {
    await page.locator(`#${id}`).fill(String(value));
    await page.locator(`#${id}`).press('Tab');
  }
  await page.waitForFunction(() => {
    const s = window.skerry.settings();
    return s.sideLobeSuppression === 41 && s.noiseRejection === 42 && s.targetSeparation === 43 && s.targetBoost === 44 &&
      s.gainAuto && s.sideLobeAuto && s.mode === 2 && s.doppler === 1 && s.dopplerThresholdMps === 3.5 && s.rotationRpm === 36 &&
      s.bearingAlignmentDeg === -12 && s.antennaHeightM === 33 && s.blankedSectors.sectors.length === 2;
  });
  assert.ok(server.received.every(({ set }) => !set?.instructor), 'no instructor, as long as the panel is folded');
  assert.equal(await page.locator('#orientation').textContent(), 'N UP');
  assert.deepEqual(page.problems, []);
});

// One more line in the schema, one more slider: nothing in the console names it.
test('a control that the console has never heard of has its place, value and lock', async () => {
  const controls = { ...CONTROLS, controls: [...CONTROLS.controls, {
    name: 'echoTrim', field: 'echo_trim', number: 99, type: 'number', min: 0, max: 100, default: 0,
    label: 'Trim', title: 'Makes all echoes stronger', panel: 'processing', row: 10, lock: 'processing',
  }] };
  await open({ controls });
  await page.locator('summary', { hasText: 'Processing' }).click();
  const shown = await page.locator('#echoTrim').evaluate((slider) => {
    const label = slider.closest('label');
    return [label.textContent, label.title, slider.min, slider.max, label === label.parentElement.lastElementChild];
  });
  assert.deepEqual(shown, ['Trim\u2013', 'Makes all echoes stronger', '0', '100', true]);
  const raw = new Promise((resolve) => { server.takeRaw = resolve; });
  await setSlider('echoTrim', 37);
  const bytes = Buffer.from(await raw);
  // Field 38 of Set, `controls`, with field 99 as a double inside.
  const inner = Buffer.concat([Buffer.from([0x99, 0x06]), Buffer.from(new Float64Array([37]).buffer)]);
  assert.ok(bytes.includes(Buffer.concat([Buffer.from([0xb2, 0x02, inner.length]), inner])), bytes.toString('hex'));
});

test('a locked control is greyed, but for the instructor, who locks and unlocks', async () => {
  await openFlat({}, {}, '?instructor=1');
  server.locked = ['gain', 'gain_auto', 'course_deg'];
  server.change({});
  await page.waitForFunction(() => document.querySelector('#gain').disabled && document.querySelector('#order-course').disabled);
  assert.equal(await page.locator('#sea').isDisabled(), false);
  assert.equal(await page.locator('#gain').getAttribute('title'), 'Locked by the instructor');

  await openTab(page, 'Set-up');
  await page.locator('#instructor > summary').click();
  await page.waitForFunction(() => !document.querySelector('#gain').disabled);
  assert.equal(await page.locator('#lock-gain').isChecked(), true);
  assert.equal(await page.locator('#lock-orders').evaluate((box) => box.indeterminate), true);
  await setSlider('gain', 70);
  await page.waitForFunction(() => window.skerry.settings().gain === 70);
  assert.equal(server.received.at(-1).set.instructor, true);

  await page.locator('#lock-gain + span').click();
  await page.locator('#lock-range + span').click();
  await page.waitForFunction(() => window.skerry.settings().locked.includes('range_nm'));
  assert.deepEqual(server.locked, ['course_deg', 'range_nm', 'instrumented_range_m']);
  await page.locator('#instructor > summary').click();
  await page.waitForFunction(() => document.querySelector('#range').disabled && !document.querySelector('#gain').disabled);
  assert.deepEqual(page.problems, []);
});

test('a ship that is driven from outside takes no orders', async () => {
  await openFlat({ driven: true });
  await page.waitForFunction(() => document.querySelector('#order-speed').disabled);
  server.driven = false;
  await page.waitForFunction(() => !document.querySelector('#order-speed').disabled);
});

test('what a recording does not tell of own ship is not shown', async () => {
  await openFlat({ untold: true });
  const told = () => page.evaluate(() => ['latitude', 'longitude', 'heading', 'speed', 'turn']
    .map((id) => document.getElementById(id).textContent));
  await page.waitForFunction(() => /^[0-9]/.test(document.querySelector('#order-course').placeholder));
  assert.deepEqual(await told(), ['–', '–', '–', '–', '–']);
  assert.equal(await page.locator('#orientation').textContent(), 'H UP · heading lost');
  server.untold = false;
  await page.waitForFunction(() => document.querySelector('#latitude').textContent !== '–');
  assert.ok((await told()).every((text) => text !== '–'));
});

test('echoes that approach are red, those that recede blue', async () => {
  await openFlat({ doppler: (deg) => (deg < 120 ? 1 : deg < 240 ? 2 : 0) });
  const shot = await capture(page);
  const counts = [[0, 0, 0], [0, 0, 0], [0, 0, 0]];  // by third of the circle: red, blue, neither
  for (let y = 0; y < shot.width; ++y) {
    for (let x = 0; x < shot.width; ++x) {
      const { bearingDeg, rangeM } = placeOf(shot, x + 0.5, y + 0.5);
      const third = Math.floor(bearingDeg / 120);
      // Near the middle a pixel is many degrees wide; not every pixel is an echo.
      if (rangeM < shot.rangeM / 10 || rangeM > shot.rangeM || Math.abs((bearingDeg % 120) - 60) > 58) continue;
      const [r, g, b] = shot.data.subarray((y * shot.width + x) * 4, (y * shot.width + x) * 4 + 3);
      if (Math.max(r, g, b) < 120) continue;
      counts[third][r > 2 * b && r > 2 * g ? 0 : b > 1.3 * r && b > 1.3 * g ? 1 : 2] += 1;
    }
  }
  assert.ok(counts[0][0] > 500 && counts[0][1] === 0 && counts[0][2] === 0, `approaching: ${counts[0]}`);
  assert.ok(counts[1][1] > 500 && counts[1][0] === 0 && counts[1][2] === 0, `receding: ${counts[1]}`);
  assert.ok(counts[2][2] > 500 && counts[2][0] === 0 && counts[2][1] === 0, `neither: ${counts[2]}`);
});

test('the instructor changes sea, rain and false echoes', async () => {
  await openFlat({}, {}, '?instructor=1');
  await openTab(page, 'Set-up');
  assert.equal(await page.locator('#seaState').isVisible(), false, 'folded away');
  await page.locator('#instructor > summary').click();
  await setSlider('seaState', 4.5);
  await page.locator('#windFromDeg').fill('310');
  await page.locator('#windFromDeg').press('Tab');
  await page.locator('#sideLobes + span').click();
  await page.locator('#rain-range').fill('2');
  await page.locator('#rain-rate').fill('16');
  await page.locator('#rain-add button').click();
  await page.waitForFunction(() => {
    const w = window.skerry.world();
    return w.seaState === 4.5 && w.windFromDeg === 310 && !w.sideLobes && w.rain.length === 1;
  });
  const [cell] = server.world.rain;
  assert.ok(Math.abs(cell.latitudeDeg - 60.3925 - 2 / 60) < 1e-3 && Math.abs(cell.longitudeDeg - 5.3233) < 1e-3);
  assert.equal(cell.rateMmH, 16);
  assert.equal(cell.kind, 0);
  await page.locator('#rain-cells button').click();
  await page.waitForFunction(() => window.skerry.world().rain.length === 0);
  // Each kind, by its name, to the server and back into the list.
  for (const [name, kind] of [['Cell', 0], ['Showers', 2], ['Squall line', 3], ['Even', 1]]) {
    await page.locator('#rain-kind').selectOption({ label: name });
    await page.locator('#rain-add button').click();
    await page.waitForFunction(() => window.skerry.world().rain.length === 1);
    assert.equal(server.world.rain[0].kind, kind, name);
    assert.match(await page.locator('#rain-cells span').innerText(), new RegExp(`: ${name.toLowerCase()}, 16 mm/h`));
    await page.locator('#rain-cells button').click();
    await page.waitForFunction(() => window.skerry.world().rain.length === 0);
  }
  assert.deepEqual(page.problems, []);
});

test('a change made at another console appears here', async () => {
  await openFlat({});
  server.change({ gain: 81, rangeNm: 24 });
  await page.waitForFunction(() => document.querySelector('#gain').value === '81' && document.querySelector('#range').value === '24');
  assert.equal(await page.locator('#gain-value').textContent(), '81');
  await page.waitForFunction(() => document.querySelector('#range-now').textContent === '24');
});

test('a refused change is told, and the old value comes back', async () => {
  await openFlat({});
  server.refuse = { code: 4, text: 'control from 10.0.0.7 needs a token' };
  await setSlider('gain', 90);
  await page.locator('.notice', { hasText: 'needs a token' }).waitFor();
  await page.waitForFunction(() => document.querySelector('#gain').value === '50');
  await page.locator('#token').fill('geheim');
  await page.locator('#token').press('Tab');
  server.refuse = null;
  await setSlider('gain', 90);
  await page.waitForFunction(() => window.skerry.settings().gain === 90);
  assert.equal(server.received.at(-1).set.token, 'geheim');
  assert.equal(server.received.filter((m) => m.kind === 'signIn').at(-1).signIn.token, 'geheim');
});

test('course and speed are ordered, also a course of zero', async () => {
  await openFlat({ headingDeg: 37 });
  await page.locator('#order-course').fill('0');
  await page.locator('#order-speed').fill('-2.5');
  await page.locator('#orders button').click();
  await page.waitForFunction(() => document.querySelector('#order-speed').placeholder === '-2.5');
  assert.deepEqual(server.ordered, { courseDeg: 0, speedKn: -2.5 });
  const set = server.received.at(-1).set;
  assert.equal(set._rangeNm, undefined);
  assert.equal(set._gain, undefined);
});

test('every lost spoke is counted, and no other', async () => {
  await openFlat({});
  assert.equal((await state(page)).lost, 0);
  server.drop(37);
  await page.waitForFunction(() => window.skerry.state().lost === 37);
  server.drop(1);
  await page.waitForFunction(() => window.skerry.state().lost === 38);
  await waitForScan(page);
  const { lost, received, restarts } = await state(page);
  assert.deepEqual([lost, restarts], [38, 0]);
  assert.ok(received > 4096);
  await page.waitForFunction(() => document.querySelector('#lost').textContent === '38');
});

test('a sector that comes no more goes out, the rest stays', async () => {
  await openFlat({ rpm: 15 });
  assert.ok(blobAt(await capture(page), 118, 1500, 3, 300));
  server.silent = [[100, 140]];
  const { scan } = await state(page);
  await page.waitForFunction((n) => window.skerry.state().scan >= n, scan + 4);
  const shot = await capture(page);
  assert.equal(blobAt(shot, 118, 1500, 3, 300), null);
  assert.ok(blobAt(shot, 190, 2500, 3, 300));
});

test('the console comes back when the server does', async () => {
  await openFlat({ headingDeg: 37 });
  await server.stop();
  await page.locator('#alarm', { hasText: 'Connection lost' }).waitFor();
  await page.waitForFunction(() => document.querySelector('#link').dataset.state === 'waiting');
  await server.start();
  await page.waitForFunction(() => window.skerry.state().connection === 'live');
  await waitForScan(page);
  checkPicture(await capture(page));
  await page.locator('#alarm').waitFor({ state: 'hidden' });
  assert.equal((await state(page)).lost, 0);
});

test('nonsense from the server is refused, and the picture goes on', async () => {
  await openFlat({ headingDeg: 37 });
  const r = random(7);
  const spoke = ServerMessage.encodeDelimited(ServerMessage.fromObject({ spoke: {
    sequence: 1, spokesPerTurn: 4096, bits: 8, cellCount: 1024, cellSizeM: 10, cells: new Uint8Array(1024) } })).finish();
  const nonsense = [
    Buffer.from([0xff, 0xff, 0xff, 0xff, 0x7f]), spoke.subarray(0, 500), Buffer.concat([spoke.subarray(0, 700), r.bytes(400)]),
    ...Array.from({ length: 60 }, () => Buffer.from(r.bytes(1 + r.below(300)).map((b, i) => (i === 0 ? b | 0x80 : b)))),
  ];
  nonsense.forEach((bytes) => server.sendRaw(bytes));
  server.sendRaw('a text message');
  await page.waitForFunction((n) => window.skerry.state().garbage >= n, 40);
  assert.equal((await state(page)).connection, 'live');
  await page.locator('.notice', { hasText: 'no radar message' }).first().waitFor();
  assert.ok(await page.locator('.notice').count() <= 3);
  await waitForScan(page);
  checkPicture(await capture(page));
  assert.deepEqual(page.problems, []);
});

test('another own ship is chosen, and only its radar is drawn', async () => {
  await openFlat({});
  await page.locator('#radar').selectOption({ label: 'Gannet · X-band' });
  await page.waitForFunction(() => window.skerry.state().radar === 1 && window.skerry.state().received > 0);
  const subscribe = server.received.findLast((m) => m.kind === 'subscribe').subscribe;
  assert.equal(subscribe.radar, 1);
  await page.waitForFunction(() => document.querySelector('#longitude').textContent === '004°19.398′E');
  await waitForScan(page);
  checkPicture(await capture(page));
});

test('the cursor reads true and relative bearing and range', async () => {
  await openFlat({ headingDeg: 37, settings: { rangeNm: 1.5 } });
  const box = await page.locator('#ppi').boundingBox();
  const { x, y } = await page.evaluate(() => window.skerry.pixelFor(118, 1500));
  await page.mouse.move(box.x + x, box.y + y);
  await page.waitForFunction(() => document.querySelector('#cursor-true').textContent !== '–');
  const text = (id) => page.locator(`#${id}`).textContent();
  assert.ok(angleBetween(parseFloat(await text('cursor-true')), 118) < 0.3);
  assert.ok(angleBetween(parseFloat(await text('cursor-relative')), 81) < 0.3);
  assert.ok(Math.abs(parseFloat(await text('cursor-range')) - 1500 / NM) < 0.006);
  assert.ok(Math.abs(parseFloat(await text('cursor-metres')) - 1500) < 10);
  await page.keyboard.press('e');
  await page.keyboard.press('v');
  await page.mouse.down();
  await page.mouse.up();
  await page.waitForFunction(() => document.querySelector('#ebl-true').textContent.startsWith('11'));
  const [ebl, vrm] = [parseFloat(await text('ebl-true')), parseFloat(await text('vrm-range'))];
  await page.keyboard.press('ArrowRight');
  await page.keyboard.press('ArrowUp');
  await page.waitForFunction((old) => parseFloat(document.querySelector('#ebl-true').textContent) !== old, ebl);
  assert.ok(Math.abs(parseFloat(await text('ebl-true')) - ebl - 1) < 0.11);
  assert.ok(Math.abs(parseFloat(await text('vrm-range')) - vrm - 0.015) < 0.0015);
});

test('trails show where echoes were', async () => {
  await openFlat({ headingDeg: 0 });
  await page.locator('#trails').selectOption('360');
  await waitForScan(page);
  server.silent = [];
  server.change({ gain: 5 });   // every echo falls below what is shown as strong
  await waitForScan(page);
  // A picture that is held does not fade, however busy the machine.
  const { scan } = await state(page);
  await page.evaluate((last) => window.skerry.holdAfter(last), scan);
  await page.waitForFunction((last) => window.skerry.state().newestScan > last, scan);
  const shot = await capture(page);
  const { x, y } = await page.evaluate(() => window.skerry.pixelFor(190, 2500));
  const at = (px, py) => [...shot.data.subarray(4 * (Math.floor(py) * shot.width + Math.floor(px)), 4 * (Math.floor(py) * shot.width + Math.floor(px)) + 3)];
  const open = await page.evaluate(() => window.skerry.pixelFor(150, 2500));
  assert.ok(at(x, y)[2] > at(open.x, open.y)[2] + 40, `${at(x, y)} on the trail, ${at(open.x, open.y)} beside it`);
});

test('a lost graphics context is drawn anew', async () => {
  await openFlat({ headingDeg: 37 });
  await page.evaluate(() => {
    const canvas = document.querySelector('#echoes');
    const extension = canvas.getContext('webgl2').getExtension('WEBGL_lose_context');
    window.restored = new Promise((resolve) => canvas.addEventListener('webglcontextrestored', resolve));
    canvas.addEventListener('webglcontextlost', () => setTimeout(() => extension.restoreContext(), 0));
    extension.loseContext();
    return window.restored;
  });
  await waitForScan(page);
  checkPicture(await capture(page));
});

// The short form of soak.mjs, which goes on for hours.
test('half a minute of 4096 spokes of 1024 cells keeps the memory bounded', async (t) => {
  await open({ headingDeg: 37, rpm: 24 });
  const client = await page.context().newCDPSession(page);
  const heapMiB = async () => {
    await client.send('HeapProfiler.collectGarbage');
    const { usedSize, backingStorageSize } = await client.send('Runtime.getHeapUsage');
    return (usedSize + (backingStorageSize ?? 0)) / 2 ** 20;
  };
  const untilReceived = (n) => page.waitForFunction((want) => window.skerry.state().received + window.skerry.state().lost >= want, n, { timeout: 240000 });
  const perSecond = 4096 * 24 / 60;
  await untilReceived(8 * perSecond);
  const early = await heapMiB();
  await untilReceived(28 * perSecond);
  const late = await heapMiB();
  const { framesPerSecond, lost, rpm, spokesPerSecond } = await state(page);
  t.diagnostic(`${early.toFixed(1)} MiB after 8 s, ${late.toFixed(1)} MiB after 28 s; ${framesPerSecond.toFixed(1)} frames/s at ` +
    `1280x800, ${rpm.toFixed(2)} rpm, ${spokesPerSecond.toFixed(0)} spokes/s, ${lost} lost`);
  assert.ok(late < early + 2, `${early} MiB, then ${late} MiB`);
  assert.deepEqual(page.problems, []);
});
