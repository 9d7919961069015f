// TargetSigns: what is always said in the picture: mode and minutes of the vectors, to what motions refer, and what is wrong.
import { t } from '../language/language.js';
import { element, say } from './dom.js';
import { GROUND } from './wire.js';

export class TargetSigns {
  // box: a corner of the picture's frame; signs: the frame's list of signs.
  constructor(box, signs) {
    this.vectors = element('output', { id: 'vector-sign' });
    this.stabilisation = element('output', { id: 'stabilisation-sign' });
    this.limits = element('output', { id: 'limits-sign', className: 'dim' });
    box.append(...[this.vectors, this.stabilisation, this.limits].map((output) => element('p', {}, output)));
    const sign = (id) => { const made = element('p', { id, hidden: true }); signs.append(made); return made; };
    this.trial = sign('trial-sign');
    this.stale = sign('targets-stale');
    this.mode = sign('pointer-mode');
    this.problem = sign('target-problem');
  }

  #sign(element, words) {
    say(element, words);
    element.hidden = words === '';
  }

  // mode: of TargetInput.
  show({ list, isStale, settings, mode }) {
    say(this.vectors, `VECT ${settings.relative ? 'R' : 'T'} ${settings.minutes} min`);
    const by = list?.stabilisedBy ?? '';
    say(this.stabilisation, !list || isStale ? 'STAB \u2013' : `STAB ${list.stabilisation === GROUND ? 'G' : 'W'} ${by || t('stabilised|none')}`);
    const { cpaNm, tcpaMin } = list?.rules ?? {};
    say(this.limits, cpaNm === undefined || tcpaMin === undefined ? '' : `CPA ${Number(cpaNm.toFixed(2))} NM TCPA ${Number(tcpaMin.toFixed(1))} min`);
    this.#sign(this.trial, list?.trial && !isStale ? t('Trial') : '');
    this.#sign(this.stale, isStale ? t('Targets not updated') : '');
    this.#sign(this.mode, mode === 'acquire' ? t('Acquire: press on an echo') : mode === 'zone' ? t('Zone: drag from near to far corner') : '');
    this.#sign(this.problem, list?.problem ?? '');
  }
}
