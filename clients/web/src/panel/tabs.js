// The tabs of the panel: each <section data-tab="..."> of #tab-sections goes into the tab of that name, in the order of
// the file; one without a tab that is known goes into the last. Tabs without a section are left out.
// By mouse, touch and keys: Left, Right, Home and End in the list of tabs (WAI-ARIA, tabs with automatic activation).
// The chosen tab is kept in this browser.
import { later, t } from '../language/language.js';

const REMEMBERED = 'skerry.tab';
export const TABS = [
  ['radar', later('Radar')], ['targets', later('Targets')], ['tools', later('Tools')], ['chart', later('Chart')], ['set-up', later('Set-up')],
];

function kept() {
  try { return localStorage.getItem(REMEMBERED); } catch { return null; }
}

export class Tabs {
  // list: the element of the tabs; place: of the sections.
  constructor(list, place) {
    this.list = list;
    this.tabs = [];
    const names = TABS.map(([name]) => name);
    const sections = [...place.querySelectorAll(':scope > section')];
    const tabOf = (section) => (names.includes(section.dataset.tab) ? section.dataset.tab : names.at(-1));
    for (const [name, title] of TABS) {
      const own = sections.filter((section) => tabOf(section) === name);
      if (own.length > 0) this.#add(place, name, title, own);
    }
    list.addEventListener('keydown', (event) => this.#press(event));
    this.show(kept());
  }

  #add(place, name, title, sections) {
    const tab = document.createElement('button');
    Object.assign(tab, { type: 'button', id: `tab-${name}`, role: 'tab', textContent: t(title) });
    tab.setAttribute('aria-controls', `sections-${name}`);
    tab.addEventListener('click', () => this.show(name, true));
    const panel = document.createElement('div');
    Object.assign(panel, { id: `sections-${name}`, role: 'tabpanel', tabIndex: 0 });
    panel.setAttribute('aria-labelledby', tab.id);
    panel.append(...sections);
    place.append(panel);
    this.list.append(tab);
    this.tabs.push({ name, tab, panel });
  }

  // The first tab, if there is none of that name.
  show(name, remember = false) {
    const chosen = this.tabs.find((each) => each.name === name) ?? this.tabs[0];
    for (const each of this.tabs) {
      const on = each === chosen;
      each.tab.setAttribute('aria-selected', String(on));
      each.tab.tabIndex = on ? 0 : -1;
      each.panel.hidden = !on;
    }
    this.shown = chosen?.name;
    if (!remember) return;
    try { localStorage.setItem(REMEMBERED, this.shown); } catch { /* A browser that keeps nothing begins with the first. */ }
  }

  #press(event) {
    const at = this.tabs.findIndex(({ name }) => name === this.shown), count = this.tabs.length;
    const next = { ArrowRight: (at + 1) % count, ArrowLeft: (at + count - 1) % count, Home: 0, End: count - 1 }[event.key];
    if (next === undefined) return;
    event.preventDefault();
    event.stopPropagation();
    this.show(this.tabs[next].name, true);
    this.tabs[next].tab.focus();
  }
}
