// The picture and its measuring tools in a real Chromium, measured on the screen.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { capture, openConsole, waitForScan } from '../browser.mjs';
import { eachTest } from '../each_test.mjs';
import { angleBetween, blobAt, place } from '../measure.mjs';
import { NM, TARGETS } from '../mock_scene.mjs';
import { MockServer } from '../mock_server.mjs';

let browser, server, page, url;
eachTest((b) => { browser = b; }, () => { const opened = { page, server }; page = server = null; return opened; });

const OWN = { latitudeDeg: 60.3925, longitudeDeg: 5.3233 };
const SHIP = { courseOverGroundDeg: 37, speedOverGroundKn: 12, lengthM: 120, beamM: 20 };

async function open(options = {}, viewport) {
  // A coarse radar, so that the tools' tests do not wait for spokes.
  server = new MockServer({ rpm: 120, spokes: 720, cells: 512, headingDeg: 37, ownShipMore: SHIP, ...options });
  url = await server.start();
  page = await openConsole(browser, url, viewport);
  await page.locator('#afterglow').fill('0');
  await waitForScan(page);
}

const showTab = (name) => page.evaluate((tab) => window.skerry.showTab(tab), name);
const text = (id) => page.locator(`#${id}`).textContent();
const ppi = () => page.evaluate(() => window.skerry.ppi);
const tools = () => page.evaluate(() => window.skerry.tools());
const until = (id, wanted) => page.waitForFunction(([i, w]) => document.getElementById(i).textContent === w, [id, wanted]);
const onPage = async ({ x, y }) => {
  const box = await page.locator('#ppi').boundingBox();
  return { x: box.x + x, y: box.y + y };
};
const pixelFor = (deg, m) => page.evaluate(([b, r]) => window.skerry.pixelFor(b, r), [deg, m]);
async function moveTo(deg, m) {
  const { x, y } = await onPage(await pixelFor(deg, m));
  await page.mouse.move(x, y);
}
async function clickAt(deg, m) {
  await moveTo(deg, m);
  await page.mouse.down();
  await page.mouse.up();
}
async function dragFrom([deg, m], [toDeg, toM]) {
  await moveTo(deg, m);
  await page.mouse.down();
  await moveTo(toDeg, toM);
  await page.mouse.up();
}

// The strongest ink of a layer within a pixel of each place, [r, g, b, alpha]; places in CSS pixels of the picture.
async function ink(id, places) {
  return page.evaluate(async ([name, all]) => {
    await window.skerry.drawn(2);
    const canvas = document.getElementById(name);
    const ratio = window.skerry.ppi.pixelRatio, c = canvas.getContext('2d', { willReadFrequently: true });
    const { data } = c.getImageData(0, 0, canvas.width, canvas.width);
    return all.map(({ x, y }) => {
      let most = [0, 0, 0, 0];
      for (let dy = -1; dy <= 1; ++dy) {
        for (let dx = -1; dx <= 1; ++dx) {
          const i = 4 * (Math.floor(y * ratio + dy) * canvas.width + Math.floor(x * ratio + dx));
          if (data[i + 3] > most[3]) most = [...data.subarray(i, i + 4)];
        }
      }
      return most;
    });
  }, [id, places]);
}
const alphas = async (id, places) => (await ink(id, places)).map(([, , , alpha]) => alpha);
// Whether there is a mark at [bearing, range].
async function marked(...places) {
  const at = [];
  for (const [deg, m] of places) at.push(await pixelFor(deg, m));
  return (await alphas('marks', at)).map((alpha) => alpha > 100);
}

