// ChartPart: the chart under the picture, lines of one's own and the man overboard, joined to the console.
import { bearing, distance } from '../format.js';
import { t } from '../language/language.js';
import { $, write } from '../widgets.js';
import { CHART_COLOURS } from './chart_colours.js';
import { LoadedChart } from './chart_objects.js';
import { ChartPainter, reachOf } from './chart_painter.js';
import { ChartRequest } from './chart_request.js';
import { ChartSettings } from './chart_settings.js';
import { MARK_NAMES } from './chart_wire.js';
import { bearingRange } from './earth.js';
import { MapEditor } from './map_editor.js';
import { MapItems } from './map_items.js';
import { MapPainter } from './map_painter.js';
import { MapPanel } from './map_panel.js';
import { MapStore } from './map_store.js';
import { Mob } from './mob.js';
import { OwnPosition } from './own_position.js';

const NEAR_PX = 16;  // of the cursor, a mark's name is told

export class ChartPart {
  // parts: radar (RadarConsole), ask(circle): a request number or null, notify(text, kind), clockPace(): seconds of the radar's clock
  // in one of ours: another than 1 in a playback.
  constructor({ radar, ask, notify, clockPace }) {
    Object.assign(this, { radar, notify, clockPace, view: null, place: null, loaded: null, canAsk: false, utc: null, nearest: '' });
    this.position = new OwnPosition();
    this.request = new ChartRequest(ask);
    this.painter = new ChartPainter($('chart'));
    this.settings = new ChartSettings(() => this.#showNote());
    this.items = new MapItems(() => this.#itemsChanged());
    this.mapPainter = new MapPainter($('map-lines'));
    this.editor = new MapEditor($('ppi'), {
      items: this.items, painter: this.mapPainter, notify,
      now: () => ({ view: this.view, place: this.place }), form: () => this.panel.form, changed: () => this.#editorChanged(),
      released: () => this.panel.keep(),
    });
    this.panel = new MapPanel({ items: this.items, editor: this.editor, store: new MapStore(localStorage), notify });
    this.panel.open(this.panel.store.current);
    this.isOpen = true;
    this.panel.show();
    this.mob = new Mob(() => ({ place: this.place, utcMs: this.utcMs() }), notify);
    $('event-mark').addEventListener('click', () => this.markEvent());
    $('ppi').addEventListener('pointermove', (event) => { this.pointer = { x: event.offsetX, y: event.offsetY }; });
    $('ppi').addEventListener('pointerleave', () => { this.pointer = null; });
    this.#showNote();
  }

  // Messages of the connection, after the console's own part has had them.
  takeAll(messages) {
    for (const message of messages) {
      if (message.hello) {
        this.canAsk = message.hello.hasChart;
        this.request.forget();
        this.utc = null;
        if (!this.canAsk) this.loaded = null;
      } else if (message.chartObjects && this.request.take(message.chartObjects)) {
        this.loaded = new LoadedChart(message.chartObjects);
        this.painter.forget();
      } else if (message.reply) {
        this.request.takeReply(message.reply);
      } else if (message.ownShip && message.ownShip.radar === this.radar.radar && message.ownShip.utcNs > 0) {
        this.utc = { ms: message.ownShip.utcNs / 1e6, atMs: performance.now() };
      } else continue;
      this.#showNote();
    }
  }

  // Of own ship, as she tells it, or else this computer's.
  utcMs() {
    return this.utc ? this.utc.ms + (performance.now() - this.utc.atMs) * this.clockPace() : Date.now();
  }

  draw(view, nowS, paletteName) {
    this.view = view;
    const { world } = this.radar;
    this.place = this.position.place(this.radar, nowS, world?.frozen ? 0 : this.clockPace() * (world?.rate || 1));
    const { settings } = this;
    if (settings.on && this.canAsk && this.place && view.rangeM > 0) {
      this.request.look(this.place, reachOf(view), view.rangeM / view.radius / view.pixelRatio);
    }
    const look = { paletteName, colours: CHART_COLOURS[paletteName], coast: settings.coast, contours: settings.contours, buoys: settings.buoys, lines: settings.lines };
    this.painter.draw(view, settings.on ? this.loaded : null, this.place, look);
    this.mapPainter.draw(view, this.place, {
      items: this.items.items, version: this.items.version, draft: this.editor.draft, selected: this.editor.selected?.id ?? null,
      handles: this.editor.mode === 'edit', mob: this.mob.at,
    }, look);
  }

  // A few times a second.
  showReadouts() {
    this.mob.show();
    write('chart-nearest', this.#nearestText());
  }

  // For the table of keys (keys/key_table.js).
  get keys() {
    const group = t('Chart');
    return [
      { id: 'chart', key: 'j', words: t('chart on, off'), group, run: () => this.toggle() },
      { id: 'mob', key: 'o', words: t('man overboard (MOB)'), group, run: () => this.mob.mark() },
      { id: 'event-mark', key: 'x', words: t('event mark'), group, run: () => this.markEvent() },
    ];
  }

  toggle() {
    $('chart-on').click();
  }

  // An event: own ship's place and the time, in the list and in the picture.
  markEvent() {
    if (!this.place) return this.notify(t('The event was not marked: own ship\u2019s position is not known'));
    const utc = new Date(this.utcMs()).toISOString();
    const item = this.items.add({ type: 'point', kind: 'event', text: this.panel.form.text, places: [this.place], utc });
    if (!item) return this.notify(this.items.refusal(1));
    return this.notify(t('Event marked: {time} UTC', { time: utc.slice(11, 19) }), 'info');
  }

  #itemsChanged() {
    if (!this.isOpen) return;
    if (!this.editor.drag) this.panel.keep();
    this.panel.show();
  }

  #editorChanged() {
    if (this.isOpen) this.panel.show();
    $('ppi').toggleAttribute('data-drawing', this.editor.mode !== 'off');
  }

  #showNote() {
    const { objects } = this.loaded ?? {};
    const text = !this.settings.on ? '' : !this.canAsk ? t('this server tells no chart') : !objects ? t('is asked for')
      : [objects.chart, objects.coastOnly ? t('coast only') : '', objects.marksLeftOut > 0 ? t('{n} marks left out', { n: objects.marksLeftOut }) : '',
        objects.linesLeftOut > 0 ? t('{n} short lines left out', { n: objects.linesLeftOut }) : '', t('not for navigation')]
        .filter(Boolean).join(' · ');
    write('chart-note', text);
    $('chart-note').title = text;
  }

