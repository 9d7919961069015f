// Availability: controls that need the server are off while it is not there and while nothing is known of the radar; those
// of the radar ([data-live-radar]) also while a recording is played. Off is `inert`: no pointer, no key, no screen
// reader reaches them, and style.css greys them.
//
// What is known of the radar goes for a moment whenever another view is asked for: so long they stay, or the keyboard
// would lose its place.
const UNKNOWN_MS = 700;

export class Availability {
  constructor(root = document) {
    this.radar = [...root.querySelectorAll('[data-live-radar]')];
    this.server = [...root.querySelectorAll('[data-needs-server]')];
    this.knownMs = -Infinity;
    this.focus = null;
    this.show({ live: false, known: false, playback: false, nowMs: 0 });
  }

  // known: the radar's settings have come; of a recording that is played nothing more than a connection is needed.
  show({ live, known, playback, nowMs }) {
    if (!live) this.knownMs = -Infinity;
    else if (known || playback) this.knownMs = nowMs;
    const on = live && nowMs - this.knownMs < UNKNOWN_MS;
    const before = document.activeElement;
    for (const part of this.server) this.#set(part, !live);
    for (const part of this.radar) this.#set(part, playback || !on);
    if (!on && this.on && before?.closest('[inert]')) this.focus = before;
    if (on && !this.on && this.focus && document.activeElement === document.body) this.focus.focus({ preventScroll: true });
    if (on) this.focus = null;
    this.on = on;
    document.documentElement.toggleAttribute('data-off', !on);
  }

  #set(part, off) {
    if (part.inert !== off) part.inert = off;
  }
}
