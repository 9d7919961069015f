// Class codes: made, shown large for a class to read, and ended; who has signed in by them.
import { $ } from '../widgets.js';
import { sureButton } from './sure_button.js';

const ASK_MS = 5000;
const MANY = 8;  // names that are told one by one

// 123456 as 123 456, 1234567 as 1234 567
export const spaced = (code) => code.replace(/^(\d{3,4})(\d{3,4})$/, '$1 $2');

export class ClassPanel {
  // send(order): an order to the server, null if it was not sent.
  constructor(exercise, send, notify) {
    Object.assign(this, { exercise, send, notify, on: false, shown: '', ships: '', spent: new Set() });
    $('class-form').addEventListener('submit', (event) => {
      event.preventDefault();
      send({ make: { ship: $('class-ship').value, minutes: Number($('class-minutes').value) } });
    });
    setInterval(() => this.#ask(), ASK_MS);
  }

  // A server has begun to answer: does it know of class codes?
  greet(knows) {
    this.on = knows;
    $('class-codes').hidden = true;
    this.#ask();
  }

  #ask() {
    if (this.on) this.send({});
  }

  // Who may not make any sees nothing of them.
  refused() {
    this.on = false;
    $('class-codes').hidden = true;
  }

  take({ codes }) {
    $('class-codes').hidden = false;
    for (const { ship, code, wrong } of codes) {
      if (code) this.spent.delete(ship);
      else if (!this.spent.has(ship)) {
        this.spent.add(ship);
        this.notify(`The class code of ${ship} takes nobody in any more: ${wrong} wrong ones were tried`);
      }
    }
    const shown = JSON.stringify(codes);
    if (shown === this.shown) return;
    this.shown = shown;
    $('class-list').replaceChildren(...codes.map((code) => this.#item(code)));
  }

  show() {
    const names = this.exercise.own.map(({ name }) => name);
    if (JSON.stringify(names) === this.ships) return;
    this.ships = JSON.stringify(names);
    const before = $('class-ship').value;
    $('class-ship').replaceChildren(...names.map((name) => new Option(name, name)));
    if (names.includes(before)) $('class-ship').value = before;
  }

  #item({ ship, code, endsUtcNs, trainees, wrong, wrongMost }) {
    const item = document.createElement('li');
    const [digits, what, who, large] = ['output', 'p', 'p', 'button'].map((name) => document.createElement(name));
    const until = new Date(Number(endsUtcNs) / 1e6).toLocaleTimeString([], {
      hour: '2-digit',
      minute: '2-digit',
      hourCycle: 'h23',
    });
    digits.textContent = code ? spaced(code) : 'spent';
    item.classList.toggle('spent', !code);
    what.textContent = `${ship}, until ${until}${wrong > 0 ? ` \u00b7 ${wrong} of ${wrongMost} wrong tries` : ''}`;
    const more = trainees.length > MANY ? ` and ${trainees.length - MANY} more` : '';
    who.textContent = trainees.length > 0 ? trainees.slice(0, MANY).join(', ') + more : 'nobody has signed in yet';
    who.className = 'dim';
    large.type = 'button';
    large.textContent = 'Show large';
    large.disabled = !code;
    large.addEventListener('click', () => this.#showLarge(ship, code));
    const buttons = document.createElement('div');
    buttons.className = 'buttons';
    buttons.append(large, sureButton('End', `End the class code of ${ship}`, () => this.send({ end: ship })));
    item.append(digits, what, who, buttons);
    return item;
  }

  #showLarge(ship, code) {
    $('class-large-ship').textContent = ship;
    $('class-large-code').textContent = spaced(code);
    $('class-large-where').textContent = location.host;
    $('class-large').showModal();
  }
}
