// Pictures of the console to be looked at: each layout in each palette, on a server of its own, with targets acquired.
//   SKERRYD=... SKERRY=... node pictures.mjs FOLDER
// Not part of npm test: there positions and colours are measured (console/clauses.test.mjs, layout.test.mjs).
import { mkdirSync } from 'node:fs';
import { join } from 'node:path';
import { launch, openConsole, waitForScan } from './browser.mjs';
import { skerry, startSkerryd } from './displays/skerryd.mjs';
import { WEB } from './mock_server.mjs';

const [folder] = process.argv.slice(2);
if (!folder) throw new Error('usage: node pictures.mjs FOLDER');
const LAYOUTS = [[1280, 720, false], [1920, 1080, false], [2560, 1440, false], [3840, 2160, false], [820, 1180, true], [1180, 820, true], [390, 844, true]];
const PALETTES = ['day', 'dusk', 'night'];

mkdirSync(folder, { recursive: true });
const server = await startSkerryd(['--web-root', WEB]);
await skerry(['targets', 'rules', '--port', String(server.tcp), '--acquire', 'all']);
const browser = await launch({ whole: true });
try {
  for (const [width, height, hasTouch] of LAYOUTS) {
    const page = await openConsole(browser, `http://127.0.0.1:${server.http}/`, { viewport: { width, height }, hasTouch });
    await waitForScan(page);
    for (const palette of PALETTES) {
      while ((await page.evaluate(() => document.documentElement.dataset.palette ?? 'day')) !== palette) await page.locator('#palette').click();
      await page.evaluate(() => window.skerry.drawn(2));
      const file = join(folder, `${width}x${height}-${palette}.png`);
      await page.screenshot({ path: file });
      console.log(file);
    }
    if (page.problems.length > 0) throw new Error(page.problems.join('\n'));
    await page.context().close();
  }
} finally {
  await browser.close();
  await server.child.end();
}