  // The charted mark under the cursor.
  #nearestText() {
    const { pointer, loaded, place, view, settings } = this;
    if (!pointer || !loaded?.plane || !place || !settings.on || !settings.buoys || !(view?.rangeM > 0)) return '';
    const at = view.fromPixel(pointer.x, pointer.y);
    const aim = view.toPixel(at.bearingDeg, at.rangeM);
    let best = { px: NEAR_PX, mark: null };
    for (const mark of loaded.marks) {
      const { x, y } = this.painter.lie?.toPixel(mark.east, mark.north) ?? { x: NaN, y: NaN };
      const px = Math.hypot(x - aim.x, y - aim.y);
      if (px < best.px) best = { px, mark };
    }
    if (!best.mark) return '';
    const { mark } = best;
    const to = bearingRange(place, mark);
    const kind = t(MARK_NAMES[mark.kind] ?? MARK_NAMES[0]);
    return [mark.name || kind, mark.name ? kind : '', mark.light, mark.racon ? t('racon') : '',
            mark.depthM === undefined ? '' : `${Number(mark.depthM.toFixed(1))} m`, `${bearing(to.bearingDeg)}° ${distance(to.rangeM)}`].filter(Boolean).join(' · ');
  }

  // For tests: what is known and where it is drawn.
  state() {
    const { loaded, place, painter } = this;
    return {
      place, items: this.items.items, mode: this.editor.mode, draft: this.editor.draft, mob: this.mob.at,
      chart: loaded && { radiusNm: loaded.objects.radiusNm, lines: loaded.lines.length, points: loaded.points, marks: loaded.marks.length, coastOnly: loaded.objects.coastOnly },
      drawn: loaded?.paths?.points ?? 0, times: { ...painter.times },
      markPixels: painter.lie ? (loaded?.marks ?? []).map(({ kind, name, latitudeDeg, longitudeDeg, east, north }) => ({ kind, name, latitudeDeg, longitudeDeg, ...painter.lie.toPixel(east, north) })) : [],
      itemPixels: this.items.items.map((item) => this.mapPainter.pixelsOf(item)),
    };
  }
}
