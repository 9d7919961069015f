// The exercise of an ARPA session: own ships far apart in the open sea, each among twelve ships on the 12 NM scale, one of which comes
// too close; and the truth about them.
import { skerry } from './displays/skerryd.mjs';
import { direct, inverse } from './vincenty.mjs';
import { NM } from './mock_scene.mjs';

const RAD = Math.PI / 180;
const OWN = { courseDeg: 0, speedKn: 12 };
export const DANGEROUS = 'Zosma';
// Name; bearing and range from own ship (degrees, NM), course and speed as the exercise begins. All pass 2 NM off or farther, whether
// own ship keeps her course or alters it by 40 to 80 degrees to starboard.
const CLEAR = [
  ['Adhara', 85, 9.5, 220, 17], ['Bellatrix', 280, 6.25, 170, 16], ['Capella', 125, 5.5, 185, 15], ['Diphda', 315, 4.75, 245, 14],
  ['Electra', 160, 5.25, 190, 10], ['Furud', 345, 3.75, 320, 9], ['Gienah', 235, 7.25, 135, 8], ['Hadar', 210, 4.5, 305, 10],
  ['Izar', 45, 9.5, 265, 8], ['Jabbah', 15, 8.75, 275, 6], ['Kraz', 185, 3.75, 245, 10],
];
const CROSSING = { courseDeg: 270, speedKn: 14, cpaNm: 0.1 };

const velocity = ({ courseDeg, speedKn }) => ({ east: speedKn * Math.sin(courseDeg * RAD), north: speedKn * Math.cos(courseDeg * RAD) });
const wrap = (deg) => ((deg % 360) + 360) % 360;
const bearingOf = ({ east, north }) => wrap(Math.atan2(east, north) / RAD);

// Where the dangerous ship is so many minutes before her closest approach.
function crossing(tcpaMin) {
  const own = velocity(OWN), hers = velocity(CROSSING);
  const by = { east: hers.east - own.east, north: hers.north - own.north }, kn = Math.hypot(by.east, by.north);
  const at = {
    east: (-by.east * tcpaMin) / 60 + (CROSSING.cpaNm * by.north) / -kn,
    north: (-by.north * tcpaMin) / 60 + (CROSSING.cpaNm * by.east) / kn,
  };
  return [DANGEROUS, bearingOf(at), Math.hypot(at.east, at.north), CROSSING.courseDeg, CROSSING.speedKn];
}

// groups: { tcpaMin (at the beginning), shipClass (or null) } of each own ship; radar n is of group n.
export function scenario(groups) {
  const yaml = ['name: ARPA session', 'seed: 12', 'sea: {state: 1, wind_from_deg: 250, wind_kn: 4, depth_m: 70}', 'own_ships:'], targets = ['targets:'];
  const at = ({ latitudeDeg, longitudeDeg }) => `position: {lat: ${latitudeDeg.toFixed(6)}, lon: ${longitudeDeg.toFixed(6)}}`;
  groups.forEach(({ tcpaMin, shipClass }, n) => {
    const here = { latitudeDeg: 55.3 + n, longitudeDeg: 4.2 };
    const motion = shipClass ? `ship_class: ${shipClass}` : 'max_rate_of_turn_deg_min: 180, turn_time_constant_s: 3';
    yaml.push(`  - {name: Own ${n}, ${at(here)}, course_deg: ${OWN.courseDeg}, speed_kn: ${OWN.speedKn}, ${motion},`,
      `     radars: [{name: X ${n}, spokes: 2048, cells: 1024, rpm: 30, range_nm: 6}]}`);
    for (const [name, bearingDeg, rangeNm, courseDeg, speedKn] of [crossing(tcpaMin), ...CLEAR]) {
      targets.push(`  - {name: ${name} ${n}, ${at(direct(here, bearingDeg, rangeNm * NM))}, course_deg: ${courseDeg}, speed_kn: ${speedKn},`,
        '     length_m: 160, beam_m: 25, height_m: 25, gives_way: never}');
    }
  });
  return [...yaml, ...targets, ''].join('\n');
}

export const NAMES = [DANGEROUS, ...CLEAR.map(([name]) => name)];

// A ship as she was, or will be, so many seconds later: all keep course and speed meanwhile.
export function later(ship, seconds) {
  const by = (ship.srmKn * seconds) / 3600, at = (nm, deg) => ({ east: nm * Math.sin(deg * RAD), north: nm * Math.cos(deg * RAD) });
  const from = at(ship.rangeNm, ship.bearingDeg), way = at(by, ship.drmDeg);
  const place = { east: from.east + way.east, north: from.north + way.north };
  return { ...ship, rangeNm: Math.hypot(place.east, place.north), bearingDeg: bearingOf(place), tcpaMin: ship.tcpaMin - seconds / 60 };
}

// The ships of group n as the exercise has them: { name, rangeNm, bearingDeg, courseDeg, speedKn, drmDeg, srmKn, cpaNm, tcpaMin }, own ship,
// and when: seconds on the clock of the exercise, which spokes and lists of targets carry.
export async function truth(server, n) {
  const { ships, exercise_s: exerciseS } = JSON.parse(await skerry(['exercise', 'show', '--port', String(server.tcp), '--json']));
  const find = (name) => ships.find((ship) => ship.name === `${name} ${n}`);
  const place = (ship) => ({ latitudeDeg: ship.latitude_deg, longitudeDeg: ship.longitude_deg });
  const motion = (ship) => ({ courseDeg: ship.course_over_ground_deg ?? 0, speedKn: ship.speed_over_ground_kn ?? ship.speed_kn ?? 0 });
  const own = find('Own'), ownMotion = motion(own), ownBy = velocity(ownMotion);
  const others = NAMES.filter((name) => find(name)).map((name) => {
    const { bearingDeg, rangeM } = inverse(place(own), place(find(name)));
    const rangeNm = rangeM / NM, hers = motion(find(name)), by = velocity(hers);
    const relative = { east: by.east - ownBy.east, north: by.north - ownBy.north }, srmKn = Math.hypot(relative.east, relative.north);
    const at = { east: rangeNm * Math.sin(bearingDeg * RAD), north: rangeNm * Math.cos(bearingDeg * RAD) };
    return {
      name, rangeNm, bearingDeg, ...hers, drmDeg: bearingOf(relative), srmKn,
      cpaNm: Math.abs(at.east * relative.north - at.north * relative.east) / srmKn,
      tcpaMin: (-60 * (at.east * relative.east + at.north * relative.north)) / srmKn ** 2,
    };
  });
  return { own: { ...ownMotion, headingDeg: own.heading_deg ?? 0 }, ships: others, exerciseS };
}
