// What tests of the page's language share: its texts, which of them are in a language, and what has no room.
import { isStandard } from '../../../clients/web/src/language/standard_words.js';
import { file, formsOf } from './words_kit.mjs';

// Every text of the page, shown or not.
export const textsOfPage = (page) => page.evaluate(() => {
  const found = new Set([document.title]);
  const walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
  while (walker.nextNode()) if (!walker.currentNode.parentElement.closest('script, style, noscript')) found.add(walker.currentNode.data);
  for (const element of document.querySelectorAll('*')) {
    for (const name of ['title', 'aria-label', 'placeholder', 'aria-valuetext', 'data-changed']) if (element.hasAttribute(name)) found.add(element.getAttribute(name));
  }
  return [...found].map((text) => text.replace(/\s+/g, ' ').trim());
});

// A function that tells whether a text is of that language: with the texts of its file and `outside` (names, the server's words)
// taken out, only numbers, abbreviations and single letters (keys, categories) are left.
export function speaker(code, outside) {
  const pieces = Object.values(file(code)).flatMap(formsOf).flatMap((form) => form.split(/\{\w+\}/)).map((piece) => piece.trim()).filter((piece) => /\p{L}/u.test(piece));
  const all = [...pieces, ...pieces.map((piece) => piece[0].toUpperCase() + piece.slice(1)), ...outside].sort((a, b) => b.length - a.length);
  const patterns = all.map((piece) => {
    const plain = piece.replace(/[.*+?^${}()|[\]\\]/g, '\\$&');
    return `${/^\p{L}/u.test(piece) ? '(?<!\\p{L})' : ''}${plain}${/\p{L}$/u.test(piece) ? '(?!\\p{L})' : ''}`;
  });
  const taken = new RegExp(patterns.join('|'), 'gu');
  const known = new Map();  // texts come again with every look
  return (text) => {
    if (!known.has(text)) known.set(text, isStandard(text.replace(taken, '\u0000').replace(/(?<!\p{L})\p{L}(?!\p{L})/gu, '')));
    return known.get(text);
  };
}

// What is shown but cut off, off the screen, or lies on another, in each part of the page that scrolls by itself.
export const faultsOfPage = (page) => page.evaluate(() => {
  const found = new Set(), parts = '#always, #tab-sections, #panel > header, .corner, dialog[open]';
  const nameOf = (each) => `${each.id || each.className || each.localName} "${(each.innerText || each.value || '').slice(0, 40).replace(/\s+/g, ' ')}"`;
  const isShown = (each) => each.checkVisibility({ visibilityProperty: true, opacityProperty: true }) && !each.closest('.unseen, svg, option');
  // As much of a box as the parts that scroll let be seen; null: nothing.
  const clipped = ({ left, right, top, bottom }, each, part) => {
    const box = { left, right, top, bottom };
    for (let parent = each; parent && parent !== part; parent = parent.parentElement) {
      if (getComputedStyle(parent).overflowX === 'visible') continue;
      const edge = parent.getBoundingClientRect();
      Object.assign(box, { left: Math.max(box.left, edge.left), right: Math.min(box.right, edge.right), top: Math.max(box.top, edge.top), bottom: Math.min(box.bottom, edge.bottom) });
    }
    return box.right - box.left > 0 && box.bottom - box.top > 0 ? box : null;
  };
  for (const part of document.querySelectorAll(parts)) {
    if (!isShown(part)) continue;
    if (part.scrollWidth > part.clientWidth + 1) found.add(`${nameOf(part)} scrolls sidewise`);
    const boxes = [];
    const put = (each, rect) => { const box = clipped(rect, each, part); if (box) boxes.push({ each, ...box }); };
    for (const each of [...part.querySelectorAll('*')].filter(isShown)) {
      const box = each.getBoundingClientRect(), isButton = each.matches('button, .button, summary, kbd, label span');
      if ((isButton || each.matches('select, input')) && (box.left < -0.5 || box.right > innerWidth + 0.5)) found.add(`${nameOf(each)} is off the screen`);
      // Names and files from outside are cut by intent, and so is a telephone's row of a target.
      const isOutside = each.matches('#server, #record-file, #playback-file, #target-list tbody th, #target-list tbody th *, input, select');
      const cuts = isButton || getComputedStyle(each).overflowX !== 'visible';
      if (cuts && !isOutside && each.clientWidth > 0 && each.scrollWidth > each.clientWidth + 1) found.add(`${nameOf(each)} is cut off: ${each.scrollWidth} in ${each.clientWidth}`);
      if (each.placeholder) {
        const { font, paddingLeft, paddingRight } = getComputedStyle(each);
        const pen = Object.assign(document.createElement('canvas').getContext('2d'), { font });
        const room = each.clientWidth - parseFloat(paddingLeft) - parseFloat(paddingRight), needs = pen.measureText(each.placeholder).width;
        if (needs > room + 1) found.add(`${each.id} has "${each.placeholder}" cut off: ${Math.round(needs)} in ${Math.round(room)}`);
      }
      if (each.matches('select')) {
        const alone = each.cloneNode(false);
        alone.removeAttribute('id');
        alone.append(new Option(each.selectedOptions[0]?.text ?? ''));
        alone.style.cssText = 'position: absolute; width: max-content; height: auto';
        each.parentElement.append(alone);
        if (alone.getBoundingClientRect().width > box.width + 0.5) found.add(`${each.id} shows "${each.selectedOptions[0]?.text}" cut off`);
        alone.remove();
      }
      if (each.matches('input[type=range]') && box.width < 40) found.add(`${each.id} has no length: ${box.width}`);
      if (each.matches('input[type=range], select, button, meter')) put(each, box);
      for (const node of each.matches('select, button') ? [] : each.childNodes) {
        if (node.nodeType !== Node.TEXT_NODE || node.data.trim() === '') continue;
        const range = document.createRange();
        range.selectNodeContents(node);
        // A line's box is higher than its letters.
        for (const { left, right, top, bottom } of range.getClientRects()) put(each, { left, right, top: top + 2, bottom: bottom - 2 });
      }
    }
    boxes.forEach((a, i) => boxes.slice(i + 1).forEach((b) => {
      const wide = Math.min(a.right, b.right) - Math.max(a.left, b.left), high = Math.min(a.bottom, b.bottom) - Math.max(a.top, b.top);
      if (wide > 1 && high > 1 && !a.each.contains(b.each) && !b.each.contains(a.each)) found.add(`${nameOf(a.each)} lies on ${nameOf(b.each)}`);
    }));
  }
  return [...found];
});
