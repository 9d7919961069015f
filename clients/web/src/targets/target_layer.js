// TargetLayer: targets, vectors, past positions, zones and the trial on a canvas of their own.
import { t } from '../language/language.js';
import { Layer } from '../overlay.js';
import { NAUTICAL_MILE_M } from '../view_geometry.js';
import { minus, moved, polar, trialPath } from './motion.js';
import { aisSymbol, dot, radarSymbol, selection, SIZES_MM, text, thick, tick, vector } from './symbols.js';
import { labelOf, ownMotion, pastPlaces, shownOf } from './target_store.js';
import { ACQUIRING, FROZEN, GROUND, LOST } from './wire.js';
import { drawZone } from './zone_shape.js';

const FLASH_MS = 500, KNOT_MPS = NAUTICAL_MILE_M / 3600;
// Drawn anew when the fastest may have moved so far, and never more often than that.
const STEP_PX = 0.25, LEAST_STEP_S = 0.1, MOST_STEP_S = 1;
// Longer names would cover their neighbours.
const LONGEST_NAME = 20;

export class TargetLayer {
  constructor(canvas) {
    this.layer = new Layer(canvas);
    this.shown = [];     // what is drawn: shownOf() with x, y, label and kind, for picking and for tests
    this.vectors = [];   // [{ key, points }] in pixels
  }

  // look: { store, settings, palette, paletteName, ownShip, headingDeg, draft (zone being drawn, or null), nowMs, version }.
  draw(view, look) {
    const { store, settings } = look;
    const live = store.list !== null && !store.isStale;
    const flashes = live && store.entries.some((entry) => entry.calls || entry.track?.state === LOST);
    const moves = live && store.entries.length > 0;
    const phase = flashes ? Math.floor(look.nowMs / FLASH_MS) % 2 : 0;
    const key = [look.paletteName, store.serial, live, moves ? Math.floor(store.stepS / moveS(store, view)) : 0, phase, view.upDeg, view.rangeM,
                 view.own, view.centre, look.version, store.selected, look.draft,
                 live && store.list.zones.some((zone) => zone.relative) ? Math.round(look.headingDeg * 10) : 0];
    this.layer.draw(view, key, (c) => {
      this.shown = [];
      this.vectors = [];
      c.save();
      c.beginPath();
      c.arc(view.centre, view.centre, view.radius, 0, 2 * Math.PI);
      c.clip();
      if (live && view.rangeM > 0) this.#paint(c, view, { ...look, mm: settings.pxPerMm, isOff: phase === 1 });
      if (look.draft) drawZone(c, view, look.draft, look.headingDeg, { colour: look.palette.zone, mm: settings.pxPerMm });
      c.restore();
    });
  }

