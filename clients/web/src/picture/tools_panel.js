// ToolsPanel: the measuring tools in the panel: switches, numbers, true or relative, origins.
import { t } from '../language/language.js';
import { NAUTICAL_MILE_M } from '../view_geometry.js';
import { $ } from '../widgets.js';
import { NumberField } from './number_field.js';
import { FARTHEST_M, inFrame, LINES, originFrom, trueBearing } from './tools.js';

const MOST_NM = FARTHEST_M / NAUTICAL_MILE_M;
const element = (tag, properties = {}, ...children) => {
  const made = Object.assign(document.createElement(tag), properties);
  made.append(...children);
  return made;
};
const bearingField = (name, enter) =>
  new NumberField({ label: t('Bearing'), name, unit: '°', least: 0, most: 359.9, digits: 1 }, enter);
const rangeField = (label, name, enter, more = {}) =>
  new NumberField({ label, name, unit: 'NM', least: 0, most: MOST_NM, digits: 3, ...more }, enter);
const nm = (metres) => (metres === null ? null : metres / NAUTICAL_MILE_M);
const metres = (value) => (value === null ? null : value * NAUTICAL_MILE_M);

export class ToolsPanel {
  // markers: Markers, for what is known now and the mode of choosing an origin.
  constructor(tools, markers) {
    Object.assign(this, { tools, markers, line: 0, shown: '' });
    this.#bindSwitches();
    this.bearings = [0, 1].map((n) => this.#bearingTool(n));
    $('bearing-tools').append(...this.bearings.map(({ box }) => box));
    this.#lineTools();
  }

  #bindSwitches() {
    for (const [id, kind, n] of [['ebl', 'ebls', 0], ['vrm', 'vrms', 0], ['ebl2', 'ebls', 1], ['vrm2', 'vrms', 1]]) {
      $(id).addEventListener('change', () => { this.tools.toggle(kind, n, this.markers.view); this.show(); });
    }
  }

