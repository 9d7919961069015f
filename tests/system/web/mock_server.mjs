// A server of the native protocol for tests of the console: its messages are made by protobufjs from
// radar.proto, not by the console's own code. It turns a radar over the scene of mock_scene.mjs.
import { createServer } from 'node:http';
import { createRequire } from 'node:module';
import { readFileSync } from 'node:fs';
import { extname } from 'node:path';
import { fileURLToPath } from 'node:url';
import protobuf from 'protobufjs';
import { WebSocketServer } from 'ws';
import { controlsDocument } from './controls_document.mjs';
import { cellsAt, NM } from './mock_scene.mjs';
import { chartAt, OWN } from './mock_chart.mjs';
import { coastlineAt } from './mock_exercise.mjs';
import { answerLogin } from './mock_login.mjs';

const path = (name) => fileURLToPath(new URL(`../../../${name}`, import.meta.url));
export const WEB = path('clients/web/');
// Imports are named from the repository's root, but for google's own, which protobufjs brings.
const root = new protobuf.Root();
root.resolvePath = (_, target) =>
  (target.startsWith('google/') ? createRequire(import.meta.url).resolve(`protobufjs/${target}`) : path(target));
export const schema = root.loadSync('protocol/wire/radar.proto');
export const ServerMessage = schema.lookupType('skerry.wire.ServerMessage');
export const ClientMessage = schema.lookupType('skerry.wire.ClientMessage');

export const CONTROLS = controlsDocument(schema);

export const RANGES_NM = [0.125, 0.25, 0.5, 0.75, 1.5, 3, 6, 12, 24, 48, 72, 96];
const MIME = { '.html': 'text/html; charset=utf-8', '.css': 'text/css', '.js': 'text/javascript', '.svg': 'image/svg+xml', '.json': 'application/json' };
const BATCH = 16;

export class MockServer {
  constructor(options = {}) {
    Object.assign(this, {
      spokes: 4096, cells: 1024, bits: 8, rpm: 24, headingDeg: 0, port: 0, ships: ['Fulmar', 'Gannet'],
      silent: [], refuse: null, mayLook: () => true, host: '127.0.0.1', doppler: null, driven: false, untold: false, recorder: null, playback: null, controls: CONTROLS,
      exercise: null, ownShipMore: {}, helloMore: {}, place: null, targets: null, answerTargets: () => ({}), stoodStillS: 0, chart: chartAt, at: OWN, setups: null, audit: null, scene: cellsAt, users: null, classCode: null, losesCookies: false,
    }, options);
    // exercise: a MockExercise; ownShipMore, helloMore: further fields of OwnShip and Hello; place(seconds): where own ship is so
    // long after the first spoke, { latitudeDeg, longitudeDeg }; null: she lies still.
    // targets: the TargetList that is sent twice a second, without radar and view; null: none.  answerTargets(order): code and text
    // of the Reply.
    // chart(request): ChartObjects, or null: none is told; at: own ship's place.
    // recorder, playback: the states that are shown; null: there is none.
    // doppler(bearingDeg): class of all cells there; null: no spoke has any.
    // audit: { entries, hasFile, unwritten, refuse }, entries as /audit has them, the oldest first; refuse: status and text of all answers.
    // users: by name { password, role }, who may sign in; what mayLook() and Reply then know of them is up to the test.
    // classCode: by which one is a trainee of the second ship; losesCookies: whoever wants a cookie has neither it nor a token.
    // scene(bearingDeg, { cells, cellSizeM, gain }): cells of one spoke, 0..255.
    // mayLook(token): whether who signed in with it, or with none, may subscribe.
    // silent: [[fromDeg, toDeg]] true bearings of which nothing is sent.
    this.settings = {
      rangeNm: 6, gain: 50, sea: 30, rain: 0, seaAuto: false, interferenceRejection: 0, echoStretch: 0, integration: 0,
      stretchBearing: false, decimation: 0, gainAuto: false, sideLobeSuppression: 0, sideLobeAuto: false, noiseRejection: 0,
      targetSeparation: 0, targetBoost: 0, doppler: 0, dopplerThresholdMps: 2, mode: 0, ...options.settings,
    };
    this.radarSettings = {
      standby: false, pulse: 0, tuneAuto: true, tune: 50, pulseLengthUs: 0.5, prfHz: 1000, rotationRpm: this.rpm,
      bearingAlignmentDeg: 0, antennaHeightM: 20,
    };
    this.blanked = [];
    this.locked = [];
    this.world = {
      seaState: 2, windFromDeg: 225, swellHeightM: 0, swellPeriodS: 10, swellFromDeg: 0, waveHeightM: 0, kFactor: 4 / 3,
      ducting: 0, rain: [], windKn: 14, currentSetDeg: 90, currentKn: 1, depthM: 40, visibilityNm: 5, sideLobes: true, multipleEchoes: true, indirectEchoes: true, shadowSectors: true,
      secondTrace: true, interference: true, overheadCables: true, saturation: true, minimumRange: true, antennaMotion: true,
    };
    this.views = new Map([[0, this.settings]]);  // by number
    this.lastView = 0;
    this.ordered = { courseDeg: this.headingDeg, speedKn: 12 };
    this.received = [];   // decoded ClientMessages
    this.targetOrders = [];
    this.dropNext = 0;
    this.clients = new Set();
  }