  #paint(c, view, look) {
    const { store, settings, palette, mm } = look;
    const { list } = store;
    const pixel = (at) => { const { bearingDeg, rangeM } = polar(at); return view.toPixel(bearingDeg, rangeM); };
    const own = ownMotion(list, look.ownShip);
    for (const zone of list.zones) drawZone(c, view, zone, look.headingDeg, { colour: palette.zone, mm });
    const entries = store.entries.filter((entry) => entry.track || settings.ais);
    this.shown = entries.map((entry) => {
      const shown = shownOf(entry, settings.source, own, store.stepS);
      return { ...shown, ...pixel(shown.at), kind: kindOf(shown), label: nameOf(shown, settings, store.selected.includes(entry.key)) };
    });
    if (settings.past) {
      for (const { track } of entries) {
        if (track) for (const at of pastPlaces(track, own, settings.relative, store.stepS)) dot(c, pixel(at), mm, palette.target);
      }
    }
    const trial = list.trial && own.list ? trialPath({ courseDeg: list.ownCourseDeg, speedKn: list.ownSpeedKn }, list.trial, settings.minutes) : null;
    for (const shown of this.shown) this.#vectorOf(c, shown, { look, pixel, own, trial });
    this.#ownVector(c, { look, pixel, own, trial });
    for (const shown of this.shown) this.#symbol(c, view, shown, look);
    this.#signs(c, view, look);
  }

  #vectorOf(c, shown, { look, pixel, trial }) {
    const { settings, palette, mm, store } = look;
    const outcome = trial ? outcomeOf(store.list.trial, shown) : null;
    const motion = settings.relative ? shown.relative : shown.motion;
    if (!motion || !shown.isActive || shown.isLost) return;
    const isDangerous = outcome ? outcome.isDangerous : shown.isDangerous;
    const pen = { colour: isDangerous ? palette.danger : palette.target, width: isDangerous ? thick(mm) : 1.5 };
    // In a trial, relative to own ship on her way through it.
    const stepS = (settings.minutes * 60) / ((trial?.length ?? 2) - 1);
    const places = trial && settings.relative && shown.motion
      ? trial.map((there, i) => minus(moved(shown.at, shown.motion, i * stepS), there))
      : [shown.at, moved(shown.at, motion, settings.minutes * 60)];
    const points = places.map(pixel);
    vector(c, points, pen);
    if (settings.ticks && settings.minutes <= 30 && !trial) {
      for (let minute = 1; minute < settings.minutes; ++minute) tick(c, points[0], pixel(moved(shown.at, motion, minute * 60)), pen.colour);
    }
    this.vectors.push({ key: shown.key, points });
  }

  // True vectors only: own ship does not move against herself.
  #ownVector(c, { look, pixel, own, trial }) {
    const { settings, palette, store } = look;
    if (settings.relative || !own.list) return;
    const here = { east: 0, north: 0 };
    const points = (trial ?? [here, moved(here, own.list, settings.minutes * 60)]).map(pixel);
    // Two arrowheads over ground, one through the water.
    vector(c, points, { colour: palette.ship }, store.list.stabilisation === GROUND ? 2 : 1);
    this.vectors.push({ key: 'own', points });
  }

  #symbol(c, view, shown, look) {
    const { store, palette, mm, isOff } = look;
    const pens = { normal: palette.target, danger: palette.danger };
    c.save();
    c.translate(shown.x, shown.y);
    if (!(isOff && (shown.calls || (shown.isLost && !shown.byAis)))) {
      if (shown.byAis) {
        const { headingDeg, courseDeg, cpaNm } = shown.from;
        const towards = headingDeg ?? courseDeg;
        aisSymbol(c, mm, shown.kind, {
          deg: towards === undefined ? 0 : towards - view.upDeg, heads: shown.isActive && headingDeg !== undefined && !shown.isLost,
          isLost: shown.isLost, isUnsure: shown.isActive && cpaNm === undefined,
        }, pens);
      } else {
        radarSymbol(c, mm, shown.kind, shown.isLost, pens);
      }
    }
    const reach = reachMm(shown);
    const isSelected = store.selected.includes(shown.key);
    if (isSelected) selection(c, mm, palette.target, reach + 2.5);
    const beside = (reach / 2 + (isSelected ? 2.2 : 1)) * mm;
    if (shown.label) text(c, shown.label, beside, 0, shown.isDangerous ? palette.danger : palette.targetText, Math.max(10, 2.9 * mm));
    c.restore();
  }

  #signs(c, view, { store, palette, mm }) {
    const { trial, testTargets } = store.list;
    const words = [trial && 'T', testTargets && 'X'].filter(Boolean);
    const size = Math.max(28, 9 * mm);
    words.forEach((word, i) => text(c, word, view.centre + (i - (words.length - 1) / 2) * size * 1.3, view.centre + view.radius - size,
      palette.targetText, size, { align: 'center', weight: 700 }));
  }
}

// Seconds in which nothing moves farther than STEP_PX, relative to own ship.
function moveS({ list, entries }, view) {
  const fastestKn = entries.reduce((most, { track, ais }) => Math.max(most, track?.speedKn ?? 0, ais?.speedKn ?? 0), 0) + (list.ownSpeedKn ?? 0);
  const pxPerS = (fastestKn * KNOT_MPS * view.radius) / view.rangeM;
  return Math.max(LEAST_STEP_S, Math.min(MOST_STEP_S, STEP_PX / pxPerS));
}

export function kindOf(shown) {
  const { from, byAis } = shown;
  if (byAis) return shown.isDangerous ? 'dangerousAis' : shown.isActive ? 'activated' : 'sleeping';
  if (shown.isDangerous) return 'dangerous';
  return from.state === ACQUIRING ? 'acquiring' : from.state === FROZEN ? 'frozen' : 'tracked';
}

// How wide a symbol is, with the crossed lines of a lost one.
const sizeMm = (kind) => SIZES_MM[kind]?.height ?? SIZES_MM[kind] ?? SIZES_MM.tracked;
const reachMm = ({ kind, isLost }) => (isLost ? (sizeMm(kind) + 2 * SIZES_MM.lostBeyond) / Math.SQRT2 : sizeMm(kind));

export function outcomeOf(trial, { entry: { track, ais } }) {
  return trial?.outcomes.find((outcome) => (outcome.target > 0 ? outcome.target === track?.number : ais !== null && outcome.mmsi === ais.mmsi)) ?? null;
}

function nameOf({ entry: { track, ais }, isActive }, { names }, isSelected) {
  const words = track ? [labelOf(track.number), track.isReference ? 'R' : '', track.state === FROZEN ? t('frozen') : ''] : [];
  if (ais && isActive && (names || isSelected)) words.push([...(ais.name || String(ais.mmsi))].slice(0, LONGEST_NAME).join(''));
  return words.filter(Boolean).join(' ');
}
