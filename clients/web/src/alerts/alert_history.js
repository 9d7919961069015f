// AlertHistory: what became of alerts while this page was open, the newest first.
import { keyOf } from './alert_words.js';

const MOST = 100;

export class AlertHistory {
  constructor() {
    this.entries = [];        // { alert, gone }
    this.current = new Map(); // by key
  }

  // alerts: of the newest list. Whether anything has changed.
  take(alerts) {
    const now = new Map(alerts.map((alert) => [keyOf(alert), alert]));
    const before = this.entries[0];
    for (const [key, alert] of this.current) if (!now.has(key)) this.#add({ alert, gone: true });
    for (const [key, alert] of [...now].reverse()) {
      const known = this.current.get(key);
      if (!known || known.state !== alert.state || known.escalations !== alert.escalations) this.#add({ alert, gone: false });
    }
    this.current = now;
    return this.entries[0] !== before;
  }

  #add(entry) {
    this.entries.unshift(entry);
    this.entries.length = Math.min(this.entries.length, MOST);
  }
}
