// The conning page's reckoning, without a browser; its messages, against protobufjs.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { test } from 'node:test';
import { hindrance, holderOf, lockedOrders } from '../../../../clients/web/src/conning/con_holder.js';
import { nextPosition, percentOf, POSITIONS, rpmOf } from '../../../../clients/web/src/conning/engine.js';
import { relativeWind } from '../../../../clients/web/src/conning/relative_wind.js';
import { ShipLink } from '../../../../clients/web/src/conning/ship_link.js';
import { ahead, side } from '../../../../clients/web/src/conning/sides.js';
import { decodeFrames, encodeSet, encodeSubscribe } from '../../../../clients/web/src/messages.js';
import { WireError } from '../../../../clients/web/src/protobuf.js';
import { ClientMessage, ServerMessage, WEB } from '../mock_server.mjs';

const decode = (message) => {
  const out = [];
  decodeFrames(new Uint8Array(ServerMessage.encodeDelimited(ServerMessage.fromObject(message)).finish()), (m) => out.push(m));
  return out[0];
};

test('ConState is read as protobuf wrote it, field by field', () => {
  const ConState = ServerMessage.root.lookupType('skerry.wire.ConState');
  const want = {};
  ConState.fieldsArray.forEach((field, i) => {
    want[field.name] = field.type === 'string' ? `text ${i}` : field.type === 'bool' ? true : field.type === 'double' ? i + 0.5 : (i % 3) + 1;
  });
  want.steering = 2;
  const { ownShip } = decode({ ownShip: { radar: 3, utcNs: 5, courseOverGroundDeg: 12.5, speedOverGroundKn: 3, con: want } });
  assert.deepEqual({ ...ownShip.con }, want);
  assert.equal(ownShip.courseOverGroundDeg, 12.5);
  assert.equal(decode({ ownShip: {} }).ownShip.con, null);
  assert.equal(decode({ hello: { you: 'console 127.0.0.1:9' } }).hello.you, 'console 127.0.0.1:9');
});

test('a number in ConState that is none is refused', () => {
  assert.throws(() => decode({ ownShip: { con: { rudderDeg: NaN } } }), WireError);
  assert.throws(() => decode({ ownShip: { con: { shaftRpm: Infinity } } }), WireError);
});

test('orders and subscriptions are written as protobuf reads them', () => {
  const read = (bytes) => ClientMessage.toObject(ClientMessage.decodeDelimited(bytes));
  const con = { rudderDeg: -35, enginePercent: 0, bowThrusterPercent: 40, sternThrusterPercent: -40, steering: 1, headingDeg: 359.5,
                turnRateDegMin: 20, take: true, release: false };
  const { set } = read(encodeSet(4, 2, 0, { con, instructor: true }));
  assert.deepEqual({ ...set.con }, con);
  assert.equal(set.instructor, true);
  assert.equal(set.radar, 2);
  assert.equal(read(encodeSet(4, 2, 0, { speedKn: 3 })).set.con, undefined);
  const { subscribe } = read(encodeSubscribe(1, 3, 0, false, '', { ownShipHz: 5, noSpokes: true }));
  assert.equal(subscribe.ownShipHz, 5);
  assert.equal(subscribe.noSpokes, true);
  const plain = read(encodeSubscribe(1, 3, 0)).subscribe;
  assert.equal(plain.ownShipHz, undefined);
  assert.equal(plain.noSpokes, undefined);
});

test('who has the con, and why no order is taken', () => {
  const you = 'console 127.0.0.1:5';
  assert.equal(holderOf(null, you), 'none');
  assert.equal(holderOf({ con: '' }, you), 'free');
  assert.equal(holderOf({ con: '' }, ''), 'free');
  assert.equal(holderOf({ con: you }, you), 'ours');
  assert.equal(holderOf({ con: 'console 127.0.0.1:50' }, you), 'theirs');
  assert.equal(holderOf({ con: you }, ''), 'theirs', 'of a server that does not tell us our name');
  const state = { fresh: true, ship: { driven: false }, con: { con: '' }, you, instructor: false, playback: false };
  assert.equal(hindrance(state), '');
  assert.equal(hindrance({ ...state, con: null }), '');
  assert.equal(hindrance({ ...state, con: { con: you } }), '');
  assert.equal(hindrance({ ...state, con: { con: 'console x' } }), 'console x has the con');
  assert.equal(hindrance({ ...state, con: { con: 'console x' }, instructor: true }), '');
  assert.match(hindrance({ ...state, fresh: false, ship: null }), /no data/);
  assert.match(hindrance({ ...state, playback: true, instructor: true }), /recording/);
  assert.match(hindrance({ ...state, ship: { driven: true } }), /simulator/);
  assert.deepEqual(lockedOrders(['gain']), { course: false, speed: false });
  assert.deepEqual(lockedOrders(['course_deg']), { course: true, speed: false });
  assert.deepEqual(lockedOrders(['con']), { course: true, speed: true });
});

