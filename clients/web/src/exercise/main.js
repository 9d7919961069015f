// The instructor's page: joins the exercise, the chart and the panels.
import { Access } from '../access.js';
import { Connection } from '../connection.js';
import { bindKeys, nextPalette, PictureSettings, showPalette } from '../controls.js';
import { loadControls } from '../controls_table.js';
import { duration, position } from '../format.js';
import { REPLY_CODES, useControls } from '../messages.js';
import { Notices } from '../notices.js';
import { showLink } from '../readouts.js';
import { $, write } from '../widgets.js';
import { AuditPanel } from './audit_panel.js';
import { HostsPanel } from './hosts_panel.js';
import { Chart } from './chart.js';
import { ChartInput } from './chart_input.js';
import { ClassPanel } from './class_panel.js';
import { Coast } from './coast.js';
import { Exercise } from './exercise.js';
import { ExercisePanel } from './exercise_panel.js';
import { FaultsPanel } from './faults_panel.js';
import { Orders } from './orders.js';
import { Replay } from './replay.js';
import { scenarioYaml } from './scenario_yaml.js';
import { ShipList } from './ship_list.js';
import { ShipsPanel } from './ships_panel.js';
import { ToolForms } from './tool_forms.js';
import { Toolbar } from './toolbar.js';
import { Tools } from './tools.js';
import { TraineeView } from './trainee_view.js';
import { WeatherPanel } from './weather_panel.js';
import { token } from '../token.js';

const EXERCISE_HZ = 2,
  LOOK_MS = 250;
// A server that knows of no exercise tells none for so long.
const SILENCE_MS = 4000;

const alarm = (text) => {
  $('alarm').hidden = text === '';
  write('alarm', text);
};
const table = await loadControls(new URL('controls.json', location.href), () => alarm('No connection to the server'));
useControls(table);

const notices = new Notices($('notices'));
const notify = (text, kind) => notices.show(text, kind);
document.addEventListener('refused', ({ detail }) => notify(detail));
const picture = new PictureSettings();
let connection = null,
  hello = null,
  asked = null,
  heardMs = 0,
  shown = false;
const orderedBy = new Map(); // request -> what was ordered

function changed() {
  if (shown) return;
  shown = true;
  requestAnimationFrame(() => {
    shown = false;
    show();
  });
}

const PLAYED = 'A recording is played: orders change nothing in it';

function send(values, what, radar = hello?.radars[0]?.radar ?? 0) {
  if (replay.on) {
    notify(PLAYED);
    return null;
  }
  const request = connection.set(radar, 0, { ...values, instructor: true }, token());
  if (request === null) {
    notify('Not connected: the order was not sent');
    return null;
  }
  orderedBy.set(request, what);
  if (orderedBy.size > 500) orderedBy.delete(orderedBy.keys().next().value);
  return request;
}

let askedClasses = null; // the request that only looks what there is
function orderClass(order) {
  const request = connection.classOrder(order, token());
  if (Object.keys(order).length === 0) askedClasses = request;
  else if (request === null) notify('Not connected: the order was not sent');
  return request;
}

const exercise = new Exercise(() => changed());
const replay = new Replay((change) => connection.playback(change, token()), notify);
const orders = new Orders(send);
const forms = new ToolForms();
const tools = new Tools({ exercise, orders, forms, notify, changed: () => changed() });
const coast = new Coast(
  (circle) => (exercise.state ? connection.coastline(circle) : null),
  () => chart.changed(),
);
const chart = new Chart($('chart'), exercise, coast, tools);
const trainee = new TraineeView(exercise, () => chart.resize());
const list = new ShipList(exercise, (ship) => showOnChart(ship));
const ships = new ShipsPanel(exercise, orders, { openTrainee: (ship) => trainee.openFor(ship), notify });
const weather = new WeatherPanel(exercise, orders);
const faults = new FaultsPanel(table.faults ?? [], exercise, orders);
const clock = new ExercisePanel(exercise, orders, notify);
const classes = new ClassPanel(exercise, orderClass, notify);
const log = new AuditPanel();
const hosts = new HostsPanel();
const toolbar = new Toolbar({ chart, tools, exercise, changed });
new ChartInput(chart, exercise, tools, orders, (place) => {
  write(
    'pointer',
    place ? `${position(place.latitudeDeg, 'N', 'S', 2)}  ${position(place.longitudeDeg, 'E', 'W', 3)}` : '',
  );
});

