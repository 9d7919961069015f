// SharedSetting: one value of the view, which every console of that view may change.
//
// While this console is changing it, its own value is shown; when the server has answered, the
// server's. Changes are sent at most once per SEND_MS, the last one always.
const SEND_MS = 90;
// How long the own value is kept after the last change if the server's settings do not follow it.
const SETTLE_MS = 1200;

export class SharedSetting {
  // send(value): to the server. show(value, pending): on the screen. refused(why): beside it, if it has a place there.
  constructor(send, show, refused = () => {}) {
    this.send = send;
    this.show = show;
    this.refused = refused;
    this.server = null;
    this.own = null;
  }

  // The user's.
  change(value) {
    this.own = value;
    this.show(value, true);
    if (!this.sendTimer) {
      this.sendTimer = setTimeout(() => {
        this.sendTimer = null;
        this.sentValue = this.own;
        if (this.own !== null) this.send(this.own);
      }, SEND_MS);
    }
    clearTimeout(this.settleTimer);
    this.settleTimer = setTimeout(() => this.settle(), SEND_MS + SETTLE_MS);
  }

  // The server's; undefined of one that does not tell it.
  take(value) {
    if (value === undefined) return;
    this.server = value;
    if (this.own === null) this.show(value, false);
    else if (!this.sendTimer && Math.abs(value - this.own) < 1e-6) this.settle();
  }

  // The server's value rules again: it has followed, refused, or not answered.
  settle() {
    clearTimeout(this.settleTimer);
    clearTimeout(this.sendTimer);
    this.sendTimer = null;
    this.own = null;
    if (this.server !== null) this.show(this.server, false);
  }

  value() {
    return this.own ?? this.server;
  }
}

// Which requests are under way and whose they are.
export class PendingRequests {
  constructor() {
    this.owners = new Map();  // request -> SharedSetting, or whatever else settles and is refused
  }

  // `request` is null if it could not be sent.
  add(request, setting) {
    if (request === null) { setting.settle(); return; }
    this.owners.set(request, setting);
    if (this.owners.size > 64) this.owners.delete(this.owners.keys().next().value);
  }

  // A refused value gives way to the server's, and it is said why.  why: the reply's text or the name of its code.
  takeReply(reply, why = reply.text) {
    const setting = this.owners.get(reply.request);
    this.owners.delete(reply.request);
    if (!setting || reply.code === 0) return;
    setting.settle();
    setting.refused(why);
  }
}
