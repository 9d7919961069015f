// VectorPanel: vectors, past positions and symbols, as this screen shows them.
import { t } from '../language/language.js';
import { button, element, say, toggle } from './dom.js';
import { MINUTES } from './vector_settings.js';

export class VectorPanel {
  // settings: VectorSettings; changed(): they have.
  constructor(settings, changed) {
    this.settings = settings;
    this.changed = changed;
    const choice = (id, value, words) => {
      const input = element('input', { id, type: 'radio', name: 'vector-mode', value });
      input.addEventListener('change', () => this.change({ relative: value === 'relative' }));
      return element('label', {}, input, element('span', { textContent: words }));
    };
    const modes = element('div', { className: 'choice', role: 'radiogroup', ariaLabel: t('Vectors') },
      choice('vectors-true', 'true', t('True vectors')), choice('vectors-relative', 'relative', t('Relative')));
    this.less = button('vector-less', '\u2212', () => this.step(-1), { title: `${t('Shorter vectors')} ([)`, ariaLabel: t('Shorter vectors') });
    this.more = button('vector-more', '+', () => this.step(1), { title: `${t('Longer vectors')} (])`, ariaLabel: t('Longer vectors') });
    this.minutes = element('output', { id: 'vector-minutes' });
    const boxes = element('div', { className: 'toggles' });
    for (const [id, name, words] of [['vector-ticks', 'ticks', t('Minutes')], ['target-past', 'past', t('Past')], ['target-ais', 'ais', 'AIS'],
                                     ['target-names', 'names', t('Names')]]) {
      boxes.append(toggle(id, words, (on) => this.change({ [name]: on })));
    }
    this.joined = element('select', { id: 'target-joined' }, new Option('AIS', 'ais'), new Option(t('Radar'), 'radar'));
    this.joined.addEventListener('change', () => this.change({ joined: this.joined.value }));
    this.element = element('div', {}, modes, element('div', { className: 'steps' }, this.less, this.minutes, this.more), boxes,
      element('label', { className: 'row' }, element('span', { textContent: t('Radar and AIS as one') }), this.joined));
    this.boxes = { ticks: boxes.querySelector('#vector-ticks'), past: boxes.querySelector('#target-past'),
                   ais: boxes.querySelector('#target-ais'), names: boxes.querySelector('#target-names') };
    this.radios = { true: modes.querySelector('#vectors-true'), relative: modes.querySelector('#vectors-relative') };
    this.show();
  }

  change(values) {
    this.settings.change(values);
    this.show();
    this.changed();
  }

  step(by) {
    this.settings.stepMinutes(by);
    this.change({});
  }

  show() {
    const { settings } = this;
    this.radios[settings.relative ? 'relative' : 'true'].checked = true;
    say(this.minutes, `${settings.minutes} min`);
    this.less.disabled = settings.minutes === MINUTES[0];
    this.more.disabled = settings.minutes === MINUTES.at(-1);
    for (const [name, box] of Object.entries(this.boxes)) box.checked = settings[name];
    this.joined.value = settings.joined;
  }
}
