// FleetPlaces: the servers that a page can be connected to: its own, and the other hosts of a fleet that it was told of.
// All have the same radars by the same numbers; the spokes of each are made at one of them.

// Of a page's address: where its WebSocket is, and what answers as long as there is a server, and weighs nothing.
function placeOf(page) {
  const ws = new URL('ws', page);
  ws.protocol = ws.protocol === 'https:' ? 'wss:' : 'ws:';
  ws.search = ws.hash = '';
  return { ws: ws.href, probe: new URL('icon.svg', page).href };
}

export class FleetPlaces {
  constructor(page) {
    this.own = placeOf(page);
    this.at = this.own;
    this.others = [];    // of the fleet, as it was told last
    this.home = null;    // of the radar that is watched, as it was told last
    this.radar = null;   // that is watched
    this.fleet = null;
  }

  // fleet: as Hello and Fleet have it; null: this server runs its exercise alone.
  take(fleet) {
    this.fleet = fleet;
    const hosts = (fleet?.hosts ?? []).filter(({ web }) => web !== '');
    // The page's own server stays a place where it is started again.
    this.others = hosts.filter(({ web }) => placeOf(web).ws !== this.own.ws).map(({ web }) => placeOf(web));
    this.watch(this.radar);
  }

  watch(radar) {
    this.radar = radar;
    const host = this.fleet?.hosts.find(({ radars, web }) => web !== '' && radars.includes(radar));
    this.home = host ? [this.own, ...this.others].find(({ ws }) => ws === placeOf(host.web).ws) ?? null : null;
  }

  // Whether the radar that is watched is somewhere else.
  get mustMove() {
    return this.home !== null && this.home.ws !== this.at.ws;
  }

  move() {
    this.at = this.home;
  }

  // After a loss: one after the other, the page's own server among them.
  next() {
    const places = [this.own, ...this.others];
    this.at = places[(places.findIndex(({ ws }) => ws === this.at.ws) + 1) % places.length];
  }
}
