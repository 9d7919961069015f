// Why a value was refused, beside the control that it was given to, for some seconds. The notice over the picture says the
// same, and is what a screen reader speaks.
import { t } from '../language/language.js';
import { shortName } from '../names.js';

const SHOWN_MS = 8000;
const ROWS = '.switched, .slider, .range, .row, .choice, .toggles, form, label';
const notes = new WeakMap();  // row: its note

export function showRefusal(element, why) {
  const row = element?.closest('.switched, .range') ?? element?.closest(ROWS);
  if (!row) return;
  clearRefusal(row);
  const note = document.createElement('p');
  note.className = 'refusal';
  note.textContent = t('refused: {why}', { why: shortName(why, 160) });
  row.after(note);
  notes.set(row, { note, timer: setTimeout(() => clearRefusal(row), SHOWN_MS) });
}

function clearRefusal(row) {
  const shown = notes.get(row);
  if (!shown) return;
  clearTimeout(shown.timer);
  shown.note.remove();
  notes.delete(row);
}