test('the wind felt on board is the true one less her way', () => {
  const felt = (fromDeg, kn, headingDeg, aheadKn, starboardKn = 0) =>
    relativeWind({ windFromDeg: fromDeg, windKn: kn, groundAheadKn: aheadKn, groundStarboardKn: starboardKn }, headingDeg);
  const near = (a, b) => assert.ok(Math.abs(a - b) < 1e-9, `${a} is not ${b}`);
  near(felt(40, 10, 40, 12).kn, 22);
  near(felt(40, 10, 40, 12).fromDeg, 0);
  near(felt(220, 10, 40, 10).kn, 0);
  near(felt(0, 0, 123, 15).fromDeg, 0);
  near(felt(100, 10, 10, 10).fromDeg, 45);
  near(felt(280, 10, 10, 10).fromDeg, -45);
  near(felt(0, 0, 0, 0, 5).fromDeg, 90);
  assert.equal(felt(0, 10, NaN, 1), null);
});

test('the telegraph steps from wherever the lever is', () => {
  assert.deepEqual(POSITIONS.map(([percent]) => percent), [100, 75, 50, 25, 0, -25, -50, -75, -100]);
  assert.equal(nextPosition(0, true), 25);
  assert.equal(nextPosition(0, false), -25);
  assert.equal(nextPosition(76, true), 100);
  assert.equal(nextPosition(76, false), 75);
  assert.equal(nextPosition(74.8, false), 50);
  assert.equal(nextPosition(100, true), 100);
  assert.equal(nextPosition(-100, false), -100);
  const con = { fullAheadRpm: 120, fullAsternRpm: 80 };
  assert.equal(rpmOf(50, con), 60);
  assert.equal(rpmOf(-50, con), -40);
  assert.equal(percentOf(-40, con), -50);
  assert.equal(percentOf(60, { fullAheadRpm: 120, fullAsternRpm: -80 }), 50);
  assert.ok(Number.isNaN(percentOf(60, { fullAheadRpm: 0, fullAsternRpm: 0 })));
});

test('a side is told by a letter, and nothing invalid by a number', () => {
  assert.equal(side(12.46, 1), '12.5 S');
  assert.equal(side(-3, 0), '3 P');
  assert.equal(side(-0.04, 1), '0.0');
  assert.equal(side(NaN, 1), '–');
  assert.equal(side(undefined, 1), '–');
  assert.equal(ahead(45.2), '45 % ahead');
  assert.equal(ahead(-0.3), 'Stop');
  assert.equal(ahead(NaN), '–');
});

test('what is out of date is not shown', () => {
  const sent = [];
  const link = new ShipLink((values) => { sent.push(values); return sent.length; }, () => {});
  const con = { con: '', rudderOrderDeg: 4, enginePercent: 50, bowThrusterPercent: 0, sternThrusterPercent: 0 };
  assert.equal(link.view(0).ship, null);
  link.takeHello({ you: 'console a', radars: [{ radar: 2, ownShip: 'A' }, { radar: 3, ownShip: 'A' }, { radar: 4, ownShip: 'B' }] });
  assert.equal(link.radar, 2, 'of an unknown radar the first');
  assert.deepEqual(link.ships(), [{ name: 'A', radar: 2 }, { name: 'B', radar: 4 }]);
  link.isLive = true;
  link.takeOwnShip({ radar: 3, con }, 10);
  assert.equal(link.view(10).ship, null, 'of another radar');
  link.takeOwnShip({ radar: 2, con }, 10);
  assert.equal(link.view(11.4).orders.rudderDeg.value, 4);
  assert.equal(link.view(11.6).fresh, false);
  assert.equal(link.view(11.6).ship, null);
  assert.ok(Number.isNaN(link.view(11.6).orders.rudderDeg.value));
  link.isLive = false;
  assert.equal(link.view(10.1).fresh, false);
  link.forget();
  assert.equal(link.isFresh(10.1), false);
});

test('every module of the page has one idea: under 400 lines', () => {
  for (const name of readFileSync(`${WEB}files.txt`, 'utf8').split('\n').filter((n) => n.startsWith('src/conning/'))) {
    assert.ok(readFileSync(WEB + name, 'utf8').split('\n').length < 400, name);
  }
});
