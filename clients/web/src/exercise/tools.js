// Tools: what a click on the chart does. One is in hand at a time; without one a click selects.
import { NAUTICAL_MILE_M } from '../view_geometry.js';

export const TOOLS = ['look', 'move', 'target', 'route', 'rain'];
// A second tap there, so soon, ends a route.
const DOUBLE_MS = 400,
  DOUBLE_PX = 10;

export class Tools {
  // forms: target(), route() and rain() give what stands in the tools' forms, or null after having said what is wrong.
  // changed(): something is to be drawn or shown anew.
  constructor({ exercise, orders, forms, notify, changed }) {
    Object.assign(this, { exercise, orders, forms, notify, changed, name: 'look', waypoints: [], lastTap: null });
  }

  take(name) {
    if (name === 'route' && this.exercise.chosenTargets.length === 0) {
      this.notify('Select a target first: a route is hers');
      name = 'look';
    }
    this.name = this.name === name ? 'look' : name;
    this.waypoints = [];
    this.changed();
  }

  plan() {
    return { waypoints: this.name === 'route' ? this.waypoints : [], from: this.exercise.chosenTargets };
  }

  rainRadiusM() {
    return this.name === 'rain' ? (this.forms.rainRadiusNm() || 0) * NAUTICAL_MILE_M : 0;
  }

  // Whether the tool takes clicks on the chart for itself.
  get places() {
    return this.name === 'target' || this.name === 'route' || this.name === 'rain';
  }

  // place: where; at: { x, y, ms } on the screen, absent: by key.
  act(place, at = null) {
    if (this.name === 'target') this.#addTarget(place);
    else if (this.name === 'rain') this.#addRain(place);
    else if (this.name === 'route') this.#addWaypoint(place, at);
  }

  #addTarget({ latitudeDeg, longitudeDeg }) {
    const values = this.forms.target();
    if (values)
      this.orders.exercise(
        { newTarget: { ...values, latitudeDeg, longitudeDeg } },
        `new target ${values.name ?? ''}`.trim(),
      );
  }

  #addRain({ latitudeDeg, longitudeDeg }) {
    const values = this.forms.rain();
    if (values) this.orders.world({ rain: [{ id: 0, ...values, latitudeDeg, longitudeDeg }] }, 'rain');
  }

  #addWaypoint(place, at) {
    const last = this.lastTap;
    this.lastTap = at;
    if (
      at &&
      last &&
      at.ms - last.ms < DOUBLE_MS &&
      Math.hypot(at.x - last.x, at.y - last.y) < DOUBLE_PX &&
      this.waypoints.length > 0
    ) {
      this.finish();
      return;
    }
    this.waypoints.push(place);
    this.changed();
  }

  dropLast() {
    this.waypoints.pop();
    this.lastTap = null;
    this.changed();
  }

  // The route as it is drawn is sent.
  finish() {
    if (this.name !== 'route' || this.waypoints.length === 0) return;
    const values = this.forms.route();
    if (!values) return;
    this.orders.route(this.exercise.chosenTargets, this.waypoints, values.speedKn, values.routeEnd);
    this.take('look');
  }

  cancel() {
    this.lastTap = null;
    this.name = 'look';
    this.waypoints = [];
    this.changed();
  }
}
