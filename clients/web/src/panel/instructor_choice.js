// Whether this console is the instructor's. Until the server knows roles it is the choice of whoever sits before it, asked
// for once and kept in this browser; ?instructor=1 makes it so for one page, ?instructor=0 not.
const REMEMBERED = 'skerry.instructor';

function kept() {
  try { return localStorage.getItem(REMEMBERED) === '1'; } catch { return false; }
}

export class InstructorChoice {
  // elements: { part: what instructors have, fold: <details> in it, box: the check box, ask: <dialog> }.
  // asked: of the page's address, or null.
  constructor({ part, fold, box, ask }, asked) {
    Object.assign(this, { part, fold, box });
    box.addEventListener('change', () => {
      if (!box.checked) { this.#choose(false); return; }
      box.checked = false;  // until it is confirmed
      ask.returnValue = '';
      ask.showModal();
    });
    ask.addEventListener('close', () => { if (ask.returnValue === 'yes') this.#choose(true); });
    this.#show(asked === null ? kept() : asked === '1');
  }

  #choose(on) {
    try { localStorage.setItem(REMEMBERED, on ? '1' : '0'); } catch { /* Then it is so until the page is left. */ }
    this.#show(on);
  }

  #show(on) {
    this.box.checked = on;
    this.part.hidden = !on;
    if (!on) this.fold.open = false;
  }
}
