// Freeboard-SK shows skerryd's radar and steers it: straight from skerryd, and through a Signal K server.
import assert from 'node:assert/strict';
import { cpSync, mkdirSync, mkdtempSync, readFileSync, rmSync, symlinkSync, writeFileSync } from 'node:fs';
import { createServer } from 'node:net';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, describe, test } from 'node:test';
import { launch } from '../browser.mjs';
import { parsePgm } from '../compare_scan.mjs';
import { capture, chooseRange, isStrong, middleOfVessels, openFreeboard, PUBLIC } from './freeboard.mjs';
import { compareOverlay, differences } from './overlay.mjs';
import { skerry, start, startSkerryd } from './skerryd.mjs';

const PLUGIN = new URL('./signalk_plugin', import.meta.url).pathname;
const SIGNALK_SERVER = new URL('../node_modules/signalk-server/bin/signalk-server', import.meta.url).pathname;
const FREEBOARD = new URL('../node_modules/@signalk/freeboard-sk', import.meta.url).pathname;
const BERGEN = new URL('../../../../server/world/scenarios/bergen.yaml', import.meta.url).pathname;
const RADARS = '/signalk/v2/api/vessels/self/radars';

let folder, browser, skerryd;

before(async () => {
  folder = mkdtempSync(join(tmpdir(), 'skerry-freeboard-'));
  mkdirSync(join(folder, 'web/@signalk'), { recursive: true });
  cpSync(PUBLIC, join(folder, 'web/@signalk/freeboard-sk'), { recursive: true });
  browser = await launch();
  // Own ship lies still: the map draws in software, and may be more turns late than she takes to move 3 pixels.
  const scenario = join(folder, 'still.yaml');
  const bergen = readFileSync(BERGEN, 'utf8'), still = bergen.replace('speed_kn: 10\n', 'speed_kn: 0\n');
  assert.notEqual(still, bergen);
  writeFileSync(scenario, still);
  skerryd = await startSkerryd(['--web-root', join(folder, 'web'), '--scenario', scenario]);
  // Coast and targets are compared, not what flickers or lies between them.
  await skerry(['set', '--port', String(skerryd.tcp), '--sea-state', '0', '--artefact', 'interference=off',
    '--artefact', 'side_lobes=off', '--artefact', 'multiple_echoes=off']);
});
after(async () => {
  await browser?.close();
  await skerryd?.child.end();
  if (folder) rmSync(folder, { recursive: true, force: true });
});

const json = async (url) => (await fetch(url)).json();
const ownRange = async () => (await json(`http://127.0.0.1:${skerryd.http}${RADARS}/skerry0/controls/range`)).value;
const ownShip = async () => (await json(`http://127.0.0.1:${skerryd.http}/signalk/v1/api/vessels/self`)).navigation;

async function until(condition, what, seconds = 60) {
  for (const end = Date.now() + 1000 * seconds; Date.now() < end;) {
    if (await condition()) return;
    await new Promise((resolve) => setTimeout(resolve, 100));
  }
  assert.fail(`${what} did not come about in ${seconds} s`);
}

// Waits for spokes of two turns, so that the whole picture was drawn anew.
async function twoTurns(page) {
  const spokes = 2 * 2048, perFrame = 32;
  const before = page.frames_;
  await until(() => page.frames_ - before > spokes / perFrame, 'a picture of two turns');
}

// The overlay, the snapshot of about the same moment, and how they compare.
async function look(page, rangeM) {
  const raw = join(folder, 'scan.pgm');
  await skerry(['snapshot', '--port', String(skerryd.tcp), '--raw', raw, '-o', join(folder, 'scan.png')]);
  const ship = await ownShip();
  const headingDeg = ship.headingTrue.value * 180 / Math.PI;
  const shot = await capture(page, ship.position.value.latitude);
  const scan = parsePgm(readFileSync(raw));
  const against = (range, heading, seen = shot) => compareOverlay(seen, isStrong, scan, range, heading);
  const aside = { ...shot, centre: { x: shot.centre.x + 12, y: shot.centre.y } };
  return {
    result: against(rangeM, headingDeg), turned: against(rangeM, headingDeg + 3),
    stretched: against(rangeM * 1.08, headingDeg), moved: against(rangeM, headingDeg, aside),
  };
}

// The picture is drawn in software and may be some turns late.
async function assertSamePicture(t, page, name) {
  const rangeM = await ownRange();
  await twoTurns(page);
  let seen = await look(page, rangeM);
  for (const end = Date.now() + 90000; differences(seen.result).length > 0 && Date.now() < end;) seen = await look(page, rangeM);
  t.diagnostic(`${name}, ${rangeM} m: ${JSON.stringify(seen.result)}`);
  assert.deepEqual(differences(seen.result), [], name);
  // The comparison sees what it must: 12 pixels, 3 deg, and 8 % of range (of a coast 100 pixels away, 8 where 3 are allowed).
  assert.notDeepEqual(differences(seen.turned), [], 'a picture turned');
  assert.notDeepEqual(differences(seen.stretched), [], 'a picture stretched');
  assert.notDeepEqual(differences(seen.moved), [], 'a picture 12 pixels aside');
}

