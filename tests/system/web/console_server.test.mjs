// The console on the real server, against the server's own snapshot of the same turn.
// SKERRYD and SKERRY name the two programs.
import assert from 'node:assert/strict';
import { spawn } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, afterEach, before, test } from 'node:test';
import { PNG } from 'pngjs';
import { capture, launch, openConsole, state, waitForScan } from './browser.mjs';
import { compare, differences, parsePgm } from './compare_scan.mjs';
import { CONTROLS } from './mock_server.mjs';

for (const name of ['SKERRYD', 'SKERRY']) {
  if (!process.env[name]) throw new Error(`${name} must name the program to test, such as build/bin/${name.toLowerCase()}`);
}

let folder, browser, server, ports, page;

// Resolves once skerryd listens and has said where.
function startServer() {
  const child = spawn(process.env.SKERRYD, ['--tcp-port', '0', '--http-port', '0', '--no-udp', '--no-cat240', '--print-ports']);
  let log = '', said = '';
  child.stderr.on('data', (data) => { log = (log + data).slice(-4000); });
  return new Promise((resolve, reject) => {
    child.on('error', reject);
    child.on('exit', (code) => reject(new Error(`skerryd ended with ${code} before it listened:\n${log}${said}`)));
    child.stdout.on('data', (data) => {
      said = (said + data).slice(-4000);
      const match = /tcp (\d+) http (\d+)/.exec(said);
      if (!match) return;
      ports = { tcp: Number(match[1]), http: Number(match[2]) };
      resolve(child);
    });
  });
}

before(async () => {
  folder = mkdtempSync(join(tmpdir(), 'skerry-web-'));
  browser = await launch({ whole: true });
  server = await startServer();
  // Coast and targets are compared, not what flickers or lies between them.
  await run(process.env.SKERRY, ['set', '--port', String(ports.tcp), '--sea-state', '0', '--artefact', 'interference=off',
    '--artefact', 'side_lobes=off', '--artefact', 'multiple_echoes=off']);
});
afterEach(async () => { await page?.context().close(); });
after(async () => {
  await browser?.close();
  if (server?.exitCode === null) {
    const ended = new Promise((resolve) => server.on('exit', resolve));
    server.kill('SIGTERM');
    await ended;
  }
  if (folder) rmSync(folder, { recursive: true });
});

function run(program, args) {
  return new Promise((resolve, reject) => {
    const child = spawn(program, args);
    let text = '';
    for (const stream of [child.stdout, child.stderr]) stream.on('data', (data) => { text += data; });
    child.on('error', reject);
    child.on('exit', (code) => (code === 0 ? resolve(text) : reject(new Error(`${program} ${args.join(' ')}: ${code}\n${text}`))));
  });
}

async function open(radar = 0) {
  assert.equal(server.exitCode ?? server.signalCode, null, 'skerryd has ended');
  page = await openConsole(browser, `http://127.0.0.1:${ports.http}/?radar=${radar}`);
  await page.locator('#afterglow').fill('0');
  await waitForScan(page);
}

// The canvas and the snapshot of one and the same turn: the first from now that the console received whole. A console
// that is given no time loses spokes, as the stream's rules have it, and a turn with a gap is no turn to compare.
async function sameTurn(radar = 0) {
  const first = (await state(page)).scan + 2;
  for (let scan = first; scan < first + 5; scan = (await state(page)).scan + 2) {
    await page.evaluate((n) => window.skerry.holdAfter(n), scan);
    const raw = join(folder, `${scan}.pgm`), png = join(folder, `${scan}.png`);
    await Promise.all([
      run(process.env.SKERRY, ['snapshot', '--port', String(ports.tcp), '--radar', String(radar), '--scan', String(scan), '--raw', raw, '-o', png]),
      page.waitForFunction((n) => window.skerry.state().newestScan > n, scan, { timeout: 60000 }),
    ]);
    const last = await page.evaluate(() => window.skerry.lastScan());
    const shot = last?.scan === scan ? await capture(page) : null;
    await page.evaluate(() => window.skerry.holdAfter(null));
    if (!shot) continue;
    assert.ok(PNG.sync.read(readFileSync(png)).width > 100);
    return { shot, headingDeg: last.headingDeg, cells: parsePgm(readFileSync(raw)) };
  }
  assert.fail('the console received none of five turns whole');
}

