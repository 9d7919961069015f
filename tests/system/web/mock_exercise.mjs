// An exercise for tests of the instructor's page: it obeys orders at once, and keeps what it was asked for.
const NM_DEG = 1 / 60;

const ship = (number, own, name, latitudeDeg, longitudeDeg, more = {}) => ({
  number,
  own,
  name,
  latitudeDeg,
  longitudeDeg,
  headingDeg: 0,
  courseOverGroundDeg: 0,
  speedKn: 0,
  lengthM: 60,
  beamM: 11,
  shipClass: own ? '' : 'coaster',
  mmsi: 257000000 + number + (own ? 500 : 0),
  orderedCourseDeg: 0,
  orderedSpeedKn: 0,
  route: [],
  radars: [],
  ...more,
});

export const defaultShips = () => [
  ship(0, true, 'Fulmar', 60.39, 5.1, {
    headingDeg: 40,
    courseOverGroundDeg: 42,
    speedKn: 12,
    radars: [0],
    shipClass: 'coaster',
    faults: {},
    orderedCourseDeg: 40,
    orderedSpeedKn: 12,
  }),
  ship(1, true, 'Gannet', 60.45, 5.0, {
    headingDeg: 200,
    courseOverGroundDeg: 200,
    speedKn: 9,
    radars: [1],
    faults: {},
    lengthM: 100,
    beamM: 16,
  }),
  ship(0, false, 'Ferry', 60.42, 5.14, {
    headingDeg: 270,
    courseOverGroundDeg: 270,
    speedKn: 15,
    orderedSpeedKn: 15,
    shipClass: 'ferry',
    lengthM: 120,
    beamM: 20,
    route: [
      { lat: 60.42, lon: 5.0 },
      { lat: 60.46, lon: 4.9 },
    ],
    routeEnd: 1,
    givesWay: 1,
    givesWayNow: true,
  }),
  ship(3, false, 'Lyngen', 60.36, 5.05, { headingDeg: 20, courseOverGroundDeg: 20, speedKn: 11, orderedSpeedKn: 11 }),
  ship(4, false, 'Tug \u00c5se', 60.4, 5.2, {
    headingDeg: 120,
    courseOverGroundDeg: 120,
    speedKn: 6,
    orderedSpeedKn: 6,
    shipClass: 'tug',
    sart: true,
  }),
];

// An island, with a lake in it, and a shore that is no area; degrees * 1e6 from the centre asked for.
const ISLAND = [
  [60.37, 5.12],
  [60.385, 5.13],
  [60.4, 5.16],
  [60.39, 5.22],
  [60.36, 5.2],
];
const LAKE = [
  [60.378, 5.16],
  [60.386, 5.17],
  [60.378, 5.185],
];
const SHORE = [
  [60.48, 4.8],
  [60.47, 4.95],
  [60.5, 5.05],
];

export function coastlineAt({ latitudeDeg, longitudeDeg, radiusNm }, detailM = radiusNm / 2) {
  const coded = (places) => {
    let [x, y] = [0, 0];
    return places.flatMap(([lat, lon]) => {
      const [east, north] = [Math.round((lon - longitudeDeg) * 1e6), Math.round((lat - latitudeDeg) * 1e6)];
      const step = [east - x, north - y];
      [x, y] = [east, north];
      return step;
    });
  };
  return {
    latitudeDeg,
    longitudeDeg,
    radiusNm,
    chart: 'mock',
    detailM,
    lines: [
      { points: coded(ISLAND), closed: true },
      { points: coded(LAKE), closed: true, water: true },
      { points: coded(SHORE), closed: false },
    ],
  };
}

export class MockExercise {
  constructor(options = {}) {
    Object.assign(
      this,
      {
        exerciseS: 3661,
        frozen: false,
        rate: 1,
        ships: defaultShips(),
        snapshots: [],
        marks: [{ exerciseS: 60, text: 'Fog signal', kind: 'event' }],
        canUndo: '',
        lastBy: '',
        lastOrder: '',
        orders: 0,
        refuse: null,
        coastAsked: [],
        playedMarks: [],
      },
      options,
    );
    this.kept = new Map();
    this.past = [];
  }

  state() {
    const { exerciseS, frozen, rate, ships, snapshots, marks, canUndo, lastBy, lastOrder, orders, playedMarks } = this;
    return { exerciseS, frozen, rate, ships, snapshots, marks, canUndo, lastBy, lastOrder, orders, playedMarks };
  }

