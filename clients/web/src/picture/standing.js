// How the picture stands: what is up, what moves, and how both are called on the screen.
import { later, t } from '../language/language.js';
import { wrapDeg } from '../view_geometry.js';
import { stabilisation } from './own_motion.js';

const LABELS = { north: 'N UP', course: 'C UP', head: 'H UP' };
const WORDS = { north: later('north up'), course: later('course up'), head: later('head up') };

// picture: PictureSettings. headingDeg: true, or null if not known. bowDeg: what the spokes take for the bow's bearing
// (the last heading that was known). ship: OwnShip message or null.
// Gives { orientation, upDeg, scaleUpDeg, label, words, isTrue, motionLabel, trailMode, stabilisation }:
// scaleUpDeg is what the bearing scale shows at the top; trailMode is 'off', 'true' or 'relative'.
export function standingOf(picture, { headingDeg, bowDeg, ship }) {
  const lost = headingDeg === null;
  const orientation = lost ? 'head' : picture.orientation;
  const upDeg = orientation === 'head' ? bowDeg : orientation === 'course' ? wrapDeg(picture.courseDeg) : 0;
  const held = stabilisation(picture.stabilised, ship, !lost);
  // With the bow up the picture turns with her: nothing on it stands still.
  const isTrue = picture.motion === 'true' && orientation !== 'head' && held.kind !== 'none';
  const canTrue = held.kind !== 'none' && !lost;
  // True motion has true trails only.
  const trailMode = picture.trailS === 0 ? 'off' : (isTrue || picture.trailMode === 'true') && canTrue ? 'true' : 'relative';
  const suffix = { off: '', true: '(T)', relative: '(R)' }[trailMode];
  return {
    orientation, upDeg, isTrue, trailMode, stabilisation: held, lost,
    scaleUpDeg: orientation === 'head' ? 0 : upDeg,
    label: LABELS[orientation] + (lost ? ` · ${t('heading lost')}` : ''),
    words: t(WORDS[orientation]) + (lost ? `, ${t('heading lost')}` : ''),
    motionLabel: isTrue ? 'TM' : `RM${suffix}`,
  };
}

export function stabilisationText({ kind, source, lost }) {
  const name = { ground: 'GND', water: 'WATER', none: 'NO STAB' }[kind];
  return [name, source, lost].filter(Boolean).join(' · ');
}

export function durationText(seconds) {
  if (seconds < 0) return t('permanent');
  return seconds < 60 ? `${seconds} s` : `${seconds / 60} min`;
}

export function trailText(mode, trailS) {
  return mode === 'off' ? t('off') : `${mode === 'true' ? 'T' : 'R'} ${durationText(trailS)}`;
}
