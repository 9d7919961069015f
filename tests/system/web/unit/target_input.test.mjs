// The pointer over targets, without a browser: which presses are heard, and what becomes of a drag.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { Pace } from '../../../../clients/web/src/picture/pace.js';
import { TargetInput } from '../../../../clients/web/src/targets/target_input.js';

const CENTRE = 200;
// Pixels are metres here, with own ship at CENTRE.
const view = {
  rangeM: 200,
  fromPixel: (x, y) => ({ bearingDeg: (Math.atan2(x - CENTRE, CENTRE - y) * 180 / Math.PI + 360) % 360, rangeM: Math.hypot(x - CENTRE, y - CENTRE),
                          inside: Math.hypot(x - CENTRE, y - CENTRE) <= 200 }),
};

function start(isBusy = false) {
  const handlers = {}, heard = [];
  const ppi = { addEventListener: (type, take) => { handlers[type] = take; }, getBoundingClientRect: () => ({ left: 0, top: 0 }), setPointerCapture() {} };
  const events = Object.fromEntries(['symbol', 'acquire', 'zone', 'draft', 'narrow'].map((name) => [name, (value) => heard.push([name, value])]));
  const input = new TargetInput(ppi, { shown: [{ x: 300, y: CENTRE, key: 't1' }] }, { ...events, isBusy: () => isBusy });
  input.view = view;
  const act = (type, x, y) => {
    let stopped = false;
    handlers[type]({ type, button: 0, pointerId: 1, pointerType: 'mouse', clientX: x, clientY: y, stopImmediatePropagation: () => { stopped = true; } });
    return stopped;
  };
  return { input, act, heard };
}

test('a press on a symbol chooses it, and two elsewhere acquire; not while another part waits for presses', () => {
  const free = start(), busy = start(true);
  assert.equal(free.act('pointerdown', 302, 201), true);
  free.act('pointerup', 302, 201);
  free.act('dblclick', 250, 150);
  assert.deepEqual(free.heard.map(([name]) => name), ['symbol', 'acquire']);
  assert.equal(busy.act('pointerdown', 302, 201), false, 'the other part hears it');
  busy.act('pointerup', 302, 201);
  assert.equal(busy.act('dblclick', 250, 150), false);
  assert.deepEqual(busy.heard, []);
});

test('a drag straight outward is no zone all round', () => {
  const { input, act, heard } = start();
  input.mode = 'zone';
  const drag = (...places) => {
    act('pointerdown', ...places[0]);
    for (const at of places.slice(1)) act('pointermove', ...at);
    act('pointerup', ...places.at(-1));
  };
  drag([200, 150], [200, 100], [200, 60]);
  assert.deepEqual(heard.filter(([name]) => name !== 'draft').map(([name]) => name), ['narrow']);
  drag([200, 150], [250, 120], [320, 200]);
  const [name, zone] = heard.filter(([each]) => each !== 'draft').at(-1);
  assert.equal(name, 'zone');
  assert.deepEqual([zone.fromDeg, zone.toDeg], [0, 90]);
});

test('a picture is due twelve times a second in software, with each frame else, and at once after a hand', () => {
  const hands = { handlers: new Map(), addEventListener(kind, run) { this.handlers.set(kind, run); } };
  const count = (pace) => Array.from({ length: 60 }, (_, i) => pace.isDue((i * 1000) / 60)).filter(Boolean).length;
  assert.equal(count(new Pace(() => true, hands)), 12);
  assert.equal(count(new Pace(() => false, hands)), 60);
  let lost = false;
  const changing = new Pace(() => lost, hands);
  assert.equal(count(changing), 60);
  lost = true;
  assert.deepEqual([changing.isDue(1100), changing.isDue(1117)], [true, false], 'another renderer has come');
  const pace = new Pace(() => true, hands);
  assert.equal(pace.isDue(0), true);
  assert.equal(pace.isDue(10), false);
  hands.handlers.get('pointermove')();
  assert.equal(pace.isDue(20), true);
});
