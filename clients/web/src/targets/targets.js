// TargetConsole: the targets of the view in this console: list, picture, panel, orders. The one door of this folder.
import { t } from '../language/language.js';
import { $ } from '../widgets.js';
import { AcquirePanel } from './acquire_panel.js';
import { DataPanel } from './data_panel.js';
import { details, element, follow, following, say, sayProblem, toggle } from './dom.js';
import { ListTable } from './list_table.js';
import { RulesPanel } from './rules_panel.js';
import { ScreenSize } from './screen_size.js';
import { TargetInput } from './target_input.js';
import { outcomeOf, TargetLayer } from './target_layer.js';
import { TargetOrders } from './target_orders.js';
import { TargetSigns } from './target_signs.js';
import { ownMotion, shownOf, TargetStore } from './target_store.js';
import { TrialPanel } from './trial_panel.js';
import { VectorPanel } from './vector_panel.js';
import { VectorSettings } from './vector_settings.js';
import { ZonesPanel } from './zones_panel.js';

// The panel's numbers are renewed with every list, and at least so often.
const SHOW_S = 0.5;

export class TargetConsole {
  // send(order): as TargetOrders has it; notify(text, kind); cursor(): { bearingDeg, rangeM } or null; isBusy(): whether the
  // next press in the picture belongs to another part; table: of
  // /controls.json; seconds(): of a clock that never goes back.
  constructor({ send, notify, cursor, isBusy, table, seconds }) {
    Object.assign(this, { notify, cursor, seconds });
    this.store = new TargetStore();
    this.settings = new VectorSettings();
    this.orders = new TargetOrders(send, notify);
    this.layer = new TargetLayer($('target-marks'));
    this.version = 0;      // of the settings, for the canvas
    this.draft = null;     // the zone that is being drawn
    this.ownShip = this.headingDeg = null;
    this.held = null;      // zones and rules of the newest list, over a break
    this.isBack = false;   // no list has come since
    this.passedAt = seconds();
    this.input = new TargetInput($('ppi'), this.layer, {
      symbol: (shown) => this.#press(shown),
      acquire: (place) => this.acquire.acquire(place),
      isBusy,
      zone: (zone) => this.zones.addDrawn(zone),
      narrow: () => sayProblem(this.zones.problem, t('Drag aside as well: a zone has a sector')),
      draft: (zone) => { this.draft = zone && { ...zone, number: 0, kind: this.zones.style.kind, relative: false }; },
    });
    this.signs = new TargetSigns($('target-box'), $('signs'));
    this.#build(table);
    document.addEventListener('keydown', (event) => { if (event.key === 'Escape') this.#setMode('select'); });
    this.show();
  }

  #build(table) {
    const { orders, store, notify } = this;
    const changed = () => { this.version += 1; this.show(); };
    const setMode = (mode) => this.#setMode(mode);
    this.acquire = new AcquirePanel({ orders, store, setMode, notify, changed });
    this.vectors = new VectorPanel(this.settings, changed);
    this.data = new DataPanel({ orders, store, problem: this.acquire.problem, changed });
    this.list = new ListTable((key) => { store.toggle(key); changed(); });
    this.rules = new RulesPanel(orders, table);
    this.zones = new ZonesPanel({ orders, table, setMode, heading: () => this.headingDeg, known: () => store.list !== null });
    this.trial = new TrialPanel(orders, table);
    this.screen = new ScreenSize(this.settings, changed);
    this.test = toggle('test-targets', t('Test targets'), (on) => orders.give({ testTargets: on }, this.acquire.problem));
    following(this.test.firstElementChild);
    this.count = element('output', { id: 'target-count' });
    this.leftOut = element('p', { id: 'ais-left-out', className: 'hint', hidden: true });
    this.none = element('p', { id: 'targets-none', className: 'hint', textContent: t('No list of targets has come from this server.') });
    this.body = element('div', { id: 'targets-body' }, this.acquire.element, this.data.element, this.vectors.element,
      details('targets-list', t('List'), true, this.list.element, this.leftOut), details('targets-rules', t('Limits and rules'), false, this.rules.element),
      details('targets-zones', t('Guard zones'), false, this.zones.element), details('targets-trial', t('Trial manoeuvre'), false, this.trial.element),
      details('targets-screen', t('Test and screen'), false, element('div', { className: 'toggles two' }, this.test), this.screen.element));
    $('targets').append(element('h2', {}, `${t('Targets')} `, element('span', { className: 'note' }, this.count)), this.none, this.body);
  }

  #setMode(mode) {
    // One thing at a time.
    if (mode !== 'zone') this.zones?.draws.setAttribute('aria-pressed', 'false');
    if (mode !== 'acquire') this.acquire?.acquiring.setAttribute('aria-pressed', 'false');
    this.input.mode = mode;
    this.show();
  }