test('off-centre by hand: echoes, scale and rings are as seen from own ship, never beyond 75 %', async () => {
  await open({ rpm: 60, spokes: 4096, cells: 1024 });
  await page.keyboard.press('Shift+o');
  await page.locator('#picture-mode', { hasText: 'own ship' }).waitFor();
  const before = await ppi();
  const to = await onPage({ x: before.centre.x - 0.3 * before.radiusPx, y: before.centre.y + 0.4 * before.radiusPx });
  await page.mouse.click(to.x, to.y);
  await page.waitForFunction((old) => window.skerry.ppi.own.x !== old, before.own.x);
  assert.ok(await page.locator('#picture-mode').isHidden(), 'one press, then all is as before');
  await waitForScan(page);
  const shot = await capture(page);
  assert.ok(Math.abs(shot.own.x - before.centre.x + 0.3 * shot.radiusPx) < 1 && Math.abs(shot.own.y - before.centre.y - 0.4 * shot.radiusPx) < 1);
  let seen = 0;
  for (const target of TARGETS) {
    const { x, y } = await pixelFor(target.bearingDeg, target.rangeM);
    if (Math.hypot(x - shot.centre.x, y - shot.centre.y) > shot.radiusPx * 0.95) continue;
    const blob = blobAt(shot, target.bearingDeg, target.rangeM, 3, 450);
    assert.ok(blob && angleBetween(blob.bearingDeg, target.bearingDeg) <= 1 && Math.abs(blob.rangeM - target.rangeM) <= 111, JSON.stringify({ target, blob }));
    seen += 1;
  }
  assert.ok(seen >= 4, `${seen} targets`);
  // Marks of the scale: along the ray of each 10 degrees, just outside the circle; none 2.5 degrees beside.
  const outside = (deg) => {
    const s = Math.sin(deg * Math.PI / 180), c = -Math.cos(deg * Math.PI / 180);
    const ox = shot.own.x - shot.centre.x, oy = shot.own.y - shot.centre.y;
    const along = ox * s + oy * c;
    const r = -along + Math.sqrt(along * along + shot.radiusPx ** 2 - ox * ox - oy * oy);
    const x = ox + r * s, y = oy + r * c;
    const out = 1 + 9 / shot.radiusPx;
    return { x: shot.centre.x + x * out, y: shot.centre.y + y * out };
  };
  const tens = Array.from({ length: 36 }, (_, i) => 10 * i);
  const on = await alphas('graticule', tens.map(outside)), off = await alphas('graticule', tens.map((deg) => outside(deg + 2.5)));
  for (const i of tens.keys()) assert.ok(on[i] > 80 && off[i] < 60, `at ${tens[i]}: ${on[i]}, beside ${off[i]}`);
  // Rings stand around own ship, a mile apart.
  for (const deg of [60, 100]) {
    const [ring, beside] = await alphas('graticule', [await pixelFor(deg, 3 * NM), await pixelFor(deg, 3.4 * NM)]);
    assert.ok(ring > 40 && beside < 20, `ring on ${deg}: ${ring}, beside ${beside}`);
  }
  assert.equal(await text('own-place'), 'Off-centre 50 %');
  // The keys move her, at most to 75 %, and that is told.
  await page.keyboard.press('Shift+o');
  for (let i = 0; i < 9; ++i) await page.keyboard.press('Shift+ArrowLeft');
  await page.locator('.notice', { hasText: '75 %' }).waitFor();
  await page.waitForFunction(() => {
    const { own, centre, radiusPx } = window.skerry.ppi;
    return Math.abs(Math.hypot(own.x - centre.x, own.y - centre.y) / radiusPx - 0.75) < 1e-6;
  });
  await page.keyboard.press('Escape');
  await page.keyboard.press('PageUp');
  await page.waitForFunction(() => { const p = window.skerry.ppi; return p.own.y > p.centre.y + 0.4 * p.radiusPx; });
  await page.keyboard.press('Home');
  await page.waitForFunction(() => { const p = window.skerry.ppi; return p.own.x === p.centre.x && p.own.y === p.centre.y; });
  assert.deepEqual(page.problems, []);
});

test('beyond the video there is no sea, but a line where it ends', async () => {
  await open();
  await page.evaluate(() => localStorage.setItem('skerry.picture', JSON.stringify({ ownX: 0, ownY: -0.7, afterglow: 0, rings: false, headingLine: false })));
  await page.goto(url);
  await page.waitForFunction(() => window.skerry?.ppi.rangeM > 0 && window.skerry.ppi.own.y > window.skerry.ppi.centre.y);
  await waitForScan(page);
  const shot = await capture(page);
  const at = async (m) => {
    const { x, y } = await pixelFor(0, m);
    let most = [0, 0, 0];
    for (const d of [-1, 0, 1]) {
      const i = 4 * (Math.floor(y + d) * shot.width + Math.floor(x));
      most = most.map((v, c) => Math.max(v, shot.data[i + c]));
    }
    return most[2];
  };
  const [sea, line, beyond] = [await at(5.2 * NM), await at(6 * NM), await at(7.5 * NM)];
  assert.ok(line > sea + 12 && beyond < sea * 0.7, `sea ${sea}, line ${line}, beyond ${beyond}`);
  await until('video-limit', 'Video to 6 NM');
});

