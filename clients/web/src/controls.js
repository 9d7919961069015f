// Controls: the panel's elements and the keys, joined to what they do.
import { SharedSetting } from './shared_setting.js';
import { rangeNm as formatRange } from './format.js';

export const $ = (id) => document.getElementById(id);

const REMEMBERED = 'skerry.picture';

// What belongs to this screen alone, kept in this browser.
export class PictureSettings {
  constructor() {
    Object.assign(this, { palette: 'day', headUp: false, afterglow: 25, trailS: 0, echo: 'yellow',
                          rings: true, headingLine: true });
    try {
      const kept = JSON.parse(localStorage.getItem(REMEMBERED)) ?? {};
      for (const [name, value] of Object.entries(kept)) {
        if (typeof this[name] === typeof value) this[name] = value;
      }
    } catch {
      // Nothing kept, or not ours: the defaults stand.
    }
  }

  change(values) {
    Object.assign(this, values);
    try {
      localStorage.setItem(REMEMBERED, JSON.stringify(this));
    } catch {
      // A browser that keeps nothing still shows a picture.
    }
  }
}

function showSlider(slider, value) {
  slider.value = value;
  slider.style.setProperty('--part', `${value}%`);
}

// The receiver's settings and range: shared with every console on the same view.
// set(values): sends them, and returns the request number or null.
export class ReceiverControls {
  constructor(set) {
    this.set = set;
    this.scales = [];
    this.pending = new Map();  // request -> SharedSetting
    this.settings = {};
    for (const name of ['gain', 'sea', 'rain']) this.settings[name] = this.#slider(name);
    const select = $('range');
    this.settings.rangeNm = new SharedSetting((value) => this.#send('rangeNm', value), (value, pending) => {
      select.value = String(value);
      select.classList.toggle('pending', pending);
      $('range-less').disabled = this.scales.indexOf(value) === 0;
      $('range-more').disabled = this.scales.indexOf(value) === this.scales.length - 1;
    });
    select.addEventListener('change', () => this.settings.rangeNm.change(Number(select.value)));
    $('range-less').addEventListener('click', () => this.stepRange(-1));
    $('range-more').addEventListener('click', () => this.stepRange(1));
  }

  #slider(name) {
    const slider = $(name), output = $(`${name}-value`);
    const setting = new SharedSetting((value) => this.#send(name, value), (value, pending) => {
      showSlider(slider, value);
      output.textContent = String(Math.round(value));
      output.classList.toggle('pending', pending);
    });
    slider.addEventListener('input', () => setting.change(Number(slider.value)));
    return setting;
  }

  #send(name, value) {
    const request = this.set({ [name]: value });
    if (request === null) this.settings[name].settle();
    else this.pending.set(request, this.settings[name]);
    if (this.pending.size > 64) this.pending.delete(this.pending.keys().next().value);
  }

  // Whether the reply was to one of these controls.
  takeReply(reply) {
    const setting = this.pending.get(reply.request);
    this.pending.delete(reply.request);
    if (setting && reply.code !== 0) setting.settle();
    return setting !== undefined;
  }

  takeSettings(settings) {
    for (const name of ['gain', 'sea', 'rain', 'rangeNm']) this.settings[name].take(settings[name]);
  }

  setScales(scales) {
    this.scales = scales;
    $('range').replaceChildren(...scales.map((nm) => new Option(`${formatRange(nm)} NM`, String(nm))));
    if (this.settings.rangeNm.value() !== null) $('range').value = String(this.settings.rangeNm.value());
  }

  stepRange(by) {
    const at = this.scales.indexOf(this.settings.rangeNm.value());
    const next = this.scales[at + by];
    if (at >= 0 && next !== undefined) this.settings.rangeNm.change(next);
  }

  stepGain(by) {
    const gain = this.settings.gain.value();
    if (gain !== null) this.settings.gain.change(Math.min(100, Math.max(0, Math.round(gain) + by)));
  }
}

// Shows the picture's settings in the panel and calls changed(values) when the operator changes one.
export function bindPicture(picture, changed) {
  const show = () => {
    document.documentElement.dataset.palette = picture.palette;
    $('palette').textContent = picture.palette === 'day' ? 'Night' : 'Day';
    document.querySelector(`input[name=orientation][value=${picture.headUp ? 'head' : 'north'}]`).checked = true;
    $('mode').textContent = picture.headUp ? 'Head up' : 'North up';
    showSlider($('afterglow'), picture.afterglow);
    $('afterglow-value').textContent = String(picture.afterglow);
    $('trails').value = String(picture.trailS);
    $('echo').value = picture.echo;
    $('rings').checked = picture.rings;
    $('heading-line').checked = picture.headingLine;
  };
  const change = (values) => { changed(values); show(); };
  $('palette').addEventListener('click', () => change({ palette: picture.palette === 'day' ? 'night' : 'day' }));
  for (const input of document.querySelectorAll('input[name=orientation]')) {
    input.addEventListener('change', () => change({ headUp: input.value === 'head' }));
  }
  $('afterglow').addEventListener('input', () => change({ afterglow: Number($('afterglow').value) }));
  $('trails').addEventListener('change', () => change({ trailS: Number($('trails').value) }));
  $('echo').addEventListener('change', () => change({ echo: $('echo').value }));
  $('rings').addEventListener('change', () => change({ rings: $('rings').checked }));
  $('heading-line').addEventListener('change', () => change({ headingLine: $('heading-line').checked }));
  show();
}

// Keys work anywhere but in a field that needs them itself.
export function bindKeys(actions) {
  document.addEventListener('keydown', (event) => {
    if (event.ctrlKey || event.altKey || event.metaKey || $('help').open) return;
    const field = event.target.closest?.('input, select');
    const arrow = event.key.startsWith('Arrow');
    if (field && (arrow || field.matches('[type=number], [type=password]') ||
                  (field.matches('select') && /^[a-z0-9]$/i.test(event.key)))) return;
    const action = actions[event.key] ?? actions[event.key.toLowerCase()];
    if (!action) return;
    action(event);
    event.preventDefault();
  });
}
