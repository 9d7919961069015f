// ChartSettings: which parts of the chart are shown, and how brightly; kept in this browser.
import { $, showSlider } from '../widgets.js';

const KEY = 'skerry.chart';
const SWITCHES = { on: 'chart-on', coast: 'chart-coast', contours: 'chart-contours', buoys: 'chart-buoys', lines: 'chart-lines' };

export class ChartSettings {
  // changed(): something is shown, or not.
  constructor(changed) {
    // As performance standards have it, a radar begins without its chart.
    Object.assign(this, { on: false, coast: true, contours: true, buoys: true, lines: true, brilliance: 80 });
    try {
      const kept = JSON.parse(localStorage.getItem(KEY)) ?? {};
      for (const [name, id] of Object.entries(SWITCHES)) if (id && typeof kept[name] === 'boolean') this[name] = kept[name];
      if (kept.brilliance >= 10 && kept.brilliance <= 100) this.brilliance = kept.brilliance;
    } catch {
      // Nothing kept, or not ours: the defaults stand.
    }
    const change = (values) => {
      Object.assign(this, values);
      try {
        localStorage.setItem(KEY, JSON.stringify(this));
      } catch {
        // A browser that keeps nothing still shows a chart.
      }
      this.#show();
      changed();
    };
    for (const [name, id] of Object.entries(SWITCHES)) $(id).addEventListener('change', () => change({ [name]: $(id).checked }));
    $('chart-brilliance').addEventListener('input', () => change({ brilliance: Number($('chart-brilliance').value) }));
    this.#show();
  }

  #show() {
    for (const [name, id] of Object.entries(SWITCHES)) $(id).checked = this[name];
    for (const name of ['coast', 'contours', 'buoys']) $(SWITCHES[name]).disabled = !this.on;
    showSlider($('chart-brilliance'), this.brilliance);
    $('chart-brilliance-value').textContent = String(this.brilliance);
    $('chart').style.opacity = String(this.brilliance / 100);
  }
}