for (const viewport of [{ width: 1024, height: 768 }, { width: 1280, height: 800 }, { width: 1920, height: 1200 }]) {
  test(`EBL and VRM are right, and the data cover nothing of the circle, at ${viewport.width} x ${viewport.height}`, async (t) => {
    await open({}, { viewport });
    for (const key of ['e', 'v', 'Shift+E', 'Shift+V', 'Shift+I']) await page.keyboard.press(key);
    await page.waitForFunction(() => !document.querySelector('#lines-box').hidden);
    await page.keyboard.press('Shift+I');
    const shown = await ppi();
    const box = await page.locator('#ppi').boundingBox();
    const middle = { x: box.x + shown.centre.x, y: box.y + shown.centre.y };
    for (const corner of await page.locator('.corner').all()) {
      const b = await corner.boundingBox();
      const dx = Math.max(b.x - middle.x, 0, middle.x - b.x - b.width), dy = Math.max(b.y - middle.y, 0, middle.y - b.y - b.height);
      assert.ok(Math.hypot(dx, dy) >= shown.radiusPx, `${await corner.getAttribute('aria-label')} covers the picture`);
    }
    const metresPerPx = shown.rangeM / shown.radiusPx, boundM = Math.max(shown.rangeM / 100, 30);
    let worstDeg = 0, worstM = 0;
    // Both pairs, each put on a target that stands alone.
    for (const [n, target] of [[1, TARGETS[2]], [0, TARGETS[5]]]) {
      const old = (await tools()).ebls[n].bearingDeg;
      if (n === 0) {
        // It becomes the active one by being taken.
        await dragFrom([old, 5.4 * NM], [old + 2, 5.4 * NM]);
        assert.equal((await tools()).active, 0);
      }
      await clickAt(target.bearingDeg, target.rangeM);
      const { ebls, vrms } = await tools();
      worstDeg = Math.max(worstDeg, angleBetween(ebls[n].bearingDeg, target.bearingDeg));
      worstM = Math.max(worstM, Math.abs(vrms[n].rangeM - target.rangeM));
      // What is drawn stands where the numbers say.
      const suffix = n === 0 ? '' : '2';
      await page.waitForFunction(([id, deg]) => Math.abs(parseFloat(document.getElementById(id).textContent) - deg) < 0.06, [`ebl${suffix}-true`, ebls[n].bearingDeg]);
      const readM = parseFloat(await text(`vrm${suffix}-range`)) * NM;
      assert.ok(Math.abs(readM - vrms[n].rangeM) <= 0.006 * NM);
      await page.mouse.move(5, 5);
      // The middle of the ink on an arc, or along a ray, about what is read; blue as EBL and VRM are.
      const drawn = async (arc) => {
        const values = Array.from({ length: 161 }, (_, i) => (i - 80) / 80);
        const pixels = await page.evaluate((all) => all.map(([deg, m]) => window.skerry.pixelFor(deg, m)), values.map(arc));
        const hits = (await ink('marks', pixels)).map(([r, g, b, alpha], i) => (alpha > 60 && b > r + 30 && b > g ? values[i] : null)).filter((v) => v !== null);
        return hits.length ? hits.reduce((sum, v) => sum + v, 0) / hits.length : NaN;
      };
      // Both are dashed: the first place where there is a dash.
      const [deg, rangeM] = [ebls[n].bearingDeg, vrms[n].rangeM];
      let offDeg = NaN, offM = NaN;
      for (let part = 0.55; part < 0.95 && Number.isNaN(offDeg); part += 0.013) {
        if (vrms.some((v) => Math.abs(part * shown.rangeM - v.rangeM) < 8 * metresPerPx)) continue;
        offDeg = 2 * await drawn((v) => [deg + 2 * v, part * shown.rangeM]);
      }
      for (let b = 60; b < 110 && Number.isNaN(offM); b += 1.7) offM = 2 * boundM * await drawn((v) => [b, rangeM + 2 * boundM * v]);
      assert.ok(Math.abs(offDeg) <= 0.5, `EBL ${n + 1} is drawn ${offDeg} deg beside what it reads`);
      assert.ok(Math.abs(offM) <= boundM, `VRM ${n + 1} is drawn ${offM} m beside what it reads`);
    }
    t.diagnostic(`placed with the mouse: worst ${worstDeg.toFixed(2)} deg, ${worstM.toFixed(0)} m`);
    assert.ok(worstDeg <= 0.5 && worstM <= boundM, `${worstDeg} deg, ${worstM} m`);
    assert.deepEqual(page.problems, []);
  });
}

