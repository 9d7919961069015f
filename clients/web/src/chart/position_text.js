// Positions as a mariner types them: 60 23.55 N, 60°23.550′N, N60.3925, 5 19 24 E. Every text is a position or is refused with what was
// expected.
const AXES = {
  latitude: { letters: 'NS', most: 90, example: '60 23.550 N' },
  longitude: { letters: 'EW', most: 180, example: '005 19.398 E' },
};

// { deg } or { wrong }, a sentence for beside the field.
export function parsePosition(text, axis) {
  const { letters, most, example } = AXES[axis];
  const refuse = (what) => ({ wrong: `${what}; expected degrees and minutes with ${letters[0]} or ${letters[1]}, such as ${example}` });
  const given = text.trim().toUpperCase().replace(/[′’‘]/g, "'").replace(/[″”“]/g, '"').replace(/,/g, '.');
  if (given === '') return refuse('nothing is entered');
  const found = /^([A-Z]?)\s*([^A-Z]*?)\s*([A-Z]?)$/.exec(given);
  if (!found || (found[1] && found[3])) return refuse('it cannot be read');
  const letter = found[1] || found[3];
  if (letter === '') return refuse(`${letters[0]} or ${letters[1]} is missing`);
  if (!letters.includes(letter)) return refuse(`${letter} is no ${axis}`);
  const numbers = /^(\d{1,3}(?:\.\d+)?)(?:[°\s-]+(\d{1,2}(?:\.\d+)?))?(?:['\s-]+(\d{1,2}(?:\.\d+)?))?[°'"\s]*$/.exec(found[2]);
  if (!numbers) return refuse('it cannot be read');
  const [d, m, s] = [numbers[1], numbers[2], numbers[3]].map((part) => (part === undefined ? 0 : Number(part)));
  if (numbers[2] !== undefined && numbers[1].includes('.')) return refuse('degrees with a fraction have no minutes');
  if (numbers[3] !== undefined && numbers[2].includes('.')) return refuse('minutes with a fraction have no seconds');
  if (m >= 60 || s >= 60) return refuse(`${m >= 60 ? 'minutes' : 'seconds'} are 60 or more`);
  const deg = d + m / 60 + s / 3600;
  if (deg > most) return refuse(`${axis} is above ${most} degrees`);
  return { deg: letter === letters[1] ? -deg || 0 : deg };
}
