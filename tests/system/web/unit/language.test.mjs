// The languages of the console's page: every text has its entry and every entry its text.
import assert from 'node:assert/strict';
import { readdirSync, readFileSync } from 'node:fs';
import { afterEach, test } from 'node:test';
import { capital, chooseLanguage, LANGUAGES, speak, t, wordsOf } from '../../../../clients/web/src/language/language.js';
import { isStandard } from '../../../../clients/web/src/language/standard_words.js';
import { writtenKey } from '../../../../clients/web/src/keys/key_names.js';
import { CONTROLS, WEB } from '../mock_server.mjs';
import { file, formsOf, pageModules, pageTexts, placeholdersOf, tableTexts, textsOf } from '../words_kit.mjs';

const CODES = LANGUAGES.map(([code]) => code).filter((code) => code !== 'en');
const modules = pageModules().map((path) => ({ path, ...textsOf(readFileSync(WEB + path, 'utf8')) }));
const inPage = pageTexts(readFileSync(`${WEB}index.html`, 'utf8'));
const inModules = modules.flatMap(({ texts }) => texts).filter((text) => !isStandard(text));
const all = new Set([...inPage, ...inModules, ...tableTexts(CONTROLS)]);
// What t() is called with besides literals: entries of tables whose texts go through later(), of the table of controls, and of the page.
const FROM_TABLES = {
  'src/alerts/alert_words.js': ['t(priorityOf(alert)', 't(STATES[state])'],
  'src/chart/chart.js': ['t(MARK_NAMES[mark.kind] ?? MARK_NAMES[0])'],
  'src/chart/map_panel.js': ['t(KIND_NAMES[kind])', 't(FIRST_NAME)', 't(KIND_NAMES[item.kind])'],
  'src/chart/map_store.js': ['t(FIRST_NAME)', 't(FIRST_NAME)', 't(FIRST_NAME)'],
  'src/chart/position_text.js': ['t(AXES[axis].word)'],
  'src/control_panel.js': ['t(control.title)', 't(control.label)', 't(choice.label)', 't(control.label)'],
  'src/controls.js': ['t(next)', 't(palette)', 't(next)'],                  // PALETTE_ORDER
  'src/instructor.js': ['t(name)', 't(RAIN_KINDS.get(cell.kind)'],
  'src/keys/key_names.js': ['t(NAMED[part])'],
  'src/language/page_words.js': ['t(keyOf(parentElement', 't(keyOf(element'],
  'src/locks.js': ['t(text)'],                                              // BOXES
  'src/panel/picture_health.js': ['t(LOST)', 't(why)'],
  'src/panel/tabs.js': ['t(title)'],                                         // TABS
  'src/picture/picture_panel.js': ['t(label)', 't(MODES[mode])'],            // LAYERS
  'src/picture/standing.js': ['t(WORDS[orientation])'],
  'src/readouts.js': ['t(LINK_TEXT[state])'],
  'src/receiver_controls.js': ['t(NAMES[name])', 't(NAMES[name])'],
  'src/recording.js': ['t(WORDS[phase])'],
  'src/targets/bounded_field.js': ['t(label)', 't(rule.help)', 't(rule.label)'],  // RULES, ZONES, TRIALS
  'src/targets/list_table.js': ['t(words)'],                                 // COLUMNS
  'src/targets/readings.js': ['t(STATES[track.state])'],
  'src/targets/rules_panel.js': ['t(words)'],                                // ACQUIRE, STABILISATION
};

afterEach(() => speak('en'));

test('the texts of the page, its modules and the table of controls are found', () => {
  assert.ok(modules.length > 100 && inPage.length > 200 && inModules.length > 400 && tableTexts(CONTROLS).length > 60,
    `${modules.length} modules, texts: ${inPage.length} in the page, ${inModules.length} in modules, ${tableTexts(CONTROLS).length} of controls`);
  for (const text of ['scale|Range', 'key|Shift', 'Skerry radar', '350-10, 120-150', 'Picture held', 'Sea', 'Nearing']) {
    assert.equal(all.has(text), text !== '350-10, 120-150', text);
  }
  assert.deepEqual(textsOf("t('a'); // t('b')\n  // t('c')\nlater('d\\u2019e'); t(f); set('g'); x.t('h'); t('{i}', { i })"),
    { texts: ['a', 'd\u2019e', '{i}'], others: ['t(f)'] });
});

