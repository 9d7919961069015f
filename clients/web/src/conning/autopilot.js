// The autopilot: who steers, the heading and the speed that are kept, the limit of its turns.
import { bearing, fixed } from '../format.js';
import { HEADING, TRACK } from '../messages.js';
import { $, write } from '../widgets.js';

// How long an answered step is shown if the heading that the server tells does not follow it.
const SETTLE_MS = 1200;
const STEERS = ['By hand', 'By heading', 'By track'];

// A field and its button: calls order(number) and is empty again if that could be sent.
export function bindEntry(form, order) {
  const field = $(form).querySelector('input');
  $(form).addEventListener('submit', (event) => {
    event.preventDefault();
    if (order(field.valueAsNumber) === null) return;
    field.blur();
    $(form).reset();  // not only emptied: it would be marked as missing what it needs
  });
}

export class Autopilot {
  // order(values): of ConOrder; keepSpeed(kn).  Each returns the request's number, or null if it could not be sent.
  constructor(order, keepSpeed) {
    this.order = order;
    this.con = null;
    for (const button of document.querySelectorAll('[data-steering]')) {
      button.addEventListener('click', () => this.steer(Number(button.dataset.steering)));
    }
    for (const button of document.querySelectorAll('[data-heading-step]')) {
      button.addEventListener('click', () => this.step(Number(button.dataset.headingStep)));
    }
    bindEntry('heading-form', (headingDeg) => order({ headingDeg }));
    bindEntry('rate-form', (turnRateDegMin) => order({ turnRateDegMin }));
    bindEntry('speed-form', keepSpeed);
  }

  steer(steering) {
    this.order({ steering });
  }

  // From the heading that is kept; when none is, there is nothing to step from.
  step(deg) {
    if (this.con?.steering !== HEADING) return;
    const from = this.stepped ?? this.con.headingOrderDeg;
    this.stepped = (((from + deg) % 360) + 360) % 360;
    clearTimeout(this.stepTimer);
    this.isAnswered = false;
    this.asked = this.order({ headingDeg: this.stepped });
    if (this.asked === null) this.settle();  // not sent
    this.show(this.con, this.ship);
  }

  // Only what the server tells after it has answered the last step can be of that step: steps to and fro pass the same
  // heading twice.
  takeReply(reply) {
    if (this.stepped === undefined || reply.request !== this.asked) return;
    this.isAnswered = true;
    this.stepTimer = setTimeout(() => { this.settle(); this.show(this.con, this.ship); }, SETTLE_MS);
  }

  // Refused: what the server has is shown.
  settle() {
    clearTimeout(this.stepTimer);
    this.stepped = undefined;
  }

  show(con, ship) {
    this.con = con;
    this.ship = ship;
    const keeps = con?.steering === HEADING;
    if (!keeps || (this.isAnswered && this.stepped === con.headingOrderDeg)) this.settle();
    for (const button of document.querySelectorAll('[data-steering]')) {
      button.ariaPressed = String(con?.steering === Number(button.dataset.steering));
      if (Number(button.dataset.steering) === TRACK) button.disabled = con?.waypoints === 0;
    }
    for (const button of document.querySelectorAll('[data-heading-step]')) button.disabled = !keeps;
    write('heading-order', keeps ? bearing(this.stepped ?? con.headingOrderDeg) : '\u2013');
    $('heading-order').classList.toggle('pending', this.stepped !== undefined);
    write('helm-mode', con ? STEERS[con.steering] ?? '' : '');
    write('engine-mode', !con ? '' : con.keepsSpeed ? `keeps ${fixed(ship.orderedSpeedKn, 1)} kn` : 'by lever');
    $('heading-entry').placeholder = keeps ? bearing(con.headingOrderDeg) : '\u2013';
    $('speed-entry').placeholder = con?.keepsSpeed ? fixed(ship.orderedSpeedKn, 1) : '\u2013';
    $('rate-entry').placeholder = !con ? '\u2013' : con.turnRateDegMin > 0 ? fixed(con.turnRateDegMin, 0) : 'class';
  }
}
