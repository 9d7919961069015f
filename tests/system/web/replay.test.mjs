// A recorded exercise in the instructor's page, in Chromium on the real server: what the page shows is what the file
// holds, wherever it is sought. SKERRYD and SKERRY name the two programs; SHOTS a folder for pictures of it.
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { copyFileSync, mkdtempSync, rmSync, statSync, truncateSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, afterEach, before, test } from 'node:test';
import { launch, openConsole, state } from './browser.mjs';
import { skerry, startSkerryd } from './displays/skerryd.mjs';
import { readByIndex, typesOf } from './mcap_file.mjs';

const SCENARIO = `name: Debrief
seed: 3
sea: {state: 0, wind_from_deg: 250, wind_kn: 5, depth_m: 35}
own_ships:
  - {name: Tern, position: {lat: 60.36, lon: 4.6}, course_deg: 90, speed_kn: 18,
     radars: [{name: X, spokes: 512, cells: 256, bits: 8, rpm: 24, range_nm: 6}]}
  - {name: Plain, position: {lat: 60.30, lon: 4.5}, course_deg: 0, speed_kn: 0,
     radars: [{name: Second, spokes: 512, cells: 256, bits: 8, rpm: 24, range_nm: 6}]}
targets:
  - {name: Lyngen, position: {lat: 60.39, lon: 4.62}, course_deg: 180, speed_kn: 0, length_m: 150, beam_m: 20}
  - {name: Ferry, position: {lat: 60.37, lon: 4.6}, course_deg: 45, speed_kn: 15, length_m: 80, beam_m: 15}
`;
const TABLET = { viewport: { width: 1180, height: 820 }, hasTouch: true };

// The names of the file's own schema, as the page has them.
function camel(value) {
  if (Array.isArray(value)) return value.map(camel);
  if (value === null || typeof value !== 'object') return value;
  return Object.fromEntries(Object.entries(value).map(([name, each]) => [name.replace(/_(.)/g, (_, c) => c.toUpperCase()), camel(each)]));
}

let folder, browser, server, file, truth, marks, pages = [];

async function until(page, condition, argument) {
  const holds = new Function('s', 'value', `return ${condition}`);
  for (let i = 0; !holds(await state(page), argument); ++i) {
    if (i > 1200) throw new Error(`never: ${condition}: ${JSON.stringify((await state(page)).playback)}`);
    await page.waitForTimeout(25);
  }
}
const at = ({ tcp }, ...args) => skerry([...args, '--port', String(tcp)]);
async function comes(condition) {
  for (let i = 0; i < 1200; ++i) {
    if (await condition()) return;
    await new Promise((resolve) => setTimeout(resolve, 50));
  }
  throw new Error(`never: ${condition}`);
}

// Records an exercise with a mark and a collision.
async function record() {
  const live = await startSkerryd(['--scenario', join(folder, 'debrief.yaml'), '--record-folder', folder]);
  const json = async (...args) => JSON.parse(await at(live, ...args, '--json'));
  try {
    await at(live, 'record', 'start', 'exercise');
    const begun = (await json('exercise', 'show')).exercise_s ?? 0;
    await at(live, 'exercise', 'pace', '4');
    await comes(async () => (await json('exercise', 'show')).exercise_s > begun + 25);
    await at(live, 'exercise', 'mark', 'Pilot aboard');
    // The recorder looks once a second, which are four of the exercise.
    const marked = (await json('exercise', 'show')).exercise_s;
    await comes(async () => (await json('exercise', 'show')).exercise_s > marked + 10);
    await at(live, 'exercise', 'put', 'Plain', '--latitude', '60.3903', '--longitude', '4.62', '--heading', '180', '--speed', '0');
    await comes(async () => ((await json('exercise', 'show')).marks ?? []).some(({ kind }) => kind === 'collision'));
    const later = (await json('exercise', 'show')).exercise_s;
    await comes(async () => (await json('exercise', 'show')).exercise_s > later + 25);
    await at(live, 'record', 'stop');
  } finally {
    await live.child.end();
  }
}

before(async () => {
  folder = mkdtempSync(join(tmpdir(), 'skerry-debrief-'));
  writeFileSync(join(folder, 'debrief.yaml'), SCENARIO);
  browser = await launch();
  await record();
  file = join(folder, 'exercise.mcap');
  const { reader, messages } = await readByIndex(file);
  const types = typesOf(reader);
  const begin = messages[0].time;
  const read = (topic) => messages.filter((each) => each.topic === topic).map(({ time, schema, data }) =>
    ({ positionS: Number(time - begin) / 1e9, ...camel(types.get(schema).toObject(types.get(schema).decode(data), { longs: Number, defaults: true })) }));
  truth = read('exercise');
  marks = read('events').filter(({ markKind }) => markKind);
});
afterEach(async () => {
  for (const page of pages) await page.context().close();
  pages = [];
  await server?.child.end();
  server = null;
});
after(async () => {
  await browser?.close();
  if (folder) rmSync(folder, { recursive: true });
});

