// Three ways to work the console: by mouse, by keys alone, by touch. Each does what a trainee does, with nothing else in its hands:
// places in the picture are CSS pixels of #ppi, parts of the panel are CSS selectors.
import assert from 'node:assert/strict';
import { placeOnPage } from './targets_kit.mjs';

const figure = (text) => Number(/-?[\d.]+/.exec(text.replace('\u2212', '-'))?.[0]);

class Pointing {
  constructor(page) { this.page = page; }

  async unfold(id) {
    if (!(await this.page.locator(`#${id}`).evaluate((fold) => fold.open))) await this.press(`#${id} > summary`);
  }
  async select(key) { await this.press(`#list-${key}`); }
  async tab(title) { await this.press(`[role=tab]:text-is("${title}")`); }
  async choice(name, value) { await this.press(`label:has(input[name=${name}][value=${value}])`); }
  async relativeVectors(on) { await this.choice('vector-mode', on ? 'relative' : 'true'); }
  async longerVectors() { await this.press('#vector-more'); }
  async longerRange() { await this.press('#range-more'); }
  async northUp() { await this.choice('orientation', 'north'); }
  async relativeMotion() { await this.tab('Radar'); await this.choice('motion', 'relative'); await this.tab('Targets'); }
  async hideAis() { await this.press('label:has(#target-ais)'); }
  async acknowledge() { await this.press('#alert-acknowledge'); }
  async cancelSelected() { await this.press('#cancel-target'); }
  async cancelAll() { await this.press('#cancel-all'); await this.press('#cancel-all-question-yes'); }
  async acquire(at) { await this.press('#acquire'); await this.pressAt(at); }
  async toolsOn() { await this.tab('Tools'); await this.press('label:has(#ebl)'); await this.press('label:has(#vrm)'); await this.tab('Targets'); }
  // EBL 1 and VRM 1 are drawn onto a place from one where nothing else is taken.
  async measure(at) { await this.drag(await freePlace(this.page), at); }
}

export class Mouse extends Pointing {
  static context = { viewport: { width: 1280, height: 800 } };
  name = 'mouse';

  async press(selector) { await this.page.locator(selector).click(); }
  async fill(selector, text) { await this.page.locator(selector).click({ clickCount: 3 }); await this.page.keyboard.type(text); await this.page.keyboard.press('Tab'); }
  async pressAt(at) { await this.cursorTo(at); await this.page.mouse.down(); await this.page.mouse.up(); }
  async cursorTo(at) { const { x, y } = await placeOnPage(this.page, at); await this.page.mouse.move(x, y); }
  async drag(from, to) { await this.cursorTo(from); await this.page.mouse.down(); await this.cursorTo(to); await this.page.mouse.up(); }
}

export class Touch extends Pointing {
  static context = { viewport: { width: 1180, height: 820 }, hasTouch: true };
  name = 'touch';

  async press(selector) { await this.page.locator(selector).tap(); }
  // The keyboard of the screen types.
  async fill(selector, text) { await this.press(selector); await this.page.keyboard.press('Control+a'); await this.page.keyboard.insertText(text); await this.page.keyboard.press('Tab'); }
  async pressAt(at) { const { x, y } = await placeOnPage(this.page, at); await this.page.touchscreen.tap(x, y); }
  // On a symbol a tap would choose it: a finger that slides there does not.
  async cursorTo(at) { await this.drag(await freePlace(this.page), at); }
  async drag(from, to) {
    const session = (this.session ??= await this.page.context().newCDPSession(this.page));
    const [a, b] = [await placeOnPage(this.page, from), await placeOnPage(this.page, to)];
    const touch = (type, ...touchPoints) => session.send('Input.dispatchTouchEvent', { type, touchPoints });
    await touch('touchStart', { ...a, id: 0 });
    for (let i = 1; i <= 4; ++i) await touch('touchMove', { x: a.x + ((b.x - a.x) * i) / 4, y: a.y + ((b.y - a.y) * i) / 4, id: 0 });
    // At rest when it is lifted: a browser takes no tap for some 200 ms after a flick.
    await new Promise((resolve) => { setTimeout(resolve, 150); });
    await touch('touchEnd');
  }
}

// Keys alone: those of the table of keys, and Tab, arrows, Space and Enter in the panel.
export class Keys {
  static context = { viewport: { width: 1280, height: 800 } };
  name = 'keys';

  constructor(page) { this.page = page; this.cursor = null; }

