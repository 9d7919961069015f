// The conning page: joins the ship, the instruments and the controls.
import { Access } from '../access.js';
import { Connection } from '../connection.js';
import { bindKeys, nextPalette, PictureSettings, showPalette } from '../controls.js';
import { HAND, HEADING, REPLY_CODES, TRACK } from '../messages.js';
import { Notices } from '../notices.js';
import { missingSensors, showLink } from '../readouts.js';
import { $, write } from '../widgets.js';
import { Autopilot, bindEntry } from './autopilot.js';
import { Engine, nextPosition } from './engine.js';
import { Helm } from './helm.js';
import { InstructorText } from './instructor_text.js';
import { Readings } from './readings.js';
import { OWN_SHIP_HZ, ShipLink } from './ship_link.js';
import { token } from '../token.js';

const seconds = () => performance.now() / 1000;
const LOOK_MS = 200;  // how often it is seen whether the ship has fallen silent

const notices = new Notices($('notices'));
const picture = new PictureSettings();
let connection = null, asked = null, shown = false;

const set = (values) => {
  const request = connection.set(link.radar, 0, link.instructor ? { ...values, instructor: true } : values, token());
  if (request === null) notices.show('Not connected: the order was not sent');
  return request;
};
// Shown with the next picture of the screen, however many things have changed.
function changed() {
  if (shown) return;
  shown = true;
  requestAnimationFrame(() => { shown = false; show(); });
}

const link = new ShipLink(set, changed);
const engine = new Engine((percent) => changeIf('speed', 'enginePercent', Math.max(-100, Math.min(100, percent))));
const helm = new Helm((name, value) => changeIf('course', name, value), () => link.valueOf('rudderDeg'));
const autopilot = new Autopilot((con) => orderIf('course', { con }),
  (speedKn) => orderIf('speed', { speedKn }));
const readings = new Readings();
const texts = new InstructorText();
bindEntry('course-form', (courseDeg) => orderIf('course', { courseDeg }));
bindEntry('plain-speed-form', (speedKn) => orderIf('speed', { speedKn }));

// Why such an order is not taken now; empty: it is.
function refusal(kind) {
  const { hindered, locks, ship } = link.view(seconds());
  if (hindered) return `No orders: ${hindered}`;
  return ship && locks[kind] ? 'Locked by the instructor' : '';
}

function orderIf(kind, values) {
  const why = refusal(kind);
  if (why) { notices.show(why); return null; }
  return set(values);
}

function changeIf(kind, name, value) {
  const why = refusal(kind);
  if (why) { notices.show(why); return; }
  if (link.ownShip?.con) link.change(name, value);
}

const wanted = new URLSearchParams(location.search).get('radar');
if (/^\d{1,9}$/.test(wanted ?? '')) link.radar = Number(wanted);

function subscribe() {
  link.forget();
  readings.reset();
  asked = connection.subscribe(link.radar, 0, false, '', { ownShipHz: OWN_SHIP_HZ, noSpokes: true });
  $('radar').replaceChildren(...link.ships().map(({ name, radar }) => new Option(name, radar)));
  $('radar').value = String(link.radar);
  $('radar-page').href = `./?radar=${link.radar}`;
  changed();
}

const TAKERS = {
  hello: (hello) => {
    const before = link.radar;
    link.takeHello(hello);
    if (link.radar !== before) notices.show(`No radar ${before} here: the first own ship is shown`);
    link.goAboard();
    subscribe();
  },
  settings: (settings) => link.takeSettings(settings),
  world: (world) => { link.world = world; changed(); },
  ownShip: (ownShip) => link.takeOwnShip(ownShip, seconds()),
  reply: (reply) => {
    link.takeReply(reply);
    if (reply.code === 0) { autopilot.takeReply(reply); return; }
    autopilot.settle();
    notices.show(reply.request === asked ? `No ship: ${reply.text}` : reply.text || REPLY_CODES[reply.code] || `code ${reply.code}`);
    if (/token/.test(reply.text)) askWho();
    changed();
  },
};

connection = new Connection(location.href, {
  state: (state) => { link.isLive = state === 'live'; changed(); },
  messages: (messages) => {
    for (const message of messages) for (const kind of Object.keys(TAKERS)) if (message[kind]) TAKERS[kind](message[kind]);
  },
  garbage: (error) => notices.show(`The server sent what is no radar message (${error.kind ?? 'text'})`),
});

const HOLDER = {
  none: () => '', free: () => 'Nobody has the con', ours: () => 'You have the con',
  theirs: (con) => con.con,
};