// One that is off the chart comes into its middle.
function showOnChart(ship) {
  const { x, y } = chart.view.toPixel(ship);
  if (x < 20 || y < 20 || x > chart.view.width - 20 || y > chart.view.height - 20)
    chart.moveTo((view) => view.centreOn(ship));
}

function show() {
  toolbar.show();
  list.show();
  ships.show();
  weather.show();
  faults.show();
  clock.show();
  classes.show();
  trainee.follow(exercise.chosenOwn[0]);
  chart.changed();
}

function subscribe() {
  exercise.forget();
  coast.forget();
  heardMs = performance.now();
  asked = connection.subscribe(hello.radars[0]?.radar ?? 0, 0, false, token(), {
    ownShipHz: 1,
    noSpokes: true,
    exerciseHz: EXERCISE_HZ,
  });
}

function askToken() {
  if (!$('help').open) $('help').showModal();
  access.want(true);
}

const TAKERS = {
  hello: (message) => {
    hello = message;
    write('scenario', hello.scenario);
    replay.greet(hello.playback);
    if (replay.on) tools.cancel();
    for (const part of document.querySelectorAll('#tab-weather .fields, #fault-table')) part.inert = replay.on;
    trainee.greet(hello.radars);
    log.forget();
    subscribe();
    classes.greet(hello.hasClasses);
    hosts.take(hello.fleet ?? null, hello.radars);
  },
  fleet: (fleet) => hosts.take(fleet, hello.radars),
  exercise: (state) => {
    heardMs = performance.now();
    exercise.take(state, replay.takeExercise(state));
    forms.addClasses(new Set(state.ships.filter((ship) => !ship.own).map((ship) => ship.shipClass)));
    if (!chart.fitted) chart.fitAll();
  },
  world: (world) => {
    exercise.world = world;
    changed();
  },
  playback: (state) => replay.take(state),
  coastline: (coastline) => coast.take(coastline),
  classes: (list) => classes.take(list),
  reply: (reply) => {
    const what = orderedBy.get(reply.request);
    orderedBy.delete(reply.request);
    replay.takeReply(reply);
    if (reply.request === askedClasses) {
      if (reply.code !== 0) classes.refused();
      return;
    }
    if (coast.takeReply(reply)) notify(`No coast: ${reply.text}`);
    else if (reply.code !== 0) {
      const why = reply.text || REPLY_CODES[reply.code] || `code ${reply.code}`;
      notify(
        reply.request === asked
          ? `No exercise: ${why}`
          : `${what ? `${what[0].toUpperCase()}${what.slice(1)}: ` : ''}${why}`,
      );
    }
    if (reply.code !== 0 && /token/.test(reply.text)) askToken();
  },
};

connection = new Connection(location.href, {
  state: (state) => {
    if (state !== 'live') coast.forget();
    changed();
  },
  messages: (messages) => {
    for (const message of messages)
      for (const kind of Object.keys(TAKERS)) if (message[kind]) TAKERS[kind](message[kind]);
  },
  garbage: (error) => notify(`The server sent what is no radar message (${error.kind ?? 'text'})`),
});

function look() {
  showLink(connection.state, (connection.retryAt - performance.now()) / 1000);
  const silent = connection.state === 'live' && performance.now() - heardMs > SILENCE_MS;
  if (connection.state === 'waiting' || connection.state === 'connecting')
    alarm(hello ? 'Connection lost' : 'No connection to the server');
  else if (replay.state && !replay.state.truth) alarm('This recording holds no truth: there are no ships to show');
  else if (silent && replay.on) alarm('No news of the recording');
  else if (silent) alarm(exercise.state ? 'No news of the exercise' : 'This server tells nothing of an exercise');
  else alarm('');
  replay.playback.showPosition();
  document.body.dataset.fresh = String(connection.state === 'live' && exercise.state !== null && !silent);
}
setInterval(look, LOOK_MS);

