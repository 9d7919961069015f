// The console: joins the stream, the picture and the panel.
import { Connection } from './connection.js';
import { RadarConsole } from './console.js';
import { buildPanel } from './control_panel.js';
import { bindKeys, PictureSettings } from './controls.js';
import { loadControls } from './controls_table.js';
import { rangeNm as formatRange } from './format.js';
import { Instructor } from './instructor.js';
import { Locks } from './locks.js';
import { Markers } from './markers.js';
import { REFUSED, useControls } from './messages.js';
import { Notices } from './notices.js';
import { Overlay } from './overlay.js';
import { echoColourTable, PALETTES } from './palette.js';
import { Layout } from './picture/fit.js';
import { bindPicture, showMode } from './picture/picture_panel.js';
import { Stage } from './picture/stage.js';
import * as status from './picture/status.js';
import { Tools } from './picture/tools.js';
import { ToolsPanel } from './picture/tools_panel.js';
import { Playback } from './playback.js';
import { PpiRenderer } from './ppi_renderer.js';
import * as readouts from './readouts.js';
import { ReceiverControls } from './receiver_controls.js';
import { Recording } from './recording.js';
import { Rate } from './stream_stats.js';
import { openTestAccess } from './test_access.js';
import { NAUTICAL_MILE_M } from './view_geometry.js';
import { $ } from './widgets.js';

const READOUTS_MS = 100;
const seconds = () => performance.now() / 1000;

let renderer;
try {
  renderer = new PpiRenderer($('echoes'));
} catch (error) {
  $('alarm').hidden = false;
  $('alarm').textContent = `This browser cannot draw the radar picture: ${error.message}. ` +
    'Turn on hardware acceleration, or use a browser with WebGL2.';
  throw error;
}

const table = await loadControls(new URL('controls.json', location.href), () => {
  $('alarm').hidden = false;
  $('alarm').textContent = 'No connection to the server';
});
useControls(table);
buildPanel(table);

const notices = new Notices($('notices'));
const picture = new PictureSettings();
const tools = new Tools();
const stage = new Stage(picture, (text, kind) => notices.show(text, kind));
const markers = new Markers($('ppi'), tools, {
  putOwn: (at) => stage.putOwn(at), moveOwn: (by) => stage.moveOwn(by), modeChanged: showMode, told: (text) => notices.show(text),
});
const toolsPanel = new ToolsPanel(tools, markers);
const overlay = new Overlay($('graticule'), $('marks'));
const frames = { drawn: 0, rate: new Rate(2) };
const choices = new URLSearchParams(location.search);
const radarChoice = choices.get('radar');

let token = sessionStorage.getItem('skerry.token') ?? '';
let connection;
// A console that watches: the picture alone, and no order leaves it. The instructor's page has one beside the chart.
const isWatching = choices.has('watch');
document.body.toggleAttribute('data-watch', isWatching);
const set = (values) => {
  if (isWatching) return null;
  const ours = locks.isInstructor ? { ...values, instructor: true } : values;
  const request = connection.set(radar.radar, radar.view, ours, token);
  if (request === null) notices.show('Not connected: the change was not sent');
  return request;
};
const receiver = new ReceiverControls(table.controls, set);
const instructor = new Instructor(table.artefacts, set, () => radar.ownShip);
const locks = new Locks(table.controls, set);
const notify = (text, kind) => notices.show(text, kind);
const recording = new Recording((record) => (isWatching ? null : connection.record(record, token)), notify);
const playback = new Playback((change) => (isWatching ? null : connection.playback(change, token)), notify, seconds);

const radar = new RadarConsole(renderer.maxRows, {
  hello: (hello) => {
    recording.greet(hello.canRecord);
    playback.greet(hello.playback);
    receiver.setScales(hello.rangeScalesNm);
    const named = (r) => [r.ownShip, r.name].filter(Boolean).join(' · ');
    $('radar').replaceChildren(...hello.radars.map((r) => new Option(named(r), r.radar)));
    $('radar').value = String(radar.radar);
    $('server').textContent = [hello.server, hello.scenario].filter(Boolean).join(' · ');
    subscribe();
  },
  settings: (settings) => { receiver.takeSettings(settings); locks.take(settings); },
  ownShip: (ownShip) => locks.takeOwnShip(ownShip),
  world: (world) => instructor.take(world),
  recorder: (state) => recording.take(state),
  playback: (state) => playback.take(state),
  spoke: (spoke, nowS) => stage.takeSpoke(spoke, nowS, radar),
  clear: () => stage.clear(),
  reply: (reply, text, refused) => {
    if (takeSubscription(reply)) return;
    receiver.takeReply(reply);
    instructor.takeReply(reply);
    recording.takeReply(reply);
    playback.takeReply(reply);
    if (reply.code !== 0) notices.show(text);
    if (refused) $('access').hidden = false;
  },
});
if (/^\d+$/.test(radarChoice ?? '')) radar.radar = Number(radarChoice);

