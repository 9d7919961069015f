// The console: joins the stream, the picture and the panel.
import { Access } from './access.js';
import { AlertConsole } from './alerts/alerts.js';
import { ChartPart } from './chart/chart.js';
import { Connection } from './connection.js';
import { RadarConsole } from './console.js';
import { buildPanel } from './control_panel.js';
import { loadControls } from './controls_table.js';
import { rangeNm as formatRange } from './format.js';
import { Pinch } from './hands/pinch.js';
import { Instructor } from './instructor.js';
import { consoleKeys, showKeyHints } from './keys/console_keys.js';
import { KeyHelp } from './keys/key_help.js';
import { listenToKeys } from './keys/key_listener.js';
import { KeyTable } from './keys/key_table.js';
import { openLanguage } from './language/language_choice.js';
import { t } from './language/language.js';
import { Locks } from './locks.js';
import { Markers } from './markers.js';
import { useControls } from './messages.js';
import { isolated } from './names.js';
import { Notices } from './notices.js';
import { Overlay } from './overlay.js';
import { echoColourTable, PALETTES } from './palette.js';
import { Availability } from './panel/availability.js';
import { setDefaults } from './panel/default_settings.js';
import { Greeting } from './panel/greeting.js';
import { InstructorChoice } from './panel/instructor_choice.js';
import { PictureHealth } from './panel/picture_health.js';
import { Screens } from './panel/screens.js';
import { SetupServer } from './panel/setup_server.js';
import { SetupStore } from './panel/setup_store.js';
import { Setups } from './panel/setups.js';
import { ShipOrders } from './panel/ship_orders.js';
import { Subscription } from './panel/subscription.js';
import { Tabs } from './panel/tabs.js';
import { Layout } from './picture/fit.js';
import { drawsInSoftware, Layers } from './picture/layers.js';
import { Pace } from './picture/pace.js';
import { bindPicture, showMode } from './picture/picture_panel.js';
import { pictureKeys } from './picture/picture_keys.js';
import { PictureSettings } from './picture/picture_settings.js';
import { Stage } from './picture/stage.js';
import * as status from './picture/status.js';
import { Tools } from './picture/tools.js';
import { ToolsPanel } from './picture/tools_panel.js';
import { Playback } from './playback.js';
import { PpiCanvas } from './ppi_canvas.js';
import { PpiRenderer } from './ppi_renderer.js';
import * as readouts from './readouts.js';
import { ReceiverControls } from './receiver_controls.js';
import { Recording } from './recording.js';
import { Rate } from './stream_stats.js';
import { TargetConsole } from './targets/targets.js';
import { openTestAccess } from './test_access.js';
import { NAUTICAL_MILE_M } from './view_geometry.js';
import { $ } from './widgets.js';
import { token } from './token.js';

const READOUTS_MS = 100;
const seconds = () => performance.now() / 1000;

const languageProblem = await openLanguage();  // before any text is made
const choices = new URLSearchParams(location.search);
const renderers = { webgl: (canvas) => new PpiRenderer(canvas), plain: (canvas) => new PpiCanvas(canvas) };
const health = new PictureHealth($('echoes'), renderers, choices.get('canvas'));
const tabs = new Tabs($('tabs'), $('tab-sections'));
const availability = new Availability();

const table = await loadControls(new URL('controls.json', location.href), () => {
  $('alarm').hidden = false;
  $('alarm').textContent = t('No connection to the server');
});
useControls(table);
buildPanel(table);
status.buildTools();

const notices = new Notices($('notices'));
if (languageProblem) notices.show(languageProblem);
health.noted = (note) => notices.show(note, 'info');
if (health.note) health.noted(health.note);
const picture = new PictureSettings();
const tools = new Tools();
const stage = new Stage(picture, (text, kind) => notices.show(text, kind));
const markers = new Markers($('ppi'), tools, {
  putOwn: (at) => stage.putOwn(at), moveOwn: (by) => stage.moveOwn(by), modeChanged: showMode, told: (text) => notices.show(text),
});
const toolsPanel = new ToolsPanel(tools, markers);
const overlay = new Overlay($('graticule'), $('marks'));
const layers = new Layers($('layers'), ['chart', 'map-lines', 'graticule', 'target-marks', 'marks'].map($));
const frames = { drawn: 0, rate: new Rate(2) };
const radarChoice = choices.get('radar');

