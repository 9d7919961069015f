// The console: joins the stream, the picture and the panel.
import { Connection } from './connection.js';
import { RadarConsole } from './console.js';
import { buildPanel } from './control_panel.js';
import { bindPicture, PictureSettings, showPalette } from './controls.js';
import { loadControls } from './controls_table.js';
import { rangeNm as formatRange } from './format.js';
import { Pinch } from './hands/pinch.js';
import { Instructor } from './instructor.js';
import { consoleKeys, showKeyHints } from './keys/console_keys.js';
import { KeyHelp } from './keys/key_help.js';
import { listenToKeys } from './keys/key_listener.js';
import { KeyTable } from './keys/key_table.js';
import { Locks } from './locks.js';
import { Markers } from './markers.js';
import { useControls } from './messages.js';
import { isolated } from './names.js';
import { Notices } from './notices.js';
import { Overlay } from './overlay.js';
import { echoColourTable, PALETTES } from './palette.js';
import { Availability } from './panel/availability.js';
import { Greeting } from './panel/greeting.js';
import { InstructorChoice } from './panel/instructor_choice.js';
import { PictureHealth } from './panel/picture_health.js';
import { Screens } from './panel/screens.js';
import { SetupStore } from './panel/setup_store.js';
import { Setups } from './panel/setups.js';
import { ShipOrders } from './panel/ship_orders.js';
import { Subscription } from './panel/subscription.js';
import { Tabs } from './panel/tabs.js';
import { Playback } from './playback.js';
import { PpiRenderer } from './ppi_renderer.js';
import * as readouts from './readouts.js';
import { ReceiverControls } from './receiver_controls.js';
import { Recording } from './recording.js';
import { Rate } from './stream_stats.js';
import { openTestAccess } from './test_access.js';
import { NAUTICAL_MILE_M, ViewGeometry } from './view_geometry.js';
import { $ } from './widgets.js';

const READOUTS_MS = 100;
const seconds = () => performance.now() / 1000;

const health = new PictureHealth($('echoes'), (canvas) => new PpiRenderer(canvas));
const { renderer } = health;
const tabs = new Tabs($('tabs'), $('tab-sections'));
const availability = new Availability();

const table = await loadControls(new URL('controls.json', location.href), () => {
  $('alarm').hidden = false;
  $('alarm').textContent = 'No connection to the server';
});
useControls(table);
buildPanel(table);

const notices = new Notices($('notices'));
const picture = new PictureSettings();
const markers = new Markers($('ppi'));
const overlay = new Overlay($('graticule'), $('marks'));
const frames = { drawn: 0, rate: new Rate(2) };
const choices = new URLSearchParams(location.search);
const radarChoice = choices.get('radar');

let token = sessionStorage.getItem('skerry.token') ?? '';
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
  const request = connection.set(radar.radar, radar.view, ours, token);
  if (request === null) notices.show('Not connected: the change was not sent');
  return request;
};
const notify = (text, kind) => notices.show(text, kind);
const receiver = new ReceiverControls(table.controls, set, notify);
const instructor = new Instructor(table.artefacts, set, () => radar.ownShip);
const locks = new Locks(table.controls, set);
const shipOrders = new ShipOrders(set);
const greeting = new Greeting({ problem: $('server-problem'), text: $('server-problem-text') }, notify);
const recording = new Recording((record) => (isWatching ? null : connection.record(record, token)), notify);
const playback = new Playback((change) => (isWatching ? null : connection.playback(change, token)), notify, seconds);

