// ListTable: all targets, sorted by a column; a row's number selects it.
import { NONE } from '../format.js';
import { later, t } from '../language/language.js';
import { button, element, say } from './dom.js';
import { cpaText, headingOf, isValid, nameOf, rangeText, tcpaText, unusualStateOf } from './readings.js';

// Each: heading, unit, and what is sorted by; what has no value comes last.
const COLUMNS = [
  ['number', later('Target'), '', ({ entry: { track, ais } }) => (track ? track.number : 1e7 + ais.mmsi)],
  ['range', later('column|Range'), 'NM', (shown) => shown.rangeM],
  ['cpa', later('CPA'), 'NM', (shown) => (isValid(shown) ? shown.from.cpaNm : undefined)],
  // What is past comes after what is to come.
  ['tcpa', later('TCPA'), 'min', (shown) => { const t = isValid(shown) ? shown.from.tcpaMin : undefined; return t < 0 ? 1e9 - t : t; }],
];

export class ListTable {
  // select(key): the operator chose a row.
  constructor(select) {
    this.select = select;
    this.sort = 'cpa';
    this.falls = false;
    this.rows = new Map();  // by key
    this.heads = COLUMNS.map(([name, words, unit]) => {
      const head = element('th', { scope: 'col' }, button(`sort-${name}`, t(words), () => this.#sortBy(name), { title: unit }));
      head.dataset.sort = name;
      return head;
    });
    this.trialHeads = ['CPA', 'TCPA'].map((words) =>
      element('th', { scope: 'col', textContent: `T ${words}`, ariaLabel: t('{value} of the trial', { value: words }), className: 'trial' }));
    this.body = element('tbody');
    this.table = element('table', { id: 'target-list', ariaLabel: t('All targets') },
      element('thead', {}, element('tr', {}, ...this.heads, ...this.trialHeads)), this.body);
    this.element = element('div', { className: 'list', tabIndex: 0, role: 'region', ariaLabel: t('List of targets') }, this.table);
    this.#showSort();
  }

  #sortBy(name) {
    this.falls = this.sort === name && !this.falls;
    this.sort = name;
    this.#showSort();
    if (this.last) this.show(...this.last);
  }

  #showSort() {
    for (const head of this.heads) head.ariaSort = head.dataset.sort !== this.sort ? 'none' : this.falls ? 'descending' : 'ascending';
  }

  // all: shownOf() of each; outcomes: of a trial by key, or null; selected: keys.
  show(all, outcomes, selected) {
    this.last = [all, outcomes, selected];
    const value = COLUMNS.find(([name]) => name === this.sort)[3];
    const keyed = all.map((shown) => ({ shown, value: value(shown) }));
    keyed.sort((a, b) => {
      if (a.value === undefined || b.value === undefined) return (a.value === undefined) - (b.value === undefined);
      return this.falls ? b.value - a.value : a.value - b.value;
    });
    // The trial takes the place of the range.
    for (const head of this.trialHeads) head.hidden = outcomes === null;
    this.heads[1].hidden = outcomes !== null;
    this.table.toggleAttribute('data-trial', outcomes !== null);
    const held = this.body.contains(document.activeElement) ? document.activeElement : null;
    const wanted = keyed.map(({ shown }) => this.#row(shown, outcomes, selected));
    const kept = new Set(wanted);
    for (const [key, row] of this.rows) if (!kept.has(row)) { row.remove(); this.rows.delete(key); }
    // Rows that stand right are not touched: whoever tabs through them keeps his place.
    wanted.forEach((row, i) => { if (this.body.children[i] !== row) this.body.insertBefore(row, this.body.children[i] ?? null); });
    if (held?.isConnected && document.activeElement !== held) held.focus({ preventScroll: true });
  }

  #row(shown, outcomes, selected) {
    let row = this.rows.get(shown.key);
    if (!row) {
      const choose = button(`list-${shown.key}`, '', () => this.select(shown.key));
      row = element('tr', {}, element('th', { scope: 'row' }, choose, element('span', { className: 'dim' })),
        ...Array.from({ length: 5 }, (_, i) => element('td', { className: i > 2 ? 'trial' : '' })));
      row.addEventListener('click', (event) => { if (!event.target.closest('button')) this.select(shown.key); });
      this.rows.set(shown.key, row);
    }
    const outcome = outcomes?.get(shown.key) ?? null;
    const [head, ...cells] = row.children;
    const [choose, words] = head.children;
    const isSelected = String(selected.includes(shown.key));
    if (choose.ariaPressed !== isSelected) { choose.ariaPressed = isSelected; row.classList.toggle('selected', isSelected === 'true'); }
    row.classList.toggle('dangerous', shown.isDangerous);
    row.classList.toggle('trial-dangerous', outcome?.isDangerous ?? false);
    say(choose, headingOf(shown.entry));
    const { track } = shown.entry;
    // The end is cut off where there is no room: of the name, not of the state.
    say(words, [shown.isDangerous ? '!' : '', unusualStateOf(shown),
      track ? (nameOf(shown.entry) === NONE ? '' : nameOf(shown.entry)) : 'AIS'].filter(Boolean).join(' '));
    const holds = isValid(shown);
    const texts = [rangeText(shown), holds ? cpaText(shown.from.cpaNm) : NONE, holds ? tcpaText(shown.from.tcpaMin) : NONE,
      outcome ? `${outcome.isDangerous ? '! ' : ''}${cpaText(outcome.cpaNm)}` : NONE, outcome ? tcpaText(outcome.tcpaMin) : NONE];
    texts.forEach((text, i) => say(cells[i], text));
    cells[3].hidden = cells[4].hidden = outcomes === null;
    cells[0].hidden = outcomes !== null;
    return row;
  }
}
