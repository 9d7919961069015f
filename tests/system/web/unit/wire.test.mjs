// The console's reader and writer of the native protocol, against protobufjs and against nonsense.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import protobuf from 'protobufjs';
import { decodeFrames, encodeClassOrder, encodePlayback, encodeRecord, encodeSet, encodeSignIn, encodeSubscribe, MAX_FRAME, useControls } from '../../../../clients/web/src/messages.js';
import { WireError } from '../../../../clients/web/src/protobuf.js';
import { ClientMessage, CONTROLS, ServerMessage } from '../mock_server.mjs';
import { random } from '../random.mjs';

const frame = (message) => ServerMessage.encodeDelimited(ServerMessage.fromObject(message)).finish();
const decode = (bytes) => {
  const out = [];
  decodeFrames(new Uint8Array(bytes), (m) => out.push(m));
  return out;
};
const spoke = (values = {}) => ({
  radar: 1, view: 0, sequence: 70000000000, scan: 12, index: 4095, spokesPerTurn: 4096, rangeScale: 6, bits: 8,
  cellCount: 5, cellSizeM: 10.8515625, heading: 0xfffffffe, latitudeDeg: -60.25, longitudeDeg: 5.5,
  utcNs: protobuf.util.Long.fromString('1700000000123456789'), scenarioNs: 5, cells: Uint8Array.of(0, 1, 2, 254, 255), ...values,
});
const refused = (bytes, kind) => assert.throws(() => decode(bytes), (error) => error instanceof WireError && (!kind || error.kind === kind));

useControls(CONTROLS);

test('a spoke is read as protobuf wrote it', () => {
  const [{ spoke: got }] = decode(frame({ spoke: spoke() }));
  assert.equal(got.sequence, 70000000000);
  assert.equal(got.heading, 0xfffffffe);
  assert.equal(got.cellSizeM, 10.8515625);
  assert.equal(got.latitudeDeg, -60.25);
  assert.ok(Math.abs(got.utcNs - 1700000000123456789) <= 512);
  assert.deepEqual([...got.cells], [0, 1, 2, 254, 255]);
  assert.equal(got.view, 0);
});

test('who one is goes in a message', () => {
  const message = ClientMessage.decodeDelimited(encodeSignIn(7, 'skerry_Ab-_'));
  assert.equal(message.request, 7);
  assert.equal(message.kind, 'signIn');
  assert.equal(message.signIn.token, 'skerry_Ab-_');
});

test('class codes are ordered and told', () => {
  const order = (...args) => ClientMessage.toObject(ClientMessage.decodeDelimited(encodeClassOrder(...args)));
  assert.deepEqual(order(7, { make: { ship: 'Frida', minutes: 90 } }, 'skerry_x'), { request: 7, classOrder: { make: { ship: 'Frida', minutes: 90 }, token: 'skerry_x' } });
  assert.deepEqual(order(8, { end: 'Frida' }), { request: 8, classOrder: { end: 'Frida' } });
  assert.deepEqual(order(9, {}), { request: 9, classOrder: {} });
  const code = { ship: 'Frida', code: '012345', trainees: ['Kim', 'Lea'], wrong: 3, wrongMost: 20 };
  const [{ classes }] = decode(frame({ classes: { codes: [{ ...code, endsUtcNs: 1700000000123456789n }] } }));
  const { endsUtcNs, ...rest } = { ...classes.codes[0] };
  assert.deepEqual(rest, code);
  assert.ok(Math.abs(endsUtcNs - 1700000000123456789) <= 512);
});

test('any number of frames in one message come in order', () => {
  const bytes = Buffer.concat([frame({ hello: { protocolVersion: 1, server: 'skerryd ü', radars: [{ radar: 3, name: 'S' }], rangeScalesNm: [0.125, 6] } }),
    frame({ settings: { rangeNm: 6, gain: 55.5 } }), frame({ ownShip: { name: 'Fulmar', rateOfTurnDegMin: -12 } }),
    frame({ reply: { request: 9, code: 2, text: 'gain 101: 0 .. 100', view: 0 } }), frame({ spoke: spoke() })]);
  const [hello, settings, ship, reply, last] = decode(bytes);
  assert.deepEqual(hello.hello.rangeScalesNm, [0.125, 6]);
  assert.equal(hello.hello.server, 'skerryd ü');
  assert.equal(hello.hello.radars[0].radar, 3);
  assert.equal(settings.settings.gain, 55.5);
  assert.equal(ship.ownShip.rateOfTurnDegMin, -12);
  assert.deepEqual({ ...reply.reply }, { request: 9, code: 2, text: 'gain 101: 0 .. 100', view: 0 });
  assert.equal(last.spoke.index, 4095);
});