let connection;
let isTold = false;  // of the radar's settings, by the server of now
// A console that watches: the picture alone, and no order leaves it. The instructor's page has one beside the chart.
const isWatching = choices.has('watch');
document.body.toggleAttribute('data-watch', isWatching);
// One of two pictures: the picture and its range buttons (src/panel/screens.js).
document.body.toggleAttribute('data-bare', choices.has('bare'));
new InstructorChoice({ part: $('instructor-part'), fold: $('instructor'), box: $('is-instructor'), ask: $('instructor-ask') }, choices.get('instructor'));
const set = (values) => {
  if (isWatching) return null;
  const ours = locks.isInstructor ? { ...values, instructor: true } : values;
  const request = subscription.isAsking ? null : connection.set(radar.radar, radar.view, ours, token());
  if (request === null) notices.show(t('Not connected: the change was not sent'));
  return request;
};
const notify = (text, kind) => notices.show(text, kind);
const receiver = new ReceiverControls(table.controls, set, notify);
const instructor = new Instructor(table.artefacts, set, () => radar.ownShip);
const locks = new Locks(table.controls, set);
const shipOrders = new ShipOrders(set);
const greeting = new Greeting({ problem: $('server-problem'), text: $('server-problem-text') }, notify);
const recording = new Recording((record) => (isWatching ? null : connection.record(record, token())), notify);
const playback = new Playback((change) => (isWatching ? null : connection.playback(change, token())), notify, seconds);
const targets = new TargetConsole({
  send: (order) => (isWatching ? undefined : subscription.isAsking ? null : connection.targetOrder(radar.radar, radar.view, order, token())),
  notify, cursor: () => markers.at(), isBusy: () => (markers.mode !== null && markers.mode !== 'cursor') || chart.editor.mode !== 'off', table, seconds,
});
const alerts = new AlertConsole({ orders: targets.orders, notify, choose: (alert) => targets.choose(alert) });

// Whoever is of one ship alone looks at a radar of hers: gives whether that is another one than till now.
let herShip = '';
function goAboard() {
  const radars = radar.hello?.radars ?? [], hers = radars.find(({ ownShip }) => ownShip === herShip);
  if (herShip === '' || !hers || radars.find((each) => each.radar === radar.radar)?.ownShip === herShip) return false;
  radar.radar = hers.radar;
  return true;
}

const radar = new RadarConsole(health.renderer.maxRows, {
  hello: (hello, wanted) => {
    goAboard();
    greeting.take(hello, wanted);
    recording.greet(hello.canRecord);
    playback.greet(hello.playback);
    receiver.setScales(hello.rangeScalesNm);
    const named = (r) => isolated([r.ownShip, r.name].filter(Boolean).join(' · '));
    $('radar').replaceChildren(...hello.radars.map((r) => new Option(named(r), r.radar)));
    $('radar').value = String(radar.radar);
    $('server').textContent = [hello.server, hello.scenario].map((name) => isolated(name)).filter(Boolean).join(' · ');
    screens.greet(hello.radars);
    subscription.begin();
    showAvailability();
  },
  settings: (settings) => {
    if (!isTold && !isWatching) setups.look();
    isTold = true;
    subscription.takeSettings(settings);
    receiver.takeSettings(settings);
    locks.take(settings);
    showAvailability();
  },
  gap: (seconds) => notify(t('No spokes were made for {seconds} s', { seconds: seconds.toFixed(1) })),
  ownShip: (ownShip) => locks.takeOwnShip(ownShip),
  world: (world) => instructor.take(world),
  recorder: (state) => recording.take(state),
  playback: (state) => { playback.take(state); showAvailability(); },
  spoke: (spoke, nowS) => stage.takeSpoke(spoke, nowS, radar),
  clear: () => stage.clear(),
  targets: (list) => { targets.take(list, !subscription.restores); alerts.take(list.alerts); },
  forget: () => { targets.forget(); alerts.forget(); },
  reply: (reply, text, refused) => {
    if (subscription.takeReply(reply)) return;
    receiver.takeReply(reply, text);
    instructor.takeReply(reply, text);
    locks.takeReply(reply, text);
    shipOrders.takeReply(reply, text);
    recording.takeReply(reply);
    playback.takeReply(reply);
    targets.takeReply(reply, text);
    if (reply.code !== 0) notify(text);
    if (refused) access.want();
  },
});
const chart = new ChartPart({
  radar, ask: (circle) => connection.chartObjects(circle), notify,
  clockPace: () => (playback.isPaused ? 0 : playback.rate),
});
if (/^\d+$/.test(radarChoice ?? '')) radar.radar = Number(radarChoice);

