// The compass repeater: the card turns under the lubber line, with the heading in figures, what the autopilot keeps and
// the course over ground.
import { bearing } from '../format.js';
import { drawing, polar, svg, text, tick, Turning } from './svg.js';

const CARDINALS = new Map([[0, 'N'], [90, 'E'], [180, 'S'], [270, 'W']]);

function card() {
  const group = svg('g');
  for (let deg = 0; deg < 360; deg += 5) group.append(tick(deg % 30 === 0 ? 82 : deg % 10 === 0 ? 86 : 89, 94, deg, deg % 10 === 0 ? 'tick' : 'tick minor'));
  for (let deg = 0; deg < 360; deg += 30) {
    const [x, y] = polar(74, deg);
    const label = text(x, y, CARDINALS.get(deg) ?? bearing(deg, 0), CARDINALS.has(deg) ? 'cardinal' : 'scale');
    label.setAttribute('transform', `rotate(${deg} ${x} ${y})`);
    group.append(label);
  }
  return group;
}

export class Compass {
  constructor(parent) {
    const cardGroup = card();
    // Hollow: an order. A diamond: over ground.
    const order = svg('g', { class: 'order' }, svg('path', { d: 'M0 -94L-6 -103H6Z' }));
    const course = svg('g', { class: 'over-ground' }, svg('path', { d: 'M0 -94L4 -87L0 -80L-4 -87Z' }));
    this.figure = text(0, 7, '', 'heading');
    this.orderText = text(0, 47, '', 'scale order-text');
    this.drawing = drawing('-106 -108 212 214', 'Compass', svg('circle', { r: 95, class: 'rim' }), cardGroup, course, order,
      svg('path', { d: 'M0 -96L-5 -107H5Z', class: 'lubber' }), tick(80, 95, 0, 'lubber-line'),
      text(0, -34, 'HDG', 'name'), this.figure, text(0, 31, '°T', 'scale'), this.orderText);
    parent.append(this.drawing);
    this.card = new Turning(cardGroup);
    this.order = new Turning(order);
    this.course = new Turning(course);
  }

  // Degrees true; NaN: not known.
  show({ headingDeg, orderDeg, courseDeg }) {
    this.card.show(-headingDeg);
    this.order.show(orderDeg - headingDeg);
    this.course.show(courseDeg - headingDeg);
    this.figure.textContent = bearing(headingDeg);
    this.orderText.textContent = Number.isFinite(orderDeg) ? `ORDER ${bearing(orderDeg)}` : '';
    this.drawing.setAttribute('aria-label', `Compass, heading ${bearing(headingDeg)} degrees true`);
  }
}
