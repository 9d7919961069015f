// ReceiverControls: the controls of the view and of the radar behind it, joined to what they do.
import { widgetOf } from './controls_table.js';
import { rangeNm as formatRange } from './format.js';
import { later, t } from './language/language.js';
import { showRefusal } from './panel/refusal.js';
import { PendingRequests, SharedSetting } from './shared_setting.js';
import { $, bindChoice, bindNumber, bindSlider, bindSwitch } from './widgets.js';

// What keys step, as it is said.
const NAMES = { gain: later('gain'), sea: later('sea'), rain: later('rain'), tune: later('tune') };
const BIND = { slider: bindSlider, switch: bindSwitch, choice: bindChoice, number: bindNumber };

// "350-10, 120-150" or "" as sectors; null if it is neither.
export function sectorsOf(text) {
  const parts = text.split(/[,;]/).map((part) => part.trim()).filter(Boolean);
  const sectors = parts.map((part) => /^(\d+(?:\.\d+)?)\s*[-\u2013]\s*(\d+(?:\.\d+)?)$/.exec(part));
  if (sectors.length > 4 || sectors.includes(null)) return null;
  const all = sectors.map(([, from, to]) => ({ fromDeg: Number(from), toDeg: Number(to) }));
  return all.every(({ fromDeg, toDeg }) => fromDeg <= 360 && toDeg <= 360) ? all : null;
}

export function sectorsText(sectors) {
  return (sectors ?? []).map(({ fromDeg, toDeg }) => `${fromDeg}-${toDeg}`).join(', ');
}

// Shared with every console on the same view; pulse, tuning and standby with every one on the radar.
// controls: the table's, whose elements buildPanel() has made.  set(values): sends them, and returns the request
// number or null.  notify(text, kind): to the operator.
export class ReceiverControls {
  constructor(controls, set, notify) {
    this.set = set;
    this.notify = notify;
    this.scales = [];
    this.pending = new PendingRequests();
    this.settings = {};
    this.names = controls.filter(widgetOf).map(({ name }) => name);
    for (const control of controls.filter(widgetOf)) {
      const { name } = control;
      this.settings[name] = BIND[widgetOf(control)](name, (value) => this.#send(name, value));
    }
    $('blankedSectors').addEventListener('change', () => this.#changeSectors());
    this.settings.transmit = new SharedSetting((value) => this.#send('transmit', value), (value) => {
      document.querySelector(`input[name=transmit][value=${value ? 'on' : 'off'}]`).checked = true;
    }, (why) => showRefusal($('transmit-on'), why));
    for (const input of document.querySelectorAll('input[name=transmit]')) {
      input.addEventListener('change', () => this.settings.transmit.change(input.value === 'on'));
    }
    const select = $('range');
    this.settings.rangeNm = new SharedSetting((value) => this.#send('rangeNm', value), (value, pending) => {
      select.value = String(value);
      select.classList.toggle('pending', pending);
      this.#limitRange(value);
    }, (why) => showRefusal(select, why));
    select.addEventListener('change', () => this.settings.rangeNm.change(Number(select.value)));
    $('range-less').addEventListener('click', () => this.stepRange(-1));
    $('range-more').addEventListener('click', () => this.stepRange(1));
  }

  #changeSectors() {
    const field = $('blankedSectors');
    const sectors = sectorsOf(field.value);
    field.setCustomValidity(sectors ? '' : t('Up to four sectors from-to in degrees from the bow, as 350-10'));
    if (sectors) this.pending.add(this.set({ blankedSectors: sectors }), { settle: () => {}, refused: (why) => showRefusal(field, why) });
    else field.reportValidity();
  }

  #send(name, value) {
    this.pending.add(this.set({ [name]: value }), this.settings[name]);
  }

  takeReply(reply, why) {
    this.pending.takeReply(reply, why);
  }

  // An own view shows at most what is on the air. The buttons can still be pressed at an end of the scales: they say why
  // nothing follows.
  #limitRange(value) {
    const most = this.scales.indexOf(this.longestNm ?? this.scales.at(-1));
    $('range-less').setAttribute('aria-disabled', String(this.scales.indexOf(value) === 0));
    $('range-more').setAttribute('aria-disabled', String(this.scales.indexOf(value) >= most));
    for (const option of $('range').options) option.disabled = Number(option.value) > this.scales[most];
  }

  takeSettings(settings) {
    this.longestNm = settings.view === 0 ? undefined : settings.radarRangeNm;
    for (const name of [...this.names, 'rangeNm']) this.settings[name].take(settings[name]);
    this.settings.transmit.take(!settings.standby);
    $('sea').classList.toggle('trims', settings.seaAuto);
    // An automatic control has no use for its slider.
    $('gain').classList.toggle('idle', settings.gainAuto || settings.mode !== 0);
    $('sideLobeSuppression').classList.toggle('idle', settings.sideLobeAuto || settings.mode !== 0);
    if (document.activeElement !== $('blankedSectors')) {
      $('blankedSectors').value = sectorsText(settings.blankedSectors?.sectors);
      $('blankedSectors').setCustomValidity('');
    }
    $('pulse-now').textContent = settings.pulseLengthUs > 0
      ? `${Number(settings.pulseLengthUs.toPrecision(3))} µs, ${Math.round(settings.prfHz)} Hz` : '';
  }

  setScales(scales) {
    this.scales = scales;
    $('range').replaceChildren(...scales.map((nm) => new Option(`${formatRange(nm)} NM`, String(nm))));
    if (this.settings.rangeNm.value() !== null) $('range').value = String(this.settings.rangeNm.value());
  }

  stepRange(by) {
    const at = this.scales.indexOf(this.settings.rangeNm.value());
    if ($('range').disabled) { this.notify(t('Locked by the instructor: {name}', { name: t('range') }), 'info'); return; }
    if (at < 0) return;
    const next = this.scales[at + by];
    if (next === undefined) {
      this.notify(by > 0 ? t('{range} NM is the longest range of this radar', { range: formatRange(this.scales[at]) })
        : t('{range} NM is the shortest range of this radar', { range: formatRange(this.scales[at]) }), 'info');
    } else if (this.longestNm && next > this.longestNm) {
      this.notify(t('Own views reach as far as the radar\u2019s range, {range} NM', { range: formatRange(this.longestNm) }), 'info');
    } else {
      this.settings.rangeNm.change(next);
    }
  }

  // name: of a control of 0 to 100.
  step(name, by) {
    const value = this.settings[name]?.value() ?? null;
    if ($(name)?.disabled) this.notify($(name).classList.contains('locked') ? t('Locked by the instructor: {name}', { name: t(NAMES[name]) }) : t('Set by itself: {name}', { name: t(NAMES[name]) }), 'info');
    else if (value !== null) this.settings[name].change(Math.min(100, Math.max(0, Math.round(value) + by)));
  }
}
