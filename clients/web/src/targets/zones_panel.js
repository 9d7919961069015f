// ZonesPanel: guard zones and areas of exclusion: drawn, by numbers, and taken away.
import { bearing } from '../format.js';
import { t } from '../language/language.js';
import { wrapDeg } from '../view_geometry.js';
import { BoundedField } from './bounded_field.js';
import { button, element, refusal, sayProblem } from './dom.js';
import { MOST_ZONES, withBounds, ZONES } from './rules.js';
import { ACQUIRES, EXCLUDES } from './wire.js';
import { widthDeg, zoneWord } from './zone_shape.js';

function zoneText(zone) {
  const ring = `${t('{min} to {max}', { min: Number(zone.innerNm.toFixed(2)), max: Number(zone.outerNm.toFixed(2)) })} NM`;
  const ends = t('{min} to {max}', { min: bearing(zone.fromDeg), max: bearing(zone.toDeg) });
  const sector = widthDeg(zone) === 360 ? t('all round') : zone.relative ? t('{sector} from the bow', { sector: ends }) : ends;
  return `${zoneWord(zone.kind)} ${zone.number}: ${ring}, ${sector}`;
}

export class ZonesPanel {
  // setMode('select' or 'zone'); heading(): true heading, or null.
  // known(): whether the zones that there are are known.
  constructor({ orders, table, setMode, heading, known }) {
    Object.assign(this, { orders, setMode, heading, known });
    this.list = element('ul', { id: 'zone-list' });
    this.problem = refusal('zone-refusal');
    this.kind = element('select', { id: 'zone-kind' }, new Option(t('Guard zone: acquires'), ACQUIRES), new Option(t('Exclusion: never acquires'), EXCLUDES));
    this.kind.ariaLabel = t('Kind of zone');
    this.relative = element('input', { id: 'zone-relative', type: 'checkbox' });
    this.fields = withBounds(ZONES, table.targetZones).map((rule) => new BoundedField(`zone-${rule.name}`, rule));
    this.draws = button('zone-draw', t('Draw'), () => this.toggleMode(), { title: t('Then drag from the near corner to the far one'), ariaPressed: 'false' });
    const form = element('form', { id: 'zone-form', noValidate: true }, element('div', { className: 'fields two' }, ...this.fields.map((field) => field.element)),
      element('div', { className: 'actions' }, element('button', { type: 'submit', id: 'zone-add', textContent: t('Add zone') }), this.draws));
    form.addEventListener('submit', (event) => { event.preventDefault(); this.#addTyped(); });
    this.element = element('div', { className: 'zones' }, this.list, this.kind,
      element('div', { className: 'toggles two' }, element('label', {}, this.relative, element('span', { textContent: t('Turns with the bow') }))), form, this.problem);
    this.zones = [];
  }

  get style() {
    return { kind: Number(this.kind.value), relative: this.relative.checked };
  }

  toggleMode(on = this.draws.ariaPressed !== 'true') {
    this.draws.ariaPressed = String(on);
    this.setMode(on ? 'zone' : 'select');
  }

  // The zone of a drag has true bearings.
  asOrdered(zone) {
    const { kind, relative } = this.style;
    const headingDeg = this.heading();
    if (!relative || widthDeg(zone) === 360) return { ...zone, kind, relative };
    if (headingDeg === null) return null;
    const turned = (deg) => Number(wrapDeg(deg - headingDeg).toFixed(1)) % 360;
    return { ...zone, kind, relative, fromDeg: turned(zone.fromDeg), toDeg: turned(zone.toDeg) };
  }

  addDrawn(zone) {
    const ordered = this.asOrdered(zone);
    if (ordered) this.#add(ordered);
    else sayProblem(this.problem, t('Heading is not known: a zone that turns with the bow cannot be drawn'));
  }

  #addTyped() {
    const values = {};
    for (const field of this.fields) values[field.rule.name] = field.read();
    if (Object.values(values).includes(null)) return;
    this.#add({ ...values, ...this.style });
  }

  #add(zone) {
    if (!this.known()) return sayProblem(this.problem, t('Not connected: nothing was ordered'));
    const taken = new Set(this.zones.map(({ number }) => number));
    const number = Array.from({ length: MOST_ZONES }, (_, i) => i + 1).find((n) => !taken.has(n));
    if (number === undefined) return sayProblem(this.problem, t('There are {n} zones: remove one first', { n: MOST_ZONES }));
    if (zone.outerNm - zone.innerNm < 0.05) return sayProblem(this.problem, t('The zone must reach at least 0.05 NM farther than it begins'));
    return this.orders.give({ zones: [{ ...zone, number }] }, this.problem, () => { if (this.draws.ariaPressed === 'true') this.toggleMode(false); });
  }

  show(zones) {
    const text = JSON.stringify(zones);
    if (text === this.shown) return;
    this.shown = text;
    this.zones = zones;
    this.list.replaceChildren(...zones.map((zone) => element('li', {}, element('span', { textContent: zoneText(zone) }),
      button(`zone-remove-${zone.number}`, t('Remove'), () => this.orders.give({ removeZones: [zone.number] }, this.problem),
        { ariaLabel: t('Remove zone {number}', { number: zone.number }) }))));
  }
}
