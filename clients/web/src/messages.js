// The messages of protocol/wire/radar.proto that a console reads and writes, and their frames: each
// message after its length as a varint, any number of them in one WebSocket message.
import { ChartObjects, encodeChartRequest, partsOfChart } from './chart/chart_wire.js';
import { ClassList, encodeClassOrderBody } from './exercise/class_wire.js';
import { Coastline, encodeCoastRequest, encodeOrder, exerciseState } from './exercise/wire.js';
import { message, Reader, WireError, Writer } from './protobuf.js';
import { checkTargets, encodeTargetOrderBody, TargetList } from './targets/wire.js';

// Longest body of one frame, as the server has it (kMaxServerFrame).
export const MAX_FRAME = 1 << 20;
export const MAX_SPOKES = 8192, MAX_CELLS = 4096;
export const REPLY_CODES = ['OK', 'MALFORMED', 'OUT_OF_RANGE', 'UNKNOWN', 'REFUSED'];
export const REFUSED = 4;

const Spoke = message({
  1: ['radar', 'uint32'], 2: ['view', 'uint32'], 3: ['sequence', 'uint64'], 4: ['scan', 'uint32'],
  5: ['index', 'uint32'], 6: ['spokesPerTurn', 'uint32'], 7: ['rangeScale', 'uint32'],
  8: ['bits', 'uint32'], 9: ['cellCount', 'uint32'], 10: ['cellSizeM', 'double'],
  11: ['heading', 'fixed32'], 12: ['latitudeDeg', 'double'], 13: ['longitudeDeg', 'double'],
  14: ['utcNs', 'fixed64'], 15: ['scenarioNs', 'fixed64'], 16: ['cells', 'bytes'],
  17: ['doppler', 'bytes'],
});
const RadarInfo = message({
  1: ['radar', 'uint32'], 2: ['name', 'string'], 3: ['ownShip', 'string'],
  4: ['spokesPerTurn', 'uint32'], 5: ['cells', 'uint32'], 6: ['bits', 'uint32'],
  7: ['rpm', 'double'], 8: ['beamWidthDeg', 'double'], 9: ['set', 'string'], 10: ['band', 'string'],
  11: ['antennaHeightM', 'double'],
});
const FleetHost = message({
  1: ['name', 'string'], 2: ['native', 'string'], 3: ['web', 'string'], 4: ['radars', ['uint32']], 5: ['heardS', 'double'], 6: ['standing', 'string'],
  7: ['tick', 'uint64'], 8: ['digest', 'string'],
});
const Fleet = message({
  1: ['exercise', 'string'], 2: ['host', 'string'], 3: ['leader', 'string'], 4: ['standing', 'string'], 5: ['refusal', 'string'],
  6: ['hosts', [FleetHost]], 7: ['problem', 'string'],
});
const Hello = message({
  1: ['protocolVersion', 'uint32'], 2: ['server', 'string'], 3: ['scenario', 'string'],
  4: ['radars', [RadarInfo]], 5: ['rangeScalesNm', ['double']],
  6: ['canRecord', 'bool'], 7: ['playback', 'bool'], 8: ['you', 'string'], 9: ['hasChart', 'bool'], 10: ['hasClasses', 'bool'],
  11: ['warning', 'string'], 14: ['fleet', Fleet],
});
const Reply = message({
  1: ['request', 'uint32'], 2: ['code', 'uint32'], 3: ['text', 'string'], 4: ['view', 'uint32'],
});
const Sector = message({ 1: ['fromDeg', 'double'], 2: ['toDeg', 'double'] });
const BlankedSectors = message({ 1: ['sectors', [Sector]] });
// The fields of Settings that are no controls; the controls come with the table.
const SETTINGS_FIELDS = {
  1: ['radar', 'uint32'], 2: ['view', 'uint32'], 11: ['standby', 'bool'], 15: ['pulseLengthUs', 'double'], 16: ['prfHz', 'double'],
  17: ['radarRangeNm', 'double'], 34: ['locked', ['string']],
};
const RainCell = message({
  1: ['id', 'uint32'], 2: ['latitudeDeg', 'double'], 3: ['longitudeDeg', 'double'], 4: ['radiusNm', 'double'],
  5: ['rateMmH', 'double'], 6: ['driftDeg', 'double'], 7: ['driftKn', 'double'], 8: ['kind', 'uint32'],
});
const WORLD_FIELDS = {
  1: ['scenarioS', 'double'], 2: ['seaState', 'double'], 3: ['windFromDeg', 'double'],
  4: ['swellHeightM', 'double'], 5: ['swellPeriodS', 'double'], 6: ['swellFromDeg', 'double'],
  7: ['waveHeightM', 'double'], 8: ['kFactor', 'double'], 9: ['ducting', 'double'], 10: ['rain', [RainCell]],
  22: ['windKn', 'double?'], 23: ['currentSetDeg', 'double'], 24: ['currentKn', 'double'], 25: ['depthM', 'double'],
  26: ['exerciseS', 'double'], 27: ['frozen', 'bool'], 28: ['rate', 'double'],
  29: ['visibilityNm', 'double?'],
};
const ConState = message({
  1: ['shipClass', 'string'], 2: ['steering', 'uint32'], 3: ['rudderDeg', 'double'], 4: ['rudderOrderDeg', 'double'],
  5: ['enginePercent', 'double'], 6: ['keepsSpeed', 'bool'], 7: ['shaftRpm', 'double'], 8: ['bowThrusterPercent', 'double'],
  9: ['sternThrusterPercent', 'double'], 10: ['headingOrderDeg', 'double'], 11: ['waterAheadKn', 'double'],
  12: ['waterStarboardKn', 'double'], 13: ['groundAheadKn', 'double'], 14: ['groundStarboardKn', 'double'],
  15: ['rollDeg', 'double'], 16: ['depthBelowKeelM', 'double'], 17: ['draughtM', 'double'], 18: ['windFromDeg', 'double'],
  19: ['windKn', 'double'], 20: ['currentSetDeg', 'double'], 21: ['currentKn', 'double'], 22: ['turnRateDegMin', 'double'],
  23: ['con', 'string'], 24: ['hasBowThruster', 'bool'], 25: ['hasSternThruster', 'bool'], 26: ['fullAheadRpm', 'double'],
  27: ['fullAsternRpm', 'double'], 28: ['serviceSpeedKn', 'double'], 29: ['rudderLimitDeg', 'double'],
  30: ['waypoint', 'uint32'], 31: ['waypoints', 'uint32'], 32: ['waypointM', 'double'], 33: ['crossTrackM', 'double'],
});
// Steering of the schema.
export const HAND = 0, HEADING = 1, TRACK = 2;
const OwnShip = message({
  1: ['radar', 'uint32'], 2: ['name', 'string'], 3: ['latitudeDeg', 'double'],
  4: ['longitudeDeg', 'double'], 5: ['headingDeg', 'double'], 6: ['speedKn', 'double'],
  7: ['rateOfTurnDegMin', 'double'], 8: ['orderedCourseDeg', 'double'], 9: ['orderedSpeedKn', 'double'],
  10: ['courseOverGroundDeg', 'double'], 11: ['speedOverGroundKn', 'double'], 12: ['utcNs', 'fixed64'],
  13: ['lengthM', 'double'], 14: ['beamM', 'double'], 15: ['mmsi', 'uint32'],
  16: ['driven', 'bool'], 17: ['noPosition', 'bool'], 18: ['noMotion', 'bool'], 19: ['noHeading', 'bool'],
  20: ['con', ConState], 21: ['noLog', 'bool'], 22: ['noWind', 'bool'], 23: ['text', 'string'], 24: ['texts', 'uint64'], 25: ['noAis', 'bool'],
});
const RecorderState = message({
  1: ['phase', 'uint32'], 2: ['file', 'string'], 3: ['folder', 'string'], 4: ['fileBytes', 'uint64'], 5: ['totalBytes', 'uint64'],
  6: ['seconds', 'double'], 7: ['bytesPerSecond', 'double'], 8: ['freeBytes', 'uint64'], 9: ['spokes', 'uint64'],
  10: ['spokesLost', 'uint64'], 11: ['marks', 'uint32'], 12: ['problem', 'string'], 13: ['inputsOnly', 'bool'], 14: ['allViews', 'bool'],
});
const PlaybackMark = message({ 1: ['positionS', 'double'], 2: ['name', 'string'] });
const PlaybackState = message({
  1: ['file', 'string'], 2: ['beginUtcNs', 'fixed64'], 3: ['lengthS', 'double'], 4: ['positionS', 'double'],
  5: ['playing', 'bool'], 6: ['rate', 'double'], 7: ['loop', 'bool'], 8: ['marks', [PlaybackMark]],
  9: ['currentTimestamps', 'bool'], 10: ['problem', 'string'],
  11: ['truth', 'bool'], 12: ['lastBy', 'string'], 13: ['orders', 'uint64'],
});
let ServerMessage, setFields, worldFields, faultTable;

