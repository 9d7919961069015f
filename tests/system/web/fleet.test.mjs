// A console of a fleet: it goes to the host that has its radar, and to the next when that one dies. SKERRYD names the program.
import assert from 'node:assert/strict';
import { spawn } from 'node:child_process';
import { existsSync, mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { createServer } from 'node:net';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { launch, openConsole, state, waitForScan } from './browser.mjs';

const SCENARIO = `name: Fleet
own_ships:
${[0, 1].map((i) => `  - name: Ship ${i}
    position: {lat: ${60.42 + 0.01 * i}, lon: 5.04}
    speed_kn: 8
    radars: [{name: Radar ${i}, spokes: 512, cells: 256, bits: 8, rpm: 60, range_nm: 6}]
`).join('')}`;

async function freePort() {
  const server = createServer();
  await new Promise((resolve) => { server.listen(0, '127.0.0.1', resolve); });
  const { port } = server.address();
  await new Promise((resolve) => { server.close(resolve); });
  return port;
}

let folder, browser, etcd, store;
const hosts = {};

function end(child) {
  if (!child || child.exitCode !== null || child.signalCode !== null) return null;
  const ended = new Promise((resolve) => { child.on('exit', resolve); });
  child.kill('SIGKILL');
  return ended;
}

// Again on the same port: a page may connect to what its server told of when it was loaded.
async function startHost(name) {
  const port = hosts[name]?.port ?? await freePort();
  const child = spawn(process.env.SKERRYD, ['--scenario', join(folder, 'fleet.yaml'), '--tcp-port', '0', '--http-port', String(port), '--no-udp', '--no-cat240',
    '--no-signalk', '--print-ports', '--fleet', store, '--fleet-host', name]);
  let log = '';
  child.stderr.on('data', (data) => { log = (log + data).slice(-4000); });
  await new Promise((resolve, reject) => {
    child.on('exit', (code) => reject(new Error(`host ${name} ended with ${code}:\n${log}`)));
    child.stdout.on('data', (data) => {
      if (/http \d+/.test(String(data))) resolve();
    });
  });
  hosts[name] = { child, port, page: `http://127.0.0.1:${port}/` };
}

// Of which host each radar is, by their numbers, as a host's status says.
async function homes(name) {
  const { fleet } = await (await fetch(`${hosts[name].page}status`)).json();
  const found = [];
  for (const host of fleet.hosts) for (const radar of host.radars ?? []) found[radar] = host.name;
  return found;
}

async function until(what, is, seconds = 60) {
  for (const last = Date.now() + 1000 * seconds; Date.now() < last;) {
    if (await is()) return;
    await new Promise((resolve) => { setTimeout(resolve, 100); });
  }
  assert.fail(`${what}: not within ${seconds} s`);
}

const isInstalled = existsSync('/usr/bin/etcd');
const options = isInstalled ? {} : { skip: 'etcd is not installed' };

before(async () => {
  if (!isInstalled) return;
  folder = mkdtempSync(join(tmpdir(), 'skerry-fleet-'));
  writeFileSync(join(folder, 'fleet.yaml'), SCENARIO);
  const [client, peer] = [await freePort(), await freePort()];
  store = `127.0.0.1:${client}`;
  etcd = spawn('etcd', ['--name', 'm', '--data-dir', join(folder, 'm'), '--listen-client-urls', `http://${store}`, '--advertise-client-urls', `http://${store}`,
    '--listen-peer-urls', `http://127.0.0.1:${peer}`, '--initial-advertise-peer-urls', `http://127.0.0.1:${peer}`, '--initial-cluster', `m=http://127.0.0.1:${peer}`,
    '--logger', 'zap', '--log-level', 'error'], { stdio: 'ignore' });
  browser = await launch();
  await startHost('a');
  await startHost('b');
  await until('a radar at each host', async () => new Set(await homes('a')).size === 2);
});
after(async () => {
  await browser?.close();
  for (const { child } of Object.values(hosts)) { child.removeAllListeners('exit'); await end(child); }
  await end(etcd);
  if (folder) rmSync(folder, { recursive: true, force: true });
});

test('a console goes to the host of its radar, and to another when that one dies', options, async () => {
  const radar = (await homes('a')).indexOf('b');
  const sockets = [];
  const page = await openConsole(browser, `${hosts.a.page}?radar=${radar}`);
  page.on('websocket', (socket) => sockets.push(new URL(socket.url()).port));
  await waitForScan(page);
  const before = (await state(page)).received;
  await until('spokes', async () => (await state(page)).received > before + 500);
  hosts.b.child.removeAllListeners('exit');
  await end(hosts.b.child);
  await until('the radar at the other host', async () => (await homes('a'))[radar] === 'a');
  await until('the console at the other host', async () => sockets.at(-1) === String(hosts.a.port));
  const then = (await state(page)).received;
  await until('spokes of the other host', async () => (await state(page)).received > then + 500);
  await waitForScan(page);
  // The host comes back, takes its share, and the console may follow it there.
  await startHost('b');
  await until('a radar at each host again', async () => new Set(await homes('a')).size === 2);
  const last = (await state(page)).received;
  await until('spokes wherever the radar is', async () => (await state(page)).received > last + 500);
  await page.context().close();
});
