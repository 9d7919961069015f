// The exercise as it is now, as a scenario file (server/world/SCENARIO.md): what ExerciseState, World and Hello tell.
import { duration } from '../format.js';
import { OWN_SHIP_CLASSES } from './ship_classes.js';
import { GIVE_WAY, ROUTE_END } from './wire.js';

const RAIN_KIND_WORDS = ['cell', 'even', 'shower', 'squall_line'];
const HEAD = `# Left out, because the server does not tell it: the settings and changes of radars (each has those of its set),
# how a ship without a class answers, wind models, tide, streams, banks, coast, buoys, racons, turbines and cables,
# what a target shall begin later, events, areas, the sheet and its checks, faults, and all that a ship has done.
# A ship that follows, fishes or lies at anchor keeps her course.
`;

// Quoted as JSON has it, which YAML reads; at most so many characters.
const quoted = (text, most = 64) =>
  JSON.stringify([...text.replace(/[\u0000-\u001f\u007f]/g, ' ')].slice(0, most).join(''));
const number = (value, digits) => String(Number(value.toFixed(digits)));
const within = (value, least, most) => Math.max(least, Math.min(most, value));
const course = (deg) => number(((deg % 360) + 360) % 360, 1);
const place = (latitudeDeg, longitudeDeg) => `{lat: ${number(latitudeDeg, 7)}, lon: ${number(longitudeDeg, 7)}}`;

// Names in a scenario are unique.
function uniqueNames(ships) {
  const taken = new Set();
  return ships.map((ship) => {
    const base = [...(ship.name.trim() || 'Ship')].slice(0, 58).join('');
    let name = base;
    for (let i = 2; taken.has(name); ++i) name = `${base} ${i}`;
    taken.add(name);
    return name;
  });
}

// Astern of her bow it is negative.
function speedAhead(ship) {
  const off = Math.abs(((ship.courseOverGroundDeg - ship.headingDeg + 540) % 360) - 180);
  return ship.speedKn < 0.05 ? 0 : off > 90 ? -ship.speedKn : ship.speedKn;
}

const mmsi = (ship) => (ship.mmsi >= 100000000 && ship.mmsi <= 999999999 ? [`mmsi: ${ship.mmsi}`] : []);

function radarText(radar) {
  const parts = [];
  if (radar.name) parts.push(`name: ${quoted(radar.name)}`);
  if (radar.set) parts.push(`set: ${quoted(radar.set)}`);
  if (radar.spokesPerTurn >= 256)
    parts.push(`spokes: ${radar.spokesPerTurn}`, `cells: ${radar.cells}`, `bits: ${radar.bits}`);
  return `      - {${parts.join(', ')}}`;
}

function ownShip(ship, name, radars) {
  const isClassed = OWN_SHIP_CLASSES.includes(ship.shipClass);
  const lines = [
    `  - name: ${quoted(name)}`,
    `    position: ${place(ship.latitudeDeg, ship.longitudeDeg)}`,
    `    course_deg: ${course(ship.headingDeg)}`,
    `    speed_kn: ${number(within(speedAhead(ship), -10, 60), 1)}`,
    ...(isClassed
      ? [`    ship_class: ${ship.shipClass}`]
      : [
          `    length_m: ${number(within(ship.lengthM, 2, 500), 1)}`,
          `    beam_m: ${number(within(ship.beamM, 0.5, 80), 1)}`,
        ]),
    ...mmsi(ship).map((text) => `    ${text}`),
  ];
  const hers = radars.filter(({ radar }) => ship.radars.includes(radar));
  return [...lines, ...(hers.length > 0 ? ['    radars:', ...hers.map(radarText)] : [])];
}

function waypoint({ lat, lon, speedKn, arriveMin, stopMin }, nowMin) {
  const parts = [`lat: ${number(lat, 7)}, lon: ${number(lon, 7)}`];
  if (speedKn >= 0.1) parts.push(`speed_kn: ${number(speedKn, 2)}`);
  if (arriveMin > nowMin) parts.push(`arrive_min: ${number(arriveMin - nowMin, 2)}`);
  if (stopMin > 0) parts.push(`stop_min: ${number(stopMin, 2)}`);
  return `{${parts.join(', ')}}`;
}

