// The messages of protocol/wire/chart.proto.
import { later } from '../language/language.js';
import { message, Writer } from '../protobuf.js';

export const COAST = 0, CONTOUR = 1;
// Kinds of ChartMark.
export const MARK = {
  OTHER: 0, LATERAL_PORT: 1, LATERAL_STARBOARD: 2, PREFERRED_STARBOARD: 3, PREFERRED_PORT: 4, CARDINAL_NORTH: 5, CARDINAL_EAST: 6,
  CARDINAL_SOUTH: 7, CARDINAL_WEST: 8, ISOLATED_DANGER: 9, SAFE_WATER: 10, SPECIAL: 11, LIGHT: 12, WRECK: 13, OBSTRUCTION: 14,
  ROCK: 15, RACON: 16, LIGHT_VESSEL: 17,
};
export const MARK_NAMES = [
  later('mark'), later('port hand'), later('starboard hand'), later('preferred channel to starboard'), later('preferred channel to port'), later('north cardinal'),
  later('east cardinal'), later('south cardinal'), later('west cardinal'), later('isolated danger'), later('safe water'), later('special'), later('light'), later('wreck'), later('obstruction'),
  later('rock'), later('racon'), later('light vessel'),
];

const ChartLine = message({ 1: ['kind', 'uint32'], 2: ['depthM', 'double'], 3: ['points', ['sint32']] });
const ChartMark = message({
  1: ['kind', 'uint32'], 2: ['longitude', 'sint32'], 3: ['latitude', 'sint32'], 4: ['fixed', 'bool'], 5: ['shape', 'uint32'],
  6: ['colours', ['uint32']], 7: ['name', 'string'], 8: ['light', 'string'], 9: ['racon', 'bool'], 10: ['depthM', 'double?'],
});
export const ChartObjects = message({
  1: ['latitudeDeg', 'double'], 2: ['longitudeDeg', 'double'], 3: ['radiusNm', 'double'], 4: ['toleranceM', 'double'],
  5: ['chart', 'string'], 6: ['coastOnly', 'bool'], 7: ['lines', [ChartLine]], 8: ['marks', [ChartMark]], 9: ['marksLeftOut', 'uint32'],
  10: ['linesLeftOut', 'uint32'],
});

// What has numbers that must be finite.
export const partsOfChart = (objects) => (objects ? [objects, ...objects.lines, ...objects.marks] : []);

export function encodeChartRequest({ latitudeDeg, longitudeDeg, radiusNm, toleranceM }) {
  return new Writer().double(1, latitudeDeg).double(2, longitudeDeg).double(3, radiusNm).double(4, toleranceM).finish();
}