function changePalette() {
  picture.change({ palette: nextPalette(picture.palette) });
  applyPalette();
}
function applyPalette() {
  showPalette(picture.palette);
  chart.palette = picture.palette;
  chart.changed();
}

function saveScenario() {
  if (!exercise.state || !hello) {
    notify('There is nothing to save yet');
    return;
  }
  const text = scenarioYaml(exercise.state, exercise.world, hello, table.artefacts);
  const link = document.createElement('a');
  link.href = URL.createObjectURL(new Blob([text], { type: 'application/yaml' }));
  const name =
    (hello.scenario || 'exercise')
      .toLowerCase()
      .replace(/[^a-z0-9]+/g, '-')
      .replace(/^-|-$/g, '') || 'exercise';
  link.download = `${name}-${duration(exercise.state.exerciseS).replaceAll(':', '-')}.yaml`;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}

$('palette').addEventListener('click', changePalette);
$('save').addEventListener('click', saveScenario);
$('trainee-toggle').addEventListener('click', () => trainee.toggle());
$('help-open').addEventListener('click', () => $('help').showModal());
const access = new Access($('access'), (isAnew) => {
  connection.tellToken(isAnew);
  log.forget();
  if (!hello || connection.state !== 'live') return;
  subscribe();
  classes.greet(hello.hasClasses);
});

const tool = (name) => () => (replay.on && name !== 'look' ? notify(PLAYED) : tools.take(name));
bindKeys({
  l: tool('look'),
  m: tool('move'),
  n: tool('target'),
  r: tool('route'),
  w: tool('rain'),
  g: () => toolbar.toggleGroup(),
  a: () => chart.fitAll(),
  '+': () => toolbar.zoom(1),
  '=': () => toolbar.zoom(1),
  '-': () => toolbar.zoom(-1),
  f: () => clock.toggleFreeze(),
  k: () => replay.playback.toggle(),
  ',': () => replay.playback.step(-1),
  '.': () => replay.playback.step(1),
  '[': () => replay.toMark(-1),
  ']': () => replay.toMark(1),
  z: () => {
    if (exercise.state?.canUndo) orders.exercise({ undo: true }, 'undo');
  },
  t: () => trainee.toggle(),
  p: changePalette,
  '/': () => {
    toolbar.showTab('ships');
    $('ship-filter').focus();
  },
  1: () => toolbar.showTab('ships'),
  2: () => toolbar.showTab('weather'),
  3: () => toolbar.showTab('faults'),
  4: () => toolbar.showTab('exercise'),
  5: () => toolbar.showTab('log'),
  Escape: () => {
    if (tools.name === 'look') exercise.select(null, false);
    else tools.cancel();
  },
  '?': () => $('help').showModal(),
});

applyPalette();
look();
show();

// window.skerry: what a test may ask of the page.
window.skerry = {
  // What the page shows: whatever waits for the next picture of the screen is shown first.
  state: () => {
    if (shown) show();
    return {
      connection: connection.state,
      garbage: connection.garbage,
      exercise: exercise.state,
      playback: replay.state,
      tracks: [...exercise.tracks.of].map(([key, track]) => ({
        key,
        fromS: track[0]?.s,
        toS: track.at(-1)?.s,
        parts: exercise.tracks.partsOf(key, Infinity).length,
      })),
      world: exercise.world,
      selection: exercise.selection,
      tool: tools.name,
      waypoints: tools.waypoints,
      coast: { ...coast.shown, lines: coast.lines, points: coast.points },
      drawn: chart.drawn,
    };
  },
  view: () => {
    const { latitudeDeg, longitudeDeg, metresPerPixel, width, height } = chart.view;
    return { latitudeDeg, longitudeDeg, metresPerPixel, width, height };
  },
  pixelOf: (latitudeDeg, longitudeDeg) => {
    const { x, y } = chart.view.toPixel({ latitudeDeg, longitudeDeg }),
      box = $('chart').getBoundingClientRect();
    return { x: x + box.x, y: y + box.y };
  },
};
