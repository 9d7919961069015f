// AlertConsole: the alerts of the view's plotter: banner, list, history and sound. The one door of this folder.
import { t } from '../language/language.js';
import { button, details, element, refusal, say } from '../targets/dom.js';
import { ACTIVE } from '../targets/wire.js';
import { $ } from '../widgets.js';
import { AlertHistory } from './alert_history.js';
import { AlertSound } from './alert_sound.js';
import { byUrgency, clockOf, isUnacknowledged, keyOf, mayBeAcknowledged, priorityOf, rankOf, stateWord, symbolOf, wordOf } from './alert_words.js';

export class AlertConsole {
  // orders: TargetOrders; notify(text, kind); choose(alert): the operator asks which target it is about.
  constructor({ orders, notify, choose, sound = new AlertSound() }) {
    Object.assign(this, { orders, notify, choose, sound });
    this.alerts = [];
    this.rows = new Map();   // by key
    this.history = new AlertHistory();
    this.#build();
    this.show();
  }

  #build() {
    this.banner = $('alert-banner');
    this.worst = element('span', { id: 'alert-worst' });
    this.count = element('span', { id: 'alert-count' });
    // Only what is new is spoken: the text, not the counts around it.
    const spoken = element('span', { id: 'alert-spoken', role: 'alert' }, this.worst);
    this.first = button('alert-acknowledge', t('Ack'), () => this.acknowledgeFirst(), { title: `${t('Acknowledge this alert')} (Q)`, ariaLabel: t('Acknowledge this alert') });
    this.banner.append(spoken, this.count, this.first);
    this.problem = refusal('alert-refusal');
    this.silences = button('alert-silence', t('Silence'), () => this.silence(), { title: t('Silence for 30 s (Shift+Q)') });
    this.all = button('alert-acknowledge-all', t('Acknowledge all'), () => this.acknowledgeAll());
    this.sounds = button('alert-sound', t('Sound on'), () => this.#allowSound(), { ariaPressed: 'false' });
    this.list = element('ul', { id: 'alert-list' });
    this.none = element('p', { className: 'hint', textContent: t('No alerts.') });
    this.past = element('ol', { id: 'alert-history' });
    $('alerts').append(element('h2', { textContent: t('Alerts') }), element('div', { className: 'actions' }, this.all, this.silences, this.sounds),
      this.problem, this.none, this.list, details('alert-history-part', t('History'), false, this.past));
  }

