// Both renderers of the console on the same spokes, in one page: what each paints, pixel by pixel.
import { cellsAt, NM } from './mock_scene.mjs';

const SPOKES = 720, CELLS = 512;

// A page of that server without a console; window.paint() is there then.
export async function openBench(browser, url) {
  const page = await (await browser.newContext()).newPage();
  await page.goto(`${url}controls.json`);
  const cells = Buffer.concat(Array.from({ length: SPOKES }, (_, i) => Buffer.from(cellsAt((i * 360) / SPOKES, { cells: CELLS, cellSizeM: (6 * NM) / CELLS, gain: 50 }))));
  await page.evaluate(setUp, { spokes: SPOKES, cells: CELLS, rangeM: 6 * NM, bytes: cells.toString('base64') });
  return page;
}

async function setUp({ spokes, cells, rangeM, bytes }) {
  const [{ PpiRenderer }, { PpiCanvas }, { ScanStore }, { ViewGeometry }, { TrueTrails }, { PALETTES, echoColourTable }] =
    await Promise.all(['ppi_renderer', 'ppi_canvas', 'scan_store', 'view_geometry', 'picture/true_trails', 'palette'].map((name) => import(`/src/${name}.js`)));
  const video = Uint8Array.from(atob(bytes), (c) => c.charCodeAt(0));
  const makers = { webgl2: PpiRenderer, '2d': PpiCanvas };

  // Paints `steps`, one after another, with one renderer, and gives the last picture. A step, kept by those after it
  // until changed:
  //   side, upDeg, rangeM, ownAt, jumps: of the view;  palette, colours, afterglow, nowS, turnS, echo, trails, trailS, sweepRow: of the look
  //   trueTrails: those instead of the store's
  //   put: [first, count, at s, gain 0..1] of spokes that come, doppler: their class;  clear: the store is emptied
  window.paint = (kind, steps) => {
    const canvas = document.createElement('canvas');
    document.body.replaceChildren(canvas);
    const renderer = new makers[kind](canvas), store = new ScanStore(), trueTrails = new TrueTrails();
    let now = {
      side: 400, upDeg: 0, rangeM, ownAt: { x: 0, y: 0 }, jumps: 0, palette: 'day', colours: 'basic', afterglow: 0.25, nowS: 100, turnS: 3,
      echo: 1, trails: 1, trailS: 0, sweepRow: -1, trueTrails: false, doppler: 0, motion: { eastM: 0, northM: 0, jumps: 0 },
    };
    let colours = '';
    for (const step of steps) {
      now = { ...now, put: null, clear: false, ...step };
      store.trailS = now.trailS;
      trueTrails.setRange(now.rangeM);
      if (now.clear) { store.clear(); trueTrails.clear(); }
      if (now.put) {
        const [first, count, atS, gain = 1] = now.put;
        for (let k = first; k < first + count; ++k) {
          const index = k % spokes, whole = video.slice(index * cells, (index + 1) * cells).map((v) => v * gain);
          const spoke = {
            index, spokesPerTurn: spokes, heading: 0, bits: 8, cellCount: cells, cellSizeM: rangeM / cells, cells: whole, scan: 0,
            doppler: now.doppler ? new Uint8Array(cells / 4).fill(0x55 * now.doppler) : null,
          };
          store.put(spoke, atS, true);
          if (now.trailS !== 0) trueTrails.put(spoke, atS, now.motion);
        }
      }
      const view = Object.assign(new ViewGeometry(now.side, 20, 1), { upDeg: now.upDeg, rangeM: now.rangeM, ownAt: now.ownAt, jumps: now.jumps });
      if (`${now.colours} ${now.palette}` !== colours) renderer.setEchoColours(echoColourTable(now.colours, now.palette));
      colours = `${now.colours} ${now.palette}`;
      renderer.draw(store, view, {
        palette: PALETTES[now.palette], turnS: now.turnS, nowS: now.nowS, afterglow: now.afterglow, sweepRow: now.sweepRow,
        videoM: rangeM, echo: now.echo, trails: now.trails, trueTrails: now.trueTrails ? trueTrails : null, trailS: now.trailS,
      });
    }
    const { data } = renderer.readPixels();
    renderer.gl?.getExtension('WEBGL_lose_context').loseContext();
    return data;
  };

  // One radar that goes from scale to scale, drawn by both renderers; videos: of each scale a turn of spokes, base64.
  window.setScales = (videos, { ranges, spokes: count, cells: length, side }) => {
    const turns = videos.map((text) => Uint8Array.from(atob(text), (c) => c.charCodeAt(0)));
    const drawers = ['webgl2', '2d'].map((kind) => {
      const canvas = document.body.appendChild(document.createElement('canvas'));
      const renderer = new makers[kind](canvas), store = new ScanStore();
      renderer.setEchoColours(echoColourTable('basic', 'day'));
      return { renderer, store };
    });
    let nowS = 100, scan = 0;
    const put = (scale, from, to) => {
      scan += 1;
      for (const { store } of drawers) {
        for (let index = from; index < to; ++index) {
          store.put({
            index, spokesPerTurn: count, heading: 0, bits: 8, cellCount: length, cellSizeM: ranges[scale] / length,
            cells: turns[scale].slice(index * length, (index + 1) * length), scan, doppler: null,
          }, nowS, index > from);
        }
      }
    };
    const draw = (scale) => {
      const view = Object.assign(new ViewGeometry(side, 20, 1), { upDeg: 0, rangeM: ranges[scale] });
      const [seen, other] = drawers.map(({ renderer, store }) => {
        renderer.draw(store, view, { palette: PALETTES.day, turnS: 3, nowS, afterglow: 0, sweepRow: -1, videoM: ranges[scale], echo: 1, trails: 1, trueTrails: null, trailS: 0 });
        return renderer.readPixels().data;
      });
      const parts = [];
      for (let i = 0; i < seen.length; i += 0x6000) parts.push(btoa(String.fromCharCode(...seen.subarray(i, i + 0x6000))));
      return { base64: parts.join(''), found: window.apart(seen, other, 3) };
    };
    // A turn of `from`, then the picture at `to` at once, after half a turn of `to` and after the whole.
    window.changeScale = (from, to) => {
      nowS += 3;
      put(from, 0, count);
      draw(from);
      const pictures = [draw(to)];
      put(to, 0, count / 2);
      pictures.push(draw(to));
      put(to, count / 2, count);
      pictures.push(draw(to));
      return pictures;
    };
  };

  // How far both pictures are apart: pixels of the circle, those more than `most` of 255 off in any colour, and the
  // worst of the others.
  window.apart = (a, b, most) => {
    const found = { pixels: 0, off: 0, worst: 0, lit: 0 };
    for (let i = 0; i < a.length; i += 4) {
      let worst = 0;
      for (let c = 0; c < 4; ++c) worst = Math.max(worst, Math.abs(a[i + c] - b[i + c]));
      found.pixels += 1;
      if (a[i] + a[i + 1] + a[i + 2] > 90) found.lit += 1;
      if (worst > most) found.off += 1;
      else found.worst = Math.max(found.worst, worst);
    }
    return found;
  };
}
