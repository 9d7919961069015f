// VectorSettings: how this screen shows targets, kept in this browser. Nothing of it goes to the server.
const REMEMBERED = 'skerry.targets';
export const MINUTES = [1, 2, 3, 6, 10, 12, 15, 20, 30, 45, 60];

const CHECKS = {
  relative: (value) => typeof value === 'boolean',
  minutes: (value) => MINUTES.includes(value),
  ticks: (value) => typeof value === 'boolean',
  past: (value) => typeof value === 'boolean',
  ais: (value) => typeof value === 'boolean',
  names: (value) => typeof value === 'boolean',
  joined: (value) => value === 'ais' || value === 'radar',
  mmOf100px: (value) => value === null || (Number.isFinite(value) && value >= 5 && value <= 100),
};

export class VectorSettings {
  constructor(storage = globalThis.localStorage) {
    this.storage = storage;
    // joined: the symbol of what radar and AIS agree on. mmOf100px: null until the operator has measured the screen.
    Object.assign(this, { relative: false, minutes: 6, ticks: false, past: false, ais: true, names: true, joined: 'ais', mmOf100px: null });
    try {
      const kept = JSON.parse(storage.getItem(REMEMBERED)) ?? {};
      for (const [name, check] of Object.entries(CHECKS)) if (name in kept && check(kept[name])) this[name] = kept[name];
    } catch {
      // No settings kept, or not ours: the defaults stand.
    }
  }

  change(values) {
    Object.assign(this, values);
    try {
      this.storage.setItem(REMEMBERED, JSON.stringify(Object.fromEntries(Object.keys(CHECKS).map((name) => [name, this[name]]))));
    } catch {
      // A browser that keeps nothing still shows targets.
    }
  }

  stepMinutes(by) {
    const at = MINUTES.indexOf(this.minutes) + by;
    this.change({ minutes: MINUTES[Math.max(0, Math.min(MINUTES.length - 1, at))] });
  }

  // By what those are shown that both radar and AIS know.
  get source() {
    return this.ais ? this.joined : 'radar';
  }

  // CSS pixels of a millimetre; a CSS inch has 96 of them where nobody has measured.
  get pxPerMm() {
    return this.mmOf100px === null ? 96 / 25.4 : 100 / this.mmOf100px;
  }
}
