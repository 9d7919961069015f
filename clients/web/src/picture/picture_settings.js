// PictureSettings: how this screen shows its picture, kept in this browser.
import { later } from '../language/language.js';
import { isSwitch, keep, oneOf, read, sound, within } from './kept.js';
import { FARTHEST } from './own_place.js';

const KEY = 'skerry.picture';
export const PALETTE_ORDER = [later('day'), later('dusk'), later('night')];
// Seconds; 0: off, -1: permanent.
export const TRAILS_S = [0, 15, 30, 60, 180, 360, 720, 1800, -1];
// Layers whose brilliance is set by itself, percent, and the least of each: echoes and the scale never vanish by it.
export const LAYERS = {
  echo: { label: later('Echoes'), least: 20 }, trails: { label: later('Trails'), least: 10 }, rings: { label: later('Rings'), least: 10 },
  heading: { label: later('Head line'), least: 20 }, marks: { label: 'EBL, VRM, PI', least: 20 }, scale: { label: later('Scale'), least: 20 },
};

const RULES = {
  palette: ['day', oneOf(...PALETTE_ORDER)],
  orientation: ['north', oneOf('north', 'course', 'head')],
  courseDeg: [0, within(0, 360)],            // what is up in course-up
  motion: ['relative', oneOf('relative', 'true')],
  stabilised: ['ground', oneOf('ground', 'water')],
  ownX: [0, within(-FARTHEST, FARTHEST)],    // as of own_place.js
  ownY: [0, within(-FARTHEST, FARTHEST)],
  afterglow: [25, within(0, 100)],
  trailS: [0, oneOf(...TRAILS_S)],
  trailMode: ['relative', oneOf('relative', 'true')],
  echo: ['basic', oneOf('basic', 'yellow', 'green', 'amber', 'levels')],
  rings: [true, isSwitch],
  headingLine: [true, isSwitch],
  sternMarks: [false, isSwitch],
  brilliance: [Object.fromEntries(Object.keys(LAYERS).map((name) => [name, 100])), (given) =>
    Object.entries(LAYERS).every(([name, { least }]) => within(least, 100)(given?.[name]))],
};

// "User default settings": one action sets these. What it does not name stays: colours and brilliance suit the light on the bridge.
const DEFAULTS = {
  orientation: 'north', motion: 'true', stabilised: 'ground', trailS: 360, trailMode: 'true', rings: false, headingLine: true,
  sternMarks: false, afterglow: 25,
};

export class PictureSettings {
  constructor() {
    Object.assign(this, sound(RULES, read(KEY)));
  }

  change(values) {
    Object.assign(this, sound(RULES, { ...this, ...values }));
    keep(KEY, this);
  }

  setDefaults() {
    this.change(DEFAULTS);
  }
}
