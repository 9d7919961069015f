// TargetOrders: orders to the plotter, and where it is said what became of them.
import { t } from '../language/language.js';
import { sayProblem } from './dom.js';

export class TargetOrders {
  // send(order): the request number, null where it could not be sent, undefined where this console gives no orders. notify(text, kind): to the operator.
  constructor(send, notify) {
    this.send = send;
    this.notify = notify;
    this.asked = new Map();  // request: { problem, done }
  }

  forget() {
    this.asked.clear();
  }

  // problem: the element beside the control, or null; done(text): called once the server has obeyed.
  give(order, problem = null, done = () => {}) {
    if (problem) sayProblem(problem, '');
    const request = this.send(order);
    if (request === null) this.notify(t('Not connected: nothing was ordered'));
    else if (request !== undefined) this.asked.set(request, { problem, done });
  }

  // Whether the reply is one of ours. The notice of a refusal is the console's own.
  takeReply(reply, text) {
    const asked = this.asked.get(reply.request);
    if (!asked) return false;
    this.asked.delete(reply.request);
    if (reply.code === 0) asked.done(reply.text);
    else if (asked.problem) sayProblem(asked.problem, text);
    return true;
  }
}
