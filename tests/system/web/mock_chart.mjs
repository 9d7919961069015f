// The chart of the scene of mock_scene.mjs: its coast by exact geodesics from OWN, a buoy on each target, two depth contours.
import { coastM, TARGETS } from './mock_scene.mjs';
import { direct } from './vincenty.mjs';

export const OWN = { latitudeDeg: 60.3925, longitudeDeg: 5.3233 };
const STEP_DEG = 0.25;
// Kinds of the marks on TARGETS, in their order, with S-57's colours.
export const MARKS = [
  { kind: 1, colours: [3], name: 'Port 1' }, { kind: 2, colours: [4], name: 'Starboard 2', light: 'Fl G 4s' }, { kind: 5, colours: [2, 6], name: 'North' },
  { kind: 11, colours: [6], name: 'Special' }, { kind: 13, name: 'Wreck', depthM: 4.2 }, { kind: 10, colours: [3, 1], name: '<b>Safe</b>' },
];
export const CONTOURS = [{ depthM: 5, rangeM: 1800 }, { depthM: 20, rangeM: 2200 }];

const arc = (fromDeg, toDeg, rangeOf) => {
  const out = [];
  for (let deg = fromDeg; deg <= toDeg; deg += STEP_DEG) out.push(direct(OWN, deg, rangeOf(deg)));
  return out;
};
let lines;

export function chartAt({ latitudeDeg, longitudeDeg, radiusNm, toleranceM }) {
  lines ??= [
    { kind: 0, places: arc(20, 95, coastM) }, { kind: 0, places: arc(205, 320, coastM) },
    ...CONTOURS.map(({ depthM, rangeM }) => ({ kind: 1, depthM, places: arc(100, 200, () => rangeM) })),
  ];
  const whole = ({ latitudeDeg: lat, longitudeDeg: lon }) => [Math.round((lon - longitudeDeg) * 1e6), Math.round((lat - latitudeDeg) * 1e6)];
  const coded = (places) => {
    let before = [0, 0];
    return places.flatMap((place) => {
      const at = whole(place), step = [at[0] - before[0], at[1] - before[1]];
      before = at;
      return step;
    });
  };
  return {
    latitudeDeg, longitudeDeg, radiusNm, toleranceM, chart: 'mock',
    lines: lines.map(({ kind, depthM, places }) => ({ kind, depthM, points: coded(places) })),
    marks: TARGETS.map(({ bearingDeg, rangeM }, i) => {
      const [longitude, latitude] = whole(direct(OWN, bearingDeg, rangeM));
      return { ...MARKS[i], longitude, latitude };
    }),
  };
}
