// The rate of turn indicator: a bar from the middle on a scale that grows with what it has had to show.
import { svg, drawing, text } from './svg.js';

const WIDTH = 380;
const SCALES = [30, 60, 120, 300, 720];

export class TurnGauge {
  constructor(parent) {
    this.ticks = svg('g');
    this.bar = svg('rect', { x: 0, y: 8, width: 0, height: 12, class: 'wedge' });
    this.limits = svg('g', { class: 'order' }, svg('path', { d: 'M0 6L-5 -3H5Z' }), svg('path', { d: 'M0 6L-5 -3H5Z' }));
    this.mark = svg('rect', { x: -1.5, y: 4, width: 3, height: 20, class: 'needle slides' });
    parent.append(drawing('-206 -5 412 50', 'Rate of turn', svg('rect', { x: -WIDTH / 2, y: 8, width: WIDTH, height: 12, class: 'groove' }),
      this.bar, this.ticks, this.limits, this.mark, text(-201, 18, 'P', 'side port'), text(201, 18, 'S', 'side starboard')));
    this.reset();
  }

  // Another ship turns at other rates.
  reset() {
    this.#scaleTo(SCALES[0]);
    this.show(NaN, 0);
  }

  #scaleTo(most) {
    this.most = most;
    const parts = [];
    for (let i = -6; i <= 6; ++i) {
      const x = (i * WIDTH) / 12;
      parts.push(svg('line', { x1: x, x2: x, y1: 20, y2: i % 2 === 0 ? 28 : 24, class: i % 2 === 0 ? 'tick' : 'tick minor' }));
      if (i % 2 === 0) parts.push(text(x, 41, String(Math.round(Math.abs((i * most) / 6))), 'scale'));
    }
    this.ticks.replaceChildren(...parts);
  }

  // deg/min, starboard positive; NaN: not known.  limit: of the autopilot, 0 for none.
  show(rate, limit) {
    const known = Number.isFinite(rate);
    const fits = SCALES.find((scale) => scale >= Math.abs(rate)) ?? SCALES.at(-1);
    if (known && fits > this.most) this.#scaleTo(fits);
    const x = known ? (Math.max(-1, Math.min(1, rate / this.most)) * WIDTH) / 2 : 0;
    this.bar.setAttribute('x', Math.min(0, x));
    this.bar.setAttribute('width', Math.abs(x));
    this.bar.setAttribute('class', `wedge ${rate < 0 ? 'port' : 'starboard'}`);
    this.mark.style.visibility = known ? '' : 'hidden';
    this.mark.style.transform = `translateX(${x.toFixed(2)}px)`;
    const at = limit > 0 && limit <= this.most ? (limit / this.most) * WIDTH / 2 : 0;
    this.limits.style.visibility = known && at > 0 ? '' : 'hidden';
    this.limits.children[0].setAttribute('transform', `translate(${-at} 0)`);
    this.limits.children[1].setAttribute('transform', `translate(${at} 0)`);
  }
}
