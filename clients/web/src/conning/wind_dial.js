// Wind and current about the ship, her bow up: T and R come from where they stand, C goes whither it points.
import { drawing, svg, text, tick, Turning } from './svg.js';

const RING = 50;
const OUTLINE = 'M0 -21C5 -16 7 -10 7 -3V18H-7V-3C-7 -10 -5 -16 0 -21Z';

// A letter that stays upright while its arrow turns.
function arrow(className, letter, path, letterY) {
  const label = text(0, letterY + 5, letter, 'letter');
  const group = svg('g', { class: className }, svg('path', { d: path }), label);
  return { group, label, letterY };
}

export class WindDial {
  constructor(parent) {
    const ticks = [];
    for (let deg = 0; deg < 360; deg += 30) ticks.push(tick(deg % 90 === 0 ? RING - 7 : RING - 4, RING, deg));
    this.arrows = {
      current: arrow('current', 'C', `M0 -82L13 -66H9V-${RING + 2}H-9V-66H-13Z`, -63),
      trueWind: arrow('true', 'T', `M0 -${RING + 2}L-13 -79H13Z`, -70),
      relative: arrow('relative', 'R', `M0 -22L-13 -${RING - 1}H13Z`, -40),  // inside, where it does not hide the true one
    };
    this.drawing = drawing('-80 -80 160 160', 'Wind and current', svg('circle', { r: RING, class: 'rim' }), ...ticks,
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
