// Orders: what the controls of the page send. Each goes to every ship given, in a Set of the instructor's.
const named = (ships) => (ships.length === 1 ? ships[0].name : `${ships.length} ships`);

export class Orders {
  // send(values, what, radar): a Set with these values, radar undefined: any; what: for a refusal.
  constructor(send) {
    this.send = send;
  }

  exercise(order, what) {
    return this.send({ exercise: order }, what);
  }

  world(change, what) {
    return this.send({ world: change }, what);
  }

  // change(ship): fields of TargetChange.
  targets(ships, change, what) {
    for (const ship of ships) {
      this.exercise(
        { target: { target: ship.number, ...(typeof change === 'function' ? change(ship) : change) } },
        `${ship.name}, ${what}`,
      );
    }
  }

  // Course and speed mean the same to both kinds.
  steer(ships, values) {
    for (const ship of ships) {
      if (!ship.own) this.targets([ship], values, 'course and speed');
      else this.ownShip(ship, values, 'course and speed');
    }
  }

  // values: of Set, or con.
  ownShip(ship, values, what) {
    if (ship.radars.length === 0) return null;
    return this.send(values, `${ship.name}, ${what}`, ship.radars[0]);
  }

  // places: [{ ship, latitudeDeg, longitudeDeg, headingDeg?, speedKn? }].
  put(places) {
    for (const { ship, latitudeDeg, longitudeDeg, headingDeg, speedKn } of places) {
      if (ship.own)
        this.exercise(
          { ownShip: { ownShip: ship.number, latitudeDeg, longitudeDeg, headingDeg, speedKn } },
          `${ship.name}, put`,
        );
      else this.targets([ship], { latitudeDeg, longitudeDeg }, 'put');
    }
  }

  // waypoints: places; the speed is that of the whole route.
  route(ships, waypoints, speedKn, routeEnd) {
    const route = waypoints.map(({ latitudeDeg, longitudeDeg }) => ({ lat: latitudeDeg, lon: longitudeDeg }));
    if (Number.isFinite(speedKn)) route[0].speedKn = speedKn;
    this.targets(ships, { route, routeEnd }, 'route');
  }

  // faults: { name: value }, change: names of the schema; both empty: all faults are taken away.
  faults(ships, faults, change, what) {
    for (const ship of ships)
      this.exercise({ fault: { ownShip: ship.number, faults, change } }, `${ship.name}, ${what}`);
  }

  static named = named;
}
