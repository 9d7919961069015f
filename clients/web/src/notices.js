// Notices: short messages to the operator, newest first, each gone after a while. The same text again
// counts up instead of filling the screen.
import { shortName } from './names.js';

const SHOWN_MS = 6000;
const MAX_SHOWN = 3;
const MAX_LETTERS = 300;

export class Notices {
  constructor(list) {
    this.list = list;
    this.shown = [];  // newest first
  }

  // kind: 'error' or 'info'.
  show(whole, kind = 'error') {
    const text = shortName(whole, MAX_LETTERS);
    let notice = this.shown.find((n) => n.text === text);
    if (notice) {
      notice.times += 1;
      notice.item.textContent = `${text} (${notice.times}×)`;
      clearTimeout(notice.timer);
    } else {
      const item = document.createElement('li');
      item.className = `notice ${kind}`;
      item.textContent = text;
      notice = { text, item, times: 1 };
      this.shown.unshift(notice);
      this.list.prepend(item);
      while (this.shown.length > MAX_SHOWN) this.#drop(this.shown.at(-1));
    }
    notice.timer = setTimeout(() => this.#drop(notice), SHOWN_MS);
  }

  #drop(notice) {
    clearTimeout(notice.timer);
    notice.item.remove();
    this.shown = this.shown.filter((n) => n !== notice);
  }
}