const radar = new RadarConsole(renderer.maxRows, {
  hello: (hello, wanted) => {
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
    isTold = true;
    subscription.takeSettings(settings);
    receiver.takeSettings(settings);
    locks.take(settings);
    showAvailability();
  },
  ownShip: (ownShip) => locks.takeOwnShip(ownShip),
  world: (world) => instructor.take(world),
  recorder: (state) => recording.take(state),
  playback: (state) => { playback.take(state); showAvailability(); },
  reply: (reply, text, refused) => {
    if (subscription.takeReply(reply)) return;
    receiver.takeReply(reply, text);
    instructor.takeReply(reply, text);
    locks.takeReply(reply, text);
    shipOrders.takeReply(reply, text);
    recording.takeReply(reply);
    playback.takeReply(reply);
    if (reply.code !== 0) notify(text);
    if (refused) $('access').hidden = false;
  },
});
if (/^\d+$/.test(radarChoice ?? '')) radar.radar = Number(radarChoice);

const screens = new Screens({ radar, layOut: () => layOut(), notify }, choices);
const subscription = new Subscription({
  radar, set, notify, controls: table.controls, askToken: () => { $('access').hidden = false; },
  send: (number, like, own) => connection.subscribe(number, like, own, token),
  shown: () => showView(),
}, choices.get('view'));

function showView() {
  const { own } = subscription;
  $('con-page').href = `conning?radar=${radar.radar}`;
  document.querySelector(`input[name=view][value=${own ? 'own' : 'shared'}]`).checked = true;
  $('receiver-note').textContent = own ? 'this console\u2019s own' : 'shared by all consoles';
}
for (const input of document.querySelectorAll('input[name=view]')) {
  input.addEventListener('change', () => subscription.choose(input.value === 'own'));
}
showView();

const url = new URL('ws', location.href);
url.protocol = location.protocol === 'https:' ? 'wss:' : 'ws:';
url.search = url.hash = '';
connection = new Connection(url, {
  state: (state) => { if (state !== 'live') isTold = false; showAvailability(); },
  messages: (messages) => radar.takeAll(messages, seconds()),
  garbage: (error) => notify(`The server sent what is no radar message (${error.kind ?? 'text'})`),
});

// Called by the connection's maker already.
function showAvailability() {
  availability.show({ live: connection?.state === 'live', known: isTold && radar.settings !== null, playback: playback.on, nowMs: performance.now() });
}

// The picture.
let view = new ViewGeometry(100, 10, 1);

function layOut() {
  const area = $('display').getBoundingClientRect();
  const side = Math.max(200, Math.floor(Math.min(area.width, area.height)));
  const margin = Math.max(24, 3.1 * Math.max(10, Math.min(20, side / 62)));
  view = new ViewGeometry(side, margin, window.devicePixelRatio || 1);
  Object.assign($('ppi').style, {
    width: `${side}px`, height: `${side}px`,
    left: `${Math.floor((area.width - side) / 2)}px`, top: `${Math.floor((area.height - side) / 2)}px`,
  });
}

// A change of the pixel ratio alone (zoom, another screen) resizes nothing but is told here.
function watchPixelRatio() {
  matchMedia(`(resolution: ${window.devicePixelRatio}dppx)`)
    .addEventListener('change', () => { layOut(); watchPixelRatio(); }, { once: true });
}

function draw() {
  const nowS = seconds();
  const headingDeg = radar.headingDeg();
  const palette = PALETTES[picture.palette];
  view.upDeg = picture.headUp && headingDeg !== null ? headingDeg : 0;
  view.rangeM = radar.rangeM();
  markers.view = view;
  const turnS = radar.turnS() / playback.rate;
  // A picture that stands still does not fade.
  const held = radar.heldAfter !== null || playback.isPaused;
  renderer.draw(radar.store, view, {
    palette, turnS,
    nowS: held ? Math.min(nowS, radar.lastSpokeS) : nowS,
    afterglow: picture.afterglow / 100,
    sweepRow: radar.isTurning(nowS) && !held ? radar.store.lastRow : -1,
  });
  overlay.draw(view, {
    paletteName: picture.palette, palette, rangeNm: view.rangeM / NAUTICAL_MILE_M, rings: picture.rings,
    headingLine: picture.headingLine, headingDeg, headUp: picture.headUp, ebl: markers.ebl, vrm: markers.vrm,
    cursor: markers.at() ? markers.pointer : null,
  });
  frames.drawn += 1;
  frames.rate.add(nowS, frames.drawn);
}