// Whether this console has a view of its own, which further view of another's it looks at if not (0: the shared one), and
// the subscription that is under way.
let ownView = choices.get('view') === 'own';
let joined = /^\d{1,9}$/.test(choices.get('view') ?? '') ? Number(choices.get('view')) : 0;
let asked = null;

function subscribe() {
  const like = ownView ? radar.view : joined;
  $('con-page').href = `conning?radar=${radar.radar}`;
  asked = { request: connection.subscribe(radar.radar, like, ownView, token), radar: radar.radar, like, ownView };
  radar.forget();
  radar.view = ownView ? 0 : joined;
  showView();
}

// Whether the reply is the subscription's. A view to copy may have ended: then the shared one is.
function takeSubscription(reply) {
  if (asked === null || reply.request !== asked.request) return false;
  const { like, ownView: wanted } = asked;
  asked = null;
  if (reply.code === 0) {
    radar.view = reply.view;
    if (wanted && reply.view === 0) { ownView = false; notices.show('This server has no views of one\u2019s own'); }
  } else if (wanted) {
    ownView = like !== 0;
    radar.view = 0;
    if (like === 0) notices.show(reply.text);
    if (reply.code === REFUSED) $('access').hidden = false;
    subscribe();
  } else {
    notices.show(reply.text);
    if (like !== 0) { joined = 0; subscribe(); }
  }
  showView();
  return true;
}

function showView() {
  document.querySelector(`input[name=view][value=${ownView ? 'own' : 'shared'}]`).checked = true;
  $('receiver-note').textContent = ownView ? 'this console\u2019s own' : 'shared by all consoles';
}
for (const input of document.querySelectorAll('input[name=view]')) {
  input.addEventListener('change', () => {
    ownView = input.value === 'own';
    joined = radar.view = 0;
    subscribe();
  });
}
showView();

const url = new URL('ws', location.href);
url.protocol = location.protocol === 'https:' ? 'wss:' : 'ws:';
url.search = url.hash = '';
connection = new Connection(url, {
  state: () => {},
  messages: (messages) => radar.takeAll(messages, seconds()),
  garbage: (error) => notices.show(`The server sent what is no radar message (${error.kind ?? 'text'})`),
});

// The picture.
let view;
new Layout($('display'), $('ppi'), isWatching, (made) => { view = made; });

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
  renderer.draw(radar.store, view, {
    palette, turnS, nowS: drawnS,
    afterglow: picture.afterglow / 100,
    sweepRow: radar.isTurning(nowS) && !held ? radar.store.lastRow : -1,
    videoM: radar.videoM(), echo: picture.brilliance.echo / 100, trails: picture.brilliance.trails / 100,
    trueTrails: stage.standing.trailMode === 'true' ? stage.trails : null, trailS: picture.trailS,
  });
  const measured = markers.measurement();
  overlay.draw(view, {
    paletteName: picture.palette, palette, rangeNm: view.rangeM / NAUTICAL_MILE_M, rings: picture.rings,
    scaleUpDeg: stage.standing.scaleUpDeg, headingLine: picture.headingLine && !picturePanel.isLineHeld(),
    sternMarks: picture.sternMarks, bowDeg: radar.spoke || ship ? markers.now.bowDeg : null, ship, brilliance: picture.brilliance,
    shapes: markers.shapes, active: tools.active, measured: measured && { from: measured.from, to: measured.to },
    cursor: markers.at() ? markers.pointer : null,
  });
  frames.drawn += 1;
  frames.rate.add(nowS, frames.drawn);
}

let readoutsAt = 0;
function frame() {
  draw();
  if (performance.now() - readoutsAt >= READOUTS_MS) {
    readoutsAt = performance.now();
    showReadouts();
  }
  requestAnimationFrame(frame);
}

