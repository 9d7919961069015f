// What tests of the console's targets share: a page on a MockServer with a list, and measures of the canvas of targets.
import assert from 'node:assert/strict';
import { PNG } from 'pngjs';
import { openConsole } from './browser.mjs';
import { NM } from './mock_scene.mjs';
import { MockServer } from './mock_server.mjs';
import { targetList } from './mock_targets.mjs';

export async function openTargets(browser, list, { settings = {}, context = { viewport: { width: 1100, height: 640 } }, ...options } = {}) {
  const server = new MockServer({ spokes: 1024, cells: 256, rpm: 20, targets: targetList(list), ...options });
  const url = await server.start();
  const page = await openConsole(browser, url, context);
  if (Object.keys(settings).length > 0) {
    await page.evaluate((kept) => localStorage.setItem('skerry.targets', JSON.stringify(kept)), settings);
    await page.reload();
    await page.waitForFunction(() => window.skerry !== undefined);
  }
  await page.evaluate(() => window.skerry.showTab('targets'));
  await listed(page);
  return { server, page };
}

// Waits until the newest list of the server is drawn.
export async function listed(page) {
  await page.waitForFunction(() => {
    const targets = window.skerry.targets();
    return targets.list !== null && window.skerry.ppi.rangeM > 0 && targets.shown.length >= targets.list.targets.length;
  });
}

// Sends a changed list, and waits until the page has it.
export async function show(server, page, change) {
  const stamp = (server.stamp = (server.stamp ?? 0) + 1);
  server.showTargets({ ...change, plots: stamp });
  await page.waitForFunction((n) => window.skerry.targets().list?.plots === n, stamp);
  const { frames } = await page.evaluate(() => window.skerry.state());
  await page.waitForFunction((n) => window.skerry.state().frames > n + 1, frames);
}

export const targetState = (page) => page.evaluate(() => window.skerry.targets());

export async function waitFor(check, what) {
  const until = Date.now() + 10000;
  for (;;) {
    const got = await check();
    if (got) return got;
    assert.ok(Date.now() < until, what);
    await new Promise((resolve) => setTimeout(resolve, 30));
  }
}

// The canvas of targets alone: { width, height, data }.
export async function canvas(page) {
  return readPng(await page.evaluate(() => document.querySelector('#target-marks').toDataURL()));
}
export const readPng = (url) => PNG.sync.read(Buffer.from(url.slice(url.indexOf(',') + 1), 'base64'));

export const rgba = (png, x, y) => [...png.data.subarray(4 * (Math.floor(y) * png.width + Math.floor(x)), 4 * (Math.floor(y) * png.width + Math.floor(x)) + 4)];
// The lines themselves, not the shade under them.
const isLine = ([r, g, b, a]) => (Math.max(r, g, b) * a) / 255 >= 110;
export const isRed = ([r, g, b, a]) => a > 100 && r > 150 && g < 120 && b < 120;

// Box of what is drawn within `reach` pixels of a place: its middle, width and height from edge to edge; null: nothing is.
export function extent(png, x, y, reach) {
  let left = Infinity, right = -Infinity, top = Infinity, bottom = -Infinity;
  for (let j = Math.floor(y - reach); j <= y + reach; ++j) {
    for (let i = Math.floor(x - reach); i <= x + reach; ++i) {
      if (i < 0 || j < 0 || i >= png.width || j >= png.height || !isLine(rgba(png, i, j))) continue;
      left = Math.min(left, i); right = Math.max(right, i + 1); top = Math.min(top, j); bottom = Math.max(bottom, j + 1);
    }
  }
  return left === Infinity ? null : { x: (left + right) / 2, y: (top + bottom) / 2, width: right - left, height: bottom - top };
}

// Whether anything is drawn within `reach` pixels of a place.
export const isDrawn = (png, { x, y }, reach = 1.5) => extent(png, x, y, reach) !== null;

// Where a place in the plane about own ship (metres) is on the screen, by the page's scale and centre but not its code.
export function pixelOf({ centre, radiusPx, rangeM, upDeg }, { east, north }) {
  const up = (upDeg * Math.PI) / 180, scale = radiusPx / rangeM;
  return {
    x: centre.x + scale * (east * Math.cos(up) - north * Math.sin(up)),
    y: centre.y - scale * (east * Math.sin(up) + north * Math.cos(up)),
  };
}

export const plane = (bearingDeg, rangeNm) => ({ east: rangeNm * NM * Math.sin((bearingDeg * Math.PI) / 180), north: rangeNm * NM * Math.cos((bearingDeg * Math.PI) / 180) });
export const plus = (a, b) => ({ east: a.east + b.east, north: a.north + b.north });
export const apart = (a, b) => Math.hypot(a.x - b.x, a.y - b.y);
export const placeOnPage = async (page, at) => {
  const box = await page.locator('#ppi').boundingBox();
  return { x: box.x + at.x, y: box.y + at.y };
};