let readoutsAt = 0;
function frame() {
  requestAnimationFrame(frame);  // first: a fault in one picture is not the end of all
  draw();
  if (performance.now() - readoutsAt >= READOUTS_MS) {
    readoutsAt = performance.now();
    showReadouts();
  }
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
  readouts.showOrientation(picture.headUp, radar.ownShip);
  readouts.showRange(rangeNm > 0 ? Number(rangeNm.toFixed(4)) : NaN);
  readouts.showMarkers(markers, headingDeg);
  readouts.showStream({
    scan: radar.spoke?.scan ?? null, rpm: radar.isTurning(seconds()) ? radar.turnRate.rpm() : null,
    spokeRate: radar.spokeRate.perSecond(seconds()), lost: radar.loss.lost, spoke: radar.spoke,
  });
  playback.showPosition();
  showAvailability();
  const alarm = [health.text, alarmText()].filter(Boolean).join('\n');
  $('alarm').hidden = alarm === '';
  $('alarm').classList.toggle('calm', radar.inStandby && connection.state === 'live' && health.text === '');
  if ($('alarm').textContent !== alarm) $('alarm').textContent = alarm;
  const summary = `Range ${formatRange(rangeNm)} nautical miles, ${$('orientation').textContent.toLowerCase()}.`;
  if ($('ppi-summary').textContent !== summary) $('ppi-summary').textContent = summary;
}

// The panel and the keys.
function applyPicture() {
  radar.store.trailS = picture.trailS;
  renderer.setEchoColours(echoColourTable(picture.echo));
}
const showPicture = bindPicture(picture, (values) => { picture.change(values); applyPicture(); });
applyPicture();
// The colours of the page around it are this console's too.
if (isWatching || choices.has('bare')) {
  addEventListener('storage', () => {
    Object.assign(picture, new PictureSettings());
    showPalette(picture.palette);
    applyPicture();
  });
}

$('radar').addEventListener('change', () => subscription.chooseRadar(Number($('radar').value)));
$('token').addEventListener('change', () => {
  token = $('token').value;
  sessionStorage.setItem('skerry.token', token);
});
$('token').value = token;

// Keys and hands.
const keys = new KeyTable();
const help = new KeyHelp($('help'), keys, () => showKeyHints(keys));
const orders = (run) => () => (availability.on ? run() : notify(playback.on ? 'A recording is played: the radar takes no orders' : 'Not connected: the change was not sent'));
keys.register(...consoleKeys({ receiver, markers, playback, recording, screens, help, inStandby: () => radar.inStandby, orders }));
showKeyHints(keys);
listenToKeys(keys);
$('help-open').addEventListener('click', () => help.open());
new Pinch($('ppi'), (by) => orders(() => receiver.stepRange(by))());

// What a set-up keeps.
const setups = new SetupStore();
setups.addPart('picture', {
  take: () => ({ ...picture }),
  put: (values) => {
    picture.change(Object.fromEntries(Object.entries(values).filter(([name, value]) => typeof picture[name] === typeof value)));
    Object.assign(picture, new PictureSettings());  // with what is valid of them
    showPicture();
    applyPicture();
  },
});
setups.addPart('receiver', { take: () => subscription.valuesOf(radar.settings), put: (values) => subscription.give(values) });
setups.addPart('keys', { take: () => ({ ...keys.changed }), put: (values) => { keys.replace(values); showKeyHints(keys); } });
new Setups(setups, notify);

new ResizeObserver(layOut).observe($('display'));
watchPixelRatio();
layOut();
openTestAccess({ radar, connection: () => connection, renderer, drawNow: draw, view: () => view, frames, recording, playback, tabs });
requestAnimationFrame(frame);
