// What the tests of clauses share: a page on a coarse radar whose canvases and texts are read, and measures along lines of them.
import { PNG } from 'pngjs';
import { openConsole } from './browser.mjs';
import { MockServer } from './mock_server.mjs';
import { targetList } from './mock_targets.mjs';

export const SHIP = { courseOverGroundDeg: 37, speedOverGroundKn: 12, lengthM: 120, beamM: 20 };

// kept: of localStorage, by key. Every text that is written on a canvas is in window.written, by the canvas' id, with its place in
// CSS pixels, until that canvas is cleared.
export async function openClauses(browser, { kept = {}, context = { viewport: { width: 1000, height: 640 } }, list = {}, ...options } = {}) {
  const server = new MockServer({ rpm: 120, spokes: 720, cells: 512, headingDeg: 37, ownShipMore: SHIP, targets: targetList(list), ...options });
  const url = await server.start();
  const page = await openConsole(browser, url, context);
  await page.addInitScript((values) => {
    for (const [key, value] of Object.entries(values)) if (localStorage.getItem(key) === null) localStorage.setItem(key, JSON.stringify(value));
    window.written = {};
    const { fillText, clearRect } = CanvasRenderingContext2D.prototype;
    CanvasRenderingContext2D.prototype.clearRect = function (...box) { window.written[this.canvas.id] = []; clearRect.apply(this, box); };
    CanvasRenderingContext2D.prototype.fillText = function (text, x, y) {
      const m = this.getTransform();
      (window.written[this.canvas.id] ??= []).push({ text, x: (m.a * x + m.c * y + m.e) / devicePixelRatio, y: (m.b * x + m.d * y + m.f) / devicePixelRatio });
      fillText.call(this, text, x, y);
    };
  }, { 'skerry.picture': { afterglow: 0 }, ...kept });
  await page.reload();
  await page.waitForFunction(() => window.skerry?.ppi.rangeM > 0 && window.skerry.state().headingDeg !== null && window.skerry.lastScan() !== null);
  return { server, page, url };
}

export const text = (page, id) => page.locator(`#${id}`).textContent();
export const until = (page, id, wanted) => page.waitForFunction(([i, w]) => document.getElementById(i).textContent === w, [id, wanted]);
export const ppi = (page) => page.evaluate(() => window.skerry.ppi);
export const frames = (page) => page.evaluate(() => window.skerry.drawn(2));

// A canvas of the picture as it is after the next frame, and what it was drawn for: { width, height, data, ppi }. Data that take
// more room beside the picture make it smaller, which is drawn a moment later.
export async function layer(page, id) {
  for (;;) {
    await frames(page);
    const { url, ppi: drawnFor, isDrawn } = await page.evaluate((name) => {
      const canvas = document.getElementById(name), { ppi: now } = window.skerry;
      return { url: canvas.toDataURL(), ppi: now, isDrawn: canvas.width === Math.round(now.side * now.pixelRatio) };
    }, id);
    if (isDrawn) return Object.assign(PNG.sync.read(Buffer.from(url.slice(url.indexOf(',') + 1), 'base64')), { ppi: drawnFor });
  }
}

export function pixel(png, { x, y }) {
  const i = 4 * (Math.floor(y) * png.width + Math.floor(x));
  return [...png.data.subarray(i, i + 4)];
}

// The most opaque pixel within one of the place.
export function ink(png, { x, y }) {
  let most = [0, 0, 0, 0];
  for (let dy = -1; dy <= 1; ++dy) for (let dx = -1; dx <= 1; ++dx) { const p = pixel(png, { x: x + dx, y: y + dy }); if (p[3] > most[3]) most = p; }
  return most;
}

// A place so many pixels from another, `deg` clockwise from the top of the screen.
export const beyond = ({ x, y }, deg, px) => ({ x: x + px * Math.sin((deg * Math.PI) / 180), y: y - px * Math.cos((deg * Math.PI) / 180) });

// Runs of what is there along a line: [{ from, to, middle }] in its own measure. isThere(at): at each step of it.
export function runs(from, to, step, isThere) {
  const found = [];
  let open = null;
  for (let at = from; at <= to; at += step) {
    if (isThere(at)) {
      open ??= { from: at };
      open.to = at;
    } else if (open) {
      found.push(open);
      open = null;
    }
  }
  if (open) found.push(open);
  return found.map((run) => ({ ...run, middle: (run.from + run.to) / 2, length: run.to - run.from + step }));
}

export const hueOf = ([r, g, b]) => {
  const most = Math.max(r, g, b), least = Math.min(r, g, b), d = most - least || 1;
  const h = most === r ? ((g - b) / d) % 6 : most === g ? (b - r) / d + 2 : (r - g) / d + 4;
  return (h * 60 + 360) % 360;
};
