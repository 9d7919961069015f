// Every change of range scale: from each to each other. Right after it what was seen stays where it belongs, as far as its
// cells tell; half a turn later one half is new; a turn later all is.
// PAIRS=all: the console itself goes through all pairs, too, with both renderers (some minutes); without it through the neighbours.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { capture, openConsole } from '../browser.mjs';
import { openBench } from '../canvas_kit.mjs';
import { eachTest } from '../each_test.mjs';
import { SMALL } from '../hands_kit.mjs';
import { NM } from '../mock_scene.mjs';
import { MockServer, RANGES_NM } from '../mock_server.mjs';
import { circuit, octaveCells, wrongEchoes } from '../range_pairs_kit.mjs';

let browser, server, page;
eachTest((b) => { browser = b; }, () => { const opened = { page, server }; page = server = null; return opened; });

const SPOKES = 256, CELLS = 512, SIDE = 240;
// As of canvas.test.mjs.
const MOST = 3, MOST_PART = 0.002;
const pairs = (path) => path.slice(1).map((to, k) => [path[k], to]);
const ALL = pairs(circuit(RANGES_NM.length));
const NEIGHBOURS = pairs([...RANGES_NM.keys(), ...[...RANGES_NM.keys()].reverse().slice(1), RANGES_NM.length - 1, 0]);
const cellOf = (scale, cells = CELLS) => (RANGES_NM[scale] * NM) / cells;

test('all pairs of scales are right with both renderers, before, while and after new spokes come', async (t) => {
  assert.equal(ALL.length, 132);
  assert.equal(new Set(ALL.map(String)).size, 132);
  server = new MockServer();
  page = await openBench(browser, await server.start());
  const videos = RANGES_NM.map((_, scale) => Buffer.concat(Array.from({ length: SPOKES },
    (_u, i) => Buffer.from(octaveCells((i * 360) / SPOKES, { cells: CELLS, cellSizeM: cellOf(scale) })))).toString('base64'));
  await page.evaluate(([videos64, shape]) => window.setScales(videos64, shape), [videos, { ranges: RANGES_NM.map((nm) => nm * NM), spokes: SPOKES, cells: CELLS, side: SIDE }]);
  const wrong = [];
  let echoes = 0, apart = 0;
  for (const [from, to] of ALL) {
    const told = `${RANGES_NM[from]} to ${RANGES_NM[to]} NM`;
    for (const [stage, { base64, found }] of (await page.evaluate((change) => window.changeScale(...change), [from, to])).entries()) {
      const shot = { width: SIDE, data: Buffer.from(base64, 'base64'), side: SIDE, centre: { x: SIDE / 2, y: SIDE / 2 }, radiusPx: SIDE / 2 - 20, pixelRatio: 1, upDeg: 0, rangeM: RANGES_NM[to] * NM };
      const isNew = ({ bearingDeg }) => stage === 2 || (stage === 1 && bearingDeg < 180);
      const { wrong: places, seen } = wrongEchoes(shot, (echo) => cellOf(isNew(echo) ? to : from), (echo) => RANGES_NM[isNew(echo) ? to : from] * NM);
      echoes += seen;
      apart = Math.max(apart, found.off / found.pixels);
      wrong.push(...places.map((place) => `${told}, ${['at once', 'half a turn later', 'a turn later'][stage]}: ${place}`));
      if (found.off / found.pixels > MOST_PART) wrong.push(`${told}, stage ${stage}: the 2D canvas has ${found.off} other pixels`);
    }
  }
  t.diagnostic(`${ALL.length} pairs, ${echoes} places of echoes; the renderers differ in at most ${(100 * apart).toFixed(3)} % of the pixels (more than ${MOST} of 255)`);
  assert.ok(echoes > 500, String(echoes));
  assert.deepEqual(wrong, []);
});

for (const kind of process.env.PAIRS === 'all' ? ['webgl2', '2d'] : ['webgl2']) {
  test(`the console follows from scale to scale, ${kind}`, async (t) => {
    server = new MockServer({ ...SMALL, rpm: 240, scene: octaveCells, settings: { rangeNm: RANGES_NM[0] } });
    page = await openConsole(browser, `${await server.start()}?canvas=${kind}`);
    await page.locator('#range option').last().waitFor({ state: 'attached' });
    const wrong = [];
    let echoes = 0;
    for (const [from, to] of process.env.PAIRS === 'all' ? ALL : NEIGHBOURS) {
      assert.equal(server.settings.rangeNm, RANGES_NM[from]);
      if (to === from + 1) await page.keyboard.press('+');
      else if (to === from - 1) await page.keyboard.press('-');
      else await page.locator('#range').selectOption(String(RANGES_NM[to]));
      await page.locator('#range').evaluate((e) => e.blur());
      await page.waitForFunction((m) => {
        const last = window.skerry.lastScan();
        return last && !last.mixedRanges && Math.abs(last.rangeM - m) < 0.01 * m && window.skerry.settings().rangeNm * 1852 === m;
      }, RANGES_NM[to] * NM);
      const shot = await capture(page);
      assert.ok(Math.abs(shot.rangeM - RANGES_NM[to] * NM) < 1e-6 * shot.rangeM, `${shot.rangeM} m is shown`);
      const found = wrongEchoes(shot, () => cellOf(to, SMALL.cells));
      echoes += found.seen;
      wrong.push(...found.wrong.map((place) => `${RANGES_NM[from]} to ${RANGES_NM[to]} NM: ${place}`));
    }
    t.diagnostic(`${echoes} places of echoes`);
    assert.ok(echoes > 60, String(echoes));
    assert.deepEqual(wrong, []);
    assert.deepEqual(page.problems, []);
  });
}