// The fields of one schema of the table.  `read` is for message(): a control without a field of its own is in a
// message `more`.  `own` and `added` are for writing.
function fieldsOf(table, more, moreFields) {
  const READ = { number: 'double', switch: 'bool', choice: 'uint32', message: BlankedSectors };
  const WRITE = { number: 'double', switch: 'uint32', choice: 'uint32' };
  const read = {}, inner = {}, own = {}, added = {};
  for (const { name, number, type, set, settings } of table) {
    if (settings === undefined) inner[number] = [name, READ[type]];
    else read[settings] = [name, READ[type]];
    if (type !== 'message') (set === undefined ? added : own)[name] = [set ?? number, WRITE[type]];
  }
  if (Object.keys(inner).length > 0) read[moreFields.read] = [more, message(inner)];
  return { read, own, added, more, at: moreFields.write };
}

// table: /controls.json.  Before it is known, messages have no controls.
export function useControls({ controls, artefacts, faults = [] }) {
  const ofSet = fieldsOf(controls, 'controls', { read: 35, write: 38 });
  const ofWorld = fieldsOf(artefacts, 'artefacts', { read: 21, write: 22 });
  ServerMessage = message({
    1: ['spoke', Spoke], 2: ['hello', Hello], 4: ['reply', Reply], 5: ['settings', message({ ...ofSet.read, ...SETTINGS_FIELDS })],
    6: ['ownShip', OwnShip], 7: ['world', message({ ...ofWorld.read, ...WORLD_FIELDS })],
    10: ['recorder', RecorderState], 11: ['playback', PlaybackState],
    12: ['exercise', exerciseState(faults)], 13: ['coastline', Coastline], 14: ['targets', TargetList], 15: ['chartObjects', ChartObjects],
    16: ['classes', ClassList], 19: ['fleet', Fleet],
  });
  faultTable = faults;
  setFields = ofSet;
  worldFields = ofWorld;
}
useControls({ controls: [], artefacts: [] });

