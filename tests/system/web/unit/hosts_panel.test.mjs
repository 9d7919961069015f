// The instructor's list of hosts: whose worlds differ, and which own ships are where.
import assert from 'node:assert/strict';
import test from 'node:test';
import { differing, shipsOf } from '../../../../clients/web/src/exercise/hosts_panel.js';

const host = (name, tick, digest) => ({ name, tick, digest });

test('only worlds of one tick are compared', () => {
  assert.deepEqual(differing([host('a', 10, 'x'), host('b', 20, 'y'), host('c', 0, '')]), []);
  assert.deepEqual(differing([host('a', 10, 'x'), host('b', 10, 'x')]), []);
  assert.deepEqual(differing([host('a', 10, 'x'), host('b', 10, 'y'), host('c', 10, 'x'), host('d', 20, 'z')]), ['a', 'c', 'b']);
});

test('a ship with two radars is named once', () => {
  const infos = [{ radar: 0, ownShip: 'Tern' }, { radar: 1, ownShip: 'Tern' }, { radar: 2, ownShip: 'Gull' }];
  assert.deepEqual(shipsOf([0, 1], infos), ['Tern']);
  assert.deepEqual(shipsOf([2, 1], infos), ['Tern', 'Gull']);
  assert.deepEqual(shipsOf([], infos), []);
});
