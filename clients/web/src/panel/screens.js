// Screens: the picture over the whole screen, in a window of its own, and a second picture beside it.
//
// A second picture is a console in a frame that shows the picture and the range buttons alone (?bare): in a view of its
// own, so that it has another range, or of another radar. ?beside=N in the address is radar N's.
import { t } from '../language/language.js';
import { isolated, shortName } from '../names.js';
import { $ } from '../widgets.js';

export class Screens {
  // host: { radar: RadarConsole, layOut(), notify(text, kind) }.  choices: URLSearchParams of the page.
  constructor(host, choices) {
    Object.assign(this, { host, choices, frame: null });
    this.asked = choices.get('beside');  // radar of the second picture as text, null without
    $('full-screen').addEventListener('click', () => this.toggleFull());
    $('full-screen-end').addEventListener('click', () => this.toggleFull());
    $('pop-out').addEventListener('click', () => this.popOut());
    $('beside').addEventListener('change', () => this.#beside($('beside').value, true));
    $('sheet').addEventListener('click', () => this.#toggleSheet());
    document.addEventListener('fullscreenchange', () => this.#showFull());
  }

  // On a telephone: the panel takes more of the screen, the picture less.
  #toggleSheet() {
    $('sheet').setAttribute('aria-pressed', String(document.body.toggleAttribute('data-sheet')));
  }

  // Over the whole screen, or where a browser does not give it (telephones), over the whole page.
  async toggleFull() {
    const alone = document.body.hasAttribute('data-alone');
    if (document.fullscreenElement) { await document.exitFullscreen(); return; }
    if (!alone && document.fullscreenEnabled) {
      try {
        await document.documentElement.requestFullscreen();
      } catch {
        this.host.notify(t('This browser gives no full screen: the picture has the page'), 'info');
      }
    }
    document.body.toggleAttribute('data-alone', !alone);
    this.#showButton();
  }

  #showFull() {
    if (!document.fullscreenElement) document.body.removeAttribute('data-alone');
    this.#showButton();
  }

  #showButton() {
    $('full-screen').setAttribute('aria-pressed', String(document.body.hasAttribute('data-alone')));
  }

  // The same view, in a window that gives no orders.
  popOut() {
    const { radar } = this.host;
    const side = Math.round(Math.min(screen.availWidth, screen.availHeight) * 0.8);
    const opened = open(`?watch&radar=${radar.radar}&view=${radar.view}${this.#language()}`, '_blank', `popup,width=${side},height=${side}`);
    if (!opened) this.host.notify(t('The browser opened no window: allow pop-ups of this page'));
  }

  // What the address says of it goes for further pictures, too.
  #language() {
    return this.choices.has('lang') ? `&lang=${encodeURIComponent(this.choices.get('lang'))}` : '';
  }

  // The radars that a second picture may show.
  greet(radars) {
    const named = (r) => isolated([r.ownShip, r.name].filter(Boolean).join(' · '));
    const own = this.host.radar.radar;
    $('beside').replaceChildren(new Option(t('None'), ''), ...radars.map((r) => new Option(r.radar === own ? t('{radar}, other range', { radar: named(r) }) : named(r), r.radar)));
    if (this.asked !== null && !radars.some(({ radar }) => String(radar) === this.asked)) {
      this.host.notify(t('There is no radar {radar} to show beside', { radar: shortName(this.asked, 12) }));
      this.asked = null;
    }
    this.#beside(this.asked ?? '', false);
  }

  #beside(radar, remember) {
    this.asked = radar === '' ? null : radar;
    $('beside').value = radar;
    document.body.toggleAttribute('data-beside', this.asked !== null);
    if (this.asked === null) {
      this.frame?.remove();
      this.frame = null;
    } else {
      const address = `?bare&view=own&radar=${radar}${this.#language()}`;
      if (!this.frame) {
        this.frame = document.createElement('iframe');
        this.frame.id = 'second';
        this.frame.title = t('Second radar picture');
        $('display').after(this.frame);
      }
      if (this.frame.getAttribute('src') !== address) this.frame.src = address;
    }
    if (remember) {
      if (this.asked === null) this.choices.delete('beside');
      else this.choices.set('beside', radar);
      const rest = this.choices.toString();
      history.replaceState(null, '', rest ? `?${rest}` : location.pathname);
    }
    this.host.layOut();
  }
}
