// Every English text of the console's page that is to be translated: of index.html, of t() and later() in the modules that it loads,
// and of the server's table of controls.
import { readFileSync } from 'node:fs';
import { dirname, relative, resolve } from 'node:path';
import { widgetOf } from '../../../clients/web/src/controls_table.js';
import { isStandard } from '../../../clients/web/src/language/standard_words.js';
import { WEB } from './mock_server.mjs';

export const file = (code) => JSON.parse(readFileSync(`${WEB}languages/${code}.json`, 'utf8'));
export const formsOf = (value) => (typeof value === 'string' ? [value] : Object.values(value));
export const placeholdersOf = (text) => [...new Set(text.match(/\{\w+\}/g) ?? [])].sort();

// Paths under clients/web of the modules that index.html loads, those that it loads later included.
export function pageModules() {
  const page = readFileSync(`${WEB}index.html`, 'utf8');
  const known = new Set();
  const add = (path) => {
    if (known.has(path)) return;
    known.add(path);
    const source = readFileSync(path, 'utf8');
    for (const [, name] of source.matchAll(/(?:from|import\(?)\s*'(\.[^']+)'/g)) add(resolve(dirname(path), name));
  };
  for (const [, src] of page.matchAll(/<script[^>]* src="([^"]+)"/g)) add(resolve(WEB, src));
  return [...known].map((path) => relative(WEB, path)).sort();
}

const LITERAL = String.raw`'((?:[^'\\]|\\.)*)'`;
const unescaped = (inner) => JSON.parse(`"${inner.replace(/"/g, '\\"').replace(/\\'/g, "'")}"`);

// Of a module: { texts, others }: the literals of t() and later(), and what else they are called with.
export function textsOf(source) {
  // A comment's t() is none.
  const code = source.replace(/^\s*\/\/.*$/gm, '').replace(/(\s)\/\/ .*$/gm, '$1');
  const texts = [], others = [];
  for (const call of code.matchAll(/(?<![\w.$#])(t|later)\(/g)) {
    if (/function\s+$/.test(code.slice(0, call.index))) continue;
    const rest = code.slice(call.index + call[0].length);
    const literal = new RegExp(`^${LITERAL}\\s*[,)]`).exec(rest);
    if (literal) texts.push(unescaped(literal[1]));
    else others.push(`${call[1]}(${/^[^,)]*\)?/.exec(rest)[0]}`);
  }
  return { texts, others };
}

const VOID = new Set(['meta', 'link', 'input', 'br', 'hr', 'img', 'path']);
const NAMES = ['title', 'aria-label', 'placeholder', 'data-words'];
const decoded = (text) => text.replace(/&lt;/g, '<').replace(/&gt;/g, '>').replace(/&quot;/g, '"').replace(/&amp;/g, '&');

// The texts of a page with their contexts, as src/language/page_words.js finds them.
export function pageTexts(html) {
  const found = [], open = [];
  const take = (text, context) => {
    const plain = decoded(text).replace(/\s+/g, ' ').trim();
    const isKept = open.some(({ name, kept }) => kept || name === 'noscript' || name === 'script' || name === 'style');
    if (!isKept && !isStandard(plain)) found.push(context ? `${context}|${plain}` : plain);
  };
  for (const [, comment, tag, text] of html.matchAll(/(<!--.*?-->|<!doctype[^>]*>)|(<[^>]+>)|([^<]+)/gis)) {
    if (comment) continue;
    if (text) { take(text, open.at(-1)?.context); continue; }
    const name = /^<\/?([\w-]+)/.exec(tag)[1].toLowerCase();
    if (tag.startsWith('</')) { while (open.pop()?.name !== name); continue; }
    const attributes = Object.fromEntries([...tag.matchAll(/\s([\w-]+)="([^"]*)"/g)].map(([, key, value]) => [key, value]));
    open.push({ name, context: attributes['data-context'], kept: attributes.translate === 'no' });
    for (const key of NAMES) if (attributes[key]) take(attributes[key], attributes['data-context']);
    if (VOID.has(name) || tag.endsWith('/>')) open.pop();
  }
  return found;
}

// What the panel shows of the table of controls.
export function tableTexts({ controls, artefacts }) {
  return [...controls.filter(widgetOf), ...artefacts]
    .flatMap(({ label, title, choices }) => [label, title, ...(choices ?? []).map((choice) => choice.label)])
    .filter((text) => text && !isStandard(text));
}