function showHolder({ holder, con, fresh }) {
  document.body.dataset.con = holder;
  write('holder-text', HOLDER[holder](con));
  $('holder-text').title = holder === 'theirs' ? `${con.con} has the con` : '';
  write('take', holder === 'ours' ? 'Give it away' : 'Take the con');
  $('take').disabled = !fresh || holder === 'none';
}

// What is not there does not show as if it were.
function showShip({ ship, con, fresh, hindered, locks }) {
  if (ship) document.body.dataset.ship = con ? 'classed' : 'plain';
  if (ship) write('ship-class', con ? con.shipClass : 'no class');
  document.body.dataset.fresh = String(fresh);
  for (const part of document.querySelectorAll('[data-orders]')) {
    const off = hindered !== '' || locks[part.dataset.orders];
    if (part.disabled !== off) part.disabled = off;
    part.classList.toggle('locked', fresh && locks[part.dataset.orders]);
    part.title = hindered ? `No orders: ${hindered}` : locks[part.dataset.orders] ? 'Locked by the instructor' : '';
  }
  document.body.dataset.orders = hindered ? 'no' : 'yes';
}

function alarmText(fresh) {
  if (connection.state !== 'live') return link.hello ? 'Connection lost' : 'No connection to the server';
  return fresh ? '' : 'No data from the ship';
}

function show() {
  const view = link.view(seconds());
  showLink(connection.state, (connection.retryAt - performance.now()) / 1000);
  showHolder(view);
  showShip(view);
  readings.show(view.ship, link.world);
  texts.show(view.ship);
  const missing = missingSensors(view.ship);
  $('sensors').hidden = missing === '';
  write('sensors', missing);
  engine.show(view.con, view.orders.enginePercent);
  helm.show(view.con, view.orders);
  autopilot.show(view.con, view.ship);
  const alarm = view.fresh || performance.now() < 1500 ? '' : alarmText(view.fresh);
  $('alarm').hidden = alarm === '';
  write('alarm', alarm);
}

// The bar and the keys.
function changePalette() {
  picture.change({ palette: nextPalette(picture.palette) });
  showPalette(picture.palette);
}
function takeOrGive() {
  const { holder } = link.view(seconds());
  if (holder !== 'none') set({ con: holder === 'ours' ? { release: true } : { take: true } });
}
$('take').addEventListener('click', takeOrGive);
$('palette').addEventListener('click', changePalette);
$('help-open').addEventListener('click', () => $('help').showModal());
$('instructor').addEventListener('change', () => { link.instructor = $('instructor').checked; changed(); });
$('radar').addEventListener('change', () => {
  link.radar = Number($('radar').value);
  history.replaceState(null, '', `?radar=${link.radar}`);
  $('radar').blur();
  subscribe();
});
const access = new Access($('access'), (isAnew) => connection.tellToken(isAnew), (ship) => link.goAboard(ship));

function askWho() {
  if (!$('help').open) $('help').showModal();
  access.want(true);
}
// A button that was clicked does not keep the space bar and the arrows for itself.
document.addEventListener('click', (event) => {
  if (event.detail > 0) event.target.closest?.('button, label.switch') && document.activeElement?.blur();
});

const wheel = (deg) => helm.wheel.order(link.valueOf('rudderDeg') + deg);
const lever = (percent) => engine.lever.order(percent);
bindKeys({
  ArrowLeft: (event) => wheel(event.shiftKey ? -5 : -1), ArrowRight: (event) => wheel(event.shiftKey ? 5 : 1),
  ' ': () => helm.wheel.order(0),
  ArrowUp: () => lever(link.valueOf('enginePercent') + 5), ArrowDown: () => lever(link.valueOf('enginePercent') - 5),
  PageUp: () => lever(nextPosition(link.valueOf('enginePercent'), true)),
  PageDown: () => lever(nextPosition(link.valueOf('enginePercent'), false)),
  s: () => lever(0),
  ',': () => autopilot.step(-1), '.': () => autopilot.step(1),
  // With Shift, on American and on German keyboards.
  '<': () => autopilot.step(-10), ';': () => autopilot.step(-10), '>': () => autopilot.step(10), ':': () => autopilot.step(10),
  a: () => autopilot.steer(HEADING), h: () => autopilot.steer(HAND), t: () => autopilot.steer(TRACK),
  c: takeOrGive, p: changePalette, '?': () => $('help').showModal(),
});

showPalette(picture.palette);
setInterval(show, LOOK_MS);
show();

// window.skerry: what a test may ask of the page.
window.skerry = {
  // What the page shows: whatever waits for the next picture of the screen is shown first.
  state: () => {
    if (shown) show();
    return { connection: connection.state, bytes: connection.bytes, garbage: connection.garbage, radar: link.radar,
             you: link.hello?.you, ...link.view(seconds()) };
  },
};
