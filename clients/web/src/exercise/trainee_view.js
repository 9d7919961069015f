// TraineeView: the console of an own ship beside the chart, in a frame that gives no orders.
import { $ } from '../widgets.js';
import { token } from '../token.js';

const STATUS_MS = 5000;
const LEAST_PX = 240,
  STEP_PX = 40;

export class TraineeView {
  // resized(): the chart has another size.
  constructor(exercise, resized) {
    Object.assign(this, {
      exercise,
      resized,
      open: false,
      radars: [],
      views: new Map(),
      radar: null,
      view: 0,
      wide: null,
    });
    $('trainee-radar').addEventListener('change', () => {
      this.radar = Number($('trainee-radar').value);
      this.view = 0;
      this.#show();
    });
    $('trainee-view').addEventListener('change', () => {
      this.view = Number($('trainee-view').value);
      this.#show();
    });
    $('trainee-close').addEventListener('click', () => this.toggle(false));
    this.#bindSplitter();
  }

  // Radars of Hello.
  greet(radars) {
    this.radars = radars;
    if (!radars.some(({ radar }) => radar === this.radar)) this.radar = null;
    if (this.open) this.toggle(true);
  }

  // Own ships' names come with the state; the list is made anew only where it has changed.
  toggle(open = !this.open) {
    this.open = open;
    $('trainee').hidden = $('splitter').hidden = !open;
    $('trainee-toggle').setAttribute('aria-pressed', String(open));
    document.body.dataset.trainee = open ? 'open' : 'closed';
    clearInterval(this.timer);
    if (open) {
      this.timer = setInterval(() => this.#look(), STATUS_MS);
      this.#look();
    }
    this.radar ??= this.radars[0]?.radar ?? null;
    this.#show();
    this.resized();
  }

  // The view of that own ship.
  openFor(ship) {
    if (ship.radars.length === 0) return;
    if (!ship.radars.includes(this.radar)) {
      this.radar = ship.radars[0];
      this.view = 0;
    }
    this.toggle(true);
  }

  // Follows the selected own ship.
  follow(ship) {
    if (this.open && ship && ship.radars.length > 0 && !ship.radars.includes(this.radar)) this.openFor(ship);
  }

  async #look() {
    try {
      const response = await fetch('status', { cache: 'no-store', headers: token() ? { Authorization: `Bearer ${token()}` } : {} });
      const status = await response.json();
      this.views = new Map(
        status.radars.map(({ radar, views }) => [Number(radar), (views ?? []).map((each) => Number(each.view))]),
      );
    } catch {
      return; // the shared view is there without
    }
    if (this.open) this.#show();
  }

  #show() {
    const address = this.open && this.radar !== null ? `./?radar=${this.radar}&view=${this.view}&watch` : 'about:blank';
    if ($('trainee-frame').getAttribute('src') !== address) $('trainee-frame').setAttribute('src', address);
    if (!this.open) return;
    const fill = (list, options, value) => {
      const text = JSON.stringify(options);
      if (list.dataset.options !== text) {
        list.replaceChildren(...options.map(([id, name]) => new Option(name, id)));
        list.dataset.options = text;
      }
      list.value = String(value);
    };
    fill(
      $('trainee-radar'),
      this.radars.map(({ radar, ownShip, name }) => [
        radar,
        [ownShip, name].filter(Boolean).join(' · ') || `Radar ${radar}`,
      ]),
      this.radar,
    );
    const views = (this.views.get(this.radar) ?? []).filter((view) => view !== 0);
    const names = [[0, 'Shared view'], ...views.map((view) => [view, `View ${view}`])];
    if (this.view !== 0 && !views.includes(this.view)) names.push([this.view, `View ${this.view} (ended)`]);
    fill($('trainee-view'), names, this.view);
    $('trainee-open').href = `./?radar=${this.radar}`;
    $('trainee-con').href = `conning?radar=${this.radar}`;
  }

  #bindSplitter() {
    const splitter = $('splitter');
    const resize = (px) => {
      const whole = $('work').clientWidth;
      this.wide = Math.max(LEAST_PX, Math.min(whole - LEAST_PX, px));
      $('work').style.setProperty('--trainee', `${this.wide}px`);
      splitter.setAttribute('aria-valuenow', String(Math.round((100 * this.wide) / whole)));
      this.resized();
    };
    splitter.addEventListener('pointerdown', (event) => {
      event.preventDefault();
      splitter.focus({ preventScroll: true });
      splitter.setPointerCapture(event.pointerId);
      document.body.dataset.resizing = 'yes'; // the frame would swallow the pointer
    });
    splitter.addEventListener('pointermove', (event) => {
      if (splitter.hasPointerCapture(event.pointerId)) resize($('work').getBoundingClientRect().right - event.clientX);
    });
    splitter.addEventListener('lostpointercapture', () => {
      delete document.body.dataset.resizing;
    });
    splitter.addEventListener('keydown', (event) => {
      const step = { ArrowLeft: STEP_PX, ArrowRight: -STEP_PX }[event.key];
      if (!step) return;
      resize($('trainee').clientWidth + step);
      event.preventDefault();
      event.stopPropagation();
    });
  }
}
