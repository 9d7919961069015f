// Drawing of instruments: SVG elements, and needles that turn the short way.
const SVG = 'http://www.w3.org/2000/svg';
const RAD = Math.PI / 180;

export function svg(name, attributes = {}, ...children) {
  const made = document.createElementNS(SVG, name);
  for (const [attribute, value] of Object.entries(attributes)) made.setAttribute(attribute, value);
  made.append(...children);
  return made;
}

export function drawing(viewBox, label, ...children) {
  return svg('svg', { viewBox, role: 'img', 'aria-label': label }, ...children);
}

export const text = (x, y, content, className = '') => svg('text', { x, y, class: className }, content);

// From the upright, clockwise, about the origin; y is downwards.
export const polar = (radius, deg) => [radius * Math.sin(deg * RAD), -radius * Math.cos(deg * RAD)];

export function tick(inner, outer, deg, className = 'tick') {
  const [x1, y1] = polar(inner, deg), [x2, y2] = polar(outer, deg);
  return svg('line', { x1, y1, x2, y2, class: className });
}

export function arc(radius, fromDeg, toDeg, className) {
  const [x1, y1] = polar(radius, fromDeg), [x2, y2] = polar(radius, toDeg);
  const large = Math.abs(toDeg - fromDeg) > 180 ? 1 : 0, clockwise = toDeg > fromDeg ? 1 : 0;
  return svg('path', { d: `M${x1} ${y1}A${radius} ${radius} 0 ${large} ${clockwise} ${x2} ${y2}`, class: className });
}

// What turns: shown at an angle, by the short way from where it is; hidden while the angle is unknown.
export class Turning {
  constructor(element) {
    this.element = element;
    this.deg = 0;
    element.classList.add('turns');
    this.show(NaN);
  }

  show(deg) {
    const known = Number.isFinite(deg);
    this.element.style.visibility = known ? '' : 'hidden';
    if (!known) return;
    this.deg += ((deg - this.deg + 540) % 360 + 360) % 360 - 180;
    this.element.style.transform = `rotate(${this.deg.toFixed(3)}deg)`;
  }
}