test('a marker is taken by itself: the range circle without the bearing line', async () => {
  await open();
  await page.keyboard.press('e');
  await page.keyboard.press('v');
  await dragFrom([200, 3 * NM], [200, 4 * NM]);
  let now = await tools();
  assert.ok(Math.abs(now.vrms[0].rangeM - 4 * NM) < 60 && now.ebls[0].bearingDeg === 45, JSON.stringify(now.vrms[0]));
  await dragFrom([45, 2 * NM], [80, 2 * NM]);
  now = await tools();
  assert.ok(Math.abs(now.ebls[0].bearingDeg - 80) < 0.5 && Math.abs(now.vrms[0].rangeM - 4 * NM) < 60, JSON.stringify(now));
});

test('numbers are entered by hand, and what is out of range is refused beside the field', async () => {
  await open();
  await showTab('tools');
  await page.keyboard.press('e');
  await page.keyboard.press('v');
  const bearing = page.getByLabel('Bearing of EBL 1', { exact: true }), range = page.getByLabel('Range of VRM 1', { exact: true });
  await bearing.fill('212.5');
  await bearing.press('Tab');
  await range.fill('2.25');
  await range.press('Tab');
  await until('ebl-true', '212.5°');
  await until('vrm-range', '2.250 NM');
  await until('ebl-relative', '175.5°');
  await bearing.fill('400');
  await bearing.press('Tab');
  const refusal = page.locator('.refusal:visible');
  assert.match(await refusal.textContent(), /0 to 359\.9 °/);
  const [field, said] = [await bearing.boundingBox(), await refusal.boundingBox()];
  assert.ok(Math.abs(said.y - field.y - field.height) < 12, 'beside the field');
  assert.equal((await tools()).ebls[0].bearingDeg, 212.5);
  // Relative: it turns with own ship.
  await page.locator('#ebl1-frame').click();
  await page.waitForFunction(() => Math.abs(window.skerry.tools().ebls[0].bearingDeg - 175.5) < 0.01);
  server.headingDeg = 57;
  await until('ebl-true', '232.5°');
  await until('ebl-relative', '175.5°');
});

test('the origin of EBL and VRM is moved to a place on earth, by hand and by numbers', async () => {
  await open();
  await showTab('tools');
  await page.keyboard.press('e');
  await page.keyboard.press('v');
  await page.locator('#origin1').selectOption('place');
  await page.locator('#origin1-choose').click();
  await clickAt(118, 3000);
  let { origin } = (await tools()).ebls[0];
  const north = (origin.latitudeDeg - OWN.latitudeDeg) * 60 * 1857, east = (origin.longitudeDeg - OWN.longitudeDeg) * 60 * 1857 * Math.cos(60.39 * Math.PI / 180);
  assert.ok(Math.abs(Math.hypot(north, east) - 3000) < 60 && angleBetween(Math.atan2(east, north) * 180 / Math.PI, 118) < 1, JSON.stringify(origin));
  // The range circle is now around that place.
  const field = page.getByLabel('Range of VRM 1', { exact: true });
  await field.fill('1');
  await field.press('Tab');
  await page.mouse.move(5, 5);
  const centre = await pixelFor(118, 3000), { radiusPx, rangeM } = await ppi(), r = (NM / rangeM) * radiusPx;
  const around = Array.from({ length: 72 }, (_, i) => i * 5 * Math.PI / 180).map((a) => ({ x: centre.x + r * Math.sin(a), y: centre.y - r * Math.cos(a) }));
  const found = (await alphas('marks', around)).filter((alpha) => alpha > 60).length;
  assert.ok(found > 35, `${found} of 72 places on the circle`);
  await page.locator('#origin1').selectOption('off');
  const range = page.getByLabel('Range of origin 1', { exact: true });
  await range.fill('2.5');
  await range.press('Tab');
  ({ origin } = (await tools()).ebls[0]);
  assert.ok(Math.abs(origin.rangeM - 2.5 * NM) < 1 && angleBetween(origin.bearingDeg, 118) < 1);
});

