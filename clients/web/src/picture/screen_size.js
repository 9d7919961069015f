// How large things are on this screen. Browsers take 96 pixels for an inch; localStorage 'skerry.mmPer100px' holds what a ruler on
// the screen says, where somebody has measured.
import { read, within } from './kept.js';

const MM_PER_100_PX = 2540 / 96;

export function mmPerPx() {
  const measured = read('skerry.mmPer100px');
  return (within(5, 100)(measured) ? measured : MM_PER_100_PX) / 100;
}