test('random spokes are read as protobuf wrote them', () => {
  const r = random(1);
  for (let i = 0; i < 500; ++i) {
    const bits = r() < 0.5 ? 4 : 8, cellCount = 1 + r.below(400), spokesPerTurn = 1 + r.below(8192);
    const want = spoke({ bits, cellCount, spokesPerTurn, index: r.below(spokesPerTurn), sequence: Math.floor(r() * 2 ** 53),
      heading: r.below(2 ** 32), scan: r.below(2 ** 32), cells: r.bytes(bits === 8 ? cellCount : (cellCount + 1) >> 1) });
    const [{ spoke: got }] = decode(frame({ spoke: want }));
    for (const name of ['sequence', 'heading', 'scan', 'index', 'spokesPerTurn', 'bits']) assert.equal(got[name], want[name], name);
    assert.deepEqual(Buffer.from(got.cells), Buffer.from(want.cells));
  }
});

test('unknown fields of every wire type are passed over', () => {
  const body = ServerMessage.encode(ServerMessage.fromObject({ settings: { gain: 7 } })).finish();
  const writer = protobuf.Writer.create();
  writer.uint32((900 << 3) | 0).uint64(protobuf.util.Long.MAX_UNSIGNED_VALUE);
  writer.uint32((901 << 3) | 1).double(3);
  writer.uint32((902 << 3) | 2).string('new');
  writer.uint32((903 << 3) | 3).uint32((1 << 3) | 0).uint32(5).uint32((903 << 3) | 4);
  writer.uint32((904 << 3) | 5).fixed32(8);
  const all = Buffer.concat([writer.finish(), body, writer.finish()]);
  const [got] = decode(Buffer.concat([protobuf.Writer.create().uint32(all.length).finish(), all]));
  assert.equal(got.settings.gain, 7);
});

test('a known field of another wire type is passed over', () => {
  const inner = protobuf.Writer.create().uint32((4 << 3) | 2).string('gain').uint32((5 << 3) | 1).double(9).finish();
  const body = protobuf.Writer.create().uint32((5 << 3) | 2).bytes(inner).finish();
  const [got] = decode(Buffer.concat([protobuf.Writer.create().uint32(body.length).finish(), body]));
  assert.equal(got.settings.gain, 0);
  assert.equal(got.settings.sea, 9);
});

test('lengths that lie are refused', () => {
  const whole = frame({ spoke: spoke() });
  for (let cut = 1; cut < whole.length; ++cut) refused(whole.subarray(0, cut), 'truncated');
  refused(Uint8Array.of(0xff, 0xff, 0xff, 0xff, 0x0f), 'truncated');
  refused(Uint8Array.of(0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0x01));
  const big = Buffer.alloc(MAX_FRAME + 10);
  const head = protobuf.Writer.create().uint32(MAX_FRAME + 1).finish();
  Buffer.from(head).copy(big);
  refused(big.subarray(0, head.length + MAX_FRAME + 1), 'oversized');
  refused(Uint8Array.of(4, 0x0a, 0x7f, 1, 2), 'truncated');  // an inner length beyond its message
});

test('spokes that cannot be are refused', () => {
  for (const bad of [{ bits: 16 }, { bits: 0 }, { cellCount: 6 }, { cellCount: 0, cells: [] }, { index: 4096 }, { spokesPerTurn: 0 },
    { spokesPerTurn: 9000 }, { cellSizeM: 0 }, { cellSizeM: -1 }, { cellSizeM: NaN }, { cellSizeM: Infinity }, { latitudeDeg: NaN },
    { cellCount: 5000, cells: new Uint8Array(5000) }]) {
    refused(frame({ spoke: spoke(bad) }), 'out_of_range');
  }
  refused(frame({ settings: { gain: NaN } }), 'out_of_range');
  refused(frame({ hello: { rangeScalesNm: [0] } }), 'out_of_range');
});

