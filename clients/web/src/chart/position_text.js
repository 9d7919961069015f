// Positions as a mariner types them: 60 23.55 N, 60°23.550′N, N60.3925, 5 19 24 E. Every text is a position or is refused with what was
// expected.
import { later, t } from '../language/language.js';

const AXES = {
  latitude: { word: later('latitude'), letters: 'NS', most: 90, example: '60 23.550 N' },
  longitude: { word: later('longitude'), letters: 'EW', most: 180, example: '005 19.398 E' },
};

// { deg } or { wrong }, a sentence for beside the field.
export function parsePosition(text, axis) {
  const { letters, most, example } = AXES[axis], word = t(AXES[axis].word);
  const refuse = (what) => ({ wrong: t('{what}; expected degrees and minutes with {positive} or {negative}, such as {example}', { what, positive: letters[0], negative: letters[1], example }) });
  const given = text.trim().toUpperCase().replace(/[′’‘]/g, "'").replace(/[″”“]/g, '"').replace(/,/g, '.');
  if (given === '') return refuse(t('nothing is entered'));
  const found = /^([A-Z]?)\s*([^A-Z]*?)\s*([A-Z]?)$/.exec(given);
  if (!found || (found[1] && found[3])) return refuse(t('it cannot be read'));
  const letter = found[1] || found[3];
  if (letter === '') return refuse(t('{positive} or {negative} is missing', { positive: letters[0], negative: letters[1] }));
  if (!letters.includes(letter)) return refuse(t('{letter} is no {axis}', { letter, axis: word }));
  const numbers = /^(\d{1,3}(?:\.\d+)?)(?:[°\s-]+(\d{1,2}(?:\.\d+)?))?(?:['\s-]+(\d{1,2}(?:\.\d+)?))?[°'"\s]*$/.exec(found[2]);
  if (!numbers) return refuse(t('it cannot be read'));
  const [d, m, s] = [numbers[1], numbers[2], numbers[3]].map((part) => (part === undefined ? 0 : Number(part)));
  if (numbers[2] !== undefined && numbers[1].includes('.')) return refuse(t('degrees with a fraction have no minutes'));
  if (numbers[3] !== undefined && numbers[2].includes('.')) return refuse(t('minutes with a fraction have no seconds'));
  if (m >= 60 || s >= 60) return refuse(m >= 60 ? t('minutes are 60 or more') : t('seconds are 60 or more'));
  const deg = d + m / 60 + s / 3600;
  if (deg > most) return refuse(t('{axis} is above {most} degrees', { axis: word, most }));
  return { deg: letter === letters[1] ? -deg || 0 : deg };
}
