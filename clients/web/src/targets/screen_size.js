// ScreenSize: how long a line of 100 CSS pixels is on this screen, so that symbols have their sizes in mm.
import { later, t } from '../language/language.js';
import { BoundedField } from './bounded_field.js';
import { button, element, say } from './dom.js';

const BAR_PX = 300;
const RULE = { label: later('Length of the bar'), min: 15, max: 300, unit: 'mm' };

export class ScreenSize {
  constructor(settings, changed) {
    this.settings = settings;
    this.changed = changed;
    this.field = new BoundedField('screen-bar-mm', RULE);
    const bar = element('div', { id: 'screen-bar' });
    bar.style.width = `${BAR_PX}px`;
    this.dialog = element('dialog', { id: 'screen-size' }, element('form', { method: 'dialog' },
      element('h2', { textContent: t('Size of this screen') }),
      element('p', { textContent: t('Hold a ruler to the bar. Symbols of targets then have the sizes that mariners expect.') }), bar, this.field.element,
      element('div', { className: 'actions' }, button('screen-size-save', t('Save'), () => this.#save()),
        button('screen-size-default', t('As 96 dpi'), () => this.#keep(100 / (96 / 25.4))), element('button', { value: 'no', textContent: t('Not now') }))));
    this.dialog.ariaLabel = t('Size of this screen');
    this.dialog.addEventListener('keydown', (event) => event.stopPropagation());
    this.dialog.querySelector('form').addEventListener('submit', (event) => {
      if (event.submitter?.value === 'no') return;
      event.preventDefault();  // Enter in the field saves
      this.#save();
    });
    document.body.append(this.dialog);
    this.opens = button('screen-size-open', '', () => this.open());
    this.question = element('p', { id: 'screen-size-question', className: 'hint',
      textContent: t('Symbols are drawn as for a screen of 96 dpi. Measure this one once:') });
    this.element = element('div', {}, this.question, this.opens);
    this.#show();
  }

  open() {
    this.field.set((BAR_PX / 100) * (this.settings.mmOf100px ?? 100 / (96 / 25.4)));
    this.dialog.showModal();
  }

  #save() {
    const mm = this.field.read();
    if (mm !== null) this.#keep((mm * 100) / BAR_PX);
  }

  #keep(mmOf100px) {
    this.settings.change({ mmOf100px });
    this.dialog.close();
    this.#show();
    this.changed();
  }

  #show() {
    const { mmOf100px } = this.settings;
    this.question.hidden = mmOf100px !== null;
    say(this.opens, mmOf100px === null ? t('Measure the screen') : t('Screen: 100 px are {size} mm', { size: mmOf100px.toFixed(1) }));
  }
}
