// A real Chromium, headless, WebGL by SwiftShader. CHROMIUM names another browser than Debian's.
import { existsSync } from 'node:fs';
import { chromium } from 'playwright-core';

const WHOLE = '/usr/bin/chromium', SHELL = '/usr/bin/chromium-headless-shell';

// Pages in the headless shell are drawn and run by the same engine, but no browser's window is made and drawn around each:
// a page costs half. whole: with those windows, for what is about windows, full screen, or the cost of a frame to a user.
export async function launch({ whole = false } = {}) {
  return chromium.launch({
    executablePath: process.env.CHROMIUM ?? (!whole && existsSync(SHELL) ? SHELL : WHOLE),
    args: ['--headless', '--no-sandbox', '--disable-quic', '--no-first-run', '--disable-background-networking',
           '--disable-component-update', '--disable-sync', '--host-resolver-rules=MAP * ~NOTFOUND , EXCLUDE 127.0.0.1',
           '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--ignore-gpu-blocklist'],
  });
}

// A page of the console in a profile of its own. Everything that goes wrong in it is in page.problems.
// frameMs: at least so long between frames of its own, for tests that look at no picture: of a large one a frame takes a
// processor a tenth of a second.
export async function openConsole(browser, url, { frameMs = 0, ...options } = {}) {
  const context = await browser.newContext({ viewport: { width: 1280, height: 800 }, ...options });
  if (frameMs > 0) {
    await context.addInitScript((ms) => {
      const asked = window.requestAnimationFrame.bind(window);
      window.requestAnimationFrame = (run) => setTimeout(() => asked(run), ms);
    }, frameMs);
  }
  const page = await context.newPage();
  page.problems = [];
  page.on('pageerror', (error) => page.problems.push(String(error)));
  page.on('console', (message) => {
    if (message.type() === 'error') page.problems.push(message.text());
  });
  await page.goto(url);
  await page.waitForFunction(() => window.skerry !== undefined);
  return page;
}

// A tab of the console's panel by its title.
export const openTab = (page, title) => page.getByRole('tab', { name: title, exact: true }).click();

export const state = (page) => page.evaluate(() => window.skerry.state());

// Waits for a whole turn that was received with the settings of now.
export async function waitForScan(page) {
  const rangeNm = (await page.evaluate(() => window.skerry.settings()))?.rangeNm;
  const after = (await state(page)).scan ?? -1;
  await page.waitForFunction(([scan]) => {
    const last = window.skerry.lastScan();
    const settings = window.skerry.settings();
    return last && settings && last.scan > scan && !last.mixedRanges &&
      Math.abs(last.rangeM - settings.rangeNm * 1852) < 1;
  }, [after, rangeNm], { timeout: 60000 });
}

// The canvas' picture, with the geometry it was drawn with; paintedS: when the echoes on that true bearing were seen, as of test_access.js.
export async function capture(page, bearingDeg = 0) {
  const { shot, ppi, paintedS } = await page.evaluate((deg) => ({ shot: window.skerry.capture(), ppi: window.skerry.ppi, paintedS: window.skerry.paintedS(deg) }), bearingDeg);
  return { ...ppi, width: shot.width, data: Buffer.from(shot.base64, 'base64'), paintedS };
}
