// Which language the page is in: ?lang=de in its address, else what was chosen in the tab Set-up (kept in this browser), else the
// browser's own, else English.
import { inLanguage } from '../panel/script_errors.js';
import { shortName } from '../names.js';
import { chooseLanguage, LANGUAGES, speak, t, wordsOf } from './language.js';
import { translatePage } from './page_words.js';

const REMEMBERED = 'skerry.language';
const WAIT_MS = 8000;

function kept() {
  try { return localStorage.getItem(REMEMBERED); } catch { return null; }
}

async function load(code) {
  const response = await fetch(new URL(`../../languages/${code}.json`, import.meta.url), { signal: AbortSignal.timeout(WAIT_MS) });
  if (!response.ok) throw new Error(`HTTP status ${response.status}`);
  return wordsOf(await response.json());
}

// Puts the page into its language. Gives what was wrong, for the operator, or ''.
export async function openLanguage() {
  const asked = new URLSearchParams(location.search).get('lang');
  const code = chooseLanguage(asked, kept(), navigator.languages ?? []);
  bindChoice(code);
  // English costs nothing.
  if (code === 'en') return unknown(asked);
  try {
    speak(code, await load(code));
  } catch (error) {
    console.warn(`languages/${code}.json:`, error);
    return `The file of this language cannot be read, the page is in English: ${shortName(error.message, 120)}`;
  }
  document.documentElement.lang = code;
  translatePage();
  inLanguage(t);
  return unknown(asked);
}

function unknown(asked) {
  const known = asked === null || LANGUAGES.some(([code]) => code === asked.toLowerCase().split('-')[0]);
  return known ? '' : t('This console has no language {code}', { code: shortName(asked, 12) });
}

// Each language is named in itself.
function bindChoice(code) {
  const select = document.getElementById('language');
  select.replaceChildren(...LANGUAGES.map(([each, name]) => Object.assign(new Option(name, each), { lang: each, translate: false })));
  select.value = code;
  select.addEventListener('change', () => {
    try { localStorage.setItem(REMEMBERED, select.value); } catch { /* Then the address says it. */ }
    const address = new URL(location.href);
    if (kept() === select.value) address.searchParams.delete('lang');
    else address.searchParams.set('lang', select.value);
    if (address.href === location.href) location.reload();
    else location.replace(address);
  });
}
