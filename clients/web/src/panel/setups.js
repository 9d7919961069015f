// The part of the panel that keeps set-ups by name: save, load, delete, as a file and from one. They are kept on the
// server, where every console has them, or in this browser alone.
import { t } from '../language/language.js';
import { shortName } from '../names.js';
import { $ } from '../widgets.js';

const REVOKE_MS = 10000;
const FRESH_MS = 3000;  // what another console has saved is looked for when a hand comes near, but not more often
const CONTROLS = ['setup-list', 'setup-load', 'setup-delete', 'setup-download'];

export class Setups {
  // store: SetupStore.  server: SetupServer.  notify(text, kind).
  constructor(store, server, notify) {
    Object.assign(this, { store, server, notify, lookedAt: -Infinity, replaces: null });
    $('setup-form').addEventListener('submit', (event) => { event.preventDefault(); this.#save(); });
    $('setup-load').addEventListener('click', () => this.#withChosen((setup) => this.#put(setup)));
    $('setup-delete').addEventListener('click', () => this.#delete());
    $('setup-download').addEventListener('click', () => this.#withChosen((setup) => this.#download(setup)));
    $('setup-upload').addEventListener('click', () => $('setup-file').click());
    $('setup-file').addEventListener('change', () => this.#upload());
    for (const come of ['pointerenter', 'focusin']) $('setups').addEventListener(come, () => this.#lookAgain());
    this.#show();
  }

  // A new connection: what the server keeps is asked for.
  async look() {
    this.lookedAt = performance.now();
    try {
      await this.server.look();
    } catch (error) {
      this.server.keeps = false;
      this.notify(t('The set-ups of the server cannot be read: {why}', { why: shortName(error.message, 200) }));
    }
    this.#show();
  }

  #lookAgain() {
    if (this.server.keeps && performance.now() - this.lookedAt > FRESH_MS) this.look();
  }

  // chosen: [where, name] of the set-up that is to be the chosen one; without, it stays as it is.
  #show(chosen) {
    const list = $('setup-list');
    const kept = { server: this.server.keeps ? this.server.names : [], browser: this.store.names };
    const wanted = chosen ? chosen.join(':') : list.value;
    const options = (where) => kept[where].map((name) => new Option(shortName(name), `${where}:${name}`));
    const group = (where, label) => {
      const made = Object.assign(document.createElement('optgroup'), { label });
      made.append(...options(where));
      return kept[where].length > 0 ? [made] : [];
    };
    list.replaceChildren(...(this.server.keeps
      ? [...group('server', t('On the server')), ...group('browser', t('In this browser'))] : options('browser')));
    const isEmpty = list.options.length === 0;
    if (isEmpty) list.replaceChildren(new Option(t('None yet'), ''));
    if ([...list.options].some(({ value }) => value === wanted)) list.value = wanted;
    for (const id of CONTROLS) $(id).disabled = isEmpty;
    $('setup-where-row').hidden = !this.server.keeps;
    $('setups-note').textContent = this.server.keeps ? '' : t('kept in this browser');
  }

  #chosen() {
    const { value } = $('setup-list');
    const colon = value.indexOf(':');
    return { where: value.slice(0, colon), name: value.slice(colon + 1) };
  }

  async #withChosen(run) {
    const { where, name } = this.#chosen();
    try {
      const setup = where === 'server' ? this.store.fromFile(await this.server.read(name)) : this.store.setups[name];
      if (setup) run(setup);
    } catch (error) {
      this.notify(`${shortName(name)}: ${error.message}`);
      if (where === 'server') this.look();
    }
  }

  #save() {
    const name = shortName($('setup-name').value);
    if (name === '') { $('setup-name').focus(); return; }
    this.#keep(this.store.take(name), () => { $('setup-name').value = ''; });
  }

  // One of another console's is replaced only if that is asked for twice.
  async #keep(setup, kept = () => {}) {
    const { name } = setup;
    if (this.server.keeps && $('setup-where').value === 'server') {
      try {
        if (this.replaces !== name) await this.server.look();
        if (this.replaces !== name && this.server.names.includes(name)) {
          this.replaces = name;
          this.notify(t('The server has a set-up {name}: once more replaces it', { name }));
          this.#show();
          return;
        }
        this.replaces = null;
        await this.server.save(name, this.store.toFile(setup));
        kept();
        this.notify(t('Set-up kept on the server: {name}', { name }), 'info');
        this.#show(['server', name]);
      } catch (error) {
        const why = shortName(error.message, 200);
        this.notify(t('The server did not keep the set-up {name}: {why}', { name, why }));
      }
      return;
    }
    try {
      this.store.save(setup);
      kept();
      this.notify(t('Set-up kept in this browser: {name}', { name }), 'info');
    } catch {
      this.notify(t('This browser keeps no set-ups (its storage is full or switched off)'));
    }
    this.#show(['browser', name]);
  }

  async #delete() {
    const { where, name } = this.#chosen();
    try {
      if (where === 'server') await this.server.remove(name);
      else this.store.remove(name);
    } catch (error) {
      this.notify(`${shortName(name)}: ${error.message}`);
    }
    this.#show();
  }

  #put(setup) {
    this.store.put(setup);
    this.notify(t('Set-up in force: {name}', { name: setup.name }), 'info');
  }

  #download(setup) {
    const link = document.createElement('a');
    link.href = URL.createObjectURL(new Blob([this.store.toFile(setup)], { type: 'application/json' }));
    link.download = `${setup.name.toLowerCase().replace(/[^\p{L}\p{N}]+/gu, '-').replace(/^-|-$/g, '') || 'set-up'}.json`;
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), REVOKE_MS);
  }

  async #upload() {
    const [file] = $('setup-file').files;
    $('setup-file').value = '';
    if (!file) return;
    try {
      this.#keep(this.store.fromFile(await file.text()));
    } catch (error) {
      this.notify(`${shortName(file.name)}: ${error.message}`);
    }
  }
}
