// The hosts that run the exercise together, as the server that the page is connected to knows them.
import { $, write } from '../widgets.js';

// Hosts tell of the same seconds at moments of their own: only those of one tick can be compared.
export function differing(hosts) {
  const ticks = new Map();
  for (const { name, tick, digest } of hosts) {
    if (!tick) continue;
    const of = ticks.get(tick) ?? ticks.set(tick, new Map()).get(tick);
    of.set(digest, [...(of.get(digest) ?? []), name]);
  }
  const torn = [...ticks.values()].find((digests) => digests.size > 1);
  return torn ? [...torn.values()].flat() : [];
}

// The names of the own ships whose radars these are.
export const shipsOf = (radars, infos) => [
  ...new Set(infos.filter(({ radar }) => radars.includes(radar)).map(({ ownShip }) => ownShip)),
];

function rowOf(host, fleet, infos) {
  const row = document.createElement('li');
  const cell = (tag, text) => Object.assign(document.createElement(tag), { textContent: text });
  const roles = [host.name === fleet.host ? 'this one' : '', host.name === fleet.leader ? 'leads' : ''].filter(Boolean);
  row.dataset.standing = host.standing;
  row.append(
    cell('b', host.name),
    cell('span', host.standing || 'has not told of itself yet'),
    cell('small', roles.join(', ')),
    cell('p', shipsOf(host.radars, infos).join(', ') || 'no own ship'),
  );
  return row;
}

export class HostsPanel {
  // fleet: null: the server runs its exercise alone. infos: the radars of Hello.
  take(fleet, infos) {
    $('hosts').hidden = fleet === null;
    if (fleet === null) return;
    const torn = differing(fleet.hosts);
    const words = [
      fleet.refusal && `No orders are taken: ${fleet.refusal}`,
      torn.length > 0 && `The worlds of ${torn.join(', ')} differ`,
      fleet.problem && !fleet.refusal && `Store: ${fleet.problem}`,
    ];
    write('hosts-problem', words.filter(Boolean).join('. '));
    $('host-list').replaceChildren(...fleet.hosts.map((host) => rowOf(host, fleet, infos)));
  }
}