  // Tab, or Shift+Tab, until that has the focus.
  async focus(selector) {
    const wanted = await this.page.locator(selector).elementHandle();
    for (let tabs = 0; tabs < 300; ++tabs) {
      const way = await wanted.evaluate((element) => {
        const active = document.activeElement;
        if (active === element) return 0;
        return active !== document.body && active.compareDocumentPosition(element) & Node.DOCUMENT_POSITION_PRECEDING ? -1 : 1;
      });
      if (way === 0) return;
      await this.page.keyboard.press(way > 0 ? 'Tab' : 'Shift+Tab');
    }
    assert.fail(`${selector} is not reached by Tab`);
  }
  async press(selector) {
    await this.focus(selector);
    await this.page.keyboard.press('Enter');
  }
  // A key of the table; fields keep keys to themselves.
  async key(name) {
    for (let tabs = 0; tabs < 50 && await this.page.evaluate(() => document.activeElement.matches('input, select, textarea')); ++tabs) await this.page.keyboard.press('Tab');
    await this.page.keyboard.press(name);
  }
  async fill(selector, text) {
    await this.focus(selector);
    await this.page.keyboard.press('Control+a');
    await this.page.keyboard.type(text);
    await this.page.keyboard.press('Tab');
  }
  async unfold(id) {
    if (!(await this.page.locator(`#${id}`).evaluate((fold) => fold.open))) await this.press(`#${id} > summary`);
  }
  async tab(title) {
    await this.focus('[role=tab][aria-selected=true]');
    for (let i = 0; i < 5 && !(await this.page.locator('[role=tab][aria-selected=true]', { hasText: title }).count()); ++i) await this.page.keyboard.press('ArrowRight');
  }
  async select(key) { await this.press(`#list-${key}`); }
  async relativeVectors(on) { if ((await this.page.locator('#vector-sign').textContent()).startsWith('VECT R') !== on) await this.key('t'); }
  async longerVectors() { await this.key(']'); }
  async longerRange() { await this.key('+'); }
  async northUp() { await this.key('n'); }
  async relativeMotion() { if ((await this.page.locator('#motion').textContent()) !== 'RM') await this.key('Shift+T'); }
  async hideAis() { await this.key('i'); }
  async acknowledge() { await this.key('q'); }
  async cancelSelected() { await this.key('Delete'); }
  async cancelAll() { await this.press('#cancel-all'); await this.press('#cancel-all-question-yes'); }
  async acquire(at) { await this.cursorTo(at); await this.key('a'); }
  async toolsOn() { await this.key('e'); await this.key('v'); }

  async #arrows(name, steps) {
    const coarse = Math.trunc(steps / 10), fine = steps - coarse * 10;
    for (let i = 0; i < coarse; ++i) await this.page.keyboard.press(name);
    for (let i = 0; i < fine; ++i) await this.page.keyboard.press(`Shift+${name}`);
  }
  // The cursor begins at own ship; ten pixels an arrow, with Shift one.
  async cursorTo(at) {
    if (await this.page.locator('#picture-mode').isHidden()) await this.key('Shift+C');
    this.cursor ??= await this.page.evaluate(() => window.skerry.ppi.own);
    const x = Math.round(at.x - this.cursor.x), y = Math.round(at.y - this.cursor.y);
    await this.#arrows(x > 0 ? 'ArrowRight' : 'ArrowLeft', Math.abs(x));
    await this.#arrows(y > 0 ? 'ArrowDown' : 'ArrowUp', Math.abs(y));
    this.cursor = { x: this.cursor.x + x, y: this.cursor.y + y };
  }
  // By what EBL and VRM show now: a degree and a hundredth of the range an arrow, with Shift a tenth of that.
  async measure(at) {
    await this.page.keyboard.press('Escape');
    const there = await this.page.evaluate(({ x, y }) => window.skerry.at(x, y), at);
    const [bearing, range] = await Promise.all(['ebl-true', 'vrm-range'].map(async (id) => figure(await this.page.locator(`#${id}`).textContent())));
    const turn = Math.round((((there.bearingDeg - bearing + 540) % 360) - 180) * 10);
    await this.#arrows(turn > 0 ? 'ArrowRight' : 'ArrowLeft', Math.abs(turn));
    const out = Math.round(((there.rangeM / 1852 - range) / 12) * 1000);
    await this.#arrows(out > 0 ? 'ArrowUp' : 'ArrowDown', Math.abs(out));
  }
}

// Where a press takes neither a symbol nor a marker.
async function freePlace(page) {
  return page.evaluate(() => {
    const { own, radiusPx, rangeM } = window.skerry.ppi;
    const taken = window.skerry.targets().shown, { ebls, vrms } = window.skerry.tools();
    const vrmPx = vrms[0].on ? (vrms[0].rangeM / rangeM) * radiusPx : -1000;
    for (let deg = 5; deg < 360; deg += 10) {
      for (const part of [0.3, 0.5, 0.7, 0.85]) {
        const r = part * radiusPx, at = { x: own.x + r * Math.sin((deg * Math.PI) / 180), y: own.y - r * Math.cos((deg * Math.PI) / 180) };
        const offDeg = Math.abs(((deg - ebls[0].bearingDeg + 540) % 360) - 180);
        if (offDeg > 20 && Math.abs(r - vrmPx) > 45 && taken.every(({ x, y }) => Math.hypot(x - at.x, y - at.y) > 60)) return at;
      }
    }
    throw new Error('no free place');
  });
}

export { figure };
