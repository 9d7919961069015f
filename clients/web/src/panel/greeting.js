// What a server says of itself when it answers, and what that means for a page that may have been opened on another one.
import { t } from '../language/language.js';
import { shortName } from '../names.js';

// Hello.protocol_version that this page speaks (protocol/SPEC.md, section 5).
const PROTOCOL_VERSION = 1;

export class Greeting {
  // elements: { problem, text }: a bar that stays, and its text.  notify(text, kind).
  constructor({ problem, text }, notify) {
    Object.assign(this, { problem, text, notify, last: null });
    problem.querySelector('button').addEventListener('click', () => location.reload());
  }

  // radar: the number that was asked for.
  take(hello, radar) {
    this.#sayStaying(this.#problemOf(hello));
    const { last } = this;
    this.last = hello;
    if (!last) return;
    if (hello.scenario !== last.scenario) this.notify(t('Another scenario: {name}', { name: shortName(hello.scenario) || t('without a name') }), 'info');
    if (last.radars.some((each) => each.radar === radar) && !hello.radars.some((each) => each.radar === radar)) {
      const [first] = hello.radars;
      const now = first ? t('{ship} is shown', { ship: shortName(first.ownShip || first.name) }) : t('the server has none');
      this.notify(t('Radar {radar} is there no more: {now}', { radar, now }));
    }
  }

  #problemOf({ protocolVersion, server }) {
    if (protocolVersion !== PROTOCOL_VERSION) {
      const versions = { server: protocolVersion, page: PROTOCOL_VERSION };
      return protocolVersion > PROTOCOL_VERSION
        ? t('This server is newer than this page: it speaks version {server} of the protocol, the page version {page}. What is shown may be wrong. Reload the page.', versions)
        : t('This server is older than this page: it speaks version {server} of the protocol, the page version {page}. What is shown may be wrong. Reload the page.', versions);
    }
    if (this.first !== undefined && server !== this.first) {
      return t('The server is now {now}; this page is of {before}. Reload the page.', { now: shortName(server), before: shortName(this.first) });
    }
    this.first ??= server;
    return '';
  }

  #sayStaying(text) {
    if (this.text.textContent !== text) this.text.textContent = text;
    this.problem.hidden = text === '';
  }
}