// Calls take(serverMessage) for every frame of one WebSocket message. What is whole before an error
// has been taken. Error: WireError.
export function decodeFrames(bytes, take) {
  const reader = new Reader(bytes);
  while (!reader.done()) {
    const at = reader.at;
    const end = reader.limit();
    if (end - reader.at > MAX_FRAME) {
      throw new WireError('oversized', at, `a frame of ${end - reader.at} bytes, at most ${MAX_FRAME}`);
    }
    const decoded = ServerMessage.decode(new Reader(bytes, reader.at, end));
    Object.assign(decoded.settings ?? {}, decoded.settings?.controls);
    Object.assign(decoded.world ?? {}, decoded.world?.artefacts);
    if (decoded.spoke) checkSpoke(decoded.spoke, at);
    for (const part of [decoded.settings, decoded.ownShip, decoded.ownShip?.con, decoded.world, decoded.recorder, decoded.playback,
                        ...(decoded.playback?.marks ?? []),
                        ...(decoded.world?.rain ?? []), ...(decoded.hello?.radars ?? []),
                        ...(decoded.settings?.blankedSectors?.sectors ?? []), ...partsOf(decoded.exercise), decoded.coastline, ...partsOfChart(decoded.chartObjects)]) {
      if (part) checkFinite(part, at);
    }
    if (decoded.hello) checkHello(decoded.hello, at);
    if (decoded.targets) checkTargets(decoded.targets, at);
    reader.at = end;
    take(decoded);
  }
}