  async start() {
    const files = new Set(readFileSync(`${WEB}files.txt`, 'utf8').split('\n').filter(Boolean));
    this.http = createServer((request, response) => {
      let name = new URL(request.url, 'http://x').pathname.slice(1) || 'index.html';
      if (files.has(`${name}.html`)) name += '.html';
      if (name === 'controls.json') {
        response.writeHead(200, { 'Content-Type': 'application/json' }).end(JSON.stringify(this.controls));
        return;
      }
      if (name === 'status') {
        const radars = this.ships.map((_, radar) => ({ radar, views: [...this.views.keys()].filter((view) => view > 0).map((view) => ({ view })) }));
        response.writeHead(200, { 'Content-Type': 'application/json' }).end(JSON.stringify({ radars }));
        return;
      }
      if (name === 'login') { answerLogin(this, request, response); return; }
      if (name === 'audit' && this.audit) { this.#answerAudit(request, response); return; }
      if (/^setups(\/|$)/.test(name)) { this.#answerSetups(request, response, decodeURIComponent(name.slice(7))); return; }
      if (!files.has(name)) { response.writeHead(404).end(); return; }
      response.writeHead(200, {
        'Content-Type': MIME[extname(name)], 'Cache-Control': 'no-store',
        // As skerryd has it (server/net/http/web_answer.cpp).
        'Content-Security-Policy': "default-src 'self'; base-uri 'none'; form-action 'self'; frame-ancestors 'self'; object-src 'none'",
      }).end(readFileSync(WEB + name));
    });
    this.sockets = new WebSocketServer({ server: this.http, path: '/ws' });
    this.sockets.on('connection', (socket) => this.#greet(socket));
    await new Promise((resolve, reject) => {
      this.http.once('error', reject);
      this.http.listen(this.port, this.host, resolve);
    });
    this.port = this.http.address().port;
    this.startedAt = performance.now();
    this.made = 0;        // spokes whose time has come
    this.sequence = 0;
    this.cache = new Map();
    this.ticker = setInterval(() => this.#turn(), 4);
    this.second = setInterval(() => this.#ownShip(), 1000);
    this.targeting = setInterval(() => this.showTargets(), 500);
    this.exercising = setInterval(() => this.showExercise(0.25), 250);
    return `http://${this.host}:${this.port}/`;
  }

  // As server/net/http/audit_page.cpp.
  #answerAudit(request, response) {
    const query = new URL(request.url, 'http://x').searchParams;
    const { entries, hasFile = true, unwritten = 0, refuse } = this.audit;
    (this.audit.asked ??= []).push({ ...Object.fromEntries(query), bearer: request.headers.authorization });
    if (refuse) { response.writeHead(refuse.status).end(`${refuse.status}: ${refuse.text}\n`); return; }
    const part = query.get('who').toLowerCase();
    const told = entries.filter((entry) => entry.n > Number(query.get('after')) && (!query.get('kind') || entry.kind === query.get('kind'))
      && [entry.who, entry.from].some((text) => (text ?? '').toLowerCase().includes(part))).slice(-Number(query.get('last'))).reverse();
    response.writeHead(200, { 'Content-Type': 'application/json' })
      .end(JSON.stringify({ entries: told, newest: entries.at(-1)?.n ?? 0, has_file: hasFile, unwritten }));
  }

  // As server/net/http/setup_routes.cpp. setups: a Map of name and document, or null where none are kept.
  async #answerSetups(request, response, name) {
    let body = '';
    for await (const piece of request) body += piece;
    const reply = (status, text) => response.writeHead(status).end(text);
    if (name !== '' && this.refuse) { reply(403, `403: ${this.refuse.text}`); return; }
    if (request.method === 'PUT') this.setups.set(name, body);
    else if (name !== '' && !this.setups?.has(name)) { reply(404, '404: there is no set-up of this name'); return; }
    else if (request.method === 'DELETE') this.setups.delete(name);
    else if (name !== '') { reply(200, this.setups.get(name)); return; }
    reply(200, JSON.stringify({ keeps: this.setups !== null, setups: [...this.setups?.keys() ?? []].map((key) => ({ name: key, bytes: this.setups.get(key).length })) }));
  }

  async stop() {
    clearInterval(this.ticker);
    clearInterval(this.second);
    clearInterval(this.exercising);
    clearInterval(this.targeting);
    for (const client of this.clients) client.socket.terminate();
    this.clients.clear();
    this.http.closeAllConnections();
    await new Promise((resolve) => this.http.close(resolve));
  }

  // The next n spokes get their sequence numbers, but are never sent.
  drop(n) {
    this.dropNext += n;
  }

  sendRaw(bytes) {
    for (const { socket } of this.clients) socket.send(bytes);
  }

  change(settings) {
    Object.assign(this.settings, settings);
    for (const client of this.clients) this.#sendSettings(client);
  }

  cellSizeM() {
    return (this.settings.rangeNm * NM) / this.cells;
  }

  #greet(socket) {
    const client = { socket, radar: null, view: 0 };
    this.clients.add(client);
    socket.on('close', () => this.clients.delete(client));
    socket.on('error', () => {});
    socket.on('message', (data) => this.#take(client, data));
    this.#send(client, { hello: {
      protocolVersion: 1, server: 'mock 1.0', scenario: 'closed form', rangeScalesNm: RANGES_NM,
      canRecord: this.recorder !== null, playback: this.playback !== null, hasChart: this.chart !== null,
      radars: this.ships.map((ownShip, radar) => ({
        radar, name: 'X-band', ownShip, spokesPerTurn: this.spokes, cells: this.cells, bits: this.bits,
        rpm: this.rpm, beamWidthDeg: 1.2,
      })),
      ...this.helloMore,
    } });
  }

