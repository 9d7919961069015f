// The messages of protocol/wire/radar.proto that a console reads and writes, and their frames: each
// message after its length as a varint, any number of them in one WebSocket message.
import { message, Reader, WireError, Writer } from './protobuf.js';

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
});
const RadarInfo = message({
  1: ['radar', 'uint32'], 2: ['name', 'string'], 3: ['ownShip', 'string'],
  4: ['spokesPerTurn', 'uint32'], 5: ['cells', 'uint32'], 6: ['bits', 'uint32'],
  7: ['rpm', 'double'], 8: ['beamWidthDeg', 'double'],
});
const Hello = message({
  1: ['protocolVersion', 'uint32'], 2: ['server', 'string'], 3: ['scenario', 'string'],
  4: ['radars', [RadarInfo]], 5: ['rangeScalesNm', ['double']],
});
const Reply = message({ 1: ['request', 'uint32'], 2: ['code', 'uint32'], 3: ['text', 'string'] });
const Settings = message({
  1: ['radar', 'uint32'], 2: ['view', 'uint32'], 3: ['rangeNm', 'double'],
  4: ['gain', 'double'], 5: ['sea', 'double'], 6: ['rain', 'double'],
});
const OwnShip = message({
  1: ['radar', 'uint32'], 2: ['name', 'string'], 3: ['latitudeDeg', 'double'],
  4: ['longitudeDeg', 'double'], 5: ['headingDeg', 'double'], 6: ['speedKn', 'double'],
  7: ['rateOfTurnDegMin', 'double'], 8: ['orderedCourseDeg', 'double'], 9: ['orderedSpeedKn', 'double'],
});
const ServerMessage = message({
  1: ['spoke', Spoke], 2: ['hello', Hello], 4: ['reply', Reply], 5: ['settings', Settings],
  6: ['ownShip', OwnShip],
});

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
    if (decoded.spoke) checkSpoke(decoded.spoke, at);
    for (const part of [decoded.settings, decoded.ownShip, ...(decoded.hello?.radars ?? [])]) {
      if (part) checkFinite(part, at);
    }
    if (decoded.hello) checkHello(decoded.hello, at);
    reader.at = end;
    take(decoded);
  }
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
}

function frame(request, field, body) {
  const inner = new Writer().uint32(1, request).bytes(field, body).finish();
  const length = new Writer().varint(inner.length).finish();
  const out = new Uint8Array(length.length + inner.length);
  out.set(length);
  out.set(inner, length.length);
  return out;
}

export function encodeSubscribe(request, radar, view) {
  return frame(request, 2, new Writer().uint32(1, radar).uint32(2, view).finish());
}

const SET_FIELDS = { courseDeg: 3, speedKn: 4, rangeNm: 5, gain: 6, sea: 7, rain: 8 };

// values: any of courseDeg, speedKn, rangeNm, gain, sea, rain; what is absent stays as it is.
export function encodeSet(request, radar, view, values, token = '') {
  const writer = new Writer().uint32(1, radar).uint32(2, view);
  for (const [name, field] of Object.entries(SET_FIELDS)) {
    if (values[name] !== undefined) writer.double(field, values[name]);
  }
  if (token) writer.string(9, token);
  return frame(request, 3, writer.finish());
}
