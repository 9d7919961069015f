// Controls: the panel's elements and the keys, joined to what they do.
import { $, showSlider } from './widgets.js';

const REMEMBERED = 'skerry.picture';
export const PALETTE_ORDER = ['day', 'dusk', 'night'];

// Colours of the screen; the button says what comes next.
export function showPalette(palette) {
  const next = nextPalette(palette);
  document.documentElement.dataset.palette = palette;
  $('palette').textContent = next[0].toUpperCase() + next.slice(1);
  $('palette').ariaLabel = `Colours: ${palette}; press for ${next}`;
}

export function nextPalette(palette) {
  return PALETTE_ORDER[(PALETTE_ORDER.indexOf(palette) + 1) % PALETTE_ORDER.length];
}

// Settings of this screen alone, kept in this browser.
export class PictureSettings {
  constructor() {
    Object.assign(this, { palette: 'day', headUp: false, afterglow: 25, trailS: 0, echo: 'yellow',
                          rings: true, headingLine: true });
    try {
      const kept = JSON.parse(localStorage.getItem(REMEMBERED)) ?? {};
      for (const [name, value] of Object.entries(kept)) {
        if (typeof this[name] === typeof value) this[name] = value;
      }
      if (!PALETTE_ORDER.includes(this.palette)) this.palette = 'day';
    } catch {
      // No settings kept, or not ours: the defaults stand.
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

// Shows the picture's settings in the panel and calls changed(values) when the operator changes one.  Gives what shows them
// anew.
export function bindPicture(picture, changed) {
  const show = () => {
    showPalette(picture.palette);
    document.querySelector(`input[name=orientation][value=${picture.headUp ? 'head' : 'north'}]`).checked = true;
    $('orientation').textContent = picture.headUp ? 'Head up' : 'North up';
    showSlider($('afterglow'), picture.afterglow);
    $('afterglow-value').textContent = String(picture.afterglow);
    $('trails').value = String(picture.trailS);
    $('echo').value = picture.echo;
    $('rings').checked = picture.rings;
    $('heading-line').checked = picture.headingLine;
  };
  const change = (values) => { changed(values); show(); };
  $('palette').addEventListener('click', () => change({ palette: nextPalette(picture.palette) }));
  for (const input of document.querySelectorAll('input[name=orientation]')) {
    input.addEventListener('change', () => change({ headUp: input.value === 'head' }));
  }
  $('afterglow').addEventListener('input', () => change({ afterglow: Number($('afterglow').value) }));
  $('trails').addEventListener('change', () => change({ trailS: Number($('trails').value) }));
  $('echo').addEventListener('change', () => change({ echo: $('echo').value }));
  $('rings').addEventListener('change', () => change({ rings: $('rings').checked }));
  $('heading-line').addEventListener('change', () => change({ headingLine: $('heading-line').checked }));
  show();
  return show;
}

// Keys work anywhere but in a field that needs them itself.
export function bindKeys(actions) {
  document.addEventListener('keydown', (event) => {
    if (event.ctrlKey || event.altKey || event.metaKey || $('help').open) return;
    // The space bar presses what the keyboard has reached.
    if (event.key === ' ' && event.target.matches?.(':is(button, input, select, a):focus-visible')) return;
    const field = event.target.closest?.('input, select');
    const arrow = event.key.startsWith('Arrow');
    if (field && (arrow || field.matches('[type=number], [type=password], [type=text]') ||
                  (field.matches('select') && /^[a-z0-9]$/i.test(event.key)))) return;
    const action = actions[event.key] ?? actions[event.key.toLowerCase()];
    if (!action) return;
    action(event);
    event.preventDefault();
  });
}