test('parallel lines keep their distance over a change of range, and their bearing over one of heading', async () => {
  await open();
  await showTab('tools');
  await page.keyboard.press('Shift+i');
  await page.locator('#parallel > summary').click();
  const enter = async (name, value) => { const f = page.getByLabel(name, { exact: true }); await f.fill(value); await f.press('Tab'); };
  await enter('Bearing of the line', '350');
  await enter('Offset of the line, to port negative', '-1.5');
  await enter('Line to, astern negative', '2');
  const at = (along, off) => [350 + Math.atan2(off, along) * 180 / Math.PI, Math.hypot(off, along) * NM];
  const places = [at(1, -1.5), at(1.9, -1.5), at(2.2, -1.5), at(1, -1.2)];
  const seen = async (along, off) => (await marked(at(along, off)))[0];
  await page.mouse.move(5, 5);
  await page.waitForFunction(() => window.skerry.tools().lines[0].toM !== null);
  assert.deepEqual(await marked(...places), [true, true, false, false]);
  server.headingDeg = 120;
  server.change({ rangeNm: 3 });
  await page.waitForFunction(() => Math.abs(window.skerry.ppi.rangeM - 5556) < 1 && Math.abs(window.skerry.state().headingDeg - 120) < 1);
  assert.deepEqual(await marked(...places), [true, true, false, false]);
  // Taken with the mouse, then turned off with the group, and back.
  await dragFrom(at(0.5, -1.5), at(0.5, -0.9));
  assert.ok(Math.abs((await tools()).lines[0].offsetM + 0.9 * NM) < 30);
  await page.mouse.move(5, 5);
  assert.equal(await seen(1, -0.9), true);
  await page.keyboard.press('Shift+i');
  assert.equal(await seen(1, -0.9), false);
  await page.locator('#lines-all').click();
  assert.equal(await seen(1, -0.9), true);
  for (const n of [2, 3, 4]) {
    await page.getByRole('button', { name: `Line ${n}`, exact: true }).first().click();
    await page.locator('#line-on').click();
  }
  await until('lines-on', '1 2 3 4');
  await page.locator('#lines-reset').click();
  await page.waitForFunction(() => window.skerry.tools().lines.every(({ on }) => !on));
});

test('course-up holds its course until reset; without heading the bow is up, and that stands there', async () => {
  await open({ headingDeg: 80 });
  await page.keyboard.press('c');
  await until('orientation', 'C UP');
  server.headingDeg = 110;
  await page.waitForFunction(() => Math.abs(window.skerry.state().headingDeg - 110) < 0.1);
  await waitForScan(page);
  const shot = await capture(page);
  assert.ok(angleBetween(shot.upDeg, 80) < 0.01);
  const blob = blobAt(shot, 118, 1500, 3, 300);
  assert.ok(blob && angleBetween(blob.bearingDeg, 118) < 1);
  await page.locator('#motion-reset').click();
  await page.waitForFunction(() => Math.abs(window.skerry.ppi.upDeg - 110) < 0.01);
  await page.keyboard.press('Shift+t');
  await until('motion', 'TM');
  server.ownShipMore = { ...SHIP, noHeading: true };
  await until('orientation', 'H UP · heading lost');
  await until('motion', 'RM');
  assert.equal(await text('stabilisation'), 'GND · position');
  assert.equal(await text('heading-short'), '–');
  server.ownShipMore = { ...SHIP, noPosition: true };
  await until('stabilisation', 'WATER · log, heading · position lost');
  await until('orientation', 'C UP');
  assert.deepEqual(page.problems, []);
});

test('in true motion own ship sails over the picture, and begins anew at 75 % with most view ahead', async () => {
  let eastM = 0;
  const perDegree = 60 * 1857 * Math.cos(60.3925 * Math.PI / 180);
  await open({
    headingDeg: 90, settings: { rangeNm: 0.25 }, ownShipMore: { ...SHIP, courseOverGroundDeg: 90 },
    place: () => ({ ...OWN, longitudeDeg: OWN.longitudeDeg + eastM / perDegree }),
  });
  await page.keyboard.press('Shift+t');
  await page.locator('#trails').selectOption('60');
  await until('motion', 'TM');
  await until('trail-state', 'T 1 min');
  const place = async () => {
    const { own, centre, radiusPx } = await ppi();
    return { x: (own.x - centre.x) / radiusPx, y: (own.y - centre.y) / radiusPx };
  };
  const begin = await place();
  assert.ok(begin.x < -0.5 && begin.x > -0.75 && Math.abs(begin.y) < 0.01, JSON.stringify(begin));
  // East, 40 m at a time: 0.0864 of the radius.
  let at = begin, steps = 0;
  for (; steps < 40; ++steps) {
    const { own } = await ppi();
    eastM += 40;
    await page.waitForFunction((old) => window.skerry.ppi.own.x !== old, own.x);
    const next = await place();
    if (next.x < at.x) { at = next; break; }
    assert.ok(Math.abs(next.x - at.x - 40 / (0.25 * NM)) < 0.002 && next.x < 0.75, JSON.stringify([at, next]));
    at = next;
  }
  assert.equal(steps, Math.ceil((0.75 + 0.7) / (40 / (0.25 * NM))) - 1, 'it begins anew at 75 %');
  assert.ok(Math.abs(at.x - begin.x) < 0.001, 'where it began');
  await page.locator('.notice', { hasText: 'reset' }).first().waitFor();
  const { own } = await ppi();
  eastM += 40;
  await page.waitForFunction((old) => window.skerry.ppi.own.x !== old, own.x);
  await page.locator('#motion-reset').click();
  await page.waitForFunction(() => { const { own, centre, radiusPx } = window.skerry.ppi; return Math.abs((own.x - centre.x) / radiusPx + 0.7) < 1e-6; });
  // Relative trails are refused while she sails.
  await page.locator('input[name=trail-mode][value=relative] + span').click();
  await page.locator('.notice', { hasText: 'true trails' }).first().waitFor();
  assert.equal(await text('trail-state'), 'T 1 min');
  await page.keyboard.press('Shift+t');
  await until('motion', 'RM(T)');
  await page.locator('input[name=trail-mode][value=relative] + span').click();
  await until('motion', 'RM(R)');
  assert.deepEqual(page.problems, []);
});