function alarmText() {
  if (connection.state === 'waiting' || connection.state === 'connecting') {
    return radar.hello ? 'Connection lost' : 'No connection to the server';
  }
  if (radar.inStandby) return 'Standby';
  if (connection.state === 'live' && playback.isPaused) return '';
  const turns = (seconds() - radar.lastSpokeS) / Math.max(0.5, radar.turnS() / playback.rate);
  if (connection.state === 'live' && radar.spoke && turns > 0.75) return 'No video';
  if (radar.heldAfter !== null && radar.spoke && turns > 0.1) return 'Picture held';
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
    spokeRate: radar.spokeRate.perSecond(seconds()), lost: radar.loss.lost, spoke: radar.spoke,
  });
  playback.showPosition();
  const alarm = alarmText();
  $('alarm').hidden = alarm === '';
  $('alarm').classList.toggle('calm', radar.inStandby && connection.state === 'live');
  if ($('alarm').textContent !== alarm) $('alarm').textContent = alarm;
  const summary = `Range ${formatRange(rangeNm)} nautical miles, ${stage.standing.words}.`;
  if ($('ppi-summary').textContent !== summary) $('ppi-summary').textContent = summary;
}

// The panel and the keys.
function applyPicture() {
  radar.store.trailS = picture.trailS;
  renderer.setEchoColours(echoColourTable(picture.echo, picture.palette));
}
const picturePanel = bindPicture({
  picture, stage, markers, notify, headingDeg: () => radar.headingDeg(),
  setDefaults: () => { picture.setDefaults(); tools.setDefaults(view); },
}, applyPicture);
applyPicture();
// The colours of the page around it are this console's too.
if (isWatching) {
  addEventListener('storage', () => {
    Object.assign(picture, new PictureSettings());
    picturePanel.show();
    applyPicture();
  });
}

$('radar').addEventListener('change', () => {
  radar.radar = Number($('radar').value);
  joined = radar.view = 0;
  subscribe();
});
$('orders').addEventListener('submit', (event) => {
  event.preventDefault();
  const course = $('order-course'), speed = $('order-speed');
  const values = {};
  if (course.value !== '') values.courseDeg = course.valueAsNumber;
  if (speed.value !== '') values.speedKn = speed.valueAsNumber;
  if (Object.keys(values).length > 0 && set(values) !== null) course.value = speed.value = '';
});
$('token').addEventListener('change', () => {
  token = $('token').value;
  sessionStorage.setItem('skerry.token', token);
});
$('token').value = token;
$('help-open').addEventListener('click', () => $('help').showModal());

const step = (event, coarse) => (event.shiftKey ? coarse / 10 : coarse);
// In the off-centre mode Shift and an arrow move own ship, else the active EBL and VRM.
const arrow = (x, y, otherwise) => (event) => {
  if (markers.mode === 'off-centre' && event.shiftKey) stage.moveOwn({ x: x * 0.05, y: y * 0.05 });
  else otherwise(event);
};
const press = (name, value) => document.querySelector(`input[name=${name}][value=${value}]`).click();
bindKeys({
  '+': () => receiver.stepRange(1), '=': () => receiver.stepRange(1), '-': () => receiver.stepRange(-1),
  n: () => press('orientation', 'north'), h: () => press('orientation', 'head'), c: () => picturePanel.setOrientation('course'),
  t: () => press('motion', picture.motion === 'true' ? 'relative' : 'true'),
  o: () => $('off-centre').click(), PageUp: () => stage.lookAhead(), Home: () => stage.centre(), End: () => $('motion-reset').click(),
  s: () => press('transmit', radar.inStandby ? 'on' : 'off'),
  g: (event) => receiver.stepGain(event.shiftKey ? -1 : 1),
  e: (event) => tools.toggle('ebls', event.shiftKey ? 1 : 0, view), v: (event) => tools.toggle('vrms', event.shiftKey ? 1 : 0, view),
  i: () => toolsPanel.toggleLines(), d: () => $('measure').click(), z: () => picturePanel.hold(true),
  Escape: () => markers.setMode(null),
  r: () => $('rings').click(), l: () => $('heading-line').click(), p: () => $('palette').click(),
  k: () => playback.toggle(), ',': () => playback.step(-1), '.': () => playback.step(1), m: () => recording.mark(''),
  '?': () => $('help').showModal(),
  ArrowLeft: arrow(-1, 0, (event) => markers.turnEbl(-step(event, 1))), ArrowRight: arrow(1, 0, (event) => markers.turnEbl(step(event, 1))),
  ArrowUp: arrow(0, 1, (event) => markers.moveVrm(step(event, 0.01))), ArrowDown: arrow(0, -1, (event) => markers.moveVrm(-step(event, 0.01))),
});

openTestAccess({ radar, connection: () => connection, renderer, drawNow: draw, view: () => view, frames, recording, playback, tools });
requestAnimationFrame(frame);