const screens = new Screens({ radar, layOut: () => layout.layOut(), notify }, choices);
const subscription = new Subscription({
  radar, set, notify, controls: table.controls, askToken: () => access.want(),
  send: (number, like, own) => connection.subscribe(number, like, own, token(), { targetsHz: 2 }),
  shown: () => showView(), restored: (view) => targets.restored(view),
}, choices.get('view'));

function showView() {
  const { own } = subscription;
  $('con-page').href = `conning?radar=${radar.radar}`;
  document.querySelector(`input[name=view][value=${own ? 'own' : 'shared'}]`).checked = true;
  $('receiver-note').textContent = own ? t('this console\u2019s own') : t('shared by all consoles');
}
for (const input of document.querySelectorAll('input[name=view]')) {
  input.addEventListener('change', () => subscription.choose(input.value === 'own'));
}
showView();

connection = new Connection(location.href, {
  state: (state) => { if (state !== 'live') { isTold = false; alerts.lost(); } showAvailability(); },
  messages: (messages) => { radar.takeAll(messages, seconds()); chart.takeAll(messages); },
  garbage: (error) => notify(t('The server sent what is no radar message ({kind})', { kind: error.kind ?? 'text' })),
});

// Called by the connection's maker already.
function showAvailability() {
  availability.show({ live: connection?.state === 'live', known: isTold && radar.settings !== null, playback: playback.on, nowMs: performance.now() });
}

// The picture.
let view;
const layout = new Layout($('display'), $('ppi'), isWatching, (made) => { view = made; });

function draw() {
  const nowS = seconds();
  const palette = PALETTES[picture.palette];
  stage.frame(view, radar);
  const ship = radar.ownShip;
  markers.view = view;
  markers.now = { bowDeg: radar.bowDeg(), ownPlace: ship && !ship.noPosition ? ship : null };
  const turnS = radar.turnS() / playback.rate;
  // A picture that stands still does not fade.
  const held = radar.heldAfter !== null || playback.isPaused;
  const drawnS = held ? Math.min(nowS, radar.lastSpokeS) : nowS;
  health.renderer.draw(radar.store, view, {
    palette, turnS, nowS: drawnS,
    afterglow: picture.afterglow / 100,
    sweepRow: radar.isTurning(nowS) && !held ? radar.store.lastRow : -1,
    videoM: radar.videoM(), echo: picture.brilliance.echo / 100, trails: picture.brilliance.trails / 100,
    trueTrails: stage.standing.trailMode === 'true' && picture.trailS !== 0 ? stage.trails : null, trailS: picture.trailS,
  });
  const measured = markers.measurement();
  overlay.draw(view, {
    paletteName: picture.palette, palette, rangeNm: view.rangeM / NAUTICAL_MILE_M, rings: picture.rings,
    scaleUpDeg: stage.standing.scaleUpDeg, headingLine: picture.headingLine && !picturePanel.isLineHeld(),
    sternMarks: picture.sternMarks, bowDeg: radar.spoke || ship ? markers.now.bowDeg : null, ship, pxPerMm: targets.settings.pxPerMm, brilliance: picture.brilliance,
    shapes: markers.shapes, active: tools.active, measured: measured && { from: measured.from, to: measured.to },
    cursor: markers.at() ? markers.pointer : null,
  });
  targets.draw(view, { palette, paletteName: picture.palette, ownShip: radar.ownShip, headingDeg: radar.headingDeg(), rate: held ? 0 : playback.rate });
  chart.draw(view, nowS, picture.palette);
  layers.draw(Math.round(view.side * view.pixelRatio));
  frames.drawn += 1;
  frames.rate.add(nowS, frames.drawn);
}

const pace = new Pace(() => health.renderer.kind === '2d' || drawsInSoftware());
let readoutsAt = 0;
function frame() {
  requestAnimationFrame(frame);  // first: a fault in one picture is not the end of all
  if (pace.isDue(performance.now())) draw();
  if (performance.now() - readoutsAt >= READOUTS_MS) {
    readoutsAt = performance.now();
    showReadouts();
  }
}

function alarmText() {
  if (connection.state === 'waiting' || connection.state === 'connecting') {
    return radar.hello ? t('Connection lost') : t('No connection to the server');
  }
  if (radar.inStandby) return t('Standby');
  if (connection.state === 'live' && playback.isPaused) return '';
  const turns = (seconds() - radar.lastSpokeS) / Math.max(0.5, radar.turnS() / playback.rate);
  if (connection.state === 'live' && radar.spoke && turns > 0.75) return t('No video');
  if (radar.heldAfter !== null && radar.spoke && turns > 0.1) return t('Picture held');
  return '';
}

