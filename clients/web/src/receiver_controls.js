// ReceiverControls: the controls of the view and of the radar behind it, joined to what they do.
import { $ } from './controls.js';
import { rangeNm as formatRange } from './format.js';
import { SharedSetting } from './shared_setting.js';

const SLIDERS = ['gain', 'sea', 'rain', 'interferenceRejection', 'echoStretch', 'integration', 'tune',
  'sideLobeSuppression', 'noiseRejection', 'targetSeparation', 'targetBoost'];
const SWITCHES = ['gainAuto', 'seaAuto', 'stretchBearing', 'sideLobeAuto', 'tuneAuto'];
const SELECTS = ['pulse', 'decimation', 'mode', 'doppler'];
const NUMBERS = ['dopplerThresholdMps', 'rotationRpm', 'bearingAlignmentDeg', 'antennaHeightM'];

export function showSlider(slider, value) {
  slider.value = value;
  const least = Number(slider.min), most = Number(slider.max);
  slider.style.setProperty('--part', `${((value - least) / (most - least)) * 100}%`);
}

// A slider, its number beside it, and the value they stand for.
export function bindSlider(id, send, text = (value) => String(Math.round(value))) {
  const slider = $(id), output = $(`${id}-value`);
  const setting = new SharedSetting(send, (value, pending) => {
    showSlider(slider, value);
    output.textContent = text(value);
    output.classList.toggle('pending', pending);
  });
  slider.addEventListener('input', () => setting.change(Number(slider.value)));
  return setting;
}

export function bindSwitch(id, send) {
  const box = $(id);
  const setting = new SharedSetting(send, (value) => { box.checked = value; });
  box.addEventListener('change', () => setting.change(box.checked));
  return setting;
}

// A field for a number; what is being typed is not overwritten.
export function bindNumber(id, send) {
  const field = $(id);
  const setting = new SharedSetting(send, (value) => {
    if (document.activeElement !== field) field.value = String(Number(value.toFixed(2)));
  });
  field.addEventListener('change', () => {
    if (field.validity.valid && field.value !== '') setting.change(field.valueAsNumber);
    else if (setting.value() !== null) field.value = String(setting.value());
  });
  return setting;
}

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

// Which requests are under way and whose they are.
export class PendingRequests {
  constructor() {
    this.owners = new Map();  // request -> SharedSetting
  }

  // `request` is null if it could not be sent.
  add(request, setting) {
    if (request === null) { setting.settle(); return; }
    this.owners.set(request, setting);
    if (this.owners.size > 64) this.owners.delete(this.owners.keys().next().value);
  }

  // A refused value gives way to the server's.
  takeReply(reply) {
    const setting = this.owners.get(reply.request);
    this.owners.delete(reply.request);
    if (setting && reply.code !== 0) setting.settle();
  }
}

// Shared with every console on the same view; pulse, tuning and standby with every one on the radar.
// set(values): sends them, and returns the request number or null.
export class ReceiverControls {
  constructor(set) {
    this.set = set;
    this.scales = [];
    this.pending = new PendingRequests();
    this.settings = {};
    for (const name of SLIDERS) this.settings[name] = bindSlider(name, (value) => this.#send(name, value));
    for (const name of SWITCHES) this.settings[name] = bindSwitch(name, (value) => this.#send(name, value));
    for (const name of SELECTS) this.settings[name] = this.#select(name);
    for (const name of NUMBERS) this.settings[name] = bindNumber(name, (value) => this.#send(name, value));
    $('blankedSectors').addEventListener('change', () => this.#changeSectors());
    this.settings.transmit = new SharedSetting((value) => this.#send('transmit', value), (value) => {
      document.querySelector(`input[name=transmit][value=${value ? 'on' : 'off'}]`).checked = true;
    });
    for (const input of document.querySelectorAll('input[name=transmit]')) {
      input.addEventListener('change', () => this.settings.transmit.change(input.value === 'on'));
    }
    const select = $('range');
    this.settings.rangeNm = new SharedSetting((value) => this.#send('rangeNm', value), (value, pending) => {
      select.value = String(value);
      select.classList.toggle('pending', pending);
      this.#limitRange(value);
    });
    select.addEventListener('change', () => this.settings.rangeNm.change(Number(select.value)));
    $('range-less').addEventListener('click', () => this.stepRange(-1));
    $('range-more').addEventListener('click', () => this.stepRange(1));
  }

  #select(name) {
    const select = $(name);
    const setting = new SharedSetting((value) => this.#send(name, value), (value) => { select.value = String(value); });
    select.addEventListener('change', () => setting.change(Number(select.value)));
    return setting;
  }

  #changeSectors() {
    const field = $('blankedSectors');
    const sectors = sectorsOf(field.value);
    field.setCustomValidity(sectors ? '' : 'Up to four sectors from-to in degrees from the bow, as 350-10');
    if (sectors) this.set({ blankedSectors: sectors });
    else field.reportValidity();
  }

  #send(name, value) {
    this.pending.add(this.set({ [name]: value }), this.settings[name]);
  }

  takeReply(reply) {
    this.pending.takeReply(reply);
  }

  // An own view shows at most what is on the air.
  #limitRange(value) {
    const most = this.scales.indexOf(this.longestNm ?? this.scales.at(-1));
    $('range-less').disabled = this.scales.indexOf(value) === 0;
    $('range-more').disabled = this.scales.indexOf(value) >= most;
    for (const option of $('range').options) option.disabled = Number(option.value) > this.scales[most];
  }

  takeSettings(settings) {
    this.longestNm = settings.view === 0 ? undefined : settings.radarRangeNm;
    for (const name of [...SLIDERS, ...SWITCHES, ...SELECTS, ...NUMBERS, 'rangeNm']) this.settings[name].take(settings[name]);
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
    const next = this.scales[at + by];
    if (at < 0 || next === undefined || (this.longestNm && next > this.longestNm)) return;
    this.settings.rangeNm.change(next);
  }

  stepGain(by) {
    const gain = this.settings.gain.value();
    if (gain !== null) this.settings.gain.change(Math.min(100, Math.max(0, Math.round(gain) + by)));
  }
}