test('t() is called with literals, or from a table that is known here', () => {
  const others = modules.filter((module) => module.others.length > 0).map(({ path, others }) => [path, others]);
  assert.deepEqual(Object.fromEntries(others), FROM_TABLES);
});

for (const code of CODES) {
  test(`${code}: every English text has an entry, and none is unused`, () => {
    const words = wordsOf(file(code));
    assert.deepEqual([...all].filter((text) => !words.has(text)), [], 'without an entry');
    assert.deepEqual([...Object.keys(file(code))].filter((text) => !all.has(text)), [], 'unused');
    assert.equal(words.size, Object.keys(file(code)).length, 'entries that are no text');
  });

  test(`${code}: the same values are in both texts, and every plural form that the language has`, () => {
    const { pluralCategories } = new Intl.PluralRules(code).resolvedOptions();
    for (const [text, value] of Object.entries(file(code))) {
      for (const form of formsOf(value)) {
        const rest = (of) => placeholdersOf(of).filter((name) => typeof value === 'string' || name !== '{n}');
        assert.deepEqual(rest(form), rest(text), text);
        assert.equal(form.trim(), form, `spaces around: ${form}`);
      }
      if (typeof value !== 'string') assert.deepEqual(Object.keys(value).sort(), [...pluralCategories].sort(), text);
    }
  });
}

test('each language of the table has its file, and each file its row', () => {
  assert.deepEqual(readdirSync(`${WEB}languages`).sort(), CODES.map((code) => `${code}.json`).sort());
});

test('English is what stands in the sources, without its context', () => {
  assert.equal(t('Picture held'), 'Picture held');
  assert.equal(t('scale|Range'), 'Range');
  assert.equal(t('Retry in {seconds} s', { seconds: 3 }), 'Retry in 3 s');
  assert.equal(t('{n} of {all}', { n: 0, all: '{n}' }), '0 of {n}');  // a value is not looked into
  assert.equal(capital('day'), 'Day');
});

test('another language has its words, plurals and contexts; what it lacks is English, and told once', (context) => {
  const told = context.mock.method(console, 'info', () => {});
  speak('de', wordsOf(file('de')));
  assert.equal(t('scale|Range'), 'Bereich');
  assert.equal(t('Range'), 'Entfernung');
  assert.match(t('{n} more AIS targets are too far to be shown.', { n: 1 }), /^1 weiteres AIS-Ziel ist/);
  assert.match(t('{n} more AIS targets are too far to be shown.', { n: 2 }), /^2 weitere AIS-Ziele sind/);
  assert.deepEqual(writtenKey('Shift+Delete'), ['Umsch', 'Entf']);
  assert.equal(told.mock.callCount(), 0);
  speak('de', wordsOf({ 'Picture held': 'Bild', Radar: 7, Chart: { one: 'Karte' }, Rings: '' }));
  assert.deepEqual(['Picture held', 'Radar', 'Chart', 'Rings', 'x|Rings', 'Rings', 'N UP'].map((text) => t(text)), ['Bild', 'Radar', 'Chart', 'Rings', 'Rings', 'Rings', 'N UP']);
  assert.deepEqual(told.mock.calls.map(({ arguments: [text] }) => text.split(': ')[1]), ['Radar', 'Chart', 'Rings', 'x|Rings']);
  for (const broken of [null, [], 'text', 7]) assert.throws(() => wordsOf(broken), /no table of texts/);
});

test('the address chooses the language, else the operator, else the browser, else it is English', () => {
  assert.equal(chooseLanguage('de', 'en', ['en']), 'de');
  assert.equal(chooseLanguage('DE-at', null, ['en']), 'de');
  assert.equal(chooseLanguage('xx', 'de', ['en']), 'de');
  assert.equal(chooseLanguage(null, 'en', ['de']), 'en');
  assert.equal(chooseLanguage(null, null, ['fr-FR', 'de-CH', 'en']), 'de');
  assert.equal(chooseLanguage(null, null, ['en-US', 'de']), 'en');
  assert.equal(chooseLanguage('__proto__', 'xx', ['fr']), 'en');
  assert.equal(chooseLanguage(null, null, []), 'en');
});

test('abbreviations and units of the standards are words of no language', () => {
  for (const text of ['EBL 1', 'N UP', '15 s', '60 23.550 N', '350-10', '', 'RM(T)', 'TTG', '°/min']) assert.ok(isStandard(text), text);
  for (const text of ['Course °T', 'Rings', 'NO STAB lost', 'Skerry radar']) assert.ok(!isStandard(text), text);
});
