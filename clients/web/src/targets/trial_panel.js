// TrialPanel: what would come of a manoeuvre.
import { duration } from '../format.js';
import { BoundedField } from './bounded_field.js';
import { button, element, refusal, say } from './dom.js';
import { TRIALS, withBounds } from './rules.js';

export class TrialPanel {
  constructor(orders, table) {
    this.orders = orders;
    this.problem = refusal('trial-refusal');
    this.fields = withBounds(TRIALS, table.trialOrder).map((rule) => new BoundedField(`trial-${rule.name}`, rule));
    this.ends = button('trial-end', 'End trial', () => this.orders.give({ endTrial: true }, this.problem));
    this.state = element('p', { id: 'trial-state', className: 'hint' });
    const form = element('form', { id: 'trial-form', noValidate: true }, element('div', { className: 'fields two' }, ...this.fields.map((field) => field.element)),
      element('div', { className: 'actions' }, element('button', { type: 'submit', id: 'trial-start', textContent: 'Start trial' }), this.ends));
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
    const dangerous = trial?.outcomes.filter((outcome) => outcome.isDangerous).length ?? 0;
    say(this.state, !trial ? '' : `${trial.beginsS > 0 ? `She begins in ${duration(trial.beginsS)}` : 'She has begun'}; ` +
      `${dangerous === 0 ? 'no target is' : dangerous === 1 ? '1 target is' : `${dangerous} targets are`} dangerous then.`);
  }
}
