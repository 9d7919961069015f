// What the tests of the chart and of lines of one's own share: a console on a mock server, and its layers' pixels.
import { after, afterEach, before } from 'node:test';
import { launch, openConsole } from './browser.mjs';
import { MockServer } from './mock_server.mjs';

let browser;
export let server, page;
before(async () => { browser = await launch(); });
after(() => browser?.close());
afterEach(async () => {
  await page?.context().close();
  await server?.stop();
  page = server = null;
});

// Few spokes, unless a test is about the picture.
export async function open(options = {}, viewport) {
  server = new MockServer({ rpm: 60, spokes: 512, cells: 256, ...options });
  const url = await server.start();
  page = await openConsole(browser, url, viewport);
  await page.locator('#afterglow').fill('0');
  await page.evaluate(() => window.skerry.showTab('chart'));
  return url;
}
export async function openChart(options, viewport) {
  await open(options, viewport);
  await page.keyboard.press('j');
  await page.waitForFunction(() => window.skerry.chart().drawn > 0);
}
export const chart = () => page.evaluate(() => window.skerry.chart());
export const pixelFor = (deg, m) => page.evaluate(([d, r]) => window.skerry.pixelFor(d, r), [deg, m]);
// The place on the screen, of a place in the picture.
export async function onScreen({ x, y }) {
  const box = await page.locator('#ppi').boundingBox();
  return [box.x + x, box.y + y];
}

// The canvas of a layer as RGBA, device pixels, straight alpha.
export async function layer(id) {
  const { width, base64 } = await page.evaluate((name) => {
    window.skerry.capture();
    const canvas = document.getElementById(name);
    const { data } = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
    let text = '';
    for (let i = 0; i < data.length; i += 0x6000) text += String.fromCharCode.apply(null, data.subarray(i, i + 0x6000));
    return { width: canvas.width, base64: btoa(text) };
  }, id);
  return { width, data: Buffer.from(base64, 'base64') };
}
export const alphaAt = ({ width, data }, x, y) => data[4 * (Math.floor(y) * width + Math.floor(x)) + 3] ?? 0;
export const inked = ({ data }) => { let n = 0; for (let i = 3; i < data.length; i += 4) n += data[i] > 0 ? 1 : 0; return n; };
