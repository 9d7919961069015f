// How large things are on this screen. Browsers take 96 pixels for an inch; what a ruler on the screen says, where somebody has
// measured, is kept with the settings of targets (targets/vector_settings.js).
import { read, within } from './kept.js';

const MM_PER_100_PX = 2540 / 96;

export function mmPerPx() {
  const measured = read('skerry.targets')?.mmOf100px;
  return (within(5, 100)(measured) ? measured : MM_PER_100_PX) / 100;
}
