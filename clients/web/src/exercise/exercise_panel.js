// The exercise itself: its clock, snapshots, undo, marks and texts; and who ordered what last.
import { duration } from '../format.js';
import { $, write } from '../widgets.js';
import { LiveField } from './live_field.js';
import { sureButton } from './sure_button.js';

export const KINDS = {
  mark: 'Mark',
  event: 'Event',
  text: 'Text',
  alarm: 'Alarm',
  grounding: 'Grounding',
  collision: 'Collision',
};

export class ExercisePanel {
  constructor(exercise, orders, notify) {
    Object.assign(this, { exercise, orders, notify, marks: '', snapshots: '', cons: '' });
    $('freeze').addEventListener('click', () => this.toggleFreeze());
    $('undo').addEventListener('click', () => orders.exercise({ undo: true }, 'undo'));
    this.rate = new LiveField($('rate'), (rate) => orders.exercise({ clock: { rate } }, 'rate'));
    for (const button of document.querySelectorAll('[data-rate]')) {
      button.addEventListener('click', () => orders.exercise({ clock: { rate: Number(button.dataset.rate) } }, 'rate'));
    }
    this.#form(
      'snapshot-form',
      'snapshot-name',
      (name) => orders.exercise({ snapshot: name }, 'snapshot'),
      () => `At ${duration(exercise.state?.exerciseS)}`,
    );
    this.#form(
      'mark-form',
      'mark-text',
      (text) => orders.exercise({ mark: text }, 'mark'),
      () => 'Mark',
    );
    this.#form('text-form', 'text-text', (text) => {
      const to = $('text-to').value;
      return orders.exercise({ text: to === 'all' ? { text } : { ownShip: Number(to), text } }, 'text');
    });
  }

  // An empty field stands for what `otherwise` makes; without that it is refused.
  #form(form, field, send, otherwise = null) {
    $(form).addEventListener('submit', (event) => {
      event.preventDefault();
      const text = $(field).value.trim() || otherwise?.();
      if (!text) {
        this.notify('Type a text first');
        return;
      }
      if (send(text) !== null) $(field).value = '';
    });
  }

  toggleFreeze() {
    const { state } = this.exercise;
    if (state) this.orders.exercise({ clock: { frozen: !state.frozen } }, state.frozen ? 'run' : 'freeze');
  }

  show() {
    const { state } = this.exercise;
    write('exercise-time', duration(state?.exerciseS ?? NaN));
    document.body.dataset.clock = !state ? 'none' : state.frozen ? 'frozen' : 'running';
    write('exercise-pace', !state ? '' : state.frozen ? 'Frozen' : `× ${Number(state.rate.toFixed(2))}`);
    write('freeze', state?.frozen ? 'Run' : 'Freeze');
    $('freeze').disabled = !state;
    $('undo').disabled = !state?.canUndo;
    $('undo').title = state?.canUndo ? `Take back: ${state.canUndo} (Z)` : 'There is nothing to take back';
    write('undo-what', state?.canUndo || 'nothing to take back');
    write('last-order', state?.lastOrder ? `${state.lastBy}: ${state.lastOrder}` : '');
    $('last-order').title = $('last-order').textContent;
    if (!state) return;
    this.rate.take(state.rate);
    for (const button of document.querySelectorAll('[data-rate]'))
      button.setAttribute('aria-pressed', String(Number(button.dataset.rate) === state.rate));
    write('orders-given', String(state.orders));
    this.#showLists(state);
  }

  #showLists(state) {
    const marks = JSON.stringify(state.marks),
      snapshots = JSON.stringify(state.snapshots),
      cons = JSON.stringify(this.exercise.own.map(({ number, name }) => [number, name]));
    if (marks !== this.marks) {
      this.marks = marks;
      $('mark-list').replaceChildren(...[...state.marks].reverse().map((mark) => this.#mark(mark)));
    }
    if (snapshots !== this.snapshots) {
      this.snapshots = snapshots;
      $('snapshot-list').replaceChildren(...[...state.snapshots].reverse().map((name) => this.#snapshot(name)));
    }
    if (cons !== this.cons) {
      this.cons = cons;
      const before = $('text-to').value;
      $('text-to').replaceChildren(
        new Option('All cons', 'all'),
        ...this.exercise.own.map(({ number, name }) => new Option(name, number)),
      );
      if ([...$('text-to').options].some(({ value }) => value === before)) $('text-to').value = before;
    }
  }

  #mark({ exerciseS, text, kind }) {
    const item = document.createElement('li');
    item.dataset.kind = kind;
    const [time, what, words] = ['time', 'b', 'span'].map((name) => document.createElement(name));
    time.textContent = duration(exerciseS);
    what.textContent = KINDS[kind] ?? kind;
    words.textContent = text;
    item.append(time, what, words);
    return item;
  }

  // It takes everybody back.
  #snapshot(name) {
    const item = document.createElement('li'),
      text = document.createElement('span');
    text.textContent = name;
    const restore = () => this.orders.exercise({ restore: name }, `restore ${name}`);
    const button = sureButton('Restore', `Restore ${name}`, restore);
    item.append(text, button);
    return item;
  }
}
