// The set-ups that the server keeps for all consoles (protocol/SPEC.md 2.8). No drawing.
import { t } from '../language/language.js';
import { token } from '../token.js';

const WAIT_MS = 5000;

export class SetupServer {
  keeps = false;  // whether the server keeps any
  names = [];

  // What the server has now. Error: throws where it cannot be reached or does not let this console see them.
  async look() {
    await this.#take(await this.#ask('GET', ''));
  }

  // The file of a set-up, as text.
  async read(name) {
    return (await this.#ask('GET', name)).text();
  }

  // text: the file of the set-up of that name.
  async save(name, text) {
    await this.#take(await this.#ask('PUT', name, text));
  }

  async remove(name) {
    await this.#take(await this.#ask('DELETE', name));
  }

  async #take(response) {
    const { keeps, setups } = await response.json();
    this.keeps = keeps === true;
    const names = (Array.isArray(setups) ? setups : []).map(({ name }) => String(name));
    this.names = names.sort((a, b) => a.localeCompare(b));
  }

  // Error: throws with the server's reason.
  async #ask(method, name, body) {
    let response;
    try {
      response = await fetch(name === '' ? 'setups' : `setups/${encodeURIComponent(name)}`, {
        method, body, cache: 'no-store', signal: AbortSignal.timeout(WAIT_MS),
        headers: token() ? { Authorization: `Bearer ${token()}` } : {},
      });
    } catch {
      throw new Error(t('the server does not answer'));
    }
    if (response.ok) return response;
    const reason = (await response.text()).replace(/^\d+: /, '').trim();
    throw new Error(reason || `HTTP ${response.status}`);
  }
}
