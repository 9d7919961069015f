// Colours of the screen, as its button shows them.
import { PALETTE_ORDER } from './picture/picture_settings.js';
import { $ } from './widgets.js';

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