  #press(shown) {
    const { track, ais } = shown.entry;
    if (ais && !track && !ais.isActivated) {
      this.orders.give({ activate: [ais.mmsi] }, this.acquire.problem);
      this.store.select(shown.key);
    } else {
      this.store.toggle(shown.key);
    }
    this.version += 1;
    this.show();
  }

  // Another view, or the same one after a break.
  forget() {
    this.isBack = true;
    this.store.forget();
    this.orders.forget();
    this.trial.forget();
    this.zones.show([]);
    this.acquire.question.close();
    this.draft = null;
    this.problem = '';
    this.#setMode('select');
    this.show();
  }

  // keeps: whether its zones and rules are what is to be had again after the server's restart.
  take(list, keeps = true) {
    const { held } = this;
    if (keeps) this.held = { radar: list.radar, view: list.view, plots: list.plots, zones: list.zones, rules: list.rules };
    // A plotter of the shared view that counts anew has lost its zones. Several consoles may say so: the same zones by the same numbers.
    if (this.isBack && held && list.view === 0 && held.view === 0 && held.radar === list.radar && list.plots < held.plots &&
        list.zones.length === 0 && held.zones.length > 0) this.#giveBack(held);
    this.isBack = false;
    this.store.take(list);
    // A page that was hidden draws nothing, but lists have come all the time.
    this.passedAt = this.seconds();
    // Said once, and shown as long as it is so.
    if (list.problem && list.problem !== this.problem) this.notify(list.problem);
    this.problem = list.problem;
    this.show();
  }

  // A view of this console's own took the place of the one that had the number `before`.
  restored({ radar, before }) {
    if (this.held?.radar === radar && this.held.view === before) this.#giveBack(this.held);
  }

  #giveBack({ zones, rules }) {
    if (zones.length > 0 || rules) this.orders.give({ zones, ...(rules ? { rules } : {}) }, this.zones.problem);
  }

  takeReply(reply, text) {
    return this.orders.takeReply(reply, text);
  }

  // look: { palette, paletteName, ownShip, headingDeg, rate (of a playback; 0: it stands) }.
  draw(view, { palette, paletteName, ownShip, headingDeg, rate }) {
    const now = this.seconds();
    this.store.pass(now - this.passedAt, rate);
    this.passedAt = now;
    this.input.view = view;
    this.ownShip = ownShip;
    this.headingDeg = headingDeg;
    this.layer.draw(view, { store: this.store, settings: this.settings, palette, paletteName, ownShip, headingDeg, draft: this.draft,
                            nowMs: now * 1000, version: this.version });
  }

  // To be called several times a second: numbers go on between lists, and what is not renewed goes.
  tick() {
    if (this.store.isStale !== this.wasStale || this.seconds() - this.shownAt >= SHOW_S) this.show();
  }

  // The panel and the signs, as things are now.
  show() {
    const { store, settings, signs } = this;
    const { list } = store;
    this.shownAt = this.seconds();
    this.wasStale = store.isStale;
    signs.show({ list, isStale: store.isStale, settings, mode: this.input.mode });
    this.acquire.show();
    this.none.hidden = list !== null;
    this.body.inert = list === null;
    say(this.count, list ? t('{n} of {all}', { n: list.tracked, all: list.rules?.capacity ?? '\u2013' }) : '');
    if (!list || store.isStale) {
      this.data.show([], null);
      this.list.show([], null, []);
      return;
    }
    const own = ownMotion(list, this.ownShip);
    const shownFor = (entry) => shownOf(entry, settings.source, own, store.stepS);
    const all = store.entries.filter((entry) => entry.track || settings.ais).map(shownFor);
    const outcomes = list.trial ? new Map(all.map((shown) => [shown.key, outcomeOf(list.trial, shown)])) : null;
    this.list.show(all, outcomes, store.selected);
    this.data.show(store.selectedEntries.map((entry) => ({ shown: shownFor(entry), outcome: outcomes ? outcomes.get(entry.key) : undefined })),
      list.ownHeadingDeg);
    this.rules.show(list.rules);
    this.zones.show(list.zones);
    this.trial.show(list);
    follow(this.test.firstElementChild, list.testTargets);
    say(this.leftOut, list.aisLeftOut > 0 ? t('{n} more AIS targets are too far to be shown.', { n: list.aisLeftOut }) : '');
    this.leftOut.hidden = list.aisLeftOut === 0;
  }

  // "User default settings", for all who look at this view. Zones stay.
  setDefaults() {
    this.vectors.change({ relative: false, minutes: 6, past: false, ais: true });
    if (this.store.list) this.orders.give({ rules: { acquire: 0, cpaNm: 2, tcpaMin: 12, stabilisation: 0, associate: true, lostWarnings: true } });
  }

  // The target that an alert is about.
  choose({ target, mmsi }) {
    const entry = this.store.entries?.find(({ track, ais }) => (target > 0 ? track?.number === target : ais?.mmsi === mmsi));
    if (!entry) { this.notify(t('That target is not in the list any more')); return; }
    this.store.select(entry.key);
    this.version += 1;
    this.show();
  }

  // For tests.
  get state() {
    const { store, layer, settings, input } = this;
    return {
      list: store.list, stale: store.isStale, selected: store.selected, mode: input.mode, pxPerMm: settings.pxPerMm, vectors: layer.vectors,
      shown: layer.shown.map(({ key, x, y, kind, label, source, isDangerous, calls }) => ({ key, x, y, kind, label, source, isDangerous, calls })),
    };
  }

  // For the table of keys (keys/key_table.js).
  get keys() {
    const group = t('Targets');
    return [
      { id: 'acquire', key: 'a', words: t('acquire at the cursor'), group, run: () => this.acquire.acquire(this.cursor()) },
      { id: 'acquire-mode', key: 'Shift+a', words: t('acquire by presses on echoes (Esc ends)'), group, run: () => this.acquire.toggleMode() },
      { id: 'cancel-target', key: 'Delete', words: t('cancel the selected targets'), group, run: () => this.acquire.cancelSelected() },
      { id: 'vectors', key: 't', words: t('vectors: true or relative'), group, run: () => this.vectors.change({ relative: !this.settings.relative }) },
      { id: 'vectors-shorter', key: '[', words: t('vectors: shorter'), group, run: () => this.vectors.step(-1) },
      { id: 'vectors-longer', key: ']', words: t('vectors: longer'), group, run: () => this.vectors.step(1) },
      { id: 'past-positions', key: 'd', words: t('past positions'), group, run: () => this.vectors.change({ past: !this.settings.past }) },
      { id: 'ais', key: 'i', words: t('AIS targets on, off'), group, run: () => this.vectors.change({ ais: !this.settings.ais }) },
    ];
  }
}
