// Controls: the panel's elements and the keys, joined to what they do.
import { capital, t } from './language/language.js';
import { PALETTE_ORDER } from './picture/picture_settings.js';
import { $ } from './widgets.js';

export { PictureSettings } from './picture/picture_settings.js';

// Colours of the screen; the button says what comes next.
export function showPalette(palette) {
  const next = nextPalette(palette);
  document.documentElement.dataset.palette = palette;
  $('palette').textContent = capital(t(next));
  $('palette').ariaLabel = t('Colours: {now}; press for {next}', { now: t(palette), next: t(next) });
}

export function nextPalette(palette) {
  return PALETTE_ORDER[(PALETTE_ORDER.indexOf(palette) + 1) % PALETTE_ORDER.length];
}

// Keys work anywhere but in a field that needs them itself.
export function bindKeys(actions) {
  document.addEventListener('keydown', (event) => {
    if (event.ctrlKey || event.altKey || event.metaKey || document.querySelector('dialog[open]')) return;
    // The space bar presses what the keyboard has reached.
    if (event.key === ' ' && event.target.matches?.(':is(button, input, select, a):focus-visible')) return;
    const field = event.target.closest?.('input, select');
    const moves = event.key.startsWith('Arrow') || ['Home', 'End', 'PageUp'].includes(event.key);
    if (field && (moves || field.matches('[type=number], [type=password], [type=text]') ||
                  (field.matches('select') && /^[a-z0-9]$/i.test(event.key)))) return;
    const action = actions[event.key] ?? actions[event.key.toLowerCase()];
    if (!action) return;
    action(event);
    event.preventDefault();
  });
}