  #take(client, data) {
    this.takeRaw?.(data);
    const message = ClientMessage.decodeDelimited(data);
    this.received.push(message);
    const reply = (code, text = '') => this.#send(client, { reply: { request: message.request, code, text } });
    if (message.kind === 'subscribe') {
      let { view } = message.subscribe;
      if (!this.mayLook(client.token)) { reply(4, 'to see a radar needs a token'); return; }
      if (!this.views.has(view)) { reply(3, `no view ${view}`); return; }
      if (message.subscribe.newView) {
        this.views.set(++this.lastView, { ...this.views.get(view) });
        view = this.lastView;
      }
      client.radar = message.subscribe.radar;
      client.view = view;
      this.#send(client, { reply: { request: message.request, code: 0, view } });
      this.#sendSettings(client);
      this.#send(client, { world: this.world });
      client.exercise = message.subscribe.exerciseHz > 0;
      client.targets = message.subscribe.targetsHz > 0;
      this.#ownShip();
      this.showStates();
      this.showExercise();
      this.showTargets();
    } else if (message.kind === 'signIn') {
      client.token = message.signIn.token;
      reply(0, 'trainee bridge-1');
    } else if (message.kind === 'targetOrder') {
      const { code = 0, text = '' } = this.answerTargets(message.targetOrder);
      if (code === 0) this.targetOrders.push(message.targetOrder);
      reply(code, text);
      this.showTargets();
    } else if (message.kind === 'getCoastline') {
      this.exercise.coastAsked.push(message.getCoastline);
      this.#send(client, { coastline: coastlineAt(message.getCoastline) });
    } else if (message.kind === 'getChartObjects') {
      this.#send(client, { chartObjects: this.chart(message.getChartObjects) });
      reply(0);
    } else if (message.kind === 'set') {
      if (this.refuse) { reply(this.refuse.code, this.refuse.text); return; }
      const wrong = message.set.exercise ? this.exercise.take(message.set.exercise) : null;
      if (wrong) { reply(2, wrong); return; }
      if (message.set.exercise) this.showExercise();
      const take = (names, from, into) => {
        for (const name of names) if (from[`_${name}`]) into[name] = from[name];
      };
      take(Object.keys(this.settings), message.set, this.views.get(message.set.view));
      take(Object.keys(this.radarSettings), message.set, this.radarSettings);
      if (message.set.blankedSectors) this.blanked = message.set.blankedSectors.sectors;
      this.locked = [...this.locked.filter((name) => !message.set.unlock.includes(name)), ...message.set.lock];
      if (message.set._transmit) this.radarSettings.standby = !message.set.transmit;
      if (message.set.world) this.#changeWorld(message.set.world, take);
      for (const name of ['courseDeg', 'speedKn']) {
        if (message.set[`_${name}`]) this.ordered[name] = message.set[name];
      }
      reply(0);
      this.change({});
    } else if (message.kind === 'record') {
      this.#record(message.record, reply);
    } else if (message.kind === 'playback') {
      this.#control(message.playback, reply);
    }
  }

  #record({ action, name }, reply) {
    if (this.refuse) return reply(this.refuse.code, this.refuse.text);
    if (action === 0) Object.assign(this.recorder, { phase: 1, file: `${name || 'now'}.mcap` });
    else if (action === 1) this.recorder.phase = 0;
    else if (this.recorder.phase === 0) return reply(4, 'nothing is being recorded');
    else this.recorder.marks += 1;
    reply(0);
    return this.showStates();
  }

  #control(change, reply) {
    if (this.refuse) return reply(this.refuse.code, this.refuse.text);
    for (const name of ['playing', 'positionS', 'rate', 'loop']) {
      if (change[`_${name}`]) this.playback[name] = change[name];
    }
    if (change._stepTurns) Object.assign(this.playback, { playing: false, positionS: this.playback.positionS + (change.stepTurns * 60) / this.rpm });
    reply(0);
    return this.showStates();
  }

  showExercise(seconds = 0) {
    if (!this.exercise) return;
    this.exercise.step(seconds);
    for (const client of this.clients) if (client.exercise) this.#send(client, { exercise: this.exercise.state() });
  }

  // Sends the list, changed by `change`.
  showTargets(change = {}) {
    if (!this.targets) return;
    Object.assign(this.targets, change);
    for (const client of this.clients) {
      if (client.targets) this.#send(client, { targets: { ...this.targets, radar: client.radar, view: client.view } });
    }
  }

  // Shows the states of recorder and playback, changed by `recorder` and `playback`.
  showStates({ recorder = {}, playback = {} } = {}) {
    if (this.recorder) Object.assign(this.recorder, recorder);
    if (this.playback) Object.assign(this.playback, playback);
    for (const client of this.clients) {
      if (client.radar === null) continue;
      if (this.recorder) this.#send(client, { recorder: this.recorder });
      if (this.playback) this.#send(client, { playback: this.playback });
    }
  }

  #changeWorld(change, take) {
    take(Object.keys(this.world).filter((name) => name !== 'rain'), change, this.world);
    this.world.rain = this.world.rain.filter((cell) => !change.removeRain.includes(cell.id));
    for (const cell of change.rain) {
      if (cell.id === 0) this.world.rain.push({ ...cell, id: (this.lastRain = (this.lastRain ?? 0) + 1) });
    }
    for (const client of this.clients) this.#send(client, { world: this.world });
  }

  #send(client, ...messages) {
    client.socket.send(Buffer.concat(messages.map((m) => ServerMessage.encodeDelimited(ServerMessage.fromObject(m)).finish())));
  }

  #sendSettings(client) {
    if (client.radar === null) return;
    this.#send(client, { settings: {
      radar: client.radar, view: client.view, ...this.views.get(client.view), ...this.radarSettings,
      radarRangeNm: this.settings.rangeNm, blankedSectors: { sectors: this.blanked }, locked: this.locked,
    } });
  }

  #ownShip() {
    for (const client of this.clients) {
      if (client.radar === null) continue;
      this.#send(client, { ownShip: {
        radar: client.radar, name: this.ships[client.radar], latitudeDeg: this.at.latitudeDeg, longitudeDeg: this.at.longitudeDeg - client.radar,
        ...this.place?.((this.made / this.spokes) * (60 / this.rpm)),
        headingDeg: this.headingDeg, speedKn: 11.9, rateOfTurnDegMin: 0,
        orderedCourseDeg: this.ordered.courseDeg, orderedSpeedKn: this.ordered.speedKn,
        driven: this.driven, noPosition: this.untold, noMotion: this.untold, noHeading: this.untold, ...this.ownShipMore,
      } });
    }
  }

  #turn() {
    let due = Math.floor(((performance.now() - this.startedAt) / 1000) * (this.rpm / 60) * this.spokes);
    // On a busy machine the antenna waits: a test that looks at the picture needs whole turns.
    const late = due - this.made - this.spokes / 4;
    if (late > 0) {
      this.startedAt += (late / this.spokes) * (60 / this.rpm) * 1000;
      due = this.made + Math.floor(this.spokes / 4);
    }
    if (this.radarSettings.standby || this.playback?.playing === false) { this.made = due - (due % BATCH); return; }
    while (due - this.made >= BATCH) {
      const batch = [];
      for (let i = 0; i < BATCH; ++i) {
        const spoke = this.#spoke(this.made + i);
        if (spoke) batch.push(spoke);
      }
      this.made += BATCH;
      for (const client of this.clients) {
        if (client.radar === null || batch.length === 0) continue;
        const { rangeNm, gain } = this.views.get(client.view);
        this.#send(client, ...batch.map((spoke) => ({ spoke: {
          ...spoke, radar: client.radar, view: client.view,
          ...(client.view === 0 ? {} : {
            rangeScale: RANGES_NM.indexOf(rangeNm), cellSizeM: (rangeNm * NM) / this.cells,
            cells: this.scene(spoke.bearingDeg, { cells: this.cells, cellSizeM: (rangeNm * NM) / this.cells, gain }),
          }),
        } })));
      }
    }
  }

  #spoke(number) {
    const sequence = this.sequence++;
    const index = number % this.spokes;
    const bearingDeg = ((index * 360) / this.spokes + this.headingDeg) % 360;
    if (this.dropNext > 0) { this.dropNext -= 1; return null; }
    if (this.silent.some(([from, to]) => bearingDeg >= from && bearingDeg < to)) return null;
    return {
      bearingDeg, sequence, scan: Math.floor(number / this.spokes), index, spokesPerTurn: this.spokes,
      rangeScale: RANGES_NM.indexOf(this.settings.rangeNm), bits: this.bits, cellCount: this.cells,
      cellSizeM: this.cellSizeM(), heading: Math.round((this.headingDeg / 360) * 2 ** 32) >>> 0,
      ...this.at, ...this.place?.((number / this.spokes) * (60 / this.rpm)),
      utcNs: protobuf.util.Long.fromNumber(1.7e18 + (number / this.spokes) * (60 / this.rpm) * 1e9),
      scenarioNs: protobuf.util.Long.fromNumber((1 + this.stoodStillS) * 1e9), cells: this.#cells(bearingDeg),
      ...(this.doppler ? { doppler: new Uint8Array((this.cells + 3) >> 2).fill(0x55 * this.doppler(bearingDeg)) } : {}),
    };
  }

  #cells(bearingDeg) {
    const { rangeNm, gain } = this.settings;
    const key = `${rangeNm}/${gain}`;
    if (this.cacheKey !== key) { this.cache.clear(); this.cacheKey = key; }
    const at = Math.round(bearingDeg * 1e4);
    let cells = this.cache.get(at);
    if (!cells) {
      cells = this.scene(bearingDeg, { cells: this.cells, cellSizeM: this.cellSizeM(), gain });
      if (this.bits === 4) {
        const packed = new Uint8Array((this.cells + 1) >> 1);
        cells.forEach((v, c) => { packed[c >> 1] |= (v >> 4) << (4 * (c & 1)); });
        cells = packed;
      }
      if (this.cache.size < 2 * this.spokes) this.cache.set(at, cells);
    }
    return cells;
  }
}

if (process.argv[1] === fileURLToPath(import.meta.url)) {
  const server = new MockServer({ port: Number(process.argv[2] ?? 7481), headingDeg: 37, ...JSON.parse(process.argv[3] ?? '{}') });
  console.log(await server.start());
}
