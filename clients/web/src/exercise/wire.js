// The messages of protocol/wire/exercise.proto: what an instructor is told, and what he orders.
import { message, Writer } from '../protobuf.js';

// GiveWay and RouteEnd of the schema; scenarios have the same words.
export const GIVE_WAY = ['never', 'early', 'late'];
export const ROUTE_END = ['stop', 'back', 'round', 'vanish', 'again'];

const Waypoint = message({
  1: ['lat', 'double'],
  2: ['lon', 'double'],
  3: ['speedKn', 'double?'],
  4: ['arriveMin', 'double?'],
  5: ['stopMin', 'double?'],
});
const SHIP_FIELDS = {
  1: ['number', 'uint32'],
  2: ['own', 'bool'],
  3: ['name', 'string'],
  4: ['latitudeDeg', 'double'],
  5: ['longitudeDeg', 'double'],
  6: ['headingDeg', 'double'],
  7: ['courseOverGroundDeg', 'double'],
  8: ['speedKn', 'double'],
  9: ['rateOfTurnDegMin', 'double'],
  10: ['lengthM', 'double'],
  11: ['beamM', 'double'],
  12: ['shipClass', 'string'],
  13: ['mmsi', 'uint32'],
  14: ['orderedCourseDeg', 'double'],
  15: ['orderedSpeedKn', 'double'],
  16: ['givesWay', 'uint32'],
  17: ['givesWayNow', 'bool'],
  18: ['route', [Waypoint]],
  19: ['routeEnd', 'uint32'],
  20: ['removed', 'bool'],
  21: ['sart', 'bool'],
  22: ['aisOff', 'bool'],
  23: ['radars', ['uint32']],
  25: ['gyroErrorDeg', 'double'],
  26: ['gnssErrorM', 'double'],
  27: ['con', 'string'],
  28: ['onCourse', 'bool'],
  29: ['aground', 'bool'],
};
const ExerciseMark = message({ 1: ['exerciseS', 'double'], 2: ['text', 'string'], 3: ['kind', 'string'] });
const PlayedMark = message({ 1: ['positionS', 'double'], 2: ['text', 'string'], 3: ['kind', 'string'] });
const CoastLine = message({ 1: ['points', ['sint32']], 2: ['closed', 'bool'], 3: ['water', 'bool'] });
export const Coastline = message({
  1: ['latitudeDeg', 'double'],
  2: ['longitudeDeg', 'double'],
  3: ['radiusNm', 'double'],
  4: ['lines', [CoastLine]],
  5: ['chart', 'string'],
  6: ['detailM', 'double'],
});

// faults: the table's, of /controls.json.
export function exerciseState(faults) {
  const fields = {};
  for (const { name, number, type } of faults) fields[number] = [name, type === 'switch' ? 'bool' : 'double'];
  const ship = message({ ...SHIP_FIELDS, 24: ['faults', message(fields)] });
  return message({
    1: ['exerciseS', 'double'],
    2: ['frozen', 'bool'],
    3: ['rate', 'double'],
    4: ['ships', [ship]],
    5: ['snapshots', ['string']],
    6: ['marks', [ExerciseMark]],
    7: ['canUndo', 'string'],
    8: ['lastBy', 'string'],
    9: ['lastOrder', 'string'],
    10: ['orders', 'uint64'],
    11: ['playedMarks', [PlayedMark]],
  });
}

// How orders are written: name: [field number, type]. Bool and enum go as uint32; an object is a message,
// a list of one a repeated field.
const WAYPOINT = {
  lat: [1, 'double'],
  lon: [2, 'double'],
  speedKn: [3, 'double'],
  arriveMin: [4, 'double'],
  stopMin: [5, 'double'],
};
const ORDER = {
  clock: [1, { frozen: [1, 'uint32'], rate: [2, 'double'] }],
  target: [
    2,
    {
      target: [1, 'uint32'],
      courseDeg: [2, 'double'],
      speedKn: [3, 'double'],
      route: [4, [WAYPOINT]],
      routeEnd: [5, 'uint32'],
      resume: [6, 'uint32'],
      givesWay: [7, 'uint32'],
      latitudeDeg: [8, 'double'],
      longitudeDeg: [9, 'double'],
      removed: [10, 'uint32'],
      sart: [11, 'uint32'],
      aisOff: [12, 'uint32'],
      aisHeadingErrorDeg: [13, 'double'],
      aisPositionErrorM: [14, 'double'],
    },
  ],
  newTarget: [
    3,
    {
      name: [1, 'string'],
      shipClass: [2, 'string'],
      latitudeDeg: [3, 'double'],
      longitudeDeg: [4, 'double'],
      courseDeg: [5, 'double'],
      speedKn: [6, 'double'],
      route: [7, [WAYPOINT]],
      routeEnd: [8, 'uint32'],
      givesWay: [9, 'uint32'],
    },
  ],
  ownShip: [
    4,
    {
      ownShip: [1, 'uint32'],
      latitudeDeg: [2, 'double'],
      longitudeDeg: [3, 'double'],
      headingDeg: [4, 'double'],
      speedKn: [5, 'double'],
    },
  ],
  text: [6, { ownShip: [1, 'uint32'], text: [2, 'string'] }],
  mark: [7, 'string'],
  snapshot: [8, 'string'],
  restore: [9, 'string'],
  undo: [10, 'uint32'],
};

function encode(fields, values) {
  const writer = new Writer();
  for (const [name, [field, type]] of Object.entries(fields)) {
    const value = values[name];
    if (value === undefined) continue;
    const repeated = Array.isArray(type);
    const inner = repeated ? type[0] : type;
    for (const each of repeated ? value : [value]) {
      if (typeof inner === 'object') writer.bytes(field, encode(inner, each));
      else writer[inner](field, inner === 'string' ? each : Number(each));
    }
  }
  return writer.finish();
}

// One kind of ORDER, or fault: { ownShip, faults: { name: value }, change: [fields' names] }.
export function encodeOrder(order, faults) {
  const table = {};
  for (const { name, number, type } of faults) table[name] = [number, type === 'switch' ? 'uint32' : 'double'];
  return encode(
    { ...ORDER, fault: [5, { ownShip: [1, 'uint32'], faults: [2, table], change: [3, ['string']] }] },
    order,
  );
}

export function encodeCoastRequest({ latitudeDeg, longitudeDeg, radiusNm }) {
  return new Writer().double(1, latitudeDeg).double(2, longitudeDeg).double(3, radiusNm).finish();
}
