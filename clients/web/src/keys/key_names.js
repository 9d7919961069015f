// Names of keys, as the table of keys keeps them: a letter in small ('g', with Shift 'Shift+g'), a sign as it is typed
// ('+', '?'; Shift belongs to the sign, for keyboards differ in which need it), and 'ArrowLeft', 'Enter', 'F2' as
// browsers say, with 'Shift+' before them.
import { later, t } from '../language/language.js';

const SHOWN = { ArrowLeft: '←', ArrowRight: '→', ArrowUp: '↑', ArrowDown: '↓', '-': '−' };
// As browsers say; what is not here is written as it is.
const NAMED = {
  Shift: later('key|Shift'), Enter: later('key|Enter'), Delete: later('key|Delete'), Backspace: later('key|Backspace'), Insert: later('key|Insert'),
  Home: later('key|Home'), End: later('key|End'), PageUp: later('key|PageUp'), PageDown: later('key|PageDown'), ' ': later('key|Space'),
};
const NEVER = ['Shift', 'Control', 'Alt', 'AltGraph', 'Meta', 'CapsLock', 'Dead', 'Process', 'Unidentified', 'Tab', 'Escape'];

// The name of the key that was pressed; null of one that is none of ours, or that the browser wants for itself.
export function keyOf(event) {
  const { key } = event;
  if (event.ctrlKey || event.altKey || event.metaKey || NEVER.includes(key)) return null;
  const isSign = [...key].length === 1, isLetter = isSign && key.toLowerCase() !== key.toUpperCase();
  const named = isSign ? key.toLowerCase() : key;
  return event.shiftKey && (isLetter || !isSign) ? `Shift+${named}` : named;
}

// As it is written on the keys: 'Shift+g' as ['Shift', 'G'].
export function writtenKey(name) {
  const parts = name.startsWith('Shift+') ? ['Shift', name.slice(6)] : [name];
  return parts.map((part) => (NAMED[part] ? t(NAMED[part]) : SHOWN[part]) ?? (part.length === 1 ? part.toUpperCase() : part));
}
