// The language of the page. Sources are in English, and the English text is the key of every other language (as of gettext); what a
// language lacks is shown in English. Numbers, units and abbreviations of the standards (standard_words.js) are the same in all of
// them, and what comes from outside (names, the server's texts) is never translated.
//
//   t('Picture held')                        always a literal, so that a test finds every text
//   t('Retry in {seconds} s', { seconds })   with values; `n`, if there is one, chooses the plural form
//   t('scale|Range')                         what stands before | tells apart two uses of a word, and is never shown
//   later('Alarm')                           in a table that is made before the language is there: t(TABLE[i]) where it is shown

import { isStandard } from './standard_words.js';

// A new language: languages/<code>.json, its line in files.txt, and its row here, named in itself.
export const LANGUAGES = [['en', 'English'], ['de', 'Deutsch']];

const spoken = { code: 'en', words: new Map(), plurals: new Intl.PluralRules('en'), lacking: new Set() };

// words: as of wordsOf(); of English none.
export function speak(code, words = new Map()) {
  Object.assign(spoken, { code, words, plurals: new Intl.PluralRules(code), lacking: new Set() });
}

export const later = (text) => text;
// The first letter large: of a word that begins something.
export const capital = (text) => text.charAt(0).toUpperCase() + text.slice(1);

export function t(text, values) {
  const found = spoken.words.get(text) ?? english(text);
  const form = typeof found === 'string' ? found : found[spoken.plurals.select(values?.n)] ?? found.other;
  return values ? form.replace(/\{(\w+)\}/g, (all, name) => String(values[name] ?? all)) : form;
}

function english(text) {
  if (spoken.code !== 'en' && !spoken.lacking.has(text) && !isStandard(text)) {
    spoken.lacking.add(text);
    console.info(`languages/${spoken.code}.json lacks: ${text}`);
  }
  return text.slice(text.indexOf('|') + 1);
}

const isForm = (value) => typeof value === 'string' && value !== '';
const isPlural = (value) => typeof value === 'object' && value !== null && isForm(value.other) && Object.values(value).every(isForm);

// The parsed file of a language as a map; entries that are neither a text nor plural forms ({ one, other }) are left out.
// Error: throws of what is no object of entries.
export function wordsOf(file) {
  if (typeof file !== 'object' || file === null || Array.isArray(file)) throw new Error('it is no table of texts');
  return new Map(Object.entries(file).filter(([, value]) => isForm(value) || isPlural(value)));
}

// asked: of the page's address; kept: in this browser; either may be null. wanted: the browser's languages, the dearest first.
export function chooseLanguage(asked, kept, wanted) {
  const known = (code) => LANGUAGES.find(([each]) => each === String(code).toLowerCase().split('-')[0])?.[0];
  return known(asked) ?? known(kept) ?? wanted.map(known).find(Boolean) ?? 'en';
}
