// Numbers as a mariner reads them. A value that is not known is a dash.
import { NAUTICAL_MILE_M, wrapDeg } from './view_geometry.js';

export const NONE = '–';

export function fixed(value, digits) {
  return Number.isFinite(value) ? value.toFixed(digits) : NONE;
}

// 000.0 .. 359.9, never 360.0.
export function bearing(deg, digits = 1) {
  if (!Number.isFinite(deg)) return NONE;
  const scale = 10 ** digits;
  const rounded = (Math.round(wrapDeg(deg) * scale) % (360 * scale)) / scale;
  return rounded.toFixed(digits).padStart(digits ? 4 + digits : 3, '0');
}

// Degrees and decimal minutes.
export function position(deg, positive, negative, degreeDigits) {
  if (!Number.isFinite(deg)) return NONE;
  const thousandths = Math.round(Math.abs(deg) * 60000);
  const whole = Math.floor(thousandths / 60000);
  const minutes = ((thousandths % 60000) / 1000).toFixed(3).padStart(6, '0');
  return `${String(whole).padStart(degreeDigits, '0')}°${minutes}′${deg < 0 ? negative : positive}`;
}

export function rangeNm(nm) {
  return Number.isFinite(nm) ? String(Number(nm.toFixed(3))) : NONE;
}

export function distance(metres) {
  if (!Number.isFinite(metres)) return NONE;
  const nm = metres / NAUTICAL_MILE_M;
  return `${nm.toFixed(nm < 10 ? 3 : 2)} NM`;
}

export function count(value) {
  return Number.isFinite(value) ? Math.round(value).toLocaleString('en-GB').replaceAll(',', '\u202f') : NONE;
}

export function rateOfTurn(degMin) {
  if (!Number.isFinite(degMin)) return NONE;
  const size = Math.abs(degMin).toFixed(1);
  return size === '0.0' ? '0.0' : `${size} ${degMin < 0 ? 'port' : 'stbd'}`;
}
