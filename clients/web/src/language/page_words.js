// The texts that stand in the page itself, put into its language once, before the panel is built. <... data-context="scale"> gives the
// context of a word (language.js); translate="no" keeps an element as it is.
import { t } from './language.js';
import { isStandard } from './standard_words.js';

const ATTRIBUTES = ['title', 'aria-label', 'placeholder', 'data-words'];
const KEPT = '[translate="no"], noscript';

export function translatePage(root = document) {
  const texts = root.createTreeWalker(root.documentElement, NodeFilter.SHOW_TEXT);
  while (texts.nextNode()) {
    const { data, parentElement } = texts.currentNode;
    const text = plain(data);
    if (isStandard(text) || parentElement.closest(KEPT)) continue;
    // The spaces around it part it from its neighbours.
    const [, before, after] = /^(\s*).*?(\s*)$/s.exec(data);
    texts.currentNode.data = before + t(keyOf(parentElement, text)) + after;
  }
  for (const name of ATTRIBUTES) {
    for (const element of root.querySelectorAll(`[${name}]`)) {
      const text = plain(element.getAttribute(name));
      if (!isStandard(text) && !element.closest(KEPT)) element.setAttribute(name, t(keyOf(element, text)));
    }
  }
}

const plain = (text) => text.replace(/\s+/g, ' ').trim();
const keyOf = ({ dataset }, text) => (dataset.context ? `${dataset.context}|${text}` : text);
