// DataPanel: the selected targets side by side, at most four.
import { t } from '../language/language.js';
import { button, element, say } from './dom.js';
import { headingOf, readings, stateOf } from './readings.js';

export class DataPanel {
  // orders: TargetOrders; store: TargetStore; problem: the element that says what was refused; changed(): what is selected has.
  constructor({ orders, store, problem, changed }) {
    Object.assign(this, { orders, store, problem, changed });
    this.head = element('tr');
    this.body = element('tbody');
    this.foot = element('tr');
    this.table = element('table', { id: 'target-data', ariaLabel: t('Selected targets') },
      element('thead', {}, this.head), this.body, element('tfoot', {}, this.foot));
    this.none = element('p', { className: 'hint', textContent: t('Press on a symbol to see its data.') });
    this.element = element('div', {}, this.none, this.table);
    this.shape = null;
  }

  // columns: [{ shown, outcome }]; outcome: of a trial, null if there is none of this target, undefined without a trial.
  show(columns, headingDeg) {
    this.none.hidden = columns.length > 0;
    this.table.hidden = columns.length === 0;
    if (columns.length === 0) { this.shape = null; return; }
    const read = columns.map(({ shown, outcome }) => readings(shown, headingDeg, outcome));
    // What is pressed must not be made anew under the finger: only if other targets or other buttons stand here.
    const shape = JSON.stringify([read[0].length, columns.map(({ shown }) => [shown.key, this.#choices(shown).map(([id]) => id)])]);
    if (shape !== this.shape) this.#build(columns, read[0]);
    this.shape = shape;
    columns.forEach(({ shown }, i) => {
      const state = shown.isDangerous ? 'dangerous' : '';
      this.head.children[i + 1].className = state;
      say(this.head.children[i + 1].firstElementChild, `${shown.isDangerous ? '! ' : ''}${headingOf(shown.entry)}`);
      this.head.children[i + 1].title = `${headingOf(shown.entry)} ${stateOf(shown)}`;
      read[i].forEach(([, , text], row) => say(this.body.children[row].children[i + 1], text));
    });
  }

  #build(columns, rows) {
    this.head.replaceChildren(element('td'), ...columns.map(({ shown }) => element('th', { scope: 'col' }, element('span'),
      button(`unselect-${shown.key}`, '\u00d7', () => { this.store.toggle(shown.key); this.changed(); }, { ariaLabel: t('Unselect {target}', { target: headingOf(shown.entry) }) }))));
    this.body.replaceChildren(...rows.map(([label, unit]) => element('tr', {}, element('th', { scope: 'row' }, label,
      unit ? element('span', { className: 'unit', textContent: unit }) : null), ...columns.map(() => element('td', { className: unit ? '' : 'words' })))));
    this.table.dataset.columns = String(columns.length);
    this.foot.replaceChildren(element('td'), ...columns.map(({ shown }) => element('td', {},
      ...this.#choices(shown).map(([id, words, order]) => button(`${id}-${shown.key}`, words, () => this.orders.give(order, this.problem))))));
  }

  #choices({ entry: { track, ais } }) {
    const choices = [];
    if (track && !track.isTest) {
      choices.push(track.isReference ? ['unset-reference', t('Not ref.'), { reference: 0 }] : ['set-reference', t('Ref.'), { reference: track.number }]);
    }
    if (ais && !track) choices.push(ais.isActivated ? ['sleep', t('Sleep'), { letSleep: [ais.mmsi] }] : ['activate', t('Activate'), { activate: [ais.mmsi] }]);
    return choices;
  }
}
