// Numbers as a mariner reads them. A value that is not known is a dash.
import { t } from './language/language.js';
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

// By eye; the server says nothing of clear weather, and takes this for it.
export const CLEAR_NM = 30;

export function visibility(nm) {
  return nm === undefined || nm >= CLEAR_NM ? 'clear' : Number.isFinite(nm) ? `${Number(nm.toPrecision(3))} NM` : NONE;
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
  return size === '0.0' ? '0.0' : `${size} ${degMin < 0 ? t('port') : t('stbd')}`;
}

// 0:00, 1:02:03; whole seconds.
export function duration(seconds) {
  if (!Number.isFinite(seconds)) return NONE;
  const whole = Math.floor(Math.max(0, seconds) + 1e-6);
  const two = (n) => String(n).padStart(2, '0');
  const hours = Math.floor(whole / 3600), minutes = Math.floor(whole / 60) % 60;
  return hours > 0 ? `${hours}:${two(minutes)}:${two(whole % 60)}` : `${minutes}:${two(whole % 60)}`;
}

// Powers of 1000, as disks are sold.
export function bytes(count) {
  if (!Number.isFinite(count)) return NONE;
  const units = ['B', 'kB', 'MB', 'GB', 'TB'];
  let value = count, unit = 0;
  while (value >= 999.5 && unit < units.length - 1) { value /= 1000; unit += 1; }
  return `${unit === 0 || value >= 99.5 ? value.toFixed(0) : value.toFixed(1)} ${units[unit]}`;
}

// Date and time of an instant, UTC; milliseconds since 1970.
export function utcClock(ms) {
  const at = new Date(ms);
  return Number.isNaN(at.getTime()) ? NONE : at.toISOString().slice(0, 19).replace('T', ' ') + ' UTC';
}
