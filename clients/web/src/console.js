// RadarConsole: what this screen knows of one radar, and what it does with each message. No drawing.
import { REFUSED, REPLY_CODES } from './messages.js';
import { ScanStore, ScanTracker } from './scan_store.js';
import { GapCounter, LossCounter, Rate, TurnRate } from './stream_stats.js';
import { NAUTICAL_MILE_M } from './view_geometry.js';

const DEFAULT_TURN_S = 2.5;

export class RadarConsole {
  // events: hello(hello, the radar that was looked at before it), settings(settings), ownShip(ownShip), world(world), recorder(state),
  // playback(state), targets(list), reply(reply, text, refused), spoke(spoke, nowS) of those that are drawn, gap(seconds) for
  // which none was made, clear() once the picture is dark, forget() when another radar or view is looked at.
  constructor(maxRows, events) {
    this.store = new ScanStore(maxRows);
    this.events = events;
    this.hello = null;
    this.radar = 0;
    this.view = 0;
    this.loss = new LossCounter();
    this.gaps = new GapCounter();
    this.isPlayed = false;  // a recording, whose clock stands still and jumps
    this.scans = new ScanTracker();
    this.spokeRate = new Rate(2);
    this.turnRate = new TurnRate();
    this.newestScan = null;  // of the newest spoke that came, drawn or not
    this.heldAfter = null;
    this.forget();
  }

  // Another radar, or the same one after a break: its picture, numbers and settings are not ours.
  forget() {
    this.store.clear();
    this.events.clear?.();
    this.events.forget?.();
    this.scans.reset();
    this.spokeRate.clear();
    this.turnRate.clear();
    this.loss.restart();
    this.gaps.restart();
    this.spoke = null;        // newest
    this.lastSpokeS = -Infinity;
    this.ownShip = null;
    this.settings = null;
    this.world = null;
  }

  takeAll(messages, nowS) {
    for (const message of messages) {
      if (message.spoke) this.#takeSpoke(message.spoke, nowS);
      else if (message.hello) this.#takeHello(message.hello);
      else if (message.settings) this.#takeSettings(message.settings);
      else if (message.ownShip) this.#takeOwnShip(message.ownShip);
      else if (message.world) { this.world = message.world; this.events.world(message.world); }
      else if (message.recorder) this.events.recorder(message.recorder);
      else if (message.playback) { this.isPlayed = true; this.events.playback(message.playback); }
      else if (message.targets) this.#takeTargets(message.targets);
      else if (message.reply) this.#takeReply(message.reply);
    }
  }

  #takeSpoke(spoke, nowS) {
    if (spoke.radar !== this.radar || spoke.view !== this.view) return;
    const missed = this.loss.take(spoke.sequence);
    if (this.isPlayed || this.inStandby) this.gaps.restart();
    const gapS = this.gaps.take(spoke.scenarioNs, missed);
    if (gapS > 0) this.events.gap?.(gapS);
    this.spokeRate.add(nowS, this.loss.received);
    this.turnRate.take(spoke);
    this.newestScan = spoke.scan;
    if (this.heldAfter !== null && spoke.scan > this.heldAfter) return;
    this.scans.take(spoke);
    this.store.put(spoke, nowS, missed === 0);
    this.events.spoke?.(spoke, nowS);
    // Not the message itself: its cells lie in the whole WebSocket message's memory.
    this.spoke = { ...spoke, cells: null, doppler: null };
    this.lastSpokeS = nowS;
  }

  #takeOwnShip(ownShip) {
    if (ownShip.radar !== this.radar) return;
    this.ownShip = ownShip;
    this.events.ownShip(ownShip);
  }

  #takeTargets(list) {
    if (list.radar === this.radar && list.view === this.view) this.events.targets(list);
  }

  #goDark() {
    this.gaps.restart();
    this.store.clear();
    this.events.clear?.();
    this.scans.reset();
    this.spokeRate.clear();
    this.turnRate.clear();
    this.lastSpokeS = -Infinity;
  }

  get inStandby() {
    return this.settings?.standby === true;
  }

  #takeHello(hello) {
    this.hello = hello;
    const wanted = this.radar;
    if (!hello.radars.some((r) => r.radar === this.radar) && hello.radars.length > 0) {
      this.radar = hello.radars[0].radar;
    }
    this.events.hello(hello, wanted);
  }

  #takeSettings(settings) {
    if (settings.radar !== this.radar || settings.view !== this.view) return;
    // The picture from before standby is out of date.
    if (settings.standby && !this.settings?.standby) this.#goDark();
    this.settings = settings;
    this.events.settings(settings);
  }

  #takeReply(reply) {
    const name = REPLY_CODES[reply.code] ?? `code ${reply.code}`;
    this.events.reply(reply, reply.text || name, reply.code === REFUSED);
  }

  // Range of the picture's edge. The settings name it before the first spoke of a new range comes.
  rangeM() {
    return this.settings?.rangeNm > 0 ? this.settings.rangeNm * NAUTICAL_MILE_M : this.videoM();
  }

  // What the spokes take for the bow's true bearing: where the heading is not known, the last that was, or 0.
  bowDeg() {
    return this.spoke ? (this.spoke.heading * 360) / 4294967296 : this.ownShip?.headingDeg ?? 0;
  }

  // How far the newest spoke reaches, metres.
  videoM() {
    return this.spoke ? this.spoke.cellSizeM * this.spoke.cellCount : 0;
  }

  // True, degrees; null when not known. Spokes carry it many times a second.
  headingDeg() {
    if (this.ownShip?.noHeading) return null;
    if (this.spoke) return (this.spoke.heading * 360) / 4294967296;
    return this.ownShip ? this.ownShip.headingDeg : null;
  }

  // Seconds of one turn of the antenna: as measured, else as announced.
  turnS() {
    const rpm = this.turnRate.rpm() ?? this.hello?.radars.find((r) => r.radar === this.radar)?.rpm;
    return rpm > 0 ? Math.min(20, Math.max(0.5, 60 / rpm)) : DEFAULT_TURN_S;
  }

  // Whether spokes come.
  isTurning(nowS) {
    return nowS - this.lastSpokeS < Math.max(0.5, this.turnS() / 4);
  }
}