function showReadouts() {
  const headingDeg = radar.headingDeg();
  const rangeNm = view.rangeM / NAUTICAL_MILE_M;
  readouts.showLink(connection.state, (connection.retryAt - performance.now()) / 1000);
  readouts.showOwnShip(radar.ownShip, headingDeg);
  readouts.showSensors(radar.ownShip);
  status.showStanding({ standing: stage.standing, picture, view, videoM: radar.videoM() });
  status.showCursor(markers, headingDeg, stage.speedKn());
  status.showTools(tools, markers, headingDeg);
  status.showReceiver(radar.settings, radar.spoke?.utcNs ?? 0);
  toolsPanel.show();
  readouts.showStream({
    scan: radar.spoke?.scan ?? null, rpm: radar.isTurning(seconds()) ? radar.turnRate.rpm() : null,
    spokeRate: radar.spokeRate.perSecond(seconds()), lost: radar.loss.lost, gaps: radar.gaps, spoke: radar.spoke,
  });
  playback.showPosition();
  chart.showReadouts();
  targets.tick();
  if (targets.store.isStale) alerts.lost();
  alerts.sound.tick();
  showAvailability();
  const alarm = [health.text, alarmText()].filter(Boolean).join('\n');
  $('alarm').hidden = alarm === '';
  $('alarm').classList.toggle('calm', radar.inStandby && connection.state === 'live' && health.text === '');
  if ($('alarm').textContent !== alarm) $('alarm').textContent = alarm;
  const summary = t('Range {range} nautical miles, {standing}.', { range: formatRange(rangeNm), standing: stage.standing.words });
  if ($('ppi-summary').textContent !== summary) $('ppi-summary').textContent = summary;
}

// The panel and the keys.
function applyPicture() {
  radar.store.trailS = picture.trailS;
  health.setEchoColours(echoColourTable(picture.echo, picture.palette));
}
const picturePanel = bindPicture({
  picture, stage, markers, notify, headingDeg: () => radar.headingDeg(),
  setDefaults: () => setDefaults({ picture, tools, targets, subscription, radar, set }, view, availability.on && !playback.on),
}, applyPicture);
applyPicture();
// The colours of the page around it are this console's too.
if (isWatching || choices.has('bare')) {
  addEventListener('storage', () => {
    Object.assign(picture, new PictureSettings());
    picturePanel.show();
    applyPicture();
  });
}

$('radar').addEventListener('change', () => subscription.chooseRadar(Number($('radar').value)));
const access = new Access($('access'), (isAnew) => connection.tellToken(isAnew), (ship) => { herShip = ship; return goAboard(); });

// Keys and hands.
const keys = new KeyTable();
const help = new KeyHelp($('help'), keys, () => showKeyHints(keys));
const orders = (run) => () => (availability.on ? run() : notify(playback.on ? t('A recording is played: the radar takes no orders') : t('Not connected: the change was not sent')));
keys.register(...consoleKeys({ receiver, playback, recording, screens, help, inStandby: () => radar.inStandby, orders }));
keys.register(...pictureKeys({ picture, picturePanel, stage, markers, tools, toolsPanel, view: () => view }));
keys.register(...targets.keys, ...alerts.keys, ...chart.keys);
showKeyHints(keys);
listenToKeys(keys);
$('help-open').addEventListener('click', () => help.open());
new Pinch($('ppi'), (by) => orders(() => receiver.stepRange(by))());

// What a set-up keeps.
const setupStore = new SetupStore();
setupStore.addPart('picture', {
  take: () => ({ ...picture }),
  put: (values) => {
    picture.change(values);
    picturePanel.show();
    applyPicture();
  },
});
setupStore.addPart('receiver', {
  take: () => subscription.valuesOf(radar.settings),
  put: (values) => subscription.give(values),
});
setupStore.addPart('keys', {
  take: () => ({ ...keys.changed }),
  put: (values) => { keys.replace(values); showKeyHints(keys); },
});
const setups = new Setups(setupStore, new SetupServer(), notify);

openTestAccess({
  radar, connection: () => connection, renderer: () => health.renderer, drawNow: draw, view: () => view, frames,
  recording, playback, tabs, tools, targets, alerts, chart,
});
requestAnimationFrame(frame);