const play = async (path = file, ...args) => { server = await startSkerryd(['--play', path, '--play-paused', ...args]); };
async function open(path = 'instructor', options = TABLET) {
  const page = await openConsole(browser, `http://127.0.0.1:${server.http}/${path}`, options);
  pages.push(page);
  if (path === 'instructor') await until(page, 's.playback && (s.exercise || !s.playback.truth)');
  return page;
}

// Where the file has a ship at a place in the recording: as its last state says, and on from there on a straight line.
function recordedAt(positionS, name) {
  const last = truth.findLast((each) => each.positionS <= positionS);
  const { latitudeDeg, longitudeDeg, courseOverGroundDeg, speedKn } = last.ships.find((ship) => ship.name === name);
  const course = (courseOverGroundDeg * Math.PI) / 180;
  const minutes = (speedKn * last.rate * (positionS - last.positionS)) / 3600;
  return {
    latitudeDeg: latitudeDeg + (minutes * Math.cos(course)) / 60,
    longitudeDeg: longitudeDeg + (minutes * Math.sin(course)) / 60 / Math.cos((latitudeDeg * Math.PI) / 180),
  };
}
const metres = (a, b) => Math.hypot((a.latitudeDeg - b.latitudeDeg) * 111120,
  (a.longitudeDeg - b.longitudeDeg) * 111120 * Math.cos((a.latitudeDeg * Math.PI) / 180));
const shipOf = async (page, name) => (await state(page)).exercise.ships.find((ship) => ship.name === name);

async function shows(page, positionS, name, within) {
  const wanted = recordedAt(positionS, name);
  let off;
  for (let i = 0; i < 400; ++i) {
    off = metres(await shipOf(page, name), wanted);
    if (off < within) return;
    await page.waitForTimeout(25);
  }
  throw new Error(`${name} is ${off} m from where the recording has her at ${positionS} s`);
}

test('ships stand where the recording has them, wherever it is sought by touch and by keys', async () => {
  await play();
  const page = await open();
  const { lengthS } = (await state(page)).playback;
  assert.ok(truth.length > 10 && lengthS > 10, `${truth.length} states in ${lengthS} s`);
  await until(page, 's.coast.points > 50');
  assert.deepEqual((await state(page)).exercise.ships.map(({ name }) => name), ['Tern', 'Plain', 'Lyngen', 'Ferry']);
  const slider = page.locator('#playback-position');
  const box = await slider.boundingBox();
  const found = [];
  for (const part of [0.75, 0.2, 0.9, 0.5]) {
    await page.touchscreen.tap(box.x + part * box.width, box.y + box.height / 2);
    await until(page, 'Math.abs(s.playback.positionS - value) < 0.05 * s.playback.lengthS', part * lengthS);
    const { positionS } = (await state(page)).playback;
    found.push(positionS);
    // At four times the pace 18 kn are 37 m in a second of the recording.
    for (const name of ['Tern', 'Ferry', 'Lyngen']) await shows(page, positionS, name, 0.5);
  }
  await slider.focus();
  await page.keyboard.press('ArrowLeft');
  await until(page, 's.playback.positionS < value - 4', found.at(-1));
  await shows(page, (await state(page)).playback.positionS, 'Tern', 0.5);
  assert.ok(metres(recordedAt(found[1], 'Tern'), recordedAt(found[2], 'Tern')) > 100, 'she sails');
  if (process.env.SHOTS) {
    await page.locator('#ship-list [data-key=own-0]').click();
    await page.screenshot({ path: join(process.env.SHOTS, 'replay-tablet.png') });
    const wide = await open('instructor', { viewport: { width: 1920, height: 1080 } });
    await until(wide, 's.coast.points > 50');
    await wide.locator('#to-exercise').click();
    await wide.screenshot({ path: join(process.env.SHOTS, 'replay-wide.png') });
  }
  assert.deepEqual(page.problems, []);
});

