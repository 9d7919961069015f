// What a server says of itself when it answers, and what that means for a page that may have been opened on another one.
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
    if (hello.scenario !== last.scenario) this.notify(`Another scenario: ${shortName(hello.scenario) || 'without a name'}`, 'info');
    if (last.radars.some((each) => each.radar === radar) && !hello.radars.some((each) => each.radar === radar)) {
      const [first] = hello.radars;
      const now = first ? `${shortName(first.ownShip || first.name)} is shown` : 'the server has none';
      this.notify(`Radar ${radar} is there no more: ${now}`);
    }
  }

  #problemOf({ protocolVersion, server }) {
    if (protocolVersion !== PROTOCOL_VERSION) {
      const age = protocolVersion > PROTOCOL_VERSION ? 'newer' : 'older';
      return `This server is ${age} than this page: it speaks version ${protocolVersion} of the protocol, the page version ` +
        `${PROTOCOL_VERSION}. What is shown may be wrong. Reload the page.`;
    }
    if (this.first !== undefined && server !== this.first) {
      return `The server is now ${shortName(server)}; this page is of ${shortName(this.first)}. Reload the page.`;
    }
    this.first ??= server;
    return '';
  }

  #sayStaying(text) {
    if (this.text.textContent !== text) this.text.textContent = text;
    this.problem.hidden = text === '';
  }
}
