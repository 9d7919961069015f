// The rudder angle indicator, seen from above looking ahead: the blade's angle as it is, and as it is ordered.
import { side } from './sides.js';
import { arc, drawing, polar, svg, text, tick, Turning } from './svg.js';

const RADIUS = 300;
// The scale hangs below its pivot: 180 deg of svg.js is amidships, and starboard is to the right.
const at = (rudderDeg) => 180 - rudderDeg;

export class RudderGauge {
  constructor(parent) {
    this.scale = svg('g');
    this.wedge = svg('path', { class: 'wedge' });
    const needle = svg('g', { class: 'needle' }, svg('path', { d: `M-4 212L-4 286L0 296L4 286L4 212Z` }));
    const order = svg('g', { class: 'order' }, svg('path', { d: `M0 ${RADIUS + 3}L-9 ${RADIUS + 18}H9Z` }));
    this.orderText = text(-205, 318, '', 'value');
    this.actualText = text(205, 318, '', 'value end');
    this.drawing = drawing('-210 200 420 132', 'Rudder', this.wedge, this.scale, needle, order,
      text(-205, 290, 'ORDER', 'name start'), text(205, 290, 'RUDDER', 'name end'), this.orderText, this.actualText);
    this.orderText.classList.add('start');
    parent.append(this.drawing);
    this.needle = new Turning(needle);
    this.order = new Turning(order);
    this.limitDeg = 0;
  }

  #draw(limitDeg) {
    this.limitDeg = limitDeg;
    const parts = [arc(RADIUS, at(-limitDeg), at(0), 'rim port'), arc(RADIUS, at(0), at(limitDeg), 'rim starboard')];
    for (let deg = -limitDeg; deg <= limitDeg; deg += 5) {
      const long = deg % 10 === 0;
      parts.push(tick(RADIUS - (long ? 16 : 10), RADIUS, at(deg), long ? 'tick' : 'tick minor'));
      if (!long) continue;
      const [x, y] = polar(RADIUS - 30, at(deg));
      parts.push(text(x, y + 5, String(Math.abs(deg)), 'scale'));
    }
    for (const [deg, name] of [[-limitDeg, 'P'], [limitDeg, 'S']]) {
      const [x, y] = polar(RADIUS - 4, at(deg));
      parts.push(text(x + Math.sign(deg) * 16, y, name, deg < 0 ? 'side port' : 'side starboard'));
    }
    this.scale.replaceChildren(...parts);
  }

  // Degrees, starboard positive; NaN: not known.  pending: ordered here, and not yet told by the server.
  show({ rudderDeg, orderDeg, limitDeg, pending }) {
    if (limitDeg > 0 && limitDeg !== this.limitDeg) this.#draw(limitDeg);
    this.needle.show(-rudderDeg);
    this.order.show(-orderDeg);
    this.order.element.classList.toggle('pending', pending);
    const known = Number.isFinite(rudderDeg) && Math.abs(rudderDeg) > 0.05;
    this.wedge.setAttribute('d', known ? this.#sector(rudderDeg) : '');
    this.wedge.setAttribute('class', `wedge ${rudderDeg < 0 ? 'port' : 'starboard'}`);
    this.orderText.textContent = side(orderDeg, 1);
    this.actualText.textContent = side(rudderDeg, 1);
    this.drawing.setAttribute('aria-label', `Rudder ${side(rudderDeg, 1)} degrees, ordered ${side(orderDeg, 1)}`);
  }

  #sector(rudderDeg) {
    const inner = RADIUS - 8, outer = RADIUS;
    const [ax, ay] = polar(inner, at(0)), [bx, by] = polar(outer, at(0));
    const [cx, cy] = polar(outer, at(rudderDeg)), [dx, dy] = polar(inner, at(rudderDeg));
    const sweep = rudderDeg < 0 ? 1 : 0;
    return `M${ax} ${ay}L${bx} ${by}A${outer} ${outer} 0 0 ${sweep} ${cx} ${cy}L${dx} ${dy}A${inner} ${inner} 0 0 ${1 - sweep} ${ax} ${ay}Z`;
  }
}
