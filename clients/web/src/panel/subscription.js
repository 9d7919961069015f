// Subscription: which radar and view this console looks at: the shared view, a view of its own, or a further one of
// another's (?view=2). After a break an own view is asked for again with the settings that it had, for a view ends some
// seconds after its last console left.
import { t } from '../language/language.js';
import { REFUSED } from '../messages.js';

const VIEW_PANELS = ['receiver', 'processing'];

export class Subscription {
  // host: { radar: RadarConsole, send(radar, like, own): request or null, set(values): request or null, controls: the
  // table's, notify(text, kind), shown(): what is chosen is to be shown, restored({ radar, before }): the view took the place of that one,
  // askToken() }.
  // chosen: of the page's address, null without: 'own' or a number.
  constructor(host, chosen) {
    this.host = host;
    this.own = chosen === 'own';
    this.joined = /^\d{1,9}$/.test(chosen ?? '') ? Number(chosen) : 0;
    this.asked = null;     // the request that is under way
    this.kept = null;      // { radar, settings } of the own view as last heard
    this.restores = false; // its settings are still to be sent
    this.names = ['rangeNm', ...host.controls.filter(({ panel }) => VIEW_PANELS.includes(panel)).map(({ name }) => name)];
    this.fields = new Map(host.controls.map(({ name, field }) => [name, field]));
  }

  // Whether it is not known yet which view is this console's: until then nothing may be ordered of one.
  get isAsking() {
    return this.asked !== null && this.asked.request !== null;
  }

  ask() {
    const { radar, send, shown } = this.host;
    const like = this.own ? radar.view : this.joined;
    this.asked = { request: send(radar.radar, like, this.own), like, own: this.own };
    radar.forget();
    radar.view = this.own ? 0 : this.joined;
    shown();
  }

  // A new connection: whatever was asked for on the last one is void.
  begin() {
    this.restores = this.own && this.kept?.radar === this.host.radar.radar;
    if (!this.restores) this.kept = null;
    this.ask();
  }

  // The operator's choice.
  choose(own) {
    this.own = own;
    this.#forgetView();
    this.ask();
  }

  chooseRadar(radar) {
    this.host.radar.radar = radar;
    this.#forgetView();
    this.ask();
  }

  #forgetView() {
    this.joined = this.host.radar.view = 0;
    this.kept = null;
    this.restores = false;
  }

  // Whether the reply is the subscription's. A view to copy may have ended: then the shared one is.
  takeReply(reply) {
    if (this.asked === null || reply.request !== this.asked.request) return false;
    const { radar, notify, askToken, shown } = this.host;
    const { like, own } = this.asked;
    this.asked = null;
    if (reply.code === 0) {
      radar.view = reply.view;
      if (own && reply.view === 0) { this.own = false; notify(t('This server has no views of one\u2019s own')); }
    } else if (own) {
      this.own = like !== 0;
      radar.view = 0;
      if (like === 0) notify(reply.text);
      if (reply.code === REFUSED) askToken();
      this.ask();
    } else {
      notify(reply.text);
      if (reply.code === REFUSED) askToken();
      if (like !== 0) { this.joined = 0; this.ask(); }
    }
    shown();
    return true;
  }

  // Settings of the view that is shown. What an own view had before a break is given to the one that took its place.
  takeSettings(settings) {
    if (!this.own || settings.view === 0) return;
    if (this.restores) {
      this.restores = false;
      const before = this.kept.settings;
      this.give(before);
      // Of the new view, also if it needs nothing of it and is not told of again.
      this.kept = { radar: settings.radar, settings: { ...before, view: settings.view } };
      this.host.restored({ radar: settings.radar, before: before.view });
      return;
    }
    this.kept = { radar: settings.radar, settings };
  }

  // The controls of the view among settings: what a set-up keeps.
  valuesOf(settings) {
    return Object.fromEntries(this.names.filter((name) => settings?.[name] !== undefined).map((name) => [name, settings[name]]));
  }

  // Gives the view such values: those that it has not, but for what is locked, and no farther than the radar reaches.
  give(wanted) {
    const { settings } = this.host.radar;
    if (!settings) { this.host.notify(t('Nothing is known of the radar yet: range and receiver stay as they are')); return; }
    const values = {};
    for (const name of this.names) {
      if (typeof wanted[name] !== typeof settings[name] || settings.locked.includes(this.fields.get(name))) continue;
      const most = name === 'rangeNm' && settings.view !== 0 ? settings.radarRangeNm || Infinity : Infinity;
      const value = typeof wanted[name] === 'number' ? Math.min(most, wanted[name]) : wanted[name];
      if (value !== undefined && value !== settings[name]) values[name] = value;
    }
    if (Object.keys(values).length > 0) this.host.set(values);
  }
}