test('true and relative trails show where echoes were, and neither is lost by the other', async () => {
  // A turn of more than a second: what was not painted for 2.6 turns goes out, and a busy machine may paint nothing for one.
  await open({ headingDeg: 0, rpm: 40 });
  await page.locator('#trails').selectOption('360');
  await waitForScan(page);
  server.change({ gain: 5 });
  await waitForScan(page);
  // No spoke is drawn any more, so that no sweep lights the sea.
  await page.evaluate(() => window.skerry.holdAfter(window.skerry.state().scan - 1));
  const blue = async () => {
    const shot = await capture(page);
    const at = ({ x, y }) => shot.data[4 * (Math.floor(y) * shot.width + Math.floor(x)) + 2];
    return at(place(shot, 190, 2500)) - at(place(shot, 150, 2500));
  };
  await until('motion', 'RM(R)');
  assert.ok(await blue() > 40, `relative: ${await blue()}`);
  await page.locator('input[name=trail-mode][value=true] + span').click();
  await until('motion', 'RM(T)');
  await until('trail-state', 'T 6 min');
  assert.ok(await blue() > 40, `true: ${await blue()}`);
  server.change({ rangeNm: 3 });
  await page.waitForFunction(() => Math.abs(window.skerry.ppi.rangeM - 5556) < 1);
  assert.ok(await blue() > 40, `another range: ${await blue()}`);
  await page.locator('#brilliance-trails').evaluate((slider) => { slider.value = '10'; slider.dispatchEvent(new Event('input')); });
  assert.ok(await blue() < 20, `dimmed: ${await blue()}`);
  await page.locator('#trails').selectOption('0');
  await until('motion', 'RM');
  assert.equal(await text('trail-state'), 'off');
});

test('the cursor reads a position and the time to it, and two presses measure between two points', async () => {
  await open();
  await moveTo(118, 3000);
  await page.waitForFunction(() => document.querySelector('#cursor-ttg').textContent !== '–');
  const minutes = (s) => { const [, d, m] = /(\d+)°([\d.]+)/.exec(s); return Number(d) * 60 + Number(m); };
  const north = minutes(await text('cursor-latitude')) - OWN.latitudeDeg * 60, east = minutes(await text('cursor-longitude')) - OWN.longitudeDeg * 60;
  assert.ok(Math.abs(north - 3000 * Math.cos(118 * Math.PI / 180) / 1857) < 0.03, `${north}`);
  assert.ok(Math.abs(east - 3000 * Math.sin(118 * Math.PI / 180) / 1857 / Math.cos(60.39 * Math.PI / 180)) < 0.06, `${east}`);
  const [m, s] = (await text('cursor-ttg')).split(':').map(Number);
  assert.ok(Math.abs(m * 60 + s - (3000 / NM / 12) * 3600) < 15);
  await page.keyboard.press('b');
  await clickAt(90, 2 * NM);
  await clickAt(180, 2 * NM);
  await page.mouse.move(5, 5);
  await page.locator('#measure-box').waitFor();
  // Written a few times a second: from the second press on, not while the pointer was on its way there.
  await page.waitForFunction((nm) => Math.abs(parseFloat(document.querySelector('#measure-range').textContent) - nm) < 0.03, 2 * Math.SQRT2);
  assert.ok(angleBetween(parseFloat(await text('measure-bearing')), 225) < 0.6, await text('measure-bearing'));
  await page.keyboard.press('Escape');
  await page.locator('#measure-box').waitFor({ state: 'hidden' });
});

