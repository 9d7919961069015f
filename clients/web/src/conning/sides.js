// Numbers with a side: port and starboard are told by a letter, never by the sign or colour alone.
import { fixed, NONE } from '../format.js';

// "12.5 S", "0.0", "3.0 P"; starboard positive.
export function side(value, digits) {
  if (!Number.isFinite(value)) return NONE;
  const size = fixed(Math.abs(value), digits);
  return Number(size) === 0 ? size : `${size} ${value < 0 ? 'P' : 'S'}`;
}

// Percent of a lever: "45 % ahead".
export function ahead(percent) {
  if (!Number.isFinite(percent)) return NONE;
  const whole = Math.round(Math.abs(percent));
  return whole === 0 ? 'Stop' : `${whole} % ${percent < 0 ? 'astern' : 'ahead'}`;
}
