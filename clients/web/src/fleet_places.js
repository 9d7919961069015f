// FleetPlaces: the servers that a page can be connected to: its own, and the other hosts of a fleet that it was told of.
// All have the same radars by the same numbers; the spokes of each are made at one of them.

// Of a page's address: where its WebSocket is, and what answers as long as there is a server, and weighs nothing.
function placeOf(page) {
  const ws = new URL('ws', page);
  ws.protocol = ws.protocol === 'https:' ? 'wss:' : 'ws:';
  ws.search = ws.hash = '';
  return { ws: ws.href, probe: new URL('icon.svg', page).href };
}

// What a host told of itself may be anything.
function isPage(web) {
  try {
    return /^https?:$/.test(new URL(web).protocol);
  } catch {
    return false;
  }
}

export class FleetPlaces {
  constructor(page) {
    this.own = placeOf(page);
    this.at = this.own;
    this.others = [];    // of the fleet, as it was told last
    this.home = null;    // of the radar that is watched, as it was told last
    this.radar = null;   // that is watched
    this.fleet = null;
    this.ownName = null; // of the page's own server in the fleet
    this.known = null;   // of which the page was told first: a browser lets it connect to no others
  }

  // fleet: as Hello and Fleet have it; null: this server runs its exercise alone.
  take(fleet) {
    this.fleet = fleet;
    // It may be known to the fleet by another name than the page has it by.
    if (fleet && this.at === this.own) this.ownName = fleet.host;
    this.others = (fleet?.hosts ?? []).map((host) => this.#placeOf(host)).filter((place) => place !== null && place !== this.own);
    this.known ??= new Set(this.others.map(({ ws }) => ws));
    this.watch(this.radar);
  }

  // null: it has not yet said where.
  #placeOf({ name, web }) {
    if (name === this.ownName) return this.own;
    if (!isPage(web)) return null;
    const place = { ...placeOf(web), page: web };
    return place.ws === this.own.ws ? this.own : place;
  }

  watch(radar) {
    this.radar = radar;
    const host = this.fleet?.hosts.find(({ radars }) => radars.includes(radar));
    this.home = host ? this.#placeOf(host) : null;
  }

  // Whether nobody makes the spokes of the radar that is watched, as far as is known here.
  get isHomeless() {
    return this.fleet !== null && this.radar !== null && this.home === null;
  }

  // The address of the page at the home, where this page cannot be connected to it; null: it can.
  pageToGoTo({ pathname, search }) {
    if (this.home === null || this.home === this.own || this.known.has(this.home.ws)) return null;
    return new URL(`.${pathname.slice(pathname.lastIndexOf('/'))}${search}`, this.home.page).href;
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
