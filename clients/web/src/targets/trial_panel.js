// TrialPanel: what would come of a manoeuvre.
import { duration } from '../format.js';
import { t } from '../language/language.js';
import { BoundedField } from './bounded_field.js';
import { button, element, refusal, say } from './dom.js';
import { TRIALS, withBounds } from './rules.js';

export class TrialPanel {
  constructor(orders, table) {
    this.orders = orders;
    this.problem = refusal('trial-refusal');
    this.fields = withBounds(TRIALS, table.trialOrder).map((rule) => new BoundedField(`trial-${rule.name}`, rule));
    this.ends = button('trial-end', t('End trial'), () => this.orders.give({ endTrial: true }, this.problem));
    this.state = element('p', { id: 'trial-state', className: 'hint' });
    const form = element('form', { id: 'trial-form', noValidate: true }, element('div', { className: 'fields two' }, ...this.fields.map((field) => field.element)),
      element('div', { className: 'actions' }, element('button', { type: 'submit', id: 'trial-start', textContent: t('Start trial') }), this.ends));
    form.addEventListener('submit', (event) => { event.preventDefault(); this.#start(); });
    this.element = element('div', {}, form, this.state, this.problem);
    this.isFilled = false;
  }

  forget() {
    this.isFilled = false;
  }

  #start() {
    const order = {};
    for (const field of this.fields) order[field.rule.name] = field.read();
    if (!Object.values(order).includes(null)) this.orders.give({ trial: order }, this.problem);
  }

  // Begins with what own ship does now.
  #fill(list) {
    if (this.isFilled || (list.ownCourseDeg === undefined && !list.trial)) return;
    this.isFilled = true;
    const order = list.trial?.order ?? {
      courseDeg: Math.round(list.ownCourseDeg) % 360, speedKn: Number(Math.max(0, list.ownSpeedKn).toFixed(1)), delayMin: 0,
      turnRateDegMin: 0, accelerationKnMin: 0,
    };
    for (const field of this.fields) field.set(order[field.rule.name]);
  }

  show(list) {
    this.#fill(list);
    const { trial } = list;
    this.ends.disabled = !trial;
    const n = trial?.outcomes.filter((outcome) => outcome.isDangerous).length ?? 0;
    const begun = trial?.beginsS > 0 ? t('She begins in {time}', { time: duration(trial.beginsS) }) : t('She has begun');
    const then = n === 0 ? t('no target is dangerous then.') : n === 1 ? t('1 target is dangerous then.') : t('{n} targets are dangerous then.', { n });
    say(this.state, trial ? `${begun}; ${then}` : '');
  }
}
