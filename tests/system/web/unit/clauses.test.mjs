// The table of clauses (clients/web/CLAUSES.md) against the tests that it names.
import assert from 'node:assert/strict';
import { existsSync, readFileSync } from 'node:fs';
import { test } from 'node:test';
import { fileURLToPath } from 'node:url';

const ROOT = new URL('../../../../', import.meta.url);
const WEB_TESTS = 'tests/system/web/';
const CLAUSES = [...Array.from({ length: 14 }, (_, i) => `D${i + 1}`), 'B8', 'B9', 'B10', 'B11'];
const PAGE = readFileSync(new URL('clients/web/CLAUSES.md', ROOT), 'utf8');

// { rows: [{ clause, claim, tag, proof }], tests: Map of key to { file, name } } of such a page.
export function read(page) {
  const rows = [...page.matchAll(/^\| ([A-Z]\d+) \| (.*?) \| (.*?) \| (.*?) \|$/gm)].map(([, clause, claim, tag, proof]) => ({ clause, claim, tag, proof }));
  const list = page.slice(page.indexOf('## Tests')).split(/^## /m)[1] ?? '';
  const tests = new Map([...list.matchAll(/^- ([A-Z]\d+) `(.+?)`:(?: |\n {2})(.+(?:\n {2}.+)*)$/gm)]
    .map(([, key, file, name]) => [key, { file: file.endsWith('.cpp') ? file : WEB_TESTS + file, name: name.replaceAll(/\n {2}/g, ' ') }]));
  return { rows, tests };
}

// Whether the text of a file has a test of that name. ${...} in a name stands for anything.
export function hasTest(text, file, name) {
  if (file.endsWith('.cpp')) {
    const [suite, of] = name.split('.');
    return new RegExp(`^TEST(?:_F|_P)?\\(${suite},\\s+${of}\\)`, 'm').test(text);
  }
  const names = [...text.matchAll(/^ *test\((['"`])((?:\\.|(?!\1).)*)\1/gm)].map(([, , written]) => written
    .replaceAll(/\\u([0-9a-f]{4})/gi, (_, hex) => String.fromCharCode(parseInt(hex, 16))).replaceAll(/\\(.)/g, '$1'));
  const escaped = (part) => part.replaceAll(/[.*+?^${}()|[\]\\]/g, '\\$&');
  return names.some((each) => new RegExp(`^${each.split(/\$\{.*?\}/).map(escaped).join('.+')}$`).test(name));
}

// What is wrong with a page; open(file): its text, or null.
export function faults(page, open) {
  const { rows, tests } = read(page);
  const found = CLAUSES.filter((clause) => !rows.some((row) => row.clause === clause)).map((clause) => `${clause} has no row`);
  for (const [key, { file, name }] of tests) {
    const text = open(file);
    if (text === null) found.push(`${key}: there is no file ${file}`);
    else if (!hasTest(text, file, name)) found.push(`${key}: ${file} has no test "${name}"`);
    if (!rows.some(({ proof }) => proof.split(', ').includes(key))) found.push(`${key} proves nothing`);
  }
  for (const { clause, claim, tag, proof } of rows) {
    const what = `${clause}, ${claim}`;
    if (!CLAUSES.includes(clause)) found.push(`${what}: there is no such clause`);
    if (!/^(V|V2|M)$/.test(tag)) found.push(`${what}: the tag ${tag} is none`);
    if (/^(not kept|no demand): \S/.test(proof)) continue;
    for (const key of proof.split(', ')) if (!tests.has(key)) found.push(`${what}: "${key}" is neither a test nor a reason`);
  }
  return found;
}

const open = (file) => {
  const path = fileURLToPath(new URL(file, ROOT));
  return existsSync(path) ? readFileSync(path, 'utf8') : null;
};

test('every clause has its rows, and every row its test or its reason', (t) => {
  assert.deepEqual(faults(PAGE, open), []);
  const { rows, tests } = read(PAGE);
  assert.equal(rows.length, PAGE.split('\n').filter((line) => /^\| (?!clause)/.test(line)).length, 'rows that are not read');
  const count = (pattern) => rows.filter(({ proof }) => pattern.test(proof)).length;
  t.diagnostic(`${rows.length} claims: ${count(/^not kept/)} not kept, ${count(/^no demand/)} no demand; ${tests.size} tests`);
});

test('lines of the table fit a page', () => {
  assert.deepEqual(PAGE.split('\n').filter((line) => line.length > 120), []);
});

test('a table with a fault is found out', () => {
  const rows = CLAUSES.map((clause) => `| ${clause} | claim | V | A1 |`).join('\n');
  const page = (table, list = '- A1 `a.test.mjs`: one of\n  two lines') => `${table}\n\n## Tests\n\n${list}\n\n## More\n`;
  const files = { [`${WEB_TESTS}a.test.mjs`]: "test('one of two lines', () => {});\ntest(`at ${width} x ${height}`, f);\ntest(\"it\\'s\", f);", 'b_test.cpp': 'TEST_F(Suite, Name) {' };
  const of = (text) => faults(text, (file) => files[file] ?? null);
  assert.deepEqual(of(page(rows)), []);
  assert.deepEqual(of(page(rows, '- A1 `a.test.mjs`: at 3 x 4')), []);
  assert.deepEqual(of(page(rows, "- A1 `a.test.mjs`: it's")), []);
  assert.deepEqual(of(page(rows, '- A1 `b_test.cpp`: Suite.Name')), []);
  assert.match(of(page(rows, '- A1 `b_test.cpp`: Suite.Nam')).join(), /has no test/);
  assert.match(of(page(rows, '- A1 `a.test.mjs`: one of')).join(), /has no test/);
  assert.match(of(page(rows, '- A1 `c.test.mjs`: one')).join(), /no file/);
  assert.match(of(page(rows.replace('| D3 |', '| D33 |'))).join(), /D3 has no row.*D33, claim: there is no such clause/);
  assert.match(of(page(rows.replace('A1', 'A2'))).join(), /"A2" is neither/);
  assert.match(of(page(rows.replace('A1', 'not kept: '))).join(), /neither/);
  assert.match(of(page(rows.replace('A1', 'A1, B1'))).join(), /"B1" is neither/);
  assert.match(of(page(rows.replace('| V |', '| X |'))).join(), /tag X/);
  assert.match(of(page(rows, '- A1 `a.test.mjs`: one of two lines\n- A2 `a.test.mjs`: one of two lines')).join(), /A2 proves nothing/);
});
