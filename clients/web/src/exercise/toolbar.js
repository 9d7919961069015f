// The bar over the chart, and the tabs of the panel: which tool is in hand, and what is shown.
import { $, write } from '../widgets.js';
import { TOOLS } from './tools.js';

const ZOOM = 1.5;
const HINTS = {
  look: '',
  move: 'Drag a ship to put her elsewhere; the water moves the chart',
  target: 'Click where she shall be',
  route: 'Click the waypoints; double click or Done sends them',
  rain: 'Click where it shall rain',
};

export class Toolbar {
  constructor({ chart, tools, exercise, changed }) {
    Object.assign(this, { chart, tools, exercise, changed });
    for (const button of document.querySelectorAll('[data-tool-button]')) {
      button.addEventListener('click', () => tools.take(button.dataset.toolButton));
    }
    $('group').addEventListener('click', () => this.toggleGroup());
    $('zoom-in').addEventListener('click', () => this.zoom(1));
    $('zoom-out').addEventListener('click', () => this.zoom(-1));
    $('fit').addEventListener('click', () => chart.fitAll());
    $('vectors').addEventListener('change', () => {
      chart.vectorMin = Number($('vectors').value);
      chart.changed();
    });
    $('tracks').addEventListener('change', () => {
      chart.trackS = Number($('tracks').value);
      chart.changed();
    });
    $('rain-radius').addEventListener('input', () => chart.changed());
    $('route-done').addEventListener('click', () => tools.finish());
    $('route-back').addEventListener('click', () => tools.dropLast());
    for (const button of document.querySelectorAll('[data-cancel]'))
      button.addEventListener('click', () => tools.cancel());
    for (const button of document.querySelectorAll('[data-at-centre]')) {
      button.addEventListener('click', () =>
        tools.act({ latitudeDeg: chart.view.latitudeDeg, longitudeDeg: chart.view.longitudeDeg }),
      );
    }
    // The forms' fields: Enter does not send a page away.
    for (const form of document.querySelectorAll('#tool-forms form'))
      form.addEventListener('submit', (event) => event.preventDefault());
    $('rain-tool').addEventListener('click', () => tools.take('rain'));
    this.#bindTabs();
  }

  zoom(steps) {
    this.chart.moveTo((view) => view.zoomAt(ZOOM ** steps));
  }

  toggleGroup() {
    this.exercise.grouping = !this.exercise.grouping;
    this.changed();
  }

  #bindTabs() {
    const tabs = [...document.querySelectorAll('[role=tab]')];
    for (const tab of tabs) {
      tab.addEventListener('click', () => this.showTab(tab.dataset.tab));
      tab.addEventListener('keydown', (event) => {
        const step = { ArrowRight: 1, ArrowLeft: tabs.length - 1 }[event.key];
        if (!step) return;
        const next = tabs[(tabs.indexOf(tab) + step) % tabs.length];
        this.showTab(next.dataset.tab);
        next.focus();
        event.preventDefault();
        event.stopPropagation();
      });
    }
    this.showTab('ships');
  }

  showTab(name) {
    for (const tab of document.querySelectorAll('[role=tab]')) {
      const is = tab.dataset.tab === name;
      tab.setAttribute('aria-selected', String(is));
      tab.tabIndex = is ? 0 : -1;
      $(`tab-${tab.dataset.tab}`).hidden = !is;
    }
  }

  show() {
    const { tools, exercise } = this;
    document.body.dataset.tool = tools.name;
    for (const button of document.querySelectorAll('[data-tool-button]'))
      button.setAttribute('aria-pressed', String(button.dataset.toolButton === tools.name));
    $('rain-tool').setAttribute('aria-pressed', String(tools.name === 'rain'));
    $('group').setAttribute('aria-pressed', String(exercise.grouping));
    for (const name of TOOLS) if ($(`tool-${name}`)) $(`tool-${name}`).hidden = tools.name !== name;
    write('hint', HINTS[tools.name]);
    $('hint').hidden = HINTS[tools.name] === '';
    $('tool-forms').hidden = tools.name === 'look';
    $('route-done').disabled = $('route-back').disabled = tools.waypoints.length === 0;
    write(
      'route-count',
      tools.name === 'route'
        ? `${exercise.chosenTargets.map((ship) => ship.name).join(', ')}: ${tools.waypoints.length} waypoints`
        : '',
    );
  }
}
