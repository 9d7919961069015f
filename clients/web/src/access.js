// Access: who this tab is to the server: by a token that is typed in, or by one that it was given for a name and a
// password.
import { t } from './language/language.js';
import { setToken, token } from './token.js';

const ANSWER_MS = 10000;

// What the server answers to a sign-in that it refuses, by HTTP status.
const refusals = () => ({
  401: t('No user has this name and password'),
  429: t('Too many sign-ins from this host. Try again in a minute.'),
  503: t('Too many sign in just now. Try again in a second.'),
});

// told: the document of an answer that is one.  bearer: who asks.
async function ask(method, { bearer = '', body } = {}) {
  try {
    const headers = bearer ? { Authorization: `Bearer ${bearer}` } : {};
    const signal = AbortSignal.timeout(ANSWER_MS);
    const sent = body && JSON.stringify(body);
    const answer = await fetch('login', { method, headers, cache: 'no-store', signal, body: sent });
    return { status: answer.status, told: answer.ok ? await answer.json() : null };
  } catch {
    return { status: 0, told: null };
  }
}

const make = (parent, tag, values) => parent.appendChild(Object.assign(document.createElement(tag), values));

export class Access {
  // section: #access of the page, shown when the server wants to know who one is.
  // changed(isGone): after one is another; isGone: nobody, so that nothing may go on that the one before was
  // allowed.
  constructor(section, changed) {
    Object.assign(this, { section, changed, hasUsers: false });
    this.form = make(section, 'form', { hidden: true });
    const required = true;
    this.name = this.#row(this.form, t('Name'),
      { id: 'sign-in-name', type: 'text', autocomplete: 'username', required, maxLength: 64 });
    this.password = this.#row(this.form, t('Password'),
      { id: 'sign-in-password', type: 'password', autocomplete: 'current-password', required, maxLength: 256 });
    this.button = make(this.form, 'button', { id: 'sign-in', textContent: t('Sign in') });
    this.problem = make(this.form, 'p', { id: 'sign-in-problem', hidden: true, role: 'alert' });
    this.form.addEventListener('submit', (event) => { event.preventDefault(); this.#signIn(); });
    this.field = this.#row(section, t('Token'), { id: 'token', type: 'password', autocomplete: 'off', value: token() });
    this.field.addEventListener('change', () => this.#become(this.field.value));
    this.signedIn = make(section, 'p', { className: 'signed-in', hidden: true });
    this.who = make(this.signedIn, 'output', { id: 'signed-in' });
    this.out = make(this.signedIn, 'button', { id: 'sign-out', type: 'button', textContent: t('Sign out') });
    this.out.addEventListener('click', () => this.#signOut());
    this.#look();
  }

  #row(parent, text, input) {
    const label = make(parent, 'label', { className: 'row' });
    make(label, 'span', { textContent: text });
    return make(label, 'input', input);
  }

  // The server wants to know; with `focus` the hand is led there.
  async want(focus = false) {
    this.section.hidden = false;
    await this.#look();
    if (focus) this.#focus();
  }

  #focus() {
    if (!this.signedIn.hidden) this.out.focus();
    else (this.form.hidden ? this.field : this.name).focus();
  }

  // What the server has of this tab's token. One that is older, or does not answer, leaves all as it is.
  async #look() {
    const asked = token();
    const { told } = await ask('GET', { bearer: asked });
    if (!told || asked !== token()) return;
    this.hasUsers = told.users === true;
    if (told.name) this.#show(told);
    else this.#showNobody();
  }

  #show({ name, role, ship, ends }) {
    const style = { hour: '2-digit', minute: '2-digit', hourCycle: 'h23' };
    const time = ends && new Date(ends).toLocaleTimeString([], style);
    const parts = [name, role, ship, time && t('until {time}', { time })];
    this.who.textContent = parts.filter(Boolean).join(' · ');
    this.signedIn.hidden = false;
    this.form.hidden = this.field.parentElement.hidden = true;
    this.section.hidden = false;
  }

  #showNobody() {
    this.signedIn.hidden = true;
    this.form.hidden = !this.hasUsers;
    this.field.parentElement.hidden = false;
  }

  #become(text, isGone = false) {
    setToken(text);
    this.field.value = text;
    this.changed(isGone);
  }

  async #signIn() {
    this.button.disabled = true;
    this.problem.hidden = true;
    const body = { name: this.name.value, password: this.password.value };
    const { status, told } = await ask('POST', { body });
    this.button.disabled = false;
    if (told) {
      this.password.value = '';
      this.#show(told);
      this.#become(told.token);
      this.#focus();
      return;
    }
    this.problem.textContent = refusals()[status] ??
      t('Not signed in: the server does not answer ({status})', { status });
    this.problem.hidden = false;
    this.password.select();
  }

  // Here at once; the server is told as well as it can be. A token of its file does not end so.
  async #signOut() {
    const bearer = token();
    this.#showNobody();
    this.#become('', true);
    this.#focus();
    const { status } = await ask('DELETE', { bearer });
    if (status === 200 || status === 401) return;
    this.problem.textContent =
      t('Signed out here; the server did not answer, and its session goes on until it ends');
    this.problem.hidden = false;
  }
}
