// Names from outside (ships, radars, scenarios, files) as they are shown: one line, at most MOST characters, and without
// the marks that would turn the writing direction of what stands around them. Names are text, never HTML.
const MOST = 60;
// Embeddings, overrides, isolates and marks of direction; controls, line and paragraph separators.
const MARKS = /[\u200e\u200f\u061c\u202a-\u202e\u2066-\u2069]/g;
const BREAKS = /[\u0000-\u001f\u007f-\u009f\u2028\u2029\s]+/g;

export function shortName(text, most = MOST) {
  // 10 kB are not searched for spaces: what is beyond will not be shown.
  const plain = String(text ?? '').slice(0, 8 * most).replace(MARKS, '').replace(BREAKS, ' ').trim();
  const letters = [...plain];
  return letters.length > most ? `${letters.slice(0, most - 1).join('')}\u2026` : plain;
}

// The same between marks that keep its direction to itself, for where there is no <bdi>: in options of a list.
export function isolated(text, most = MOST) {
  const name = shortName(text, most);
  return name && /[^\u0000-\u02ff\u2026]/.test(name) ? `\u2068${name}\u2069` : name;
}
