// The picture that the processor draws (ppi_canvas.js): as WebGL2's, on the same spokes; and the console without WebGL2.
import assert from 'node:assert/strict';
import { after, afterEach, before, test } from 'node:test';
import { capture, launch, openConsole, waitForScan } from '../browser.mjs';
import { openBench } from '../canvas_kit.mjs';
import { angleBetween, blobAt, echoPixels, leadingEdge } from '../measure.mjs';
import { coastM, NM, TARGETS } from '../mock_scene.mjs';
import { MockServer } from '../mock_server.mjs';

let browser, server, page;
before(async () => { browser = await launch(); });
after(() => browser?.close());
afterEach(async () => {
  await page?.context().close();
  await server?.stop();
  page = server = null;
});

// A pixel counts as another one when a colour is more than MOST of 255 off. Of all pixels at most MOST_PART may be: those at whose
// very edge a cell begins, which single and double precision may put on either side.
const MOST = 3, MOST_PART = 0.002;
const TURN = [0, 720, 100];

// [name, steps of canvas_kit.mjs, least part of the pixels that is lit]
const LOOKS = [
  ['a turn of spokes by day', [{ put: TURN }]],
  ['dusk', [{ palette: 'dusk', put: TURN }]],
  ['night', [{ palette: 'night', put: TURN }], 0.01],
  ['levels', [{ colours: 'levels', put: TURN }]],
  ['green, dimmed', [{ colours: 'green', echo: 0.6, put: TURN }]],
  ['approaching', [{ doppler: 1, put: TURN }]],
  ['receding', [{ doppler: 2, put: TURN }]],
  ['head up', [{ upDeg: 137.3, put: TURN }]],
  ['turned after it was drawn', [{ put: TURN }, { upDeg: 41 }]],
  ['a shorter range, before new spokes', [{ put: TURN }, { rangeM: 3 * NM }]],
  ['a longer range', [{ put: TURN }, { rangeM: 12 * NM }], 0.01],
  ['off-centre', [{ ownAt: { x: -0.3, y: 0.55 }, jumps: 1, put: TURN }]],
  ['put elsewhere', [{ put: TURN }, { ownAt: { x: 0.75, y: 0 }, jumps: 1 }]],
  ['sailing in true motion', [{ put: TURN }, ...[1, 2, 3, 4].map((k) => ({ ownAt: { x: 0.01 * k, y: 0.003 * k }, put: [180 * k, 180, 100 + k] }))]],
  ['faded over a turn', [{ put: TURN, afterglow: 1 }, { nowS: 102 }]],
  ['half gone', [{ put: [0, 400, 94] }, { put: [400, 320, 100] }], 0.01],
  ['the sweep', [{ put: TURN, sweepRow: 250 }]],
  ['relative trails', [{ trailS: 60, put: TURN }, { put: [0, 720, 110, 0.2], nowS: 110 }], 0.02],
  ['true trails', [{ trailS: 60, trueTrails: true, put: TURN }, { put: [0, 720, 110, 0.2], nowS: 110 }], 0.02],
  ['true trails that fade', [{ trailS: 60, trueTrails: true, put: TURN }, { put: [0, 720, 130, 0.2], nowS: 130 }, { nowS: 131 }], 0.01],
  ['another size', [{ put: TURN }, { side: 333 }]],
];

test('on the same spokes the picture is WebGL2\u2019s', async (t) => {
  server = new MockServer();
  page = await openBench(browser, await server.start());
  const wrong = [];
  for (const [name, steps, least = 0.03] of LOOKS) {
    const found = await page.evaluate(([s, most]) => window.apart(window.paint('webgl2', s), window.paint('2d', s), most), [steps, MOST]);
    const part = found.off / found.pixels;
    t.diagnostic(`${name}: ${(100 * part).toFixed(3)} % of the pixels are others, the rest at most ${found.worst} of 255 off`);
    if (part > MOST_PART || found.lit < least * found.pixels) wrong.push(`${name}: ${JSON.stringify(found)}`);
  }
  assert.deepEqual(wrong, []);
});