function partsOf(exercise) {
  if (!exercise) return [];
  const { ships, marks, playedMarks } = exercise;
  return [exercise, ...ships, ...marks, ...playedMarks, ...ships.flatMap((ship) => [ship.faults, ...ship.route])];
}

function checkHello(hello, at) {
  for (const nm of hello.rangeScalesNm) {
    if (!(nm > 0 && nm <= 1000)) throw new WireError('out_of_range', at, `range scale ${nm} NM`);
  }
}

function checkFinite(part, at) {
  for (const [name, value] of Object.entries(part)) {
    if (typeof value === 'number' && !Number.isFinite(value)) {
      throw new WireError('out_of_range', at, `${name} ${value}`);
    }
  }
}

function checkSpoke(s, at) {
  checkFinite(s, at);
  const bad = (text) => { throw new WireError('out_of_range', at, `spoke: ${text}`); };
  if (s.spokesPerTurn < 1 || s.spokesPerTurn > MAX_SPOKES) bad(`${s.spokesPerTurn} spokes per turn`);
  if (s.index >= s.spokesPerTurn) bad(`index ${s.index} of ${s.spokesPerTurn}`);
  if (s.bits !== 4 && s.bits !== 8) bad(`${s.bits} bits per cell`);
  if (s.cellCount < 1 || s.cellCount > MAX_CELLS) bad(`${s.cellCount} cells`);
  if (!(s.cellSizeM > 0 && s.cellSizeM <= 10000)) bad(`cells of ${s.cellSizeM} m`);
  const length = s.bits === 8 ? s.cellCount : (s.cellCount + 1) >> 1;
  if (s.cells.length !== length) bad(`${s.cells.length} bytes for ${s.cellCount} cells of ${s.bits} bits`);
  if (s.doppler.length !== 0 && s.doppler.length !== (s.cellCount + 3) >> 2) {
    bad(`${s.doppler.length} bytes of doppler for ${s.cellCount} cells`);
  }
}

function frame(request, field, body) {
  const inner = new Writer().uint32(1, request).bytes(field, body).finish();
  const length = new Writer().varint(inner.length).finish();
  const out = new Uint8Array(length.length + inner.length);
  out.set(length);
  out.set(inner, length.length);
  return out;
}

// newView: a view of this console's own, with the settings of `view`.  ownShipHz, exerciseHz, targetsHz: OwnShip,
// ExerciseState and TargetList messages a second.
export function encodeSubscribe(request, radar, view, newView = false, token = '', { ownShipHz = 0, noSpokes = false, exerciseHz = 0, targetsHz = 0 } = {}) {
  const writer = new Writer().uint32(1, radar).uint32(2, view);
  if (newView) writer.uint32(3, 1);
  if ((newView || exerciseHz > 0) && token) writer.string(4, token);
  if (ownShipHz > 0) writer.uint32(5, ownShipHz);
  if (noSpokes) writer.uint32(6, 1);
  if (exerciseHz > 0) writer.uint32(7, exerciseHz);
  if (targetsHz > 0) writer.uint32(8, targetsHz);
  return frame(request, 2, writer.finish());
}

// Name: field number and how it is written; bool and enum go as uint32.
const ORDER_FIELDS = { courseDeg: [3, 'double'], speedKn: [4, 'double'], instructor: [37, 'uint32'] };
const CON_FIELDS = {
  rudderDeg: [1, 'double'], enginePercent: [2, 'double'], bowThrusterPercent: [3, 'double'], sternThrusterPercent: [4, 'double'],
  steering: [5, 'uint32'], headingDeg: [6, 'double'], turnRateDegMin: [7, 'double'], take: [8, 'uint32'], release: [9, 'uint32'],
};
const CHANGE_FIELDS = {
  seaState: [1, 'double'], windFromDeg: [2, 'double'], swellHeightM: [3, 'double'], swellPeriodS: [4, 'double'],
  swellFromDeg: [5, 'double'], waveHeightM: [6, 'double'], kFactor: [7, 'double'], ducting: [8, 'double'],
  removeAllRain: [11, 'uint32'], windKn: [23, 'double'], currentSetDeg: [24, 'double'], currentKn: [25, 'double'], depthM: [26, 'double'],
  visibilityNm: [27, 'double'],
};
const RAIN_FIELDS = {
  id: [1, 'uint32'], latitudeDeg: [2, 'double'], longitudeDeg: [3, 'double'], radiusNm: [4, 'double'],
  rateMmH: [5, 'double'], driftDeg: [6, 'double'], driftKn: [7, 'double'], kind: [8, 'uint32'],
};

