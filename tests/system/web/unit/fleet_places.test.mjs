// Which server of a fleet a page is connected to.
import assert from 'node:assert/strict';
import test from 'node:test';
import { FleetPlaces } from '../../../../clients/web/src/fleet_places.js';

const host = (name, port, ...radars) => ({ name, web: port === 0 ? '' : `http://192.0.2.7:${port}/`, radars });
const fleetOf = (...hosts) => ({ host: 'a', hosts });
const PAGE = 'http://192.0.2.7:7480/conning?radar=1#x';

test('a page of a server that runs its exercise alone stays where it is', () => {
  const places = new FleetPlaces(PAGE);
  assert.equal(places.at.ws, 'ws://192.0.2.7:7480/ws');
  assert.equal(places.at.probe, 'http://192.0.2.7:7480/icon.svg');
  places.take(null);
  places.watch(3);
  assert.equal(places.mustMove, false);
  places.next();
  assert.equal(places.at.ws, 'ws://192.0.2.7:7480/ws');
  assert.equal(new FleetPlaces('https://bridge/').at.ws, 'wss://bridge/ws');
});

test('it goes to the host that has the radar which it watches, and back', () => {
  const places = new FleetPlaces(PAGE);
  places.take(fleetOf(host('a', 7480, 0), host('b', 7481, 1)));
  assert.equal(places.mustMove, false, 'nothing is watched');
  places.watch(1);
  assert.equal(places.mustMove, true);
  places.move();
  assert.equal(places.at.ws, 'ws://192.0.2.7:7481/ws');
  assert.equal(places.mustMove, false);
  places.take(fleetOf(host('a', 7480, 0, 1), host('b', 7481)));
  assert.equal(places.mustMove, true);
  places.move();
  assert.equal(places.at.ws, 'ws://192.0.2.7:7480/ws');
  places.take(fleetOf(host('b', 0, 1)));
  assert.equal(places.mustMove, false, 'a host that has not yet said where its pages are');
});

test('its own server may be known to the fleet by another name than the page has it by', () => {
  const places = new FleetPlaces('http://localhost:7480/');
  places.take(fleetOf(host('a', 7480, 0), host('b', 7481, 1)));
  places.watch(0);
  assert.equal(places.mustMove, false);
  places.watch(1);
  places.move();
  places.take({ host: 'b', hosts: [host('a', 7480, 0, 1), host('b', 7481)] });
  places.move();
  assert.equal(places.at.ws, 'ws://localhost:7480/ws');
});

test('to a host that came after the page was loaded the page itself goes', () => {
  const places = new FleetPlaces(PAGE);
  places.take(fleetOf(host('a', 7480, 0), host('b', 7481)));
  places.watch(1);
  assert.equal(places.isHomeless, true);
  places.take(fleetOf(host('a', 7480, 0), host('b', 7481), host('c', 7482, 1)));
  assert.equal(places.isHomeless, false);
  assert.equal(places.mustMove, true);
  assert.equal(places.pageToGoTo(new URL(PAGE)), 'http://192.0.2.7:7482/conning?radar=1');
  places.take(fleetOf(host('a', 7480, 0), host('b', 7481, 1)));
  assert.equal(places.pageToGoTo(new URL(PAGE)), null);
});

test('what a host tells of itself and is no page is no place', () => {
  const places = new FleetPlaces(PAGE);
  for (const web of ['', 'b:7481', 'javascript:alert(1)', 'http://', '\u0000', 'file:///etc/passwd', 'data:text/html,x']) {
    places.take({ host: 'a', hosts: [host('a', 7480), { name: 'b', web, radars: [1] }] });
    places.watch(1);
    assert.equal(places.mustMove, false, web);
    assert.deepEqual(places.others, [], web);
  }
});

test('after a loss it asks all that it knows of by turns', () => {
  const places = new FleetPlaces(PAGE);
  places.take(fleetOf(host('a', 7480), host('b', 7481), host('c', 7482)));
  const asked = [];
  for (let i = 0; i < 4; i += 1) {
    places.next();
    asked.push(new URL(places.at.probe).port);
  }
  assert.deepEqual(asked, ['7481', '7482', '7480', '7481']);
  places.take(fleetOf(host('c', 7482)));
  places.next();
  assert.equal(new URL(places.at.probe).port, '7480', 'the one that it was at is gone');
});
