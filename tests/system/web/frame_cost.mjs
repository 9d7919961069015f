// What a picture of the console costs: CPU milliseconds of the whole browser for each picture drawn, in software
// rendering, beside a page that only fills a canvas of the same size, in turns within the same run; medians. The
// console is measured as WebGL2 draws it and as the 2D canvas does.
//   SKERRYD=... SKERRY=... node frame_cost.mjs [--rounds 5] [--seconds 8] [--sizes 1280x800,1920x1080] [--before FOLDER,FOLDER]
// FOLDER: the pages (clients/web) of another tree, to compare with. Not part of npm test.
import { readFileSync, readdirSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { parseArgs } from 'node:util';
import { launch } from './browser.mjs';
import { startSkerryd } from './displays/skerryd.mjs';

const { values } = parseArgs({ options: { rounds: { type: 'string', default: '5' }, seconds: { type: 'string', default: '8' },
  sizes: { type: 'string', default: '1280x800,1920x1080' }, before: { type: 'string', default: '' } } });
const SIZES = values.sizes.split(',').map((size) => size.split('x').map(Number));
const TICK_MS = 10;  // of /proc, as Linux has it on all usual machines

// CPU time of the browser's processes so far: what has this program among its parents.
function browserMs() {
  const all = new Map();
  for (const pid of readdirSync('/proc')) {
    if (!/^\d+$/.test(pid)) continue;
    try {
      const fields = readFileSync(`/proc/${pid}/stat`, 'utf8').split(') ')[1].split(' ');
      const name = readFileSync(`/proc/${pid}/comm`, 'utf8').trim();
      all.set(Number(pid), { parent: Number(fields[1]), ms: (Number(fields[11]) + Number(fields[12])) * TICK_MS, name });
    } catch {
      // It has ended meanwhile.
    }
  }
  const isOurs = (pid) => pid === process.pid || (all.has(pid) && isOurs(all.get(pid).parent));
  return [...all].reduce((sum, [pid, { ms, name }]) => sum + (name.startsWith('chrom') && isOurs(pid) ? ms : 0), 0);
}

function fill(side) {
  const canvas = Object.assign(document.createElement('canvas'), { width: side, height: side });
  document.body.replaceChildren(canvas);
  const gl = canvas.getContext('webgl2', { alpha: true, antialias: false });
  let frames = 0;
  window.frames = () => frames;
  const draw = () => {
    requestAnimationFrame(draw);
    gl.clearColor(0, 0, (frames % 60) / 60, 1);
    gl.clear(gl.COLOR_BUFFER_BIT);
    frames += 1;
  };
  draw();
}

const WEB = fileURLToPath(new URL('../../../clients/web', import.meta.url));
const QUERIES = { webgl2: '?canvas=webgl2', '2d': '?canvas=2d' };
const PAGES = { floor: null, webgl2: WEB, '2d': WEB, ...Object.fromEntries(values.before.split(',').filter(Boolean).map((folder) => [folder, folder])) };
const median = (list) => list.sort((a, b) => a - b)[list.length >> 1];
const browser = await launch({ whole: true });
const servers = {};
for (const [name, root] of Object.entries(PAGES)) if (root) servers[name] = await startSkerryd(['--web-root', root]);

for (const [width, height] of SIZES) {
  const found = Object.fromEntries(Object.keys(PAGES).map((name) => [name, []]));
  let side = 0;
  for (let round = 0; round < Number(values.rounds); ++round) {
    for (const name of ['webgl2', ...Object.keys(PAGES).filter((each) => each !== 'webgl2')]) {
      const context = await browser.newContext({ viewport: { width, height } });
      const page = await context.newPage();
      if (servers[name]) {
        await page.goto(`http://127.0.0.1:${servers[name].http}/${QUERIES[name] ?? ''}`);
        // A turn and more, so that the whole picture is there.
        await page.waitForFunction(() => (window.skerry?.lastScan()?.spokes ?? 0) > 0, null, { timeout: 60000 });
        if (name === 'webgl2') side = await page.evaluate(() => document.getElementById('echoes').width);
      } else {
        await page.setContent('<body style="margin: 0; background: #000">');
        await page.evaluate(fill, side);
      }
      const drawn = () => page.evaluate(() => (window.skerry ? window.skerry.state().frames : window.frames()));
      const [frames, ms] = [await drawn(), browserMs()];
      await new Promise((resolve) => setTimeout(resolve, 1000 * Number(values.seconds)));
      const [more, used] = [await drawn() - frames, browserMs() - ms];
      found[name].push({ perFrame: used / more, rate: more / Number(values.seconds) });
      await context.close();
    }
  }
  const of = (name) => median(found[name].map((each) => each.perFrame));
  console.log(`${width} x ${height} (canvas ${side})`);
  for (const name of Object.keys(PAGES)) {
    console.log(`  ${name.padEnd(8)} ${of(name).toFixed(1)} ms of CPU a picture, ${median(found[name].map((each) => each.rate)).toFixed(1)} pictures/s, ` +
      `${(of(name) / of('floor')).toFixed(2)} floors`);
  }
}
await browser.close();
for (const server of Object.values(servers)) await server.child.end();