function target(ship, name, nowMin) {
  const sails = ship.route.length > 0 && !ship.onCourse;
  // On her way she makes for the ordered speed; one that was ordered nothing keeps what she has.
  const speedKn = sails || ship.onCourse || ship.orderedSpeedKn > 0 ? ship.orderedSpeedKn : ship.speedKn;
  const lines = [
    `  - name: ${quoted(name)}`,
    `    position: ${place(ship.latitudeDeg, ship.longitudeDeg)}`,
    ...(sails ? [] : [`    course_deg: ${course(ship.headingDeg)}`]), // a route sets the course
    `    speed_kn: ${number(within(speedKn, sails ? 0.1 : 0, 100), 1)}`,
  ];
  if (ship.shipClass) lines.push(`    ship_class: ${ship.shipClass}`);
  else if (ship.lengthM >= 1)
    lines.push(
      `    length_m: ${number(within(ship.lengthM, 1, 500), 1)}`,
      `    beam_m: ${number(within(ship.beamM, 0.3, 80), 1)}`,
    );
  lines.push(...mmsi(ship).map((text) => `    ${text}`));
  if (ship.givesWay > 0) lines.push(`    gives_way: ${GIVE_WAY[ship.givesWay]}`);
  if (ship.sart) lines.push('    sart: true');
  if (sails) {
    lines.push('    waypoints:', ...ship.route.map((each) => `      - ${waypoint(each, nowMin)}`));
    if (ROUTE_END[ship.routeEnd] !== undefined && ship.routeEnd > 0)
      lines.push(`    route_end: ${ROUTE_END[ship.routeEnd]}`);
  }
  return lines;
}

function weather(world, artefacts) {
  const sea = [`state: ${number(world.seaState, 2)}`, `wind_from_deg: ${course(world.windFromDeg)}`];
  if (world.windKn !== undefined) sea.push(`wind_kn: ${number(world.windKn, 1)}`);
  sea.push(
    `swell: {height_m: ${number(world.swellHeightM, 2)}, period_s: ${number(within(world.swellPeriodS, 4, 25), 1)}, from_deg: ${course(world.swellFromDeg)}}`,
    `wave_height_m: ${number(world.waveHeightM, 2)}`,
    `current_set_deg: ${course(world.currentSetDeg)}`,
    `current_kn: ${number(world.currentKn, 2)}`,
  );
  if (world.depthM >= 2) sea.push(`depth_m: ${number(world.depthM, 1)}`);
  const lines = [`sea: {${sea.join(', ')}}`];
  const air =
    world.kFactor >= 0.8 ? [`k_factor: ${number(world.kFactor, 4)}`, `ducting: ${number(world.ducting, 3)}`] : [];
  if (world.visibilityNm >= 0.02) air.push(`visibility_nm: ${number(world.visibilityNm, 3)}`);
  if (air.length > 0) lines.push(`atmosphere: {${air.join(', ')}}`);
  if (world.rain.length > 0) {
    lines.push(
      'rain:',
      ...world.rain.map(
        (cell) =>
          `  - {position: ${place(cell.latitudeDeg, cell.longitudeDeg)}, radius_nm: ${number(cell.radiusNm, 2)}, ` +
          `rate_mm_h: ${number(cell.rateMmH, 2)}, drift_deg: ${course(cell.driftDeg)}, drift_kn: ${number(cell.driftKn, 1)}, kind: ${RAIN_KIND_WORDS[cell.kind] ?? 'cell'}}`,
      ),
    );
  }
  const switches = artefacts
    .filter(({ name }) => typeof world[name] === 'boolean')
    .map(({ name, field }) => `${field}: ${world[name]}`);
  if (switches.length > 0) lines.push(`artefacts: {${switches.join(', ')}}`);
  return lines;
}

// state: ExerciseState; world: World or null; hello: Hello; artefacts: the table's.
export function scenarioYaml(state, world, hello, artefacts) {
  const at = duration(state.exerciseS);
  const ships = state.ships.filter(({ removed }) => !removed);
  const names = uniqueNames(ships),
    nowMin = state.exerciseS / 60;
  const own = ships.flatMap((ship, i) => (ship.own ? ownShip(ship, names[i], hello.radars) : []));
  const targets = ships.flatMap((ship, i) => (ship.own ? [] : target(ship, names[i], nowMin)));
  const title = hello.scenario || 'Exercise';
  return [
    `# ${title.replace(/[\u0000-\u001f\u007f]/g, ' ')}, as it was at ${at} of the exercise, written by the instructor's page.`,
    HEAD.trimEnd(),
    `name: ${quoted(`${[...title].slice(0, 50).join('')} at ${at}`)}`,
    'own_ships:',
    ...own,
    ...(targets.length > 0 ? ['targets:', ...targets] : []),
    ...(world ? weather(world, artefacts) : []),
    '',
  ].join('\n');
}
