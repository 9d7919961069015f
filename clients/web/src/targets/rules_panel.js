// RulesPanel: how the plotter works, for all who look at this view.
import { later, t } from '../language/language.js';
import { BoundedField } from './bounded_field.js';
import { button, element, follow, following, refusal, toggle } from './dom.js';
import { RULES, withBounds } from './rules.js';

const ACQUIRE = [[0, later('By hand and in zones')], [1, later('What moves')], [2, later('acquires|All')]];
const STABILISATION = [[0, later('Ground')], [1, later('Water')]];

export class RulesPanel {
  // table: of /controls.json.
  constructor(orders, table) {
    this.orders = orders;
    this.problem = refusal('rules-refusal');
    const order = (rules) => this.orders.give({ rules }, this.problem);
    this.fields = withBounds(RULES, table.targetRules).map((rule) => new BoundedField(`rule-${rule.name}`, rule, (value) => order({ [rule.name]: value })));
    const select = (id, choices, name) => {
      const made = following(element('select', { id }, ...choices.map(([value, words]) => new Option(t(words), value))));
      made.addEventListener('change', () => order({ [name]: Number(made.value) }));
      return made;
    };
    this.acquire = select('rule-acquire', ACQUIRE, 'acquire');
    this.stabilisation = select('rule-stabilisation', STABILISATION, 'stabilisation');
    const lost = toggle('rule-lostWarnings', t('Lost warnings'), (on) => order({ lostWarnings: on }));
    const associate = toggle('rule-associate', t('Join radar and AIS'), (on) => order({ associate: on }));
    this.boxes = { lostWarnings: following(lost.firstElementChild), associate: following(associate.firstElementChild) };
    const row = (words, control) => element('label', { className: 'row' }, element('span', { textContent: words }), control);
    this.element = element('div', { className: 'rules' }, row(t('Acquires'), this.acquire), row(t('Motion over'), this.stabilisation),
      element('div', { className: 'toggles two' }, lost, associate), element('div', { className: 'fields two' }, ...this.fields.map((field) => field.element)),
      this.problem, element('div', { className: 'actions' }, button('rules-default', t('As at the start'), () => this.orders.give({ defaultRules: true }, this.problem),
        { title: t('All rules as they were; zones go') })));
  }

  show(rules) {
    if (!rules) return;
    for (const field of this.fields) if (rules[field.rule.name] !== undefined) field.take(rules[field.rule.name]);
    for (const [name, box] of Object.entries(this.boxes)) follow(box, rules[name] === true);
    for (const name of ['acquire', 'stabilisation']) {
      if (rules[name] !== undefined) follow(this[name], String(rules[name]));
    }
  }
}