test('random bytes and damaged messages never do more than raise WireError', () => {
  const r = random(2);
  const good = Buffer.concat([frame({ hello: { server: 's', radars: [{ name: 'x' }], rangeScalesNm: [1, 2] } }), frame({ spoke: spoke() }), frame({ ownShip: { name: 'n' } })]);
  let whole = 0, bad = 0;
  for (let i = 0; i < 60000; ++i) {
    let bytes;
    if (i % 2 === 0) {
      bytes = r.bytes(r.below(64));
    } else {
      bytes = Uint8Array.from(good);
      for (let k = 1 + r.below(4); k > 0; --k) bytes[r.below(bytes.length)] = r.below(256);
    }
    try {
      whole += decode(bytes).length;
    } catch (error) {
      assert.ok(error instanceof WireError, String(error.stack));
      bad += 1;
    }
  }
  assert.ok(whole > 1000 && bad > 1000, `${whole} read, ${bad} refused`);
});

test('what the console sends is what protobuf reads', () => {
  const subscribe = ClientMessage.decodeDelimited(encodeSubscribe(300, 2, 1));
  assert.deepEqual(subscribe.toJSON(), { request: 300, subscribe: { radar: 2, view: 1 } });
  const set = ClientMessage.decodeDelimited(encodeSet(4294967295, 1, 0, { gain: 0, rangeNm: 0.125, courseDeg: 359.5 }, 'geheim'));
  assert.equal(set.request, 4294967295);
  assert.deepEqual(set.set.toJSON(), { radar: 1, courseDeg: 359.5, rangeNm: 0.125, gain: 0, token: 'geheim' });
  assert.equal(set.set._speedKn, undefined);
});

test('controls, views and the world are written as the schema reads them', () => {
  const own = ClientMessage.decodeDelimited(encodeSubscribe(7, 1, 3, true, 'geheim')).subscribe;
  assert.deepEqual([own.radar, own.view, own.newView, own.token], [1, 3, true, 'geheim']);
  const { set } = ClientMessage.decodeDelimited(encodeSet(8, 0, 2, {
    seaAuto: true, transmit: false, pulse: 0, decimation: 1, tune: 0,
    world: { seaState: 0, ducting: 0.5, sideLobes: false, removeRain: [3, 300],
      rain: [{ id: 0, latitudeDeg: 60.4, longitudeDeg: -5.1, rateMmH: 16, kind: 3 }, { id: 2, driftKn: 0 }] },
  }));
  assert.deepEqual([set.view, set.seaAuto, set.transmit, set.pulse, set.decimation, set.tune], [2, true, false, 0, 1, 0]);
  for (const name of ['_transmit', '_pulse', '_tune']) assert.ok(set[name], `${name} is present though zero`);
  assert.equal(set._gain, undefined);
  const { world } = set;
  assert.deepEqual([world.seaState, world.ducting, world.sideLobes, [...world.removeRain]], [0, 0.5, false, [3, 300]]);
  assert.ok(world._seaState && world._sideLobes && !world._windFromDeg && !world._interference);
  const [shower] = world.rain;
  assert.deepEqual([shower.id, shower.latitudeDeg, shower.longitudeDeg, shower.rateMmH, shower.kind],
    [0, 60.4, -5.1, 16, 3]);
  assert.ok(world.rain[1]._driftKn && !world.rain[1]._rateMmH);
});

test('the controls of displays and the instructor are written and read as the schema has them', () => {
  const { set } = ClientMessage.decodeDelimited(encodeSet(9, 1, 0, {
    gainAuto: true, sideLobeSuppression: 10, sideLobeAuto: false, noiseRejection: 20, targetSeparation: 30, targetBoost: 40,
    doppler: 2, dopplerThresholdMps: 1.5, mode: 5, instrumentedRangeM: 12000, rotationRpm: 48, bearingAlignmentDeg: -3,
    antennaHeightM: 31, blankedSectors: [{ fromDeg: 350, toDeg: 10 }, { fromDeg: 1, toDeg: 5 }], instructor: true,
    lock: ['gain', 'world'], unlock: ['sea'],
  }));
  const got = set.toJSON();
  assert.deepEqual(got, {
    radar: 1, gainAuto: true, sideLobeSuppression: 10, sideLobeAuto: false, noiseRejection: 20, targetSeparation: 30, targetBoost: 40,
    doppler: 'DOPPLER_APPROACHING', dopplerThresholdMps: 1.5, mode: 'BIRD', instrumentedRangeM: 12000, rotationRpm: 48,
    bearingAlignmentDeg: -3, antennaHeightM: 31, blankedSectors: { sectors: [{ fromDeg: 350, toDeg: 10 }, { fromDeg: 1, toDeg: 5 }] },
    instructor: true, lock: ['gain', 'world'], unlock: ['sea'],
  });
  const none = ClientMessage.decodeDelimited(encodeSet(10, 1, 0, { blankedSectors: [] })).set;
  assert.ok(none.blankedSectors && none.blankedSectors.sectors.length === 0, 'present, though none');

  const [{ settings }] = decode(frame({ settings: { mode: 3, doppler: 1, locked: ['gain', 'world'],
    blankedSectors: { sectors: [{ fromDeg: 1, toDeg: 2 }] }, rotationRpm: 36 } }));
  assert.deepEqual([settings.mode, settings.doppler, settings.rotationRpm, settings.locked], [3, 1, 36, ['gain', 'world']]);
  assert.equal(settings.blankedSectors.sectors[0].toDeg, 2);
  refused(frame({ settings: { blankedSectors: { sectors: [{ fromDeg: NaN }] } } }), 'out_of_range');
});