  // A tool's frame is changed, and it stays where it is.
  #turnFrame(kind, n) {
    const tool = this.tools[kind][n], { bowDeg } = this.markers.now;
    const frame = tool.frame === 'true' ? 'relative' : 'true';
    this.tools.set(kind, n, { frame, bearingDeg: inFrame(frame, trueBearing(tool, bowDeg), bowDeg) });
  }

  #bearingTool(n) {
    const { tools, markers } = this;
    const number = n + 1;
    const bearing = bearingField(t('Bearing of EBL {n}', { n: number }), (deg) => { tools.set('ebls', n, { bearingDeg: deg }); tools.activate(n); });
    const frame = element('button', { type: 'button', id: `ebl${number}-frame` });
    frame.addEventListener('click', () => this.#turnFrame('ebls', n));
    const range = rangeField(t('Range'), t('Range of VRM {n}', { n: number }), (value) => { tools.set('vrms', n, { rangeM: metres(value) }); tools.activate(n); });
    const origin = element('select', { id: `origin${number}`, ariaLabel: t('Origin of EBL and VRM {n}', { n: number }) },
      new Option(t('From own ship'), 'own'), new Option(t('From a place'), 'place'), new Option(t('From off own ship'), 'off'));
    const choose = element('button', { type: 'button', id: `origin${number}-choose`, textContent: t('Choose in picture') });
    const originBearing = bearingField(t('Bearing of origin {n}', { n: number }), (deg) => this.#moveOrigin(n, { bearingDeg: deg }));
    const originRange = rangeField(t('Range'), t('Range of origin {n}', { n: number }), (value) => this.#moveOrigin(n, { rangeM: metres(value) }));
    origin.addEventListener('change', () => this.#setOrigin(n, origin.value));
    choose.addEventListener('click', () => { tools.activate(n); markers.setMode('origin'); });
    const eblName = element('span', { className: 'name', textContent: `EBL ${number}` });
    const vrmName = element('span', { className: 'name', textContent: `VRM ${number}` });
    const off = element('div', { className: 'wide' }, origin, originBearing.element, originRange.element, choose);
    const box = element('div', { className: 'tool' }, eblName, bearing.element, frame, vrmName, range.element, element('span'), element('span'), off);
    return { box, bearing, frame, range, origin, choose, originBearing, originRange };
  }

  #setOrigin(n, kind) {
    const { tools, markers } = this;
    const at = originFrom(tools.ebls[n].origin, markers.now.ownPlace) ?? { bearingDeg: 0, rangeM: 0 };
    const carried = { bearingDeg: at.bearingDeg, rangeM: at.rangeM };
    const place = markers.placeOf(carried);
    if (kind === 'place' && place === null) markers.events.told(t('No position: the origin goes with own ship'));
    tools.set('ebls', n, { origin: kind === 'own' ? null : kind === 'place' && place ? place : carried });
  }

  #moveOrigin(n, values) {
    const { tools, markers } = this;
    const { origin } = tools.ebls[n];
    const at = originFrom(origin, markers.now.ownPlace);
    if (origin === null || at === null) return;
    const moved = { bearingDeg: at.bearingDeg, rangeM: at.rangeM, ...values };
    tools.set('ebls', n, { origin: origin.rangeM === undefined ? markers.placeOf(moved) : moved });
  }

  #lineTools() {
    const { tools } = this;
    const set = (values) => tools.set('lines', this.line, values);
    const group = element('button', { type: 'button', id: 'lines-all', textContent: t('All lines'), title: t('All on or off (I)') });
    const reset = element('button', { type: 'button', id: 'lines-reset', textContent: t('Reset') });
    const on = element('button', { type: 'button', id: 'line-on' });
    group.addEventListener('click', () => this.toggleLines());
    reset.addEventListener('click', () => tools.resetLines());
    on.addEventListener('click', () => tools.toggle('lines', this.line, this.markers.view, this.markers.now.bowDeg));
    const choice = Array.from({ length: LINES }, (_, n) => {
      const button = element('button', { type: 'button', textContent: String(n + 1), ariaLabel: t('Line {n}', { n: n + 1 }) });
      button.addEventListener('click', () => this.#chooseLine(n));
      return button;
    });
    const frame = element('button', { type: 'button', id: 'line-frame' });
    frame.addEventListener('click', () => this.#turnFrame('lines', this.line));
    const signed = { least: -MOST_NM, most: MOST_NM };
    const fields = {
      bearing: bearingField(t('Bearing of the line'), (deg) => set({ bearingDeg: deg })),
      offset: rangeField(t('Offset'), t('Offset of the line, to port negative'), (value) => set({ offsetM: metres(value) }), signed),
      from: rangeField(t('From'), t('Line from, astern negative'), (value) => set({ fromM: metres(value) }), { ...signed, isOptional: true }),
      to: rangeField(t('To'), t('Line to, astern negative'), (value) => set({ toM: metres(value) }), { ...signed, isOptional: true }),
    };
    const name = (text) => element('span', { className: 'name', textContent: text });
    $('parallel-tools').append(
      element('div', { className: 'actions' }, group, reset),
      element('div', { className: 'line-choice' }, ...choice),
      element('div', { className: 'tool' }, name(t('Bearing')), fields.bearing.element, frame, name(t('Offset')), fields.offset.element, on,
        name(t('From')), fields.from.element, element('span'), name(t('To')), fields.to.element, element('span')));
    this.lineParts = { group, on, choice, frame, fields };
  }

  #chooseLine(n) {
    for (const field of Object.values(this.lineParts.fields)) field.leave();
    this.line = n;
    this.show(true);
  }

  // The group: what is on singly shows or hides together; without any, the first.
  toggleLines() {
    const { tools } = this;
    if (!tools.lines.some(({ on }) => on)) { tools.toggle('lines', 0, this.markers.view, this.markers.now.bowDeg); return; }
    tools.areLinesOn = !tools.areLinesOn;
    tools.changed();
  }

  // Called a few times a second.
  show(force = false) {
    const { tools, markers } = this;
    const { bowDeg, ownPlace } = markers.now;
    const key = `${tools.changes} ${this.line} ${markers.mode}`;
    const moves = tools.ebls.some(({ origin }) => origin !== null);
    if (!force && !moves && key === this.shown) return;
    this.shown = key;
    for (const [id, tool] of [['ebl', tools.ebls[0]], ['vrm', tools.vrms[0]], ['ebl2', tools.ebls[1]], ['vrm2', tools.vrms[1]]]) {
      $(id).checked = tool.on;
    }
    this.bearings.forEach((part, n) => {
      const ebl = tools.ebls[n], vrm = tools.vrms[n], at = originFrom(ebl.origin, ownPlace);
      part.box.hidden = !ebl.on && !vrm.on;
      part.box.classList.toggle('active', n === tools.active);
      part.bearing.show(ebl.bearingDeg);
      showFrame(part.frame, ebl.frame, `EBL ${n + 1}`);
      part.range.show(nm(vrm.rangeM));
      part.origin.value = ebl.origin === null ? 'own' : ebl.origin.rangeM === undefined ? 'place' : 'off';
      const isOff = ebl.origin !== null;
      for (const shown of [part.originBearing.element, part.originRange.element, part.choose]) shown.hidden = !isOff;
      part.originBearing.show(at?.bearingDeg ?? null);
      part.originRange.show(nm(at?.rangeM ?? null));
      part.choose.setAttribute('aria-pressed', String(markers.mode === 'origin' && n === tools.active));
    });
    const { group, on, choice, frame, fields } = this.lineParts, line = tools.lines[this.line];
    group.setAttribute('aria-pressed', String(tools.areLinesOn && tools.lines.some((l) => l.on)));
    on.textContent = line.on ? t('On') : t('Off');
    on.ariaLabel = `${t('Line {n}', { n: this.line + 1 })}: ${on.textContent}`;
    on.setAttribute('aria-pressed', String(line.on));
    choice.forEach((button, n) => {
      button.setAttribute('aria-pressed', String(n === this.line));
      button.textContent = `${n + 1}${tools.lines[n].on ? ' •' : ''}`;
    });
    showFrame(frame, line.frame, t('line'));
    fields.bearing.show(line.bearingDeg);
    fields.offset.show(nm(line.offsetM));
    fields.from.show(nm(line.fromM));
    fields.to.show(nm(line.toM));
  }
}

function showFrame(button, frame, of) {
  button.textContent = frame === 'true' ? 'T' : 'R';
  button.ariaLabel = frame === 'true' ? t('Bearing of {tool}: true; press for relative', { tool: of }) : t('Bearing of {tool}: relative; press for true', { tool: of });
}
