// The engine: telegraph positions, lever, and the shaft's revolutions beside it on the same scale.
import { fixed } from '../format.js';
import { $, write } from '../widgets.js';
import { Lever } from './lever.js';
import { ahead } from './sides.js';

// Percent of full turns; the lever has them at equal distances.
export const POSITIONS = [
  [100, 'Full ahead'], [75, 'Half ahead'], [50, 'Slow ahead'], [25, 'Dead slow ahead'], [0, 'Stop'],
  [-25, 'Dead slow astern'], [-50, 'Slow astern'], [-75, 'Half astern'], [-100, 'Full astern'],
];

// The next position above (ahead) or below.
export function nextPosition(percent, ahead) {
  const values = POSITIONS.map(([value]) => value);
  const beyond = ahead ? values.filter((value) => value > percent + 0.5) : values.filter((value) => value < percent - 0.5);
  return ahead ? beyond.at(-1) ?? 100 : beyond[0] ?? -100;
}

// Of full turns, ahead or astern; NaN: not known.
export function percentOf(rpm, con) {
  const full = rpm < 0 ? Math.abs(con.fullAsternRpm) : con.fullAheadRpm;
  return full > 0 ? (100 * rpm) / full : NaN;
}

export function rpmOf(percent, con) {
  return (percent / 100) * (percent < 0 ? Math.abs(con.fullAsternRpm) : con.fullAheadRpm);
}

export class Engine {
  // order(percent)
  constructor(order) {
    this.buttons = POSITIONS.map(([percent, name]) => {
      const button = document.createElement('button');
      Object.assign(button, { type: 'button', textContent: name });
      button.dataset.percent = percent;
      button.classList.toggle('stop', percent === 0);
      button.addEventListener('click', () => order(percent));
      return button;
    });
    $('telegraph').replaceChildren(...this.buttons);
    this.lever = new Lever($('engine-lever'), {
      label: 'Engine order, percent', least: -100, most: 100, page: 25, vertical: true, words: ahead, change: order,
      marks: Object.fromEntries(POSITIONS.map(([percent]) => [percent, ''])),
    });
    for (const button of document.querySelectorAll('[data-engine-step]')) {
      button.addEventListener('click', () => order(this.lever.value + Number(button.dataset.engineStep)));
    }
    this.gauge = new RpmGauge($('rpm-gauge'));
  }

  // con: ConState or null.  order: { value, pending }.
  show(con, order) {
    const percent = con ? order.value : NaN;
    this.lever.show(percent, order.pending);
    for (const button of this.buttons) {
      button.ariaPressed = String(Math.abs(Number(button.dataset.percent) - percent) < 0.5);
    }
    write('engine-order', ahead(percent));
    $('engine-order').classList.toggle('pending', order.pending);
    write('shaft', fixed(con?.shaftRpm, 0).replace('-', '\u2212'));
    this.gauge.show(con, percent);
  }
}

// Actual turns as a bar from the middle, ordered ones as a hollow arrow.
class RpmGauge {
  constructor(parent) {
    const part = (className) => {
      const made = document.createElement('div');
      made.className = className;
      return made;
    };
    this.bar = part('fill');
    this.mark = part('needle-line');
    this.order = part('order-mark');
    this.scale = part('marks');
    this.groove = part('groove');
    parent.append(this.groove, this.bar, this.scale, this.mark, this.order);
  }

  #draw(con) {
    this.drawn = `${con.fullAheadRpm} ${con.fullAsternRpm}`;
    this.scale.replaceChildren(...[100, 75, 50, 25, 0, -25, -50, -75, -100].map((percent) => {
      const mark = document.createElement('div');
      mark.className = 'mark-at';
      mark.textContent = percent % 50 === 0 ? String(Math.round(Math.abs(rpmOf(percent, con)))) : '';
      mark.style.setProperty('--at', String((percent + 100) / 200));
      return mark;
    }));
  }

  show(con, orderPercent) {
    if (con && this.drawn !== `${con.fullAheadRpm} ${con.fullAsternRpm}`) this.#draw(con);
    const at = (percent) => Math.max(0, Math.min(1, (percent + 100) / 200));
    const actual = con ? percentOf(con.shaftRpm, con) : NaN;
    for (const [part, percent] of [[this.mark, actual], [this.order, orderPercent]]) {
      part.style.visibility = Number.isFinite(percent) ? '' : 'hidden';
      if (Number.isFinite(percent)) part.style.setProperty('--at', String(at(percent)));
    }
    this.bar.style.visibility = Number.isFinite(actual) ? '' : 'hidden';
    if (!Number.isFinite(actual)) return;
    this.bar.style.setProperty('--from', String(Math.min(0.5, at(actual))));
    this.bar.style.setProperty('--size', String(Math.abs(at(actual) - 0.5)));
    this.bar.classList.toggle('astern', actual < 0);
  }
}