test('the heading line is off while it is held; stern marks and own ship\'s outline are drawn', async () => {
  await open({ settings: { rangeNm: 0.25 } });
  const line = async (deg, m) => (await marked([deg, m]))[0];
  assert.equal(await line(37, 300), true);
  await page.keyboard.down('Shift');
  await page.keyboard.down('L');
  await page.waitForFunction(() => document.querySelector('#heading-hold').getAttribute('aria-pressed') === 'true');
  assert.equal(await line(37, 300), false);
  await page.keyboard.up('L');
  await page.keyboard.up('Shift');
  await page.waitForFunction(() => document.querySelector('#heading-hold').getAttribute('aria-pressed') === 'false');
  assert.equal(await line(37, 300), true);
  await page.locator('#heading-hold').scrollIntoViewIfNeeded();
  await page.locator('#heading-hold').hover();
  await page.mouse.down();
  assert.equal(await line(37, 300), false);
  await page.mouse.up();
  assert.equal(await line(37, 300), true);
  // Her side is 10 m abeam of her middle; at 6 NM she is a cross.
  assert.equal(await line(37 + 90, 10), true);
  const stern = async () => (await marked(...Array.from({ length: 50 }, (_, i) => [217, 100 + 4 * i]))).includes(true);
  assert.equal(await line(217, 60), true, 'her stern');
  assert.equal(await stern(), false);
  await page.locator('#stern-marks + span').click();
  assert.equal(await stern(), true);
});

test('what is chosen survives a reload, and default settings are one action with a question', async () => {
  await open();
  await page.keyboard.press('h');
  await page.keyboard.press('Shift+E');
  await page.locator('#trails').selectOption('1800');
  await page.locator('#echo').selectOption('levels');
  await page.reload();
  await page.waitForFunction(() => window.skerry?.state().headingDeg !== null && document.querySelector('#orientation').textContent === 'H UP');
  assert.deepEqual([await page.locator('#trails').inputValue(), await page.locator('#echo').inputValue(), (await tools()).ebls[1].on], ['1800', 'levels', true]);
  await page.locator('#defaults').click();
  await page.locator('#defaults-ask button[value=no]').click();
  assert.equal(await page.locator('#trails').inputValue(), '1800');
  await page.locator('#defaults').click();
  await page.locator('#defaults-ask button[value=yes]').click();
  await until('orientation', 'N UP');
  await until('motion', 'TM');
  await until('trail-state', 'T 6 min');
  const now = await tools();
  assert.deepEqual([now.ebls.map((e) => e.on), now.vrms.map((v) => v.on), await page.locator('#rings').isChecked()], [[true, false], [true, false], false]);
  assert.deepEqual(page.problems, []);
});

test('by night echoes are dark red, by dusk orange, and what the receiver does stands beside them', async () => {
  await open();
  const brightest = async () => {
    const shot = await capture(page);
    const { x, y } = await pixelFor(118, 1500);
    const pixels = [];
    for (let dy = -3; dy <= 3; ++dy) {
      for (let dx = -3; dx <= 3; ++dx) {
        const i = 4 * (Math.floor(y + dy) * shot.width + Math.floor(x + dx));
        pixels.push([...shot.data.subarray(i, i + 3)]);
      }
    }
    return pixels.sort((a, b) => b[0] - a[0])[0];
  };
  const day = await brightest();
  assert.ok(day[0] > 150 && day[1] > 0.85 * day[0] && day[2] < 110, `yellow by day: ${day}`);
  await page.keyboard.press('p');
  const dusk = await brightest();
  assert.ok(dusk[0] > 150 && dusk[1] < 0.85 * dusk[0] && dusk[1] > 0.5 * dusk[0] && dusk[2] < 90, `${dusk}`);
  await page.keyboard.press('p');
  const night = await brightest();
  assert.ok(night[0] > 60 && night[0] < 140 && night[1] < 20 && night[2] < 20, `${night}`);
  server.change({ gain: 61, sea: 12, rain: 7, seaAuto: true });
  await until('gain-short', '61');
  assert.deepEqual([await text('sea-short'), await text('rain-short'), await text('tune-short')], ['12 A', '7', '50 A']);
  assert.equal(await page.locator('#tune-bar').evaluate((m) => m.value), 50);
  assert.match(await text('clock'), /^\d\d:\d\d:\d\d$/);
});