async function showAndSteer(t, base) {
  await fetch(`http://127.0.0.1:${skerryd.http}${RADARS}/skerry0/controls/range`, { method: 'PUT', body: '{"value":11112}' });
  const page = await openFreeboard(browser, base);
  try {
    await assertSamePicture(t, page, 'as found');
    await chooseRange(page, '3 NM');
    await until(async () => (await ownRange()) === 5556, 'the range that was chosen');
    await assertSamePicture(t, page, 'after its range control was used');
  } finally {
    await page.context().close();
  }
}

test('straight from skerryd, the overlay lies where the snapshot has it and its range control works', async (t) => {
  await showAndSteer(t, `http://127.0.0.1:${skerryd.http}`);
});

// A ship without AIS in the open sea, which the plotter alone knows of.
const SILENT = `
name: A silent ship
own_ships:
  - {name: Frida, position: {lat: 55.5, lon: 4.0}, course_deg: 0, speed_kn: 0,
     radars: [{name: Radar, spokes: 1024, cells: 512, bits: 8, rpm: 60, range_nm: 3}]}
targets:
  - {name: Silent, position: {lat: 55.53, lon: 4.04}, course_deg: 180, speed_kn: 12, length_m: 90, beam_m: 15, height_m: 15}
`;

test('what the plotter tracks is drawn where the plotter has it', async (t) => {
  const file = join(folder, 'silent.yaml');
  writeFileSync(file, SILENT);
  const server = await startSkerryd(['--web-root', join(folder, 'web'), '--scenario', file]);
  const page = await openFreeboard(browser, `http://127.0.0.1:${server.http}`);
  try {
    await skerry(['exercise', 'target', 'order', 'Silent', '--port', String(server.tcp), '--ais-off', 'on']);
    const targets = async () => json(`http://127.0.0.1:${server.http}${RADARS}/skerry0/targets`);
    await until(async () => (await targets()).length === 1, 'a target', 90);
    let seen;
    await until(async () => {
      const [target] = await targets();
      const ship = (await json(`http://127.0.0.1:${server.http}/signalk/v1/api/vessels/self`)).navigation.position.value;
      const shot = await capture(page, ship.latitude);
      const { bearing, distance } = target.position;
      const expected = {
        x: shot.centre.x + distance * Math.sin(bearing) / shot.metresPerPixel,
        y: shot.centre.y - distance * Math.cos(bearing) / shot.metresPerPixel,
      };
      const drawn = middleOfVessels(shot);
      seen = drawn && { off: Math.hypot(drawn.x - expected.x, drawn.y - expected.y), pixels: drawn.pixels,
        away: Math.hypot(expected.x - shot.centre.x, expected.y - shot.centre.y) };
      return seen && seen.off < 8;
    }, 'the target on the map');
    t.diagnostic(JSON.stringify(seen));
    assert.ok(seen.away > 30, 'she is well off own ship');
    const vessels = await json(`http://127.0.0.1:${server.http}/signalk/v1/api/vessels`);
    assert.deepEqual(Object.values(vessels).map((each) => each.name).sort(), ['Frida', 'Radar target 1']);
  } finally {
    await page.context().close();
    await server.child.end();
  }
});

describe('through signalk-server', () => {
  let server;
  before(async () => {
    const config = join(folder, 'signalk');
    mkdirSync(join(config, 'node_modules/@signalk'), { recursive: true });
    mkdirSync(join(config, 'plugin-config-data'));
    symlinkSync(FREEBOARD, join(config, 'node_modules/@signalk/freeboard-sk'));
    symlinkSync(PLUGIN, join(config, 'node_modules/skerry-radar'));
    const write = (name, value) => writeFileSync(join(config, name), JSON.stringify(value));
    write('settings.json', { interfaces: { tcp: false, 'nmea-tcp': false, mdns: false }, mdns: false, ssl: false, pipedProviders: [] });
    write('baseDeltas.json', [{ context: 'vessels.self', updates: [{ values: [{ path: '', value: { name: 'Frida', uuid: 'urn:mrn:signalk:uuid:c0d79334-4e25-4245-8892-54e8ccc8021d' } }] }] }]);
    write('plugin-config-data/skerry-radar.json', { enabled: true, configuration: { url: `http://127.0.0.1:${skerryd.http}` } });
    const port = await freePort();
    server = await start(process.execPath, [SIGNALK_SERVER], (said) => (/running at/.test(said) ? { port } : null), {
      cwd: config,
      env: { ...process.env, SIGNALK_NODE_CONFIG_DIR: config, PORT: String(port), EXTERNALHOST: '127.0.0.1', SKIP_ADMINUI_VERSION_CHECK: '1', SIGNALK_DISABLE_SERVER_UPDATES: '1', HOME: config },
    });
    await until(async () => (await json(`http://127.0.0.1:${port}${RADARS}`))[0]?.id === 'skerry0', 'the plugin\'s radar');
  });
  after(async () => { await server?.child.end(); });

  test('the overlay lies where the snapshot has it and its range control works', async (t) => {
    await showAndSteer(t, `http://127.0.0.1:${server.port}`);
  });
});

function freePort() {
  return new Promise((resolve) => {
    const probe = createServer().listen(0, '127.0.0.1', () => {
      const { port } = probe.address();
      probe.close(() => resolve(port));
    });
  });
}
