// Recordings read by @mcap/core, and played to the console: what it draws is what a decoder of the capture
// makes of it. SKERRYD and SKERRY name the two programs.
import assert from 'node:assert/strict';
import { spawn } from 'node:child_process';
import { createHash } from 'node:crypto';
import { existsSync, mkdtempSync, readdirSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, afterEach, before, test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { capture, launch, openConsole, openTab, state, waitForScan } from './browser.mjs';
import { compare, differences, parsePgm } from './compare_scan.mjs';
import { readAsStream, readByIndex, typesOf, unpackSpokes } from './mcap_file.mjs';
import { schema } from './mock_server.mjs';

for (const name of ['SKERRYD', 'SKERRY']) {
  if (!process.env[name]) throw new Error(`${name} must name the program to test, such as build/bin/${name.toLowerCase()}`);
}

const CAPTURES = fileURLToPath(new URL('../../../../shared/data/radar/', import.meta.url));
const HALO20 = `${CAPTURES}halo20-ranges.pcap.gz`;
const withCaptures = { skip: existsSync(HALO20) ? false : 'no captures of real radars beside the repository' };
const Spoke = schema.lookupType('skerry.wire.Spoke');

let folder, browser, server, page;
before(async () => {
  folder = mkdtempSync(join(tmpdir(), 'skerry-recording-'));
  browser = await launch();
});
afterEach(async () => {
  await page?.context().close();
  await stop();
  page = null;
});
after(async () => {
  await browser?.close();
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

// Its ports, once it listens.
function start(args) {
  server = spawn(process.env.SKERRYD, ['--tcp-port', '0', '--http-port', '0', '--no-udp', '--no-cat240', '--print-ports', ...args]);
  let log = '', said = '';
  return new Promise((resolve, reject) => {
    server.stderr.on('data', (data) => { log = (log + data).slice(-4000); });
    server.on('error', reject);
    server.on('exit', (code) => reject(new Error(`skerryd ended with ${code} before it listened:\n${log}${said}`)));
    server.stdout.on('data', (data) => {
      said = (said + data).slice(-4000);
      const match = /tcp (\d+) http (\d+)/.exec(said);
      if (match) resolve({ tcp: Number(match[1]), http: Number(match[2]) });
    });
  });
}

async function stop() {
  if (!server || server.exitCode !== null) return;
  const ended = new Promise((resolve) => server.on('exit', resolve));
  server.kill('SIGTERM');
  await ended;
  server = null;
}

async function imported(...options) {
  const path = join(folder, `${options.join('')}.mcap`);
  if (!existsSync(path)) await run(process.env.SKERRY, ['recording', 'import', HALO20, '-o', path, ...options]);
  return path;
}

function expectedSha1(name) {
  const rows = readFileSync(`${CAPTURES}expected_decode.csv`, 'utf8').split('\n').map((line) => line.split(','));
  return rows.find(([file]) => file === name)[rows[0].indexOf('sha1_of_unpacked_cells')].trim();
}

// The messages of all spokes, packed or not, as bytes.
function spokesOf({ reader, messages }) {
  const types = typesOf(reader);
  return messages.filter(({ topic }) => topic.startsWith('radar/') && topic.endsWith('spokes')).flatMap(({ topic, schema: id, data }) =>
    (topic.endsWith('packed_spokes') ? unpackSpokes(types.get(id).decode(data)) : [data]));
}

function unpackedCells({ cells, cellCount, bits }) {
  if (bits === 8) return cells;
  const out = new Uint8Array(cellCount);
  for (let c = 0; c < cellCount; ++c) out[c] = (cells[c >> 1] >> (4 * (c & 1))) & 15;
  return out;
}

// Schemas, statistics and every message are what the index says; each message is written again as it was.
function checkFile({ reader, messages }) {
  assert.equal(reader.header.profile, 'skerry');
  assert.equal(reader.statistics.messageCount, BigInt(messages.length));
  assert.equal(reader.statistics.chunkCount, reader.chunkIndexes.length);
  const types = typesOf(reader);
  const counts = new Map();
  for (const { topic, schema: id, data } of messages) {
    counts.set(topic, (counts.get(topic) ?? 0) + 1);
    const type = types.get(id);
    assert.deepEqual(Buffer.from(type.encode(type.decode(data)).finish()), Buffer.from(data), topic);
  }
  for (const [id, count] of reader.statistics.channelMessageCounts) assert.equal(count, BigInt(counts.get(reader.channelsById.get(id).topic)));
  return counts;
}

let plainSpokes;  // SHA-1 of the messages of all spokes, which no option may change

for (const options of [['--compression', 'lz4'], ['--compression', 'none'], ['--compression', 'zstd'], ['--compression', 'zstd', '--compact'],
  ['--compression', 'lz4', '--compact']]) {
  test(`@mcap/core reads every message of a HALO20's recording: ${options.join(' ')}`, withCaptures, async (t) => {
    const path = await imported(...options);
    const file = await readByIndex(path);
    const counts = checkFile(file);
    assert.equal(counts.get('hello'), 1);
    assert.equal(file.messages[0].topic, 'hello');
    const cells = createHash('sha1'), bytes = createHash('sha1');
    const spokes = spokesOf(file);
    for (const spoke of spokes) {
      bytes.update(spoke);
      cells.update(unpackedCells(Spoke.decode(spoke)));
    }
    assert.equal(spokes.length, 43874);
    assert.equal(cells.digest('hex'), expectedSha1('halo20-ranges.pcap.gz'));
    const digest = bytes.digest('hex');
    assert.equal(digest, plainSpokes ??= digest);
    assert.ok(file.attachments.some(({ name }) => name === 'skerry.contents'));

    const stream = await readAsStream(path);
    assert.ok(stream.done);
    assert.equal(stream.records.filter(({ type }) => type === 'Message').length, file.messages.length);
    t.diagnostic(`${file.messages.length} messages in ${file.reader.chunkIndexes.length} chunks, ${readFileSync(path).length} bytes`);
  });
}

test('@mcap/core reads every message of what skerryd records', async (t) => {
  const recordings = join(folder, 'recorded');
  const ports = await start(['--record', '--record-folder', recordings]);
  page = await openConsole(browser, `http://127.0.0.1:${ports.http}/`);
  const until = (id, expected) => page.waitForFunction(([i, e]) => document.getElementById(i).textContent === e, [id, expected], { timeout: 20000 });
  await until('record-phase', 'Recording');
  await waitForScan(page);
  await openTab(page, 'Set-up');
  await page.locator('#record-mark').fill('seen by the test');
  await page.locator('#record-mark').press('Enter');
  await until('record-marks', '1');
  await page.waitForFunction(() => document.getElementById('record-size').textContent.endsWith('MB'), null, { timeout: 60000 });
  await page.locator('#record').click();
  await until('record-phase', 'Off');
  assert.deepEqual(page.problems, []);
  await stop();
  const [name] = readdirSync(recordings).filter((file) => file.endsWith('.mcap'));
  const file = await readByIndex(join(recordings, name));
  const counts = checkFile(file);
  for (const topic of ['hello', 'world', 'radar/0/own_ship', 'radar/0/view/0/settings', 'events', 'traffic']) assert.ok(counts.get(topic) > 0, topic);
  assert.equal(file.messages[0].topic, 'hello');
  const spokes = spokesOf(file).map((bytes) => Spoke.decode(bytes));
  assert.ok(spokes.length > 4096);
  const types = typesOf(file.reader);
  const marks = file.messages.filter(({ topic }) => topic === 'events').map(({ schema: id, data }) => types.get(id).decode(data))
    .filter(({ kind }) => kind === 3);
  assert.deepEqual(marks.map(({ text }) => text), ['seen by the test']);
  // None is missing, of any radar.
  const last = new Map();
  for (const { radar, view, sequence } of spokes) {
    const key = `${radar}/${view}`;
    if (last.has(key)) assert.equal(Number(sequence), last.get(key) + 1, key);
    last.set(key, Number(sequence));
  }
  t.diagnostic(`${name}: ${file.messages.length} messages, ${spokes.length} spokes of ${last.size} radars`);
});

// Turns of the file: rows of cells by index, as long as all are of one range.
function turnsOf(spokes) {
  const turns = new Map();
  for (const spoke of spokes) {
    const turn = turns.get(spoke.scan) ?? turns.set(spoke.scan, { rows: [], cellSizeM: spoke.cellSizeM, mixed: false, heading: spoke.heading }).get(spoke.scan);
    turn.mixed ||= turn.cellSizeM !== spoke.cellSizeM;
    turn.rows[spoke.index] = unpackedCells(spoke);
  }
  return turns;
}

// The part of a turn within so many metres.
function within(turn, cells, cellSizeM, rangeM) {
  const kept = Math.min(cells, Math.round(rangeM / cellSizeM));
  const data = new Uint8Array(turn.spokes * kept);
  for (let row = 0; row < turn.spokes; ++row) data.set(turn.data.subarray(row * cells, row * cells + kept), row * kept);
  return { ...turn, cells: kept, data };
}

test('a HALO20 played back stands on the console as its decoder has it', withCaptures, async (t) => {
  const path = await imported('--compression', 'zstd', '--compact');
  const spokes = spokesOf(await readByIndex(path)).map((bytes) => Spoke.decode(bytes));
  const turns = turnsOf(spokes);
  const begin = Number(spokes[0].utcNs) / 1e9;
  // The longest run of whole turns at 3183 m: the coast.
  const coast = spokes.find(({ cellSizeM, scan }) => Math.abs(cellSizeM * 1024 - 3183) < 2 && !turns.get(scan).mixed && turns.get(scan + 3) && !turns.get(scan + 3).mixed);
  const from = Number(coast.utcNs) / 1e9 - begin;
  const ports = await start(['--play', path, '--play-from', from.toFixed(1)]);
  page = await openConsole(browser, `http://127.0.0.1:${ports.http}/`);
  await page.locator('#playback-sign').waitFor({ state: 'visible' });
  await page.locator('#afterglow').fill('0');
  await page.waitForFunction(() => window.skerry.lastScan() !== null, null, { timeout: 30000 });

  const scan = (await state(page)).scan + 2;
  await page.evaluate((n) => window.skerry.holdAfter(n), scan);
  const raw = join(folder, 'turn.pgm');
  await Promise.all([
    run(process.env.SKERRY, ['snapshot', '--port', String(ports.tcp), '--scan', String(scan), '--raw', raw, '-o', join(folder, 'turn.png')]),
    page.waitForFunction((n) => window.skerry.lastScan()?.scan >= n, scan, { timeout: 60000 }),
  ]);
  const shot = await capture(page);
  const { headingDeg } = await page.evaluate(() => window.skerry.lastScan());
  const cells = parsePgm(readFileSync(raw));
  // The server's own snapshot is one of the file's turns, cell by cell: those are the decoder's, by their SHA-1.
  const same = [...turns.entries()].find(([, turn]) => {
    for (let row = 0; row < cells.spokes; ++row) {
      const want = turn.rows[row] ?? new Uint8Array(cells.cells);
      if (Buffer.compare(want, cells.data.subarray(row * cells.cells, (row + 1) * cells.cells)) !== 0) return false;
    }
    return true;
  });
  assert.ok(same, 'the snapshot is no turn of the recording');
  const [number, turn] = same;
  const truth = within(cells, cells.cells, turn.cellSizeM, shot.rangeM);
  const result = compare(shot, truth, headingDeg);
  t.diagnostic(`turn ${number}, ${turn.cellSizeM.toFixed(3)} m cells, picture to ${shot.rangeM} m: ${JSON.stringify(result)}`);
  assert.deepEqual(differences(result), []);
  assert.ok(result.edges > 100, `a coast on only ${result.edges} of 1440 bearings`);
  assert.notDeepEqual(differences(compare(shot, truth, headingDeg + 2)), []);
  assert.deepEqual(page.problems, []);
});

test('playback is paused, stepped and sought from the console, and the picture stays', withCaptures, async () => {
  const path = await imported('--compression', 'zstd', '--compact');
  const ports = await start(['--play', path, '--play-paused', '--play-from', '30']);
  page = await openConsole(browser, `http://127.0.0.1:${ports.http}/`);
  await page.waitForFunction(() => window.skerry.playback()?.playing === false && window.skerry.state().received > 1000, null, { timeout: 20000 });
  const { positionS, lengthS } = await page.evaluate(() => window.skerry.playback());
  assert.ok(Math.abs(positionS - 30) < 0.1, `at ${positionS}`);
  assert.ok(Math.abs(lengthS - 65.95) < 0.1);
  const before = (await state(page)).received;
  await page.locator('#playback-forward').click();
  await page.waitForFunction((n) => window.skerry.state().received >= n + 2000 && !window.skerry.playback().playing, before, { timeout: 20000 });
  await page.locator('#playback-position').fill('50');
  await page.waitForFunction(() => Math.abs(window.skerry.playback().positionS - 50) < 0.1, null, { timeout: 20000 });
  await page.locator('#playback-rate').selectOption('10');
  await page.keyboard.press('k');
  await page.waitForFunction(() => window.skerry.playback().positionS > 60, null, { timeout: 20000 });
  assert.equal((await state(page)).lost, 0);
  assert.equal(await page.locator('#alarm').isVisible(), false);
  assert.deepEqual(page.problems, []);
});