  #allowSound() {
    const on = !this.sound.isAllowed;
    if (!this.sound.allow(on)) this.notify(t('This browser plays no sound'));
    this.sounds.ariaPressed = String(this.sound.isAllowed);
    say(this.sounds, this.sound.isAllowed ? t('Sound off') : t('Sound on'));
    this.#call();
  }

  acknowledge(alerts) {
    const those = alerts.filter(mayBeAcknowledged);
    if (those.length > 0) this.orders.give({ acknowledge: those.map(({ number, instance }) => ({ number, instance })) }, this.problem);
  }

  acknowledgeFirst() {
    this.acknowledge(this.#urgent().filter(mayBeAcknowledged).slice(0, 1));
  }

  acknowledgeAll() {
    this.acknowledge(this.alerts);
  }

  silence() {
    this.orders.give({ silence: true }, this.problem);
  }

  #urgent() {
    return [...this.alerts].sort(byUrgency);
  }

  // Another view: its alerts are others, and those of this one are not gone.
  forget() {
    this.history.current.clear();
    this.alerts = [];
    this.show();
  }

  take(alerts) {
    this.alerts = alerts;
    if (this.history.take(alerts)) this.#showHistory();
    this.show();
  }

  show() {
    const urgent = this.#urgent();
    const [worst] = urgent;
    const words = worst ? `${symbolOf(worst)} ${wordOf(worst)}: ${worst.title}: ${worst.text}` : t('No alerts');
    say(this.worst, words);
    this.banner.dataset.priority = worst ? priorityOf(worst).name : '';
    this.banner.toggleAttribute('data-calls', worst !== undefined && isUnacknowledged(worst));
    const calling = urgent.filter(isUnacknowledged).length;
    say(this.count, urgent.length === 0 ? '' : t('{n} of {all}', { n: calling, all: urgent.length }));
    this.count.title = t('{n} not acknowledged, of {all}', { n: calling, all: urgent.length });
    this.first.hidden = !urgent.some(mayBeAcknowledged);
    this.all.disabled = this.first.hidden;
    this.silences.disabled = !urgent.some((alert) => alert.state === ACTIVE);
    this.none.hidden = urgent.length > 0;
    this.#showList(urgent);
    this.#call();
  }

  // The server is gone, or its lists have stopped: nothing sounds on, and what is shown is of then.
  lost() {
    this.sound.call(null, '');
    this.banner.toggleAttribute('data-stale', this.alerts.length > 0);
  }

  #call() {
    this.banner.removeAttribute('data-stale');
    const heard = this.alerts.filter((alert) => alert.state === ACTIVE && isUnacknowledged(alert));
    const highest = heard.reduce((most, alert) => Math.max(most, rankOf(alert)), -1);
    this.sound.call(highest, heard.filter((alert) => rankOf(alert) === highest).map(keyOf).join());
  }

  #showList(urgent) {
    const now = new Set(urgent.map(keyOf));
    for (const [key, row] of this.rows) if (!now.has(key)) { row.item.remove(); this.rows.delete(key); }
    urgent.forEach((alert, i) => {
      const row = this.rows.get(keyOf(alert)) ?? this.#row(keyOf(alert));
      row.alert = alert;
      row.item.dataset.priority = priorityOf(alert).name;
      row.item.dataset.state = String(alert.state);
      say(row.head, `${symbolOf(alert)} ${wordOf(alert)} ${alert.number}.${alert.instance} ${alert.title}`);
      say(row.text, alert.text);
      say(row.more, `${clockOf(alert.utcNs)} UTC \u00b7 ${t('category {category}', { category: alert.category || '\u2013' })} \u00b7 ${stateWord(alert)}` +
        (alert.escalations > 0 ? ` \u00b7 ${t('escalated {n}\u00d7', { n: alert.escalations })}` : ''));
      row.acknowledges.hidden = !mayBeAcknowledged(alert);
      row.chooses.hidden = alert.target === 0 && alert.mmsi === 0;
      if (this.list.children[i] !== row.item) this.list.insertBefore(row.item, this.list.children[i] ?? null);
    });
  }

  #row(key) {
    const row = { head: element('strong'), text: element('span', { className: 'text' }), more: element('span', { className: 'dim' }) };
    row.acknowledges = button(`acknowledge-${key}`, t('Acknowledge'), () => this.acknowledge([row.alert]), { ariaLabel: t('Acknowledge {alert}', { alert: key }) });
    row.chooses = button(`show-${key}`, t('Show'), () => this.choose(row.alert), { ariaLabel: t('Select the target of {alert}', { alert: key }) });
    row.item = element('li', {}, row.head, row.text, row.more, element('div', { className: 'actions' }, row.acknowledges, row.chooses));
    this.rows.set(key, row);
    return row;
  }

  #showHistory() {
    this.past.replaceChildren(...this.history.entries.map(({ alert, gone }) => element('li', { dataset: { priority: priorityOf(alert).name } },
      `${clockOf(alert.utcNs)} ${wordOf(alert)} ${keyOf(alert)} ${alert.title}: ${alert.text} (${gone ? t('gone') : stateWord(alert)})`)));
  }

  // For tests.
  get state() {
    return { calling: this.sound.calling, soundAllowed: this.sound.isAllowed, beeps: this.sound.beeps, history: this.history.entries.length };
  }

  // For the table of keys (keys/key_table.js).
  get keys() {
    const group = t('Alerts');
    return [
      { id: 'acknowledge', key: 'q', words: t('acknowledge the alert'), group, run: () => this.acknowledgeFirst() },
      { id: 'silence', key: 'Shift+q', words: t('silence alerts'), group, run: () => this.silence() },
    ];
  }
}
