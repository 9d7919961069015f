// Locks: which controls only the instructor may change, and what that does to the panel.
import { showRefusal } from './panel/refusal.js';
import { PendingRequests } from './shared_setting.js';
import { $ } from './widgets.js';

// Elements of controls that are not one element with the control's name, by the field's name.
const ELEMENTS = {
  range_nm: ['range', 'range-less', 'range-more'], instrumented_range_m: [], transmit: ['transmit-on', 'transmit-off'],
};

// The boxes of the instructor's panel, by the lock of the table of controls; orders and world are no controls.
const BOXES = {
  range: 'Range', gain: 'Gain', sea: 'Sea', rain: 'Rain', mode: 'Mode, Doppler', processing: 'Processing', transmitter: 'Transmitter',
  antenna: 'Antenna', orders: 'Course, speed', world: 'World',
};

// The controls that the instructor locks with one box, by their names in radar.proto, and the elements of each.
function groupsOf(controls) {
  const groups = {
    'lock-orders': { course_deg: ['order-course'], speed_kn: ['order-speed'] },
    'lock-world': { world: [] },
  };
  for (const { name, field, lock } of controls) {
    if (lock) (groups[`lock-${lock}`] ??= {})[field] = ELEMENTS[field] ?? [name];
  }
  return groups;
}

export class Locks {
  // controls: the table's.  set(values): sends them, and returns the request number or null.  While the instructor's panel is
  // open this console is the instructor's, whom no lock holds.
  constructor(controls, set) {
    this.groups = groupsOf(controls);
    $('locks').append(...Object.entries(BOXES).map(([lock, text]) => {
      const label = document.createElement('label'), box = document.createElement('input'), span = document.createElement('span');
      Object.assign(box, { id: `lock-${lock}`, type: 'checkbox' });
      span.textContent = text;
      label.append(box, span);
      return label;
    }));
    this.pending = new PendingRequests();
    this.locked = new Set();
    this.tuneAuto = false;
    this.driven = false;
    for (const [id, controls] of Object.entries(this.groups)) {
      $(id).addEventListener('change', () => {
        this.#ask(set({ [$(id).checked ? 'lock' : 'unlock']: Object.keys(controls) }), $(id));
      });
    }
    // An exam: everything locked, then what the instructor allows unlocked.
    const all = Object.values(this.groups).flatMap((controls) => Object.keys(controls));
    $('lock-all').addEventListener('click', () => this.#ask(set({ lock: all }), $('lock-range')));
    $('unlock-all').addEventListener('click', () => this.#ask(set({ unlock: all }), $('lock-range')));
    $('instructor').addEventListener('toggle', () => this.show());
  }

  #ask(request, element) {
    this.pending.add(request, { settle: () => this.show(), refused: (why) => showRefusal(element, why) });
    this.show();  // as the server has it, until it says otherwise
  }

  get isInstructor() {
    return $('instructor').open;
  }

  takeReply(reply, why) {
    this.pending.takeReply(reply, why);
  }

  take(settings) {
    this.locked = new Set(settings.locked);
    this.tuneAuto = settings.tuneAuto;
    this.show();
  }

  takeOwnShip(ownShip) {
    if (ownShip.driven === this.driven) return;
    this.driven = ownShip.driven;
    this.show();
  }

  show() {
    for (const [id, controls] of Object.entries(this.groups)) {
      const names = Object.keys(controls);
      $(id).checked = names.every((name) => this.locked.has(name));
      $(id).indeterminate = !$(id).checked && names.some((name) => this.locked.has(name));
      for (const name of names) for (const element of controls[name]) this.#show($(element), name);
    }
    $('exam-sign').hidden = !Object.values(this.groups).every((controls) => Object.keys(controls).every((name) => this.locked.has(name)));
  }

  #show(element, name) {
    const locked = this.locked.has(name);
    element.classList.toggle('locked', locked);
    if (locked) element.title = 'Locked by the instructor';
    else if (element.title === 'Locked by the instructor') element.removeAttribute('title');
    // The tuning and a ship that is driven from outside have a say of their own in when they serve.
    const idle = (name === 'tune' && this.tuneAuto) || (this.driven && (name === 'course_deg' || name === 'speed_kn'));
    element.disabled = (locked && !this.isInstructor) || idle;
  }
}
