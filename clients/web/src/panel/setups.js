// The part of the panel that keeps set-ups by name: save, load, delete, as a file and from one.
import { t } from '../language/language.js';
import { shortName } from '../names.js';
import { $ } from '../widgets.js';

const REVOKE_MS = 10000;

export class Setups {
  // store: SetupStore.  notify(text, kind).
  constructor(store, notify) {
    Object.assign(this, { store, notify });
    $('setup-form').addEventListener('submit', (event) => { event.preventDefault(); this.#save(); });
    $('setup-load').addEventListener('click', () => this.#withChosen((setup) => this.#put(setup)));
    $('setup-delete').addEventListener('click', () => this.#withChosen(({ name }) => { store.remove(name); this.#show(); }));
    $('setup-download').addEventListener('click', () => this.#withChosen((setup) => this.#download(setup)));
    $('setup-upload').addEventListener('click', () => $('setup-file').click());
    $('setup-file').addEventListener('change', () => this.#upload());
    this.#show();
  }

  #show(chosen) {
    const { names } = this.store;
    $('setup-list').replaceChildren(...(names.length > 0 ? names.map((name) => new Option(shortName(name), name)) : [new Option(t('None yet'), '')]));
    if (chosen) $('setup-list').value = chosen;
    for (const id of ['setup-list', 'setup-load', 'setup-delete', 'setup-download']) $(id).disabled = names.length === 0;
  }

  #withChosen(run) {
    const setup = this.store.setups[$('setup-list').value];
    if (setup) run(setup);
  }

  #save() {
    const name = shortName($('setup-name').value);
    if (name === '') { $('setup-name').focus(); return; }
    this.#keep(this.store.take(name));
    $('setup-name').value = '';
  }

  #keep(setup) {
    try {
      this.store.save(setup);
      this.notify(t('Set-up kept in this browser: {name}', { name: setup.name }), 'info');
    } catch {
      this.notify(t('This browser keeps no set-ups (its storage is full or switched off)'));
    }
    this.#show(setup.name);
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
