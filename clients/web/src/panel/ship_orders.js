// Course and speed that are ordered of own ship. What is refused stays in the fields, to be put right.
import { PendingRequests } from '../shared_setting.js';
import { $ } from '../widgets.js';
import { showRefusal } from './refusal.js';

export class ShipOrders {
  // set(values): sends them, and returns the request number or null.
  constructor(set) {
    this.pending = new PendingRequests();
    $('orders').addEventListener('submit', (event) => { event.preventDefault(); this.#send(set); });
  }

  #send(set) {
    const course = $('order-course'), speed = $('order-speed');
    const values = {}, before = [course.value, speed.value];
    if (course.value !== '') values.courseDeg = course.valueAsNumber;
    if (speed.value !== '') values.speedKn = speed.valueAsNumber;
    const request = Object.keys(values).length > 0 ? set(values) : null;
    if (request === null) return;
    course.value = speed.value = '';
    this.pending.add(request, { settle: () => { [course.value, speed.value] = before; }, refused: (why) => showRefusal($('orders'), why) });
  }

  takeReply(reply, why) {
    this.pending.takeReply(reply, why);
  }
}