  // Ships go where they head; called as often as states are sent.
  step(seconds) {
    if (this.frozen) return;
    this.exerciseS += seconds * this.rate;
    for (const each of this.ships) {
      const angle = (each.courseOverGroundDeg * Math.PI) / 180,
        far = ((each.speedKn * seconds * this.rate) / 3600) * NM_DEG;
      each.latitudeDeg += far * Math.cos(angle);
      each.longitudeDeg += (far * Math.sin(angle)) / Math.cos((each.latitudeDeg * Math.PI) / 180);
    }
  }

  #keep(what) {
    this.past.push({ what, ships: structuredClone(this.ships) });
    this.canUndo = what;
  }

  // order: of protobufjs. Null, or what is wrong.
  take(order) {
    this.orders += 1;
    this.lastBy = 'instructor 127.0.0.1:5';
    this.lastOrder = order.kind;
    const own = (number) => this.ships.find((each) => each.own && each.number === number);
    const given = (message, names) =>
      Object.fromEntries(names.filter((name) => message[`_${name}`]).map((name) => [name, message[name]]));
    if (order.kind === 'clock') Object.assign(this, given(order.clock, ['frozen', 'rate']));
    else if (order.kind === 'target') return this.#target(order.target, given);
    else if (order.kind === 'newTarget') this.#add(order.newTarget);
    else if (order.kind === 'ownShip') {
      this.#keep(`${own(order.ownShip.ownShip).name}, put`);
      Object.assign(
        own(order.ownShip.ownShip),
        given(order.ownShip, ['latitudeDeg', 'longitudeDeg', 'headingDeg', 'speedKn']),
      );
    } else if (order.kind === 'fault') this.#fault(own(order.fault.ownShip), order.fault);
    else if (order.kind === 'mark') this.marks.push({ exerciseS: this.exerciseS, text: order.mark, kind: 'mark' });
    else if (order.kind === 'text') this.marks.push({ exerciseS: this.exerciseS, text: order.text.text, kind: 'text' });
    else if (order.kind === 'snapshot') {
      this.snapshots.push(order.snapshot);
      this.kept.set(order.snapshot, { exerciseS: this.exerciseS, ships: structuredClone(this.ships) });
    } else if (order.kind === 'restore') Object.assign(this, structuredClone(this.kept.get(order.restore)));
    else if (order.kind === 'undo') this.#undo();
    return null;
  }

  #target(change, given) {
    const hers = this.ships.find((each) => !each.own && each.number === change.target);
    if (!hers) return `target ${change.target}: there is none`;
    this.#keep(`${hers.name}, ${Object.keys(change).filter((name) => name !== 'target')[0] ?? 'change'}`);
    Object.assign(
      hers,
      given(change, ['latitudeDeg', 'longitudeDeg', 'removed', 'sart', 'aisOff', 'givesWay', 'routeEnd']),
    );
    const { courseDeg, speedKn } = given(change, ['courseDeg', 'speedKn']);
    if (courseDeg !== undefined)
      Object.assign(hers, {
        orderedCourseDeg: courseDeg,
        courseOverGroundDeg: courseDeg,
        headingDeg: courseDeg,
        onCourse: true,
      });
    if (speedKn !== undefined) Object.assign(hers, { orderedSpeedKn: speedKn, speedKn });
    if (change.route.length > 0)
      Object.assign(hers, { route: change.route.map(({ lat, lon }) => ({ lat, lon })), onCourse: false });
    if (change.resume) hers.onCourse = false;
    return null;
  }

  #add({ name, shipClass, latitudeDeg, longitudeDeg, courseDeg, speedKn, givesWay }) {
    const number = 1 + Math.max(...this.ships.filter((each) => !each.own).map((each) => each.number));
    this.#keep(`new ${name || `Target ${number}`}`);
    this.ships.push(
      ship(number, false, name || `Target ${number}`, latitudeDeg, longitudeDeg, {
        headingDeg: courseDeg,
        courseOverGroundDeg: courseDeg,
        speedKn,
        shipClass,
        givesWay,
      }),
    );
  }

  #fault(hers, { faults, change }) {
    this.#keep(`${hers.name}, faults`);
    const camel = (name) => name.replace(/_([a-z])/g, (_, letter) => letter.toUpperCase());
    if (change.length === 0) hers.faults = {};
    else for (const name of change) hers.faults = { ...hers.faults, [camel(name)]: faults[camel(name)] };
    hers.gyroErrorDeg = hers.faults.gyroBiasDeg ?? 0;
  }

  #undo() {
    const { ships } = this.past.pop() ?? this;
    this.ships = ships;
    this.canUndo = this.past.at(-1)?.what ?? '';
  }
}
