// Figures of the stream: spokes lost, spokes a second, the antenna's turns.

// Losses read off the sequence numbers of one subscription. WebSocket keeps the order, so a number
// that does not grow means that the server has started its count again.
export class LossCounter {
  constructor() {
    this.received = 0;
    this.lost = 0;
    this.restarts = 0;
    this.last = null;
  }

  // A new connection or subscription: what was sent in between was not sent to us.
  restart() {
    this.last = null;
  }

  // How many spokes are lost between the one before it and this one; null if that is not known.
  take(sequence) {
    const expected = this.last === null ? sequence : this.last + 1;
    if (sequence > expected) this.lost += sequence - expected;
    if (sequence < expected) this.restarts += 1;
    const missed = this.last === null || sequence < expected ? null : sequence - expected;
    this.last = sequence;
    this.received += 1;
    return missed;
  }
}

// Times for which the server made no spokes: it was stopped or overloaded. The server never counted these, so none of
// them is lost. Told by the antenna's clock, which goes on. Spokes may be lost at the same moment: the time that these
// took, by the time of a spoke before them, is no gap.
export const GAP_S = 1;
const TURNING = 0.1;  // by so much the antenna's speed may have changed meanwhile
export class GapCounter {
  constructor() {
    this.gaps = 0;
    this.seconds = 0;  // of all gaps
    this.restart();
  }

  // What comes now need not follow what came before: standby, another view, a new connection.
  restart() {
    this.lastNs = null;
    this.spokeNs = null;  // from a spoke to the next, mean of about the last 64
  }

  // missed: how many spokes were lost before this one; null if that is not known. Gives the length of the gap before it
  // in seconds, or 0.
  take(scenarioNs, missed) {
    const passedNs = this.lastNs === null || missed === null ? 0 : scenarioNs - this.lastNs;
    this.lastNs = scenarioNs;
    if (missed > 0 && this.spokeNs === null) return 0;
    const lostS = missed > 0 ? (missed * this.spokeNs) / 1e9 : 0;
    const gapS = passedNs / 1e9 - lostS;
    if (gapS >= Math.max(GAP_S, lostS * TURNING)) {
      this.gaps += 1;
      this.seconds += gapS;
      return gapS;
    }
    if (missed === 0 && passedNs > 0) {
      const before = this.spokeNs ?? passedNs;
      this.spokeNs = before + (passedNs - before) / 64;
    }
    return 0;
  }
}

// The slope of a growing quantity over the last `windowS` seconds.
export class Rate {
  constructor(windowS, stepS = windowS / 16) {
    this.windowS = windowS;
    this.stepS = stepS;
    this.samples = [];  // { t, value }, at most windowS / stepS + 2
  }

  clear() {
    this.samples.length = 0;
  }

  add(t, value) {
    const samples = this.samples;
    const last = samples[samples.length - 1];
    if (last && (t < last.t || value < last.value)) this.clear();
    if (samples.length > 1 && t - samples[samples.length - 2].t < this.stepS) samples.pop();
    samples.push({ t, value });
    while (samples.length > 2 && t - samples[1].t >= this.windowS) samples.shift();
  }

  // Per second, or null while less than a quarter of the window is known. At time `now` with no new
  // sample the rate falls, to zero after one window of silence.
  perSecond(now = this.samples.at(-1)?.t) {
    const first = this.samples[0], last = this.samples.at(-1);
    if (!first || last.t - first.t < this.windowS / 4) return null;
    if (now - last.t > this.windowS) return 0;
    const silence = now - last.t > 2 * this.stepS ? now - last.t : 0;
    return (last.value - first.value) / (last.t - first.t + silence);
  }
}

// Turns of the antenna (relative to the bow) against the time at which it pointed there.
export class TurnRate {
  constructor() {
    this.rate = new Rate(4);
  }

  clear() {
    this.rate.clear();
  }

  take(spoke) {
    this.rate.add(spoke.utcNs / 1e9, spoke.scan + spoke.index / spoke.spokesPerTurn);
  }

  rpm() {
    const turns = this.rate.perSecond();
    return turns === null ? null : turns * 60;
  }
}
