// SharedSetting: one value of the view, which every console of that view may change.
//
// While this console is changing it, its own value is shown; when the server has answered, the
// server's. Changes are sent at most once per SEND_MS, the last one always.
const SEND_MS = 90;
// How long the own value is kept after the last change if the server's settings do not follow it.
const SETTLE_MS = 1200;

export class SharedSetting {
  // send(value): to the server. show(value, pending): on the screen.
  constructor(send, show) {
    this.send = send;
    this.show = show;
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

  // The server's.
  take(value) {
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
