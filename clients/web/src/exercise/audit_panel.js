// Who did what: the newest entries of the server's audit, asked for once a second while they are looked at.
import { token } from '../token.js';
import { $, write } from '../widgets.js';

const EVERY_MS = 1000,
  TYPED_MS = 300,
  ANSWER_MS = 5000,
  MOST = 200;
// In the words of the list, and of the choice above it.
export const KINDS = {
  change: ['Change', 'Changes'],
  request: ['Order', 'Orders'],
  sign_in: ['Sign-in', 'Sign-ins'],
  refusal: ['Refused', 'Refusals'],
  server: ['Server', 'Server'],
};

const two = (n) => String(n).padStart(2, '0');
export function timeOf(utc, now = new Date()) {
  const at = new Date(utc);
  const time = [at.getHours(), at.getMinutes(), at.getSeconds()].map(two).join(':');
  return at.toDateString() === now.toDateString() ? time : `${at.getFullYear()}-${two(at.getMonth() + 1)}-${two(at.getDate())} ${time}`;
}
export const whoOf = ({ who, from }) => who || (from ? 'not signed in' : 'the server');
// As protocol/recording/audit_text.cpp.
export function whatOf({ what = '', before = '', after = '', times = 1, result }) {
  const change = before ? `: ${before} → ${after || 'nothing'}` : after && `: ${after}`;
  return `${what}${change}${times > 1 ? ` (${times} changes)` : ''}${result ? ` · ${result}` : ''}`;
}

export class AuditPanel {
  constructor() {
    this.panel = $('tab-log');
    $('log-kind').replaceChildren(
      new Option('All', ''),
      ...Object.entries(KINDS).map(([kind, [, many]]) => new Option(many, kind)),
    );
    $('log-kind').addEventListener('change', () => this.forget());
    $('log-who').addEventListener('input', () => {
      clearTimeout(this.typing);
      this.typing = setTimeout(() => this.forget(), TYPED_MS);
    });
    new MutationObserver(() => this.forget()).observe(this.panel, { attributes: true, attributeFilter: ['hidden'] });
    setInterval(() => this.#look(), EVERY_MS);
    this.forget();
  }

  // Begins anew: another filter, or somebody else who looks.
  forget() {
    this.asked = null;
    this.isRefused = false;
    this.newest = 0;
    this.#look();
  }

  async #look() {
    if (this.panel.hidden || document.hidden || this.isRefused || this.asked) return;
    const asked = (this.asked = { after: this.newest });
    const query = new URLSearchParams({ last: MOST, after: asked.after, who: $('log-who').value, kind: $('log-kind').value });
    let answer = null,
      told = null;
    try {
      const headers = token() ? { Authorization: `Bearer ${token()}` } : {};
      answer = await fetch(`audit?${query}`, { headers, cache: 'no-store', signal: AbortSignal.timeout(ANSWER_MS) });
      told = answer.ok ? await answer.json() : await answer.text();
    } catch {
      answer = null;
    }
    if (this.asked !== asked) return;
    this.asked = null;
    if (!answer) write('log-problem', 'No answer from the server');
    else if (!answer.ok) this.#refuse(answer.status, told);
    else this.#take(told, asked.after);
  }

  #refuse(status, text) {
    this.isRefused = true;
    $('log-list').replaceChildren();
    write('log-count', '');
    write('log-problem', status === 404 ? 'This server keeps no audit' : text.replace(/^\d+: /, '').trim());
  }

  #take({ entries, newest, has_file: hasFile, unwritten }, after) {
    // Another run of the server, or more than one answer holds.
    if (after > 0 && (newest < after || entries.length === MOST)) {
      this.forget();
      return;
    }
    this.newest = newest;
    const list = $('log-list');
    const items = entries.map((entry) => this.#item(entry));
    if (after === 0) list.replaceChildren(...items);
    else list.prepend(...items);
    while (list.children.length > MOST) list.lastElementChild.remove();
    const shown = list.children.length;
    const count = shown === MOST ? `the newest ${MOST}` : shown === 1 ? '1 entry' : `${shown} entries`;
    write('log-count', hasFile ? count : `${count}, in memory alone (no --audit)`);
    write('log-problem', unwritten > 0 ? `The disk takes nothing: ${unwritten} wait` : '');
  }

  #item(entry) {
    const item = document.createElement('li');
    item.dataset.kind = entry.kind;
    const [time, kind, who, what] = ['time', 'b', 'span', 'p'].map((name) => document.createElement(name));
    time.dateTime = entry.utc;
    time.title = `Entry ${entry.n}, ${entry.utc}`;
    time.textContent = timeOf(entry.utc);
    kind.textContent = KINDS[entry.kind]?.[0] ?? entry.kind;
    who.textContent = whoOf(entry);
    what.textContent = whatOf(entry);
    if (entry.from) what.append(' ', Object.assign(document.createElement('small'), { textContent: `from ${entry.from}` }));
    item.append(time, kind, who, what);
    return item;
  }
}
