// window.skerry: what a test, or a curious engineer, may ask of the console. Nothing here changes what
// is shown, but holdAfter().
//
//   state()               connection, counters, scan, rates, range, orientation, frames, canvas
//   settings()            the view's settings as the server last sent them, or null
//   world()               sea, air, rain and artefacts as the server last sent them, or null
//   lastScan()            the newest turn received whole: { scan, spokes, cells, rangeM, headingDeg,
//                         mixedRanges }, or null
//   ppi                   { centre: {x, y}, own: {x, y}, radiusPx, side, pixelRatio, upDeg, rangeM }, CSS pixels
//   pixelFor(deg, m)      {x, y} on the picture of a true bearing and a range
//   at(x, y)              { bearingDeg, rangeM, inside } of such a pixel
//   tools()               the measuring tools, as picture/tools.js has them
//   renderer()            what draws the echoes: 'webgl2', '2d', or '' where nothing can
//   capture()             draws a frame now: { width, height, base64 } of RGBA, top row first, device pixels
//   readPolar()           { rows, cols, cells, meta } in base64: row r is true bearing r/rows of a turn;
//                         cells: echo and trail, a byte each; meta: time s, cell size m, cells, scan, floats
//   paintedS(bearingDeg)  exercise seconds at which the spoke on that true bearing was seen, or null; its error is the jitter of arrival
//   showTab(name)         of the panel: 'radar', 'targets', 'tools', 'chart', 'set-up'
//   targets()             { list, stale, selected, mode, shown, vectors, pxPerMm }: what is drawn of targets now, in CSS pixels
//   alerts()              { calling (priority that sounds, or null), soundAllowed, beeps, history }
//   chart()               own ship's place, the loaded chart, lines and marks and their pixels (chart/chart.js)
//   drawn(n)              resolves when n more pictures have been drawn
//   holdAfter(scan|null)  spokes of later scans are counted, but not drawn
export function openTestAccess({ radar, connection, renderer, drawNow, view, frames, recording, playback, tabs, tools, targets, alerts, chart }) {
  const scenarioS = () => (radar.spoke ? radar.spoke.scenarioNs / 1e9 : null);  // of the newest spoke
  window.skerry = {
    state: () => ({
      connection: connection().state,
      garbage: connection().garbage,
      bytes: connection().bytes,
      radar: radar.radar,
      view: radar.view,
      standby: radar.inStandby,
      received: radar.loss.received,
      lost: radar.loss.lost,
      restarts: radar.loss.restarts,
      scan: radar.spoke?.scan ?? null,
      newestScan: radar.newestScan,
      index: radar.spoke?.index ?? null,
      scenarioS: scenarioS(),
      bits: radar.spoke?.bits ?? null,
      spokesPerTurn: radar.spoke?.spokesPerTurn ?? null,
      headingDeg: radar.headingDeg(),
      rpm: radar.turnRate.rpm(),
      spokesPerSecond: radar.spokeRate.perSecond(performance.now() / 1000),
      frames: frames.drawn,
      framesPerSecond: frames.rate.perSecond(),
      ownShip: radar.ownShip,
    }),
    settings: () => radar.settings,
    recorder: () => recording.state,
    playback: () => playback.state,
    world: () => radar.world,
    targets: () => targets.state,
    alerts: () => alerts.state,
    chart: () => chart.state(),
    lastScan: () => radar.scans.last,
    get ppi() {
      const { side, centre, own, radius, pixelRatio, upDeg, rangeM } = view();
      return { side, centre: { x: centre, y: centre }, own, radiusPx: radius, pixelRatio, upDeg, rangeM };
    },
    pixelFor: (bearingDeg, rangeM) => view().toPixel(bearingDeg, rangeM),
    at: (x, y) => view().fromPixel(x, y),
    tools: () => { const { ebls, vrms, lines, active } = tools; return structuredClone({ ebls, vrms, lines, active }); },
    renderer: () => renderer().kind ?? '',
    capture: () => {
      drawNow();
      const { width, height, data } = renderer().readPixels();
      return { width, height, base64: base64(data) };
    },
    readPolar: () => {
      const { rows, cols, cells, meta } = radar.store;
      return { rows, cols, cells: base64(cells), meta: base64(new Uint8Array(meta.buffer)) };
    },
    paintedS: (bearingDeg) => {
      const { rows, meta } = radar.store;
      const row = Math.round((bearingDeg / 360) * rows) % rows;
      return radar.spoke && meta[row * 4 + 1] > 0 ? scenarioS() - (radar.lastSpokeS - meta[row * 4]) : null;
    },
    showTab: (name) => tabs.show(name),
    drawn: (n) => new Promise((resolve) => {
      const last = frames.drawn + n;
      const look = () => (frames.drawn >= last ? resolve() : requestAnimationFrame(look));
      look();
    }),
    holdAfter: (scan) => { radar.heldAfter = scan; },
  };
}

function base64(bytes) {
  const parts = [];
  for (let i = 0; i < bytes.length; i += 0x6000) {
    parts.push(btoa(String.fromCharCode.apply(null, bytes.subarray(i, i + 0x6000))));
  }
  return parts.join('');
}