function assertSame(t, turn, name) {
  const result = compare(turn.shot, turn.cells, turn.headingDeg);
  t.diagnostic(`${name}: ${JSON.stringify(result)}`);
  assert.deepEqual(differences(result), [], name);
  return result;
}

test('the table of controls is what protobufjs reads in the schema', async () => {
  const response = await fetch(`http://127.0.0.1:${ports.http}/controls.json`);
  assert.equal(response.headers.get('content-type'), 'application/json');
  assert.deepEqual(await response.json(), CONTROLS);
});

test('coast and targets stand where the snapshot of the same turn has them', async (t) => {
  await open();
  const turn = await sameTurn();
  const result = assertSame(t, turn, 'north up');
  assert.ok(result.edges >= 100, `a coast on only ${result.edges} of 1440 bearings`);
  assert.ok(result.blobs >= 3, `only ${result.blobs} targets that stand alone`);
  // The comparison sees what it must: 2 deg, and 2 % of range.
  assert.notDeepEqual(differences(compare(turn.shot, turn.cells, turn.headingDeg + 2)), []);
  assert.notDeepEqual(differences(compare({ ...turn.shot, rangeM: turn.shot.rangeM, radiusPx: turn.shot.radiusPx * 1.02 }, turn.cells, turn.headingDeg)), []);

  await page.keyboard.press('h');
  const headUp = await sameTurn();
  assert.ok(Math.abs(headUp.shot.upDeg - headUp.headingDeg) < 1);
  assertSame(t, headUp, 'head up');
  assert.deepEqual(page.problems, []);
});

test('the picture follows range and gain, and still agrees', async (t) => {
  await open();
  const before = await sameTurn();
  const { rangeNm, gain } = await page.evaluate(() => window.skerry.settings());
  await page.keyboard.press('+');
  await page.waitForFunction((old) => window.skerry.settings().rangeNm > old, rangeNm);
  await waitForScan(page);
  const farther = await sameTurn();
  assert.ok(farther.shot.rangeM > before.shot.rangeM * 1.2);
  assertSame(t, farther, 'longer range');
  assert.notDeepEqual(differences(compare(farther.shot, before.cells, before.headingDeg)), [], 'the picture did not follow the range');

  await page.keyboard.press('-');
  await page.waitForFunction((old) => window.skerry.settings().rangeNm === old, rangeNm);
  const less = Math.round(gain / 4);
  await page.locator('#gain').fill(String(less));
  await page.waitForFunction((old) => window.skerry.settings().gain < old, gain);
  await waitForScan(page);
  const weaker = await sameTurn();
  const result = compare(weaker.shot, weaker.cells, weaker.headingDeg);
  const full = compare(before.shot, before.cells, before.headingDeg);
  t.diagnostic(`gain ${gain} to ${less}: ${full.canvasBins} to ${result.canvasBins} echo bins`);
  assert.ok(result.canvasBins < full.canvasBins * 0.9, 'less gain shows less');
  assert.deepEqual(differences(result), []);

  await page.locator('#gain').fill(String(gain));
  await page.waitForFunction((old) => window.skerry.settings().gain === old, gain);
});

test('the other own ship has a picture of its own', async (t) => {
  await open(1);
  assert.equal((await state(page)).radar, 1);
  assertSame(t, await sameTurn(1), 'radar 1');
});

test('a server that was stopped for three seconds: the console says so', async () => {
  page = await openConsole(browser, `http://127.0.0.1:${ports.http}/`);
  await waitForScan(page);
  await page.evaluate(() => window.skerry.showTab('set-up'));
  server.kill('SIGSTOP');
  await new Promise((resolve) => { setTimeout(resolve, 3000); });
  server.kill('SIGCONT');
  // The server makes up for half a second of it. A busy machine stands still at other times, too.
  await page.waitForFunction(() => {
    const [, count, seconds] = /^(\d+), ([\d.]+) s in all$/.exec(document.getElementById('gaps').textContent) ?? [];
    return Number(count) >= 1 && Number(seconds) >= 2;
  });
});
