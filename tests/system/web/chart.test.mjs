// The chart on the real server: its coast beside the radar's, and the buoys of an ENC cell at their charted places.
// SKERRYD names the program.
import assert from 'node:assert/strict';
import { spawn } from 'node:child_process';
import { existsSync, mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { after, afterEach, before, test } from 'node:test';
import WebSocket from 'ws';
import { capture, launch, openConsole, waitForScan } from './browser.mjs';
import { leadingEdge } from './measure.mjs';
import { ClientMessage, ServerMessage } from './mock_server.mjs';
import { inverse } from './vincenty.mjs';

if (!process.env.SKERRYD) throw new Error('SKERRYD must name the program to test, such as build/bin/skerryd');
const ENC = fileURLToPath(new URL('../../../../shared/data/enc/US5WA22M.000', import.meta.url));
const TACOMA = `
name: Tacoma
seed: 7
sea: {state: 0}
own_ships:
  - name: Tern
    position: {lat: 47.2900, lon: -122.4250}
    course_deg: 135
    speed_kn: 0
    radars:
      - {name: X-band, spokes: 4096, cells: 1024, bits: 8, rpm: 24, range_nm: 1.5, antenna_height_m: 14, peak_power_kw: 12}
`;
// Of the cell, as ogrinfo shows them.
const BUOYS = [
  { name: 'Hylebos Waterway Lighted Buoy 1', kind: 1, latitudeDeg: 47.2872345, longitudeDeg: -122.4127682 },
  { name: 'Blair Waterway Lighted Buoy 2', kind: 2, latitudeDeg: 47.2783889, longitudeDeg: -122.4161667 },
  { name: 'Tacoma Outfall Lighted Buoy', kind: 11, latitudeDeg: 47.2780556, longitudeDeg: -122.4216667 },
];

let folder, browser, server, page;
before(async () => {
  folder = mkdtempSync(join(tmpdir(), 'skerry-chart-'));
  browser = await launch();
});
afterEach(async () => {
  await page?.context().close();
  page = null;
  if (server?.exitCode === null) {
    const ended = new Promise((resolve) => server.on('exit', resolve));
    server.kill('SIGTERM');
    await ended;
  }
  server = null;
});
after(async () => {
  await browser?.close();
  rmSync(folder, { recursive: true });
});

// Resolves to its ports once skerryd listens.
function start(...args) {
  server = spawn(process.env.SKERRYD, ['--tcp-port', '0', '--http-port', '0', '--no-udp', '--no-cat240', '--print-ports', ...args]);
  let said = '', log = '';
  server.stderr.on('data', (data) => { log = (log + data).slice(-4000); });
  return new Promise((resolve, reject) => {
    server.on('error', reject);
    server.on('exit', (code) => reject(new Error(`skerryd ended with ${code}:\n${log}`)));
    server.stdout.on('data', (data) => {
      said = (said + data).slice(-4000);
      const match = /tcp (\d+) http (\d+)/.exec(said);
      if (match) resolve({ tcp: Number(match[1]), http: Number(match[2]) });
    });
  });
}

async function open({ http }) {
  page = await openConsole(browser, `http://127.0.0.1:${http}/`);
  await page.locator('#afterglow').fill('0');
  await page.evaluate(() => window.skerry.showTab('chart'));
  await page.keyboard.press('j');
  await page.waitForFunction(() => window.skerry.chart().drawn > 0, null, { timeout: 60000 });
  await waitForScan(page);
}
const chart = () => page.evaluate(() => window.skerry.chart());

test('off Bergen the charted coast lies along the radar\u2019s', async (t) => {
  await open(await start());
  assert.match(await page.locator('#chart-note').textContent(), /^GSHHG .* coast only/);
  const shot = await capture(page);
  const ink = await page.evaluate(() => {
    const canvas = document.getElementById('chart');
    const { data } = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
    return [...data.filter((_, i) => i % 4 === 3)].map((alpha) => (alpha > 60 ? 1 : 0)).join('');
  });
  // On each bearing the first coast of the chart and the first strong echo beyond the sea's clutter. Low islands and coasts in
  // shadow have none; where both are, they are one.
  const step = shot.rangeM / shot.radiusPx / shot.pixelRatio;
  const lineOn = (deg) => {
    const angle = ((deg - shot.upDeg) * Math.PI) / 180;
    for (let r = 1500 / step; r < shot.radiusPx * shot.pixelRatio * 0.97; r += 0.5) {
      const x = Math.floor(shot.centre.x * shot.pixelRatio + r * Math.sin(angle)), y = Math.floor(shot.centre.y * shot.pixelRatio - r * Math.cos(angle));
      if (ink[y * shot.width + x] === '1') return r * step;
    }
    return null;
  };
  // Part of the bearings on which they are within 100 m, were the chart turned by so much.
  const sharedAt = (turnDeg) => {
    let both = 0, near = 0;
    for (let deg = 0; deg < 360; deg += 1) {
      const line = lineOn(deg), echo = leadingEdge(shot, deg + turnDeg, 1500);
      if (line === null || echo === null) continue;
      both += 1;
      near += Math.abs(echo - line) < 100 ? 1 : 0;
    }
    return { both, share: near / both };
  };
  const { both, share } = sharedAt(0);
  const turned = [-8, -5, 5, 8].map((deg) => sharedAt(deg).share);
  t.diagnostic(`${both} bearings, ${(100 * share).toFixed(0)} % within 100 m; turned by 5 and 8 deg ${turned.map((each) => (100 * each).toFixed(0)).join(', ')} %`);
  assert.ok(both > 200);
  assert.ok(share > 0.2 && share > 1.5 * Math.max(...turned), `${share} ${turned}`);
  assert.deepEqual(page.problems, []);
});

test('buoys of an ENC cell are at their charted places, within 5 m', { skip: existsSync(ENC) ? false : `no chart ${ENC}` }, async (t) => {
  const scenario = join(folder, 'tacoma.yaml');
  writeFileSync(scenario, TACOMA);
  await open(await start('--scenario', scenario, '--chart', ENC));
  assert.match(await page.locator('#chart-note').textContent(), /^ENC US5WA22M edition 40 update 2 over GSHHG/);
  const { markPixels, place } = await chart();
  assert.ok(markPixels.length > 100);
  for (const buoy of BUOYS) {
    const found = markPixels.find((mark) => mark.name === buoy.name);
    assert.ok(found, buoy.name);
    assert.equal(found.kind, buoy.kind);
    const told = inverse(found, buoy).rangeM;
    // And where it is drawn: the place under its pixel, by the exact geodesic from own ship.
    const at = await page.evaluate(([x, y]) => window.skerry.at(x, y), [found.x, found.y]);
    const exact = inverse(place, buoy);
    const across = (((at.bearingDeg - exact.bearingDeg + 540) % 360) - 180) * (Math.PI / 180) * exact.rangeM;
    const drawn = Math.hypot(across, at.rangeM - exact.rangeM);
    t.diagnostic(`${buoy.name}: told ${told.toFixed(2)} m, drawn ${drawn.toFixed(2)} m off`);
    assert.ok(told < 5 && drawn < 5);
  }
  assert.deepEqual(page.problems, []);
});

test('a request out of its range is refused, and so is a second before the first has its answer', async () => {
  const { http } = await start();
  const socket = new WebSocket(`ws://127.0.0.1:${http}/ws`);
  const got = [];
  const whole = new Promise((resolve, reject) => {
    socket.on('error', reject);
    socket.on('message', (data) => {
      for (let rest = data; rest.length > 0;) {
        const reader = ServerMessage.decodeDelimited(rest);
        got.push(reader);
        rest = rest.subarray(ServerMessage.encodeDelimited(reader).finish().length);
      }
      if (got.filter((message) => message.reply).length === 3) resolve();
    });
  });
  await new Promise((resolve) => socket.on('open', resolve));
  const ask = (request, values) => socket.send(ClientMessage.encodeDelimited(ClientMessage.fromObject({
    request, getChartObjects: { latitudeDeg: 60.4, longitudeDeg: 5.2, radiusNm: 60, toleranceM: 0, ...values },
  })).finish());
  ask(1, { toleranceM: NaN });
  ask(2, {});
  ask(3, {});
  await whole;
  socket.close();
  assert.equal(got[0].hello.hasChart, true);
  const reply = (request) => got.find((message) => message.reply?.request === request).reply;
  assert.equal(reply(1).code, 2);
  assert.match(reply(1).text, /tolerance/);
  assert.equal(reply(3).code, 4);
  assert.equal(reply(2).code, 0);
  const objects = got.find((message) => message.chartObjects);
  assert.ok(ServerMessage.encode(objects).finish().length <= 200100);
  assert.ok(objects.chartObjects.toleranceM > 0, 'coarser than asked for: 60 NM about Bergen have more');
  assert.ok(objects.chartObjects.lines.length > 100);
});
