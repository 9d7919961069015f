// Keys work anywhere but in a field that needs them itself, and while a dialog is open.
import { keyOf } from './key_names.js';

const TEXTS = 'textarea, [contenteditable], input:is([type=number], [type=password], [type=text], [type=search], :not([type]))';
// What moves by arrows itself.
const MOVED = 'input:not([type=checkbox]), select, textarea, [role=tab], [role=slider], [role=listbox], [role=tabpanel]:focus-visible';

// Whether the arrows are for what has the focus now, not for the picture.
export function focusTakesArrows() {
  return document.activeElement?.closest(MOVED) !== null;
}

export function listenToKeys(table) {
  document.addEventListener('keydown', (event) => {
    if (event.defaultPrevented || document.querySelector('dialog[open]')) return;
    const target = event.target instanceof Element ? event.target : document.body;
    if (target.closest(TEXTS)) return;
    // The space bar and Enter press what the keyboard has reached.
    if ([' ', 'Enter'].includes(event.key) && target.closest(':is(button, input, select, a, summary):focus-visible')) return;
    if (/^(Arrow|Page|Home|End)/.test(event.key) && target.closest(MOVED)) return;
    if (target.closest('select') && /^[a-z0-9]$/i.test(event.key)) return;
    const action = table.actionOf(keyOf(event));
    if (!action) return;
    action.run(event);
    event.preventDefault();
  });
}