test('with fingers: a marker is taken from 20 pixels away, and two fingers move own ship', async () => {
  await open({}, { viewport: { width: 1280, height: 800 }, hasTouch: true });
  await page.keyboard.press('e');
  const cdp = await page.context().newCDPSession(page);
  const touch = (type, ...points) => cdp.send('Input.dispatchTouchEvent', { type, touchPoints: points.map((p, id) => ({ ...p, id })) });
  const on = await pixelFor(45, 3 * NM), beside = await onPage({ x: on.x + 14, y: on.y + 14 });
  await touch('touchStart', beside);
  const to = await onPage(await pixelFor(90, 3 * NM));
  await touch('touchMove', to);
  await touch('touchEnd');
  await page.waitForFunction(() => Math.abs(window.skerry.tools().ebls[0].bearingDeg - 90) < 1);
  const centre = await onPage((await ppi()).centre);
  const fingers = (dx, dy) => [{ x: centre.x + 60 + dx, y: centre.y + 80 + dy }, { x: centre.x - 60 + dx, y: centre.y + 80 + dy }];
  await touch('touchStart', fingers(0, 0)[0]);
  await touch('touchStart', ...fingers(0, 0));
  for (let k = 1; k <= 5; ++k) await touch('touchMove', ...fingers(-20 * k, 10 * k));
  await touch('touchEnd');
  await page.waitForFunction(() => {
    const { own, centre: c } = window.skerry.ppi;
    return Math.abs(own.x - c.x + 100) < 3 && Math.abs(own.y - c.y - 50) < 3;
  });
  assert.ok(Math.abs((await tools()).ebls[0].bearingDeg - 90) < 1, 'two fingers move no marker');
  for (const id of ['off-centre', 'heading-hold', 'defaults']) assert.ok(await page.locator(`#${id}`).isVisible(), id);
  await showTab('tools');
  assert.ok(await page.locator('#measure').isVisible());
});

test('the cursor goes by arrows in its mode, and stays where a finger was lifted', async () => {
  await open({}, { viewport: { width: 1280, height: 800 }, hasTouch: true });
  await page.keyboard.press('e');
  const ebl = (await tools()).ebls[0].bearingDeg, { own, radiusPx, rangeM } = await ppi();
  const pxM = rangeM / radiusPx;
  const reads = (dx, dy) => page.waitForFunction(([deg, nm]) => {
    const at = (id) => parseFloat(document.getElementById(id).textContent);
    return Math.abs(((at('cursor-true') - deg + 540) % 360) - 180) < 0.3 && Math.abs(at('cursor-range') - nm) < 0.003;
  }, [(Math.atan2(dx, -dy) * 180 / Math.PI + 360) % 360, (Math.hypot(dx, dy) * pxM) / NM]);
  await page.locator('#orders input').first().focus();
  await page.keyboard.press('Tab');
  await page.keyboard.press('Tab');
  await page.keyboard.press('Shift+C');
  assert.match(await text('picture-mode'), /Arrows move the cursor/);
  for (let i = 0; i < 12; ++i) await page.keyboard.press('ArrowRight');
  for (let i = 0; i < 7; ++i) await page.keyboard.press('ArrowUp');
  for (let i = 0; i < 3; ++i) await page.keyboard.press('Shift+ArrowLeft');
  await page.keyboard.press('Shift+ArrowDown');
  await reads(117, -69);
  assert.equal((await tools()).ebls[0].bearingDeg, ebl);
  // Not out of the picture.
  for (let i = 0; i < 60; ++i) await page.keyboard.press('ArrowRight');
  await page.waitForFunction((nm) => Math.abs(parseFloat(document.getElementById('cursor-range').textContent) - nm) < 0.05, rangeM / NM);
  await page.keyboard.press('Escape');
  assert.ok(await page.locator('#picture-mode').isHidden());
  await page.keyboard.press('ArrowRight');
  await page.waitForFunction((deg) => Math.abs(window.skerry.tools().ebls[0].bearingDeg - deg - 1) < 0.01, ebl);
  // A press means what it did, in the mode, too.
  await page.keyboard.press('Shift+C');
  const there = await onPage({ x: own.x - 120, y: own.y + 50 });
  await page.touchscreen.tap(there.x, there.y);
  await reads(-120, 50);
  assert.ok(angleBetween((await tools()).ebls[0].bearingDeg, (Math.atan2(-120, -50) * 180 / Math.PI + 360) % 360) < 0.3);
  assert.deepEqual(page.problems, []);
});
