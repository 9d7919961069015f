// Access: who this tab is to the server: by a token that is typed in, or by signing in with a password or the code of a
// class. Who has signed in is known by a cookie where the browser keeps it safely, otherwise by a token of the tab.
import { t } from './language/language.js';
import { setToken, token } from './token.js';

const ANSWER_MS = 10000;
// Browsers keep a cookie that no script reads for encrypted pages, and most for their own host (RFC 6265bis).
const mayKeepCookie = () => location.protocol === 'https:' || /^(localhost|127\.0\.0\.1|\[::1\])$/.test(location.hostname);

// What the server answers to a sign-in that it refuses, by HTTP status.
const refusals = (byCode) => ({
  400: t('A name has 1 to 64 letters'),
  401: byCode ? t('No class has this code now. Ask the instructor for it.') : t('No user has this name and password'),
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
  // changed(isAnew): after one is another; isAnew: the connection has to begin anew, as nobody may go on with what the
  // one before was allowed, or as the token is in a cookie.
  // aboard(ship): one is of that own ship alone, '': of none in particular; gives whether the connection has to begin
  // anew for that.
  constructor(section, changed, aboard = () => false) {
    Object.assign(this, { section, changed, aboard, hasUsers: false, hasClass: false });
    this.form = make(section, 'form', { hidden: true });
    this.name = this.#row(this.form, t('Name'),
      { id: 'sign-in-name', type: 'text', autocomplete: 'username', required: true, maxLength: 64 });
    this.password = this.#row(this.form, t('Password'),
      { id: 'sign-in-password', type: 'password', autocomplete: 'current-password', maxLength: 256 });
    this.code = this.#row(this.form, t('Class code'),
      { id: 'sign-in-code', type: 'text', inputMode: 'numeric', autocomplete: 'off', maxLength: 16 });
    this.button = make(this.form, 'button', { id: 'sign-in', textContent: t('Sign in') });
    this.problem = make(this.form, 'p', { id: 'sign-in-problem', hidden: true, role: 'alert' });
    this.form.addEventListener('input', () => this.#showNeeded());
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

  // What the server has of this tab's token, or of the browser's cookie. One that is older, or does not answer, leaves
  // all as it is.
  async #look() {
    const asked = token();
    const { told } = await ask('GET', { bearer: asked });
    if (!told || asked !== token()) return;
    this.hasUsers = told.users === true;
    this.hasClass = told.class === true;
    if (!told.name) this.#showNobody();
    else if (this.#show(told)) this.changed(true);
  }

  // Gives whether the connection has to begin anew.
  #show({ name, role, ship, ends }) {
    const style = { hour: '2-digit', minute: '2-digit', hourCycle: 'h23' };
    const time = ends && new Date(ends).toLocaleTimeString([], style);
    const parts = [name, role, ship, time && t('until {time}', { time })];
    this.who.textContent = parts.filter(Boolean).join(' · ');
    this.signedIn.hidden = false;
    this.form.hidden = this.field.parentElement.hidden = true;
    this.section.hidden = false;
    return this.aboard(ship ?? '');
  }

  #showNobody() {
    this.aboard('');
    this.signedIn.hidden = true;
    this.form.hidden = !this.hasUsers && !this.hasClass;
    this.password.parentElement.hidden = !this.hasUsers;
    this.code.parentElement.hidden = !this.hasClass;
    this.field.parentElement.hidden = false;
    this.#showNeeded();
  }

  // Either is enough.
  #showNeeded() {
    this.code.required = this.hasClass && this.password.value === '';
    this.password.required = this.hasUsers && this.code.value === '';
  }

  #become(text, isAnew = false) {
    setToken(text);
    this.field.value = text;
    this.changed(isAnew);
  }

  async #signIn() {
    this.button.disabled = true;
    this.problem.hidden = true;
    const byCode = this.hasClass && this.code.value !== '';
    const shown = byCode ? { name: this.name.value, code: this.code.value } :
      { name: this.name.value, password: this.password.value };
    let { status, told } = await ask('POST', { body: { ...shown, cookie: mayKeepCookie() } });
    // A browser that did not keep the cookie has the token in the tab.
    if (told && !told.token && !(await ask('GET')).told?.name) ({ status, told } = await ask('POST', { body: shown }));
    this.button.disabled = false;
    if (told) {
      this.password.value = this.code.value = '';
      const moves = this.#show(told);
      this.#become(told.token ?? '', moves || !told.token);
      this.#focus();
      return;
    }
    this.problem.textContent = refusals(byCode)[status] ??
      t('Not signed in: the server does not answer ({status})', { status });
    this.problem.hidden = false;
    (byCode ? this.code : this.password).select();
  }

  // With a token of the tab here at once, and the server is told as well as it can be; the browser's cookie is taken
  // away by the server alone. A token of the server's file does not end so.
  async #signOut() {
    const bearer = token();
    const sent = ask('DELETE', { bearer });
    if (!bearer && !isOut(await sent)) {
      this.problem.textContent = t('Not signed out: the server does not answer');
      this.form.hidden = this.problem.hidden = false;
      return;
    }
    this.#showNobody();
    this.#become('', true);
    this.#focus();
    if (isOut(await sent)) return;
    this.problem.textContent =
      t('Signed out here; the server did not answer, and its session goes on until it ends');
    this.problem.hidden = false;
  }
}

const isOut = ({ status }) => status === 200 || status === 401;
