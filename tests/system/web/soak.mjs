// Endurance of the console: opens pages on a server and tells each minute what they hold, and at the end what grew.
//   node soak.mjs URL [pages] [minutes]          a server that runs, such as http://127.0.0.1:7480/
//   SKERRYD=... node soak.mjs - [pages] [minutes] starts one of its own, with the pages of this tree
// Not part of npm test. Exit code 1: something grew, a page had a fault, or spokes were lost.
import { spawn } from 'node:child_process';
import { fileURLToPath } from 'node:url';
import { launch } from './browser.mjs';

const [address = '-', pages = '3', minutes = '10'] = process.argv.slice(2);
const MINUTE_MS = 60000;
// What a figure may grow by from the second minute to the last, beside a tenth of itself: a collection of garbage more or
// less, a notice that is shown.
const ROOM = { heapMiB: 4, nodes: 300, listeners: 40, textures: 0, frames: 0 };

async function startServer() {
  const web = fileURLToPath(new URL('../../../clients/web', import.meta.url));
  const child = spawn(process.env.SKERRYD, ['--tcp-port', '0', '--http-port', '0', '--no-udp', '--no-cat240', '--print-ports', '--web-root', web]);
  child.stderr.resume();
  let said = '';
  const port = await new Promise((resolve, reject) => {
    child.on('exit', (code) => reject(new Error(`skerryd ended with ${code}`)));
    child.stdout.on('data', (data) => { said += data; const match = /http (\d+)/.exec(said); if (match) resolve(match[1]); });
  });
  return { child, url: `http://127.0.0.1:${port}/` };
}

// Textures are counted as they are made and deleted: no browser tells them.
function countTextures() {
  const made = WebGL2RenderingContext.prototype;
  window.textures = 0;
  for (const [name, by] of [['createTexture', 1], ['deleteTexture', -1]]) {
    const original = made[name];
    made[name] = function (...args) { window.textures += by; return original.apply(this, args); };
  }
}

async function measure({ page, session }) {
  await session.send('HeapProfiler.collectGarbage');
  const { metrics } = await session.send('Performance.getMetrics');
  const of = (name) => metrics.find((metric) => metric.name === name).value;
  const { usedSize, backingStorageSize } = await session.send('Runtime.getHeapUsage');
  const told = await page.evaluate(() => ({ ...window.skerry.state(), textures: window.textures }));
  return {
    heapMiB: (usedSize + (backingStorageSize ?? 0)) / 2 ** 20, nodes: of('Nodes'), listeners: of('JSEventListeners'), frames: of('Frames'),
    textures: told.textures, received: told.received, lost: told.lost, perSecond: told.framesPerSecond,
  };
}

async function open(url) {
  const context = await browser.newContext({ viewport: { width: 1280, height: 800 } });
  const page = await context.newPage();
  const problems = [];
  page.on('pageerror', (error) => problems.push(String(error)));
  await page.addInitScript(countTextures);
  await page.goto(url);
  await page.waitForFunction(() => window.skerry?.lastScan(), null, { timeout: MINUTE_MS });
  const session = await context.newCDPSession(page);
  await session.send('Performance.enable');
  return { page, session, problems, seen: [] };
}

const show = (n, minute, { heapMiB, nodes, listeners, frames, textures, received, lost, perSecond }) =>
  console.log(`${String(minute).padStart(4)} min  page ${n}  heap ${heapMiB.toFixed(1).padStart(6)} MiB  nodes ${String(nodes).padStart(5)}  listeners ` +
    `${String(listeners).padStart(4)}  frames ${frames}  textures ${textures}  spokes ${received}, lost ${lost}  ${perSecond?.toFixed(1) ?? '?'} pictures/s`);

const server = address === '-' ? await startServer() : { url: address };
const browser = await launch({ whole: true });
let bad = false;
try {
  const all = [];
  for (let n = 0; n < Number(pages); ++n) all.push(await open(server.url));
  for (let minute = 1; minute <= Number(minutes); ++minute) {
    await new Promise((resolve) => setTimeout(resolve, MINUTE_MS));
    for (const [n, one] of all.entries()) {
      const now = await measure(one);
      one.seen.push(now);
      show(n, minute, now);
    }
  }
  for (const [n, { seen, problems }] of all.entries()) {
    const from = seen[Math.min(1, seen.length - 1)], to = seen.at(-1);
    const grew = Object.keys(ROOM).filter((name) => to[name] > from[name] * 1.1 + ROOM[name]).map((name) => `${name} ${from[name].toFixed(1)} to ${to[name].toFixed(1)}`);
    console.log(`page ${n}: ${grew.length > 0 ? `grew: ${grew.join(', ')}` : 'nothing grew'}; ${to.lost} of ${to.received + to.lost} spokes lost` +
      `${problems.length > 0 ? `; faults: ${problems.slice(0, 3).join(' | ')}` : ''}`);
    bad ||= grew.length > 0 || problems.length > 0 || to.lost > 0;
  }
} finally {
  await browser.close();
  server.child?.removeAllListeners('exit');
  server.child?.kill('SIGTERM');
}
process.exitCode = bad ? 1 : 0;