test('Doppler classes are of all cells or of none', () => {
  const of = (length) => frame({ spoke: spoke({ doppler: new Uint8Array(length) }) });  // of five cells
  assert.equal(decode(of(2))[0].spoke.doppler.length, 2);
  assert.equal(decode(of(0))[0].spoke.doppler.length, 0);
  for (const length of [1, 3]) refused(of(length), 'out_of_range');
});

test('settings of a server that knows fewer controls are no standby', () => {
  const [message] = decode(frame({ settings: { gain: 7 } }));
  assert.equal(message.settings.standby, false);
  assert.equal(message.settings.seaAuto, false);
});

test('a world is read whole, and refused with a number that is none', () => {
  const rain = [{ id: 4, rateMmH: 8, kind: 2 }];
  const [{ world }] = decode(frame({ world: { seaState: 3.5, sideLobes: true, rain } }));
  const [cell] = world.rain;
  assert.deepEqual([world.seaState, world.sideLobes, world.interference, cell.id, cell.rateMmH, cell.kind],
    [3.5, true, false, 4, 8, 2]);
  refused(frame({ world: { rain: [{ id: 1, radiusNm: NaN }] } }), 'out_of_range');
});

test('what is asked of recorder and playback is what protobuf reads', () => {
  const record = (values, token) => ClientMessage.decodeDelimited(encodeRecord(7, values, token));
  assert.equal(record({ action: 0 }).request, 7);
  assert.equal(record({ action: 0 }).kind, 'record');
  assert.deepEqual({ ...record({ action: 2, name: 'man overboard ü' }, 'secret').record }, { action: 2, name: 'man overboard ü', radars: [], token: 'secret' });
  const playback = (values, token) => ClientMessage.decodeDelimited(encodePlayback(8, values, token)).playback;
  assert.deepEqual({ ...playback({}) }, {});
  for (const turns of [-1000, -1, 0, 1, 1000]) assert.equal(playback({ stepTurns: turns }).stepTurns, turns);
  assert.deepEqual({ ...playback({ playing: false, positionS: 12.25, rate: 0.1, loop: true }, 't') },
    { playing: false, positionS: 12.25, rate: 0.1, loop: true, token: 't' });
});

test('states of recorder and playback are read as protobuf wrote them', () => {
  const recorder = { phase: 2, file: 'a.mcap', folder: '/var', fileBytes: 5e12, totalBytes: 6e12, seconds: 1.5, bytesPerSecond: 2e6,
    freeBytes: 7, spokes: 8, spokesLost: 9, marks: 10, problem: 'full', inputsOnly: true, allViews: true };
  const playback = { file: 'b.mcap', beginUtcNs: protobuf.util.Long.fromString('1790000000000000000'), lengthS: 60, positionS: 12.5, playing: true, rate: 10,
    loop: true, marks: [{ positionS: 3, name: 'first' }, { positionS: 4, name: '' }], currentTimestamps: true, problem: 'byte 7',
    truth: true, lastBy: 'console a', orders: 3 };
  const [first, second] = decode(Buffer.concat([frame({ recorder }), frame({ playback })]));
  assert.deepEqual({ ...first.recorder }, recorder);
  assert.deepEqual({ ...second.playback, beginUtcNs: null, marks: second.playback.marks.map((m) => ({ ...m })) }, { ...playback, beginUtcNs: null });
  assert.ok(Math.abs(second.playback.beginUtcNs - 1.79e18) <= 512);
  refused(frame({ playback: { lengthS: NaN } }), 'out_of_range');
  refused(frame({ playback: { marks: [{ positionS: Infinity }] } }), 'out_of_range');
});