function write(writer, fields, values) {
  for (const [name, [field, type]] of Object.entries(fields)) {
    if (values[name] !== undefined) writer[type](field, Number(values[name]));
  }
  return writer;
}

// The fields of a table: its own, and a message of the others if there are any.
function writeTable(writer, { own, added, at }, values) {
  write(writer, own, values);
  if (Object.keys(added).some((name) => values[name] !== undefined)) {
    writer.bytes(at, write(new Writer(), added, values).finish());
  }
  return writer;
}

function encodeWorld(world) {
  const writer = writeTable(write(new Writer(), CHANGE_FIELDS, world), worldFields, world);
  for (const cell of world.rain ?? []) writer.bytes(9, write(new Writer(), RAIN_FIELDS, cell).finish());
  for (const id of world.removeRain ?? []) writer.uint32(10, id);
  return writer.finish();
}

function encodeSectors(sectors) {
  const writer = new Writer();
  for (const { fromDeg, toDeg } of sectors) writer.bytes(1, new Writer().double(1, fromDeg).double(2, toDeg).finish());
  return writer.finish();
}

// values: orders above, con (names of CON_FIELDS), controls of the table, blankedSectors ([{ fromDeg, toDeg }]), lock and unlock (names of
// fields of Set), and world: any of its names and artefacts of the table, rain (cells; id 0 is a new one) and
// removeRain (ids), and exercise (exercise/wire.js); what is absent stays as it is.
export function encodeSet(request, radar, view, values, token = '') {
  const writer = writeTable(write(new Writer().uint32(1, radar).uint32(2, view), ORDER_FIELDS, values), setFields, values);
  if (token) writer.string(9, token);
  if (values.blankedSectors) writer.bytes(33, encodeSectors(values.blankedSectors));
  for (const name of values.lock ?? []) writer.string(35, name);
  for (const name of values.unlock ?? []) writer.string(36, name);
  if (values.con) writer.bytes(39, write(new Writer(), CON_FIELDS, values.con).finish());
  if (values.world) writer.bytes(18, encodeWorld(values.world));
  if (values.exercise) writer.bytes(40, encodeOrder(values.exercise, faultTable));
  return frame(request, 3, writer.finish());
}

// order: as targets/wire.js has it.
export function encodeTargetOrder(request, radar, view, order, token = '') {
  return frame(request, 12, encodeTargetOrderBody(radar, view, order, token));
}

export function encodeSignIn(request, token) {
  return frame(request, 14, new Writer().string(1, token).finish());
}

// order: as exercise/class_wire.js has it.
export function encodeClassOrder(request, order, token = '') {
  return frame(request, 15, encodeClassOrderBody(order, token));
}

export function encodeGetCoastline(request, place) {
  return frame(request, 11, encodeCoastRequest(place));
}

export function encodeGetChartObjects(request, place) {
  return frame(request, 13, encodeChartRequest(place));
}

// record: action (0 start, 1 stop, 2 mark) and, if there is one, name.
export function encodeRecord(request, { action, name }, token = '') {
  const writer = new Writer().uint32(1, action);
  if (name) writer.string(2, name);
  if (token) writer.string(5, token);
  return frame(request, 9, writer.finish());
}

const PLAYBACK_FIELDS = {
  playing: [1, 'uint32'], positionS: [2, 'double'], stepTurns: [4, 'sint32'], rate: [5, 'double'], loop: [6, 'uint32'],
};

// change: any of the names above; what is absent stays as it is.
export function encodePlayback(request, change, token = '') {
  const writer = write(new Writer(), PLAYBACK_FIELDS, change);
  if (token) writer.string(7, token);
  return frame(request, 10, writer.finish());
}
