// Wind and current about the ship, her bow up: T and R come from where they stand, C goes whither it points.
import { drawing, svg, text, tick, Turning } from './svg.js';

const OUTLINE = 'M0 -26C6 -20 8 -12 8 -4V22H-8V-4C-8 -12 -6 -20 0 -26Z';

// A letter that stays upright while its arrow turns.
function arrow(className, letter, path, letterY) {
  const label = text(0, letterY + 4, letter, 'letter');
  const group = svg('g', { class: className }, svg('path', { d: path }), label);
  return { group, label, letterY };
}

export class WindDial {
  constructor(parent) {
    const ticks = [];
    for (let deg = 0; deg < 360; deg += 30) ticks.push(tick(deg % 90 === 0 ? 57 : 60, 64, deg));
    this.arrows = {
      current: arrow('current', 'C', 'M0 -52L7 -38H3V-30H-3V-38H-7Z', -44),
      trueWind: arrow('true', 'T', 'M0 -42L-8 -64H8Z', -72),
      relative: arrow('relative', 'R', 'M0 -42L-8 -64L0 -58L8 -64Z', -72),
    };
    this.drawing = drawing('-82 -82 164 164', 'Wind and current', svg('circle', { r: 64, class: 'rim' }), ...ticks,
      svg('path', { d: OUTLINE, class: 'hull' }), ...Object.values(this.arrows).map((a) => a.group));
    parent.append(this.drawing);
    for (const a of Object.values(this.arrows)) a.turning = new Turning(a.group);
  }

  show(con, headingDeg, relative) {
    const place = (name, deg) => {
      const { turning, label, letterY } = this.arrows[name];
      turning.show(deg);
      if (Number.isFinite(deg)) label.setAttribute('transform', `rotate(${-deg} 0 ${letterY})`);
    };
    place('current', con?.currentKn >= 0.05 ? con.currentSetDeg - headingDeg : NaN);
    place('trueWind', con?.windKn >= 0.05 ? con.windFromDeg - headingDeg : NaN);
    place('relative', relative?.kn >= 0.05 ? relative.fromDeg : NaN);
  }
}