test('it is played, tracks grow, and a seek back takes the future out of them', async () => {
  await play();
  const page = await open();
  await page.locator('#playback-rate').selectOption('10');
  await page.locator('#playback-play').tap();
  const before = await shipOf(page, 'Tern');
  await until(page, 's.exercise.ships[0].longitudeDeg > value + 1e-3', before.longitudeDeg);
  await until(page, '!s.playback.playing && Math.abs(s.playback.positionS - s.playback.lengthS) < 0.1');
  await until(page, 's.tracks[0].toS > s.exercise.exerciseS - 15');
  const end = (await state(page)).exercise.exerciseS;
  await page.locator('#playback-position').press('Home');
  await until(page, 's.exercise.exerciseS < value - 30', end);
  const { tracks, exercise } = await state(page);
  for (const { toS } of tracks) assert.ok(toS <= exercise.exerciseS + 1e-6, `${toS} after ${exercise.exerciseS}`);
});

test('marks and mishaps are in the time line, and for instructors alone', async () => {
  await play();
  const page = await open();
  assert.ok(marks.some(({ markKind, text }) => markKind === 'mark' && text === 'Pilot aboard'));
  const collision = marks.find(({ markKind }) => markKind === 'collision');
  assert.ok(collision);
  assert.equal(await page.locator('#replay-ticks i').count(), marks.length);
  const option = page.locator('#replay-mark option', { hasText: 'Collision' }).first();
  await page.locator('#replay-mark').selectOption(await option.getAttribute('value'));
  await until(page, 'Math.abs(s.playback.positionS - value) < 0.2', collision.positionS);
  await page.locator('#to-exercise').click();
  await page.locator('#mark-list [data-kind=collision]').first().waitFor();
  await page.locator('#replay-before').tap();
  await until(page, 's.playback.positionS < value - 0.2', collision.positionS);
  const trainee = await open('', {});
  await trainee.waitForFunction(() => window.skerry.playback() !== null);
  assert.deepEqual(await trainee.evaluate(() => window.skerry.playback().marks), []);
  assert.deepEqual(page.problems, []);
});

test('of two instructors the last seek counts, and the other is told', async () => {
  await play();
  const [page, other] = [await open(), await open()];
  await page.locator('#playback-position').press('End');
  await until(other, 's.playback.positionS === s.playback.lengthS');
  await other.locator('.notice', { hasText: 'The recording was moved by' }).waitFor();
  await other.locator('#playback-position').press('Home');
  await until(page, 's.playback.positionS === 0');
  await page.locator('.notice', { hasText: 'The recording was moved by' }).waitFor();
  await shows(page, 0, 'Tern', 40);
});

test('the command line has the same truth, and orders are refused with the reason', async () => {
  await play(file, '--play-from', '0:06');
  const page = await open();
  const shown = JSON.parse(await at(server, 'exercise', 'show', '--json'));
  assert.deepEqual(shown.ships.map(({ name }) => name), ['Tern', 'Plain', 'Lyngen', 'Ferry']);
  await shows(page, 6, 'Tern', 0.5);
  await assert.rejects(at(server, 'exercise', 'mark', 'now'), /a recording is played/);
  await assert.rejects(at(server, 'play', '--server', 'seek', '9:00:00'), /out of range/);
  await page.keyboard.press('f');
  await page.locator('.notice', { hasText: 'A recording is played' }).waitFor();
});

test('a file that was cut is shown as far as it goes; inputs alone are refused with the way out', async () => {
  const cut = join(folder, 'cut.mcap');
  copyFileSync(file, cut);
  truncateSync(cut, Math.floor(0.6 * statSync(cut).size));
  await play(cut);
  const page = await open();
  await until(page, 's.playback.problem !== ""');
  const { lengthS } = (await state(page)).playback;
  await page.locator('#playback-position').press('End');
  await until(page, 's.playback.positionS === s.playback.lengthS');
  await page.locator('#playback-position').press('ArrowLeft');
  await until(page, 'Math.abs(s.playback.positionS - value) < 0.1', lengthS - 5);
  await shows(page, (await state(page)).playback.positionS, 'Tern', 0.5);

  const live = await startSkerryd(['--scenario', join(folder, 'debrief.yaml'), '--record-folder', folder]);
  await at(live, 'record', 'start', 'inputs', '--inputs-only');
  await at(live, 'record', 'stop');
  await live.child.end();
  const refused = spawnSync(process.env.SKERRYD, ['--play', join(folder, 'inputs.mcap'), '--tcp-port', '0', '--http-port', '0'], { encoding: 'utf8' });
  assert.equal(refused.status, 2);
  assert.match(refused.stderr, /no spokes in it to play; of its inputs skerryd --verify/);
});
