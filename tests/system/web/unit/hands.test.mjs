// Keys, names, retries, set-ups and availability of the console, without a browser.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { retryMs } from '../../../../clients/web/src/connection_retry.js';
import { keyOf, writtenKey } from '../../../../clients/web/src/keys/key_names.js';
import { KeyTable } from '../../../../clients/web/src/keys/key_table.js';
import { isolated, shortName } from '../../../../clients/web/src/names.js';
import { SetupStore } from '../../../../clients/web/src/panel/setup_store.js';

class Store {
  items = new Map();

  getItem(name) { return this.items.get(name) ?? null; }

  setItem(name, text) { this.items.set(name, text); }
}

test('a key has one name, whatever Shift and Caps Lock do to its letter', () => {
  const of = (key, shiftKey = false, more = {}) => keyOf({ key, shiftKey, ctrlKey: false, altKey: false, metaKey: false, ...more });
  assert.deepEqual([of('g'), of('G', true), of('G'), of('g', true)], ['g', 'Shift+g', 'g', 'Shift+g']);
  assert.deepEqual([of('+'), of('+', true), of('?', true), of('1'), of(' ')], ['+', '+', '?', '1', ' ']);
  assert.deepEqual([of('ArrowLeft'), of('ArrowLeft', true), of('F2')], ['ArrowLeft', 'Shift+ArrowLeft', 'F2']);
  assert.deepEqual([of('g', false, { ctrlKey: true }), of('Shift', true), of('Tab'), of('Escape'), of('Dead')], [null, null, null, null, null]);
  assert.deepEqual(writtenKey('Shift+g'), ['Shift', 'G']);
});

test('a table of keys refuses a default that is taken, tells a conflict, and forgets changes on request', () => {
  const store = new Store(), ran = [];
  const make = () => {
    const table = new KeyTable(store);
    table.register({ id: 'a', key: 'a', words: 'A', run: () => ran.push('a') }, { id: 'b', key: 'b', also: ['x'], words: 'B', run: () => ran.push('b') });
    return table;
  };
  const table = make();
  assert.throws(() => table.register({ id: 'c', key: 'a', words: 'C' }), /the key a is the default of a and of c/);
  assert.throws(() => table.register({ id: 'a', key: 'q', words: 'C' }), /two actions/);
  assert.equal(table.actionOf('x').id, 'b');
  assert.equal(table.change('a', 'b').id, 'b', 'not taken');
  assert.equal(table.keyOf('a'), 'a');
  assert.equal(table.change('a', 'x'), null, 'a further key of another is free to take');
  assert.equal(table.actionOf('x').id, 'a');
  assert.equal(table.change('a', 'b', true), null);
  assert.deepEqual([table.keyOf('a'), table.keyOf('b'), table.actionOf('')], ['b', '', undefined]);
  assert.equal(make().keyOf('a'), 'b', 'kept');
  table.reset();
  assert.deepEqual([make().keyOf('a'), make().keyOf('b')], ['a', 'b']);
  store.setItem('skerry.keys', '{"a": 5, "b":');
  assert.equal(make().keyOf('a'), 'a', 'nonsense that is kept changes nothing');
});

test('retries are spread, and none is later than 2 s', () => {
  for (let attempts = 0; attempts < 2000; ++attempts) {
    assert.ok(retryMs(attempts, 0) >= 200 && retryMs(attempts, 0.999999) <= 2000, `${attempts}`);
  }
  assert.ok(retryMs(9, 1) - retryMs(9, 0) >= 800);
});

test('a name is one short line of its own direction', () => {
  assert.equal(shortName(' Sea\n\tStar\u0000 '), 'Sea Star');
  assert.equal([...shortName('x'.repeat(10240))].length, 60);
  assert.equal([...shortName('\u{1F6A2}'.repeat(70))].length, 60, 'letters are not cut in two');
  assert.equal(shortName('a\u202eb\u2066c'), 'abc');
  assert.equal(isolated('Frida'), 'Frida');
  assert.equal(isolated('\u05e9\u05dc'), '\u2068\u05e9\u05dc\u2069');
  assert.equal(shortName(undefined), '');
});

test('set-ups are kept, restored part by part, and refused if they are none', () => {
  const store = new Store();
  let now = { gain: 3 };
  const make = () => {
    const setups = new SetupStore(store);
    setups.addPart('receiver', { take: () => now, put: (values) => { now = values; } });
    return setups;
  };
  const setups = make();
  setups.save(setups.take('One'));
  now = { gain: 9 };
  assert.deepEqual(make().names, ['One']);
  const file = setups.toFile(setups.setups.One);
  make().put(make().fromFile(file));
  assert.deepEqual(now, { gain: 3 });
  make().put({ parts: { receiver: 5, other: {} } });
  assert.deepEqual(now, { gain: 3 }, 'what is no part of ours, or no values, is left');
  for (const [text, why] of [['', /not JSON/], ['[]', /no set-up/], ['{"kind": "skerry set-up", "version": 2, "parts": {}}', /version 2/],
    ['{"kind": "skerry set-up", "version": 1, "parts": []}', /no set-up/], ['x'.repeat(2 ** 20 + 1), /too large/]]) {
    assert.throws(() => setups.fromFile(text), why, text.slice(0, 50));
  }
  store.setItem('skerry.setups', '{"a": 1, "b": {"parts": {}}}');
  assert.deepEqual(make().names, ['b']);
  setups.remove('One');
  assert.deepEqual(make().names, []);
});
