// Tools: the measuring tools of this console and where they stand; kept in this browser. No drawing, no elements.
//
//   ebls[2]    { on, frame, bearingDeg, origin }   frame: 'true' or 'relative' (turns with own ship)
//   vrms[2]    { on, rangeM }                      centred on the origin of the EBL of the same number
//   lines[6]   { on, frame, bearingDeg, offsetM, fromM, toM }   parallel index lines; offsetM is athwart own ship as seen along the
//              bearing, to the right if positive; fromM and toM run along the line from abeam, null: as far as the picture
//   origin     null: own ship; { latitudeDeg, longitudeDeg }: stays there; { bearingDeg, rangeM }: goes with own ship
import { wrapDeg } from '../view_geometry.js';
import { isSwitch, keep, oneOf, read, sound, within } from './kept.js';
import { fromTo, isPlace } from './places.js';

const KEY = 'skerry.tools';
export const FARTHEST_M = 200 * 1852;
export const LINES = 6;
const isBearing = (deg) => within(0, 360)(deg) && deg < 360;
const isEnd = (value) => value === null || within(-FARTHEST_M, FARTHEST_M)(value);
const isOrigin = (o) => o === null || isPlace(o) || (isBearing(o?.bearingDeg) && within(0, FARTHEST_M)(o.rangeM));

const EBL = { on: [false, isSwitch], frame: ['true', oneOf('true', 'relative')], bearingDeg: [45, isBearing], origin: [null, isOrigin] };
const VRM = { on: [false, isSwitch], rangeM: [1852, within(0, FARTHEST_M)] };
const LINE = {
  on: [false, isSwitch], frame: ['true', oneOf('true', 'relative')], bearingDeg: [0, isBearing],
  offsetM: [0, within(-FARTHEST_M, FARTHEST_M)], fromM: [null, isEnd], toM: [null, isEnd],
};

export class Tools {
  constructor() {
    const kept = read(KEY);
    const list = (name, rules, count) => Array.from({ length: count }, (_, i) => sound(rules, kept?.[name]?.[i]));
    this.ebls = list('ebls', EBL, 2);
    this.vrms = list('vrms', VRM, 2);
    this.lines = list('lines', LINE, LINES);
    this.areLinesOn = kept?.areLinesOn !== false;
    this.active = kept?.active === 1 ? 1 : 0;  // which EBL and VRM keys and a click move
    this.changes = 0;                          // grows with each, so that what shows them knows
  }

  // kept: whether to write it down now; a drag is written at its end.
  changed(isKept = true) {
    this.changes += 1;
    if (!isKept) return;
    const { ebls, vrms, lines, areLinesOn, active } = this;
    keep(KEY, { ebls, vrms, lines, areLinesOn, active });
  }

  // A bearing line and a range marker begin where they can be seen; a parallel line that was never placed along the heading, so
  // much athwart. bowDeg: as of trueBearing().
  toggle(kind, n, view, bowDeg = 0) {
    const tool = this[kind][n];
    tool.on = !tool.on;
    if (tool.on && kind !== 'lines') this.active = n;
    if (tool.on && kind === 'vrms' && view?.rangeM > 0) tool.rangeM = view.rangeM * (n === 0 ? 0.5 : 0.75);
    if (tool.on && kind === 'ebls' && tool.frame === 'true') tool.bearingDeg = wrapDeg((view?.upDeg ?? 0) + (n === 0 ? 45 : 315));
    if (tool.on && kind === 'lines') {
      this.areLinesOn = true;
      if (tool.offsetM === 0 && tool.bearingDeg === 0 && view?.rangeM > 0) {
        tool.offsetM = (n % 2 === 0 ? 1 : -1) * Math.round(view.rangeM * 0.1 * (1 + (n >> 1)));
        if (tool.frame === 'true') tool.bearingDeg = Math.round(wrapDeg(bowDeg) * 10) / 10 % 360;
      }
    }
    this.changed();
    return tool.on;
  }

  set(kind, n, values, isKept = true) {
    Object.assign(this[kind][n], values);
    this.changed(isKept);
  }

  activate(n) {
    if (this.active === n) return;
    this.active = n;
    this.changed();
  }

  resetLines() {
    this.lines = this.lines.map(() => sound(LINE, null));
    this.areLinesOn = true;
    this.changed();
  }

  setDefaults(view) {
    this.ebls = [0, 1].map(() => sound(EBL, null));
    this.vrms = [0, 1].map(() => sound(VRM, null));
    this.lines.forEach((line) => { line.on = false; });
    this.active = 0;
    this.toggle('ebls', 0, view);
    this.toggle('vrms', 0, view);
  }
}

// True bearing of a tool; NaN if it is relative and the heading is not known well enough to tell. bowDeg: as the picture has it.
export function trueBearing({ frame, bearingDeg }, bowDeg) {
  return frame === 'relative' ? wrapDeg(bearingDeg + bowDeg) : bearingDeg;
}

export function inFrame(frame, trueDeg, bowDeg) {
  return frame === 'relative' ? wrapDeg(trueDeg - bowDeg) : wrapDeg(trueDeg);
}

// Where an origin lies from own ship: { bearingDeg, rangeM }; null if it is a place on earth and own ship's is not known.
export function originFrom(origin, ownPlace) {
  if (origin === null) return { bearingDeg: 0, rangeM: 0 };
  if (origin.rangeM !== undefined) return origin;
  return ownPlace ? fromTo(ownPlace, origin) : null;
}
