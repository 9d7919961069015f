// Freeboard-SK in a real Chromium: opens it, shows the radar, and measures its overlay by the pixels.
import { PNG } from 'pngjs';

export const PUBLIC = new URL('../node_modules/@signalk/freeboard-sk/public', import.meta.url).pathname;
const ZOOM = 11;

// A page with the radar overlay on.  `base` is the server's address.
export async function openFreeboard(browser, base) {
  const context = await browser.newContext({ viewport: { width: 1280, height: 900 } });
  const page = await context.newPage();
  page.frames_ = 0;
  page.on('websocket', (socket) => {
    if (/\/(spokes|stream)$/.test(new URL(socket.url()).pathname)) socket.on('framereceived', () => { page.frames_ += 1; });
  });
  await page.goto(`${base}/@signalk/freeboard-sk/?zoom=${ZOOM}&northup=1&movemap=1`);
  const ok = page.getByRole('button', { name: 'OK', exact: true });
  await ok.waitFor({ timeout: 60000 });
  await ok.click();
  const button = page.locator('button[mattooltip="Radar"]');
  await button.waitFor({ timeout: 60000 });
  // Freeboard shows the button when it knows the radar's name, and only then asks what it can do: a click before
  // the answer ends in an error of its own (openRadar of undefined).  Its user clicks again.
  const panel = page.locator('radar-panel');
  for (const end = Date.now() + 60000; !(await panel.isVisible());) {
    if (Date.now() > end) throw new Error('Freeboard\'s button "Radar" opens no panel within 60 s');
    await button.click();
    await panel.waitFor({ timeout: 2000 }).catch(() => {});
  }
  return page;
}

// Chooses a range of the radar panel by its text, such as "3 NM".
export async function chooseRange(page, text) {
  const row = page.locator('radar-panel .kvRow', { hasText: 'Range' });
  await row.locator('mat-select').click();
  await page.locator('mat-option', { hasText: new RegExp(`^\\s*${text}\\s*$`) }).click();
}

// The map as pixels, and where the ship is in it: the map follows her, north up.
export async function capture(page, latitudeDeg) {
  const box = await page.locator('.ol-viewport').boundingBox();
  const png = PNG.sync.read(await page.screenshot({ clip: box }));
  // Web Mercator: metres of the ground to a pixel of a 256-pixel tile.
  const metresPerPixel = (Math.cos(latitudeDeg * Math.PI / 180) * 2 * Math.PI * 6378137) / (256 * 2 ** ZOOM);
  return { width: png.width, height: png.height, data: png.data, centre: { x: png.width / 2, y: png.height / 2 }, metresPerPixel };
}

// Colours of echoes of half strength and more (protocol/signalk/legend.cpp): full green to red, which
// nothing else on the map has.
export function isStrong(shot, x, y) {
  const i = 4 * (y * shot.width + x);
  const [r, g, b] = shot.data.subarray(i, i + 3);
  return Math.max(r, g) > 190 && b < 90 && Math.max(r, g) - b > 130;
}

// The middle of the magenta with which other vessels are drawn, and nothing else on the map; null if there is none.
export function middleOfVessels(shot) {
  let pixels = 0, x = 0, y = 0;
  for (let i = 0; i < shot.width * shot.height; i += 1) {
    const [r, g, b] = shot.data.subarray(4 * i, 4 * i + 3);
    if (!(r > 200 && b > 200 && g < 80)) continue;
    pixels += 1;
    x += i % shot.width;
    y += Math.floor(i / shot.width);
  }
  return pixels === 0 ? null : { pixels, x: x / pixels, y: y / pixels };
}
