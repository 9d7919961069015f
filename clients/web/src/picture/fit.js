// How large the picture is and where it lies, so that the data in its corners cover nothing of its circle.
import { ViewGeometry } from '../view_geometry.js';

const SMALLEST = 0.55;  // of what there is room for; below it the data may cover what is left

// width, height: of the area; corners: [{ width, height }] of the boxes in its corners; marginOf(side): of the bearing scale.
// Gives the side of the square in the area's middle.
export function fitSide(width, height, corners, marginOf) {
  const most = Math.max(200, Math.floor(Math.min(width, height)));
  let side = most;
  // From the centre to a box's nearest point; the ticks of the scale count as the circle.
  const clear = (side) => corners.every((box) => {
    const reach = side / 2 - 0.6 * marginOf(side);
    return Math.hypot(Math.max(0, width / 2 - box.width), Math.max(0, height / 2 - box.height)) >= reach;
  });
  while (side > most * SMALLEST && !clear(side)) side -= 2;
  return Math.floor(side);
}

// Of the signs at the picture's left (style.css), in rem; where less room is left beside the circle they stand within it.
const SIGNS_LEFT = 1.1, LEAST_ROOM = 5.5;

const marginOf = (side) => Math.max(24, 3.1 * Math.max(10, Math.min(20, side / 62)));

export class Layout {
  // display: the area, with .corner boxes; ppi: the square in it. isAlone: there are no boxes. made(view): the size is another; a
  // ViewGeometry that stands as the one before.
  constructor(display, ppi, isAlone, made) {
    Object.assign(this, { display, ppi, made });
    this.view = new ViewGeometry(100, 10, 1);
    // At their largest, so that a figure more or less does not resize the picture.
    const corners = isAlone ? [] : [...display.querySelectorAll(':scope > .corner')];
    this.boxes = corners.map((element) => ({ element, width: 0, height: 0 }));
    this.narrow = isAlone ? { matches: false } : matchMedia('(max-width: 760px)');
    new ResizeObserver(() => {
      for (const box of this.boxes) box.width = box.height = 0;
      this.#measure();
      this.layOut();
    }).observe(display);
    const grown = new ResizeObserver(() => { if (this.#measure()) this.layOut(); });
    for (const { element } of this.boxes) grown.observe(element);
    this.#watchPixelRatio();
    this.layOut();
  }

  // Whether a box has grown.
  #measure() {
    let grew = false;
    for (const box of this.boxes) {
      const { offsetWidth: width, offsetHeight: height } = box.element;
      grew ||= width > box.width || height > box.height;
      Object.assign(box, { width: Math.max(width, box.width), height: Math.max(height, box.height) });
    }
    return grew;
  }

  layOut() {
    const { width, height: all } = this.display.getBoundingClientRect();
    // On a narrow screen the data stand below the picture.
    const height = this.narrow.matches ? width : all;
    const side = fitSide(width, height, this.narrow.matches ? [] : this.boxes, marginOf);
    const pixelRatio = window.devicePixelRatio || 1;
    if (side !== this.view.side || pixelRatio !== this.view.pixelRatio) {
      const { upDeg, rangeM, ownAt, jumps } = this.view;
      this.view = Object.assign(new ViewGeometry(side, marginOf(side), pixelRatio), { upDeg, rangeM, ownAt, jumps });
      this.made(this.view);
    }
    this.#placeSigns(width, height, side);
    Object.assign(this.ppi.style, {
      width: `${side}px`, height: `${side}px`, left: `${Math.floor((width - side) / 2)}px`, top: `${Math.floor((height - side) / 2)}px`,
    });
  }

  // What is said over the picture covers nothing of the bearing scale.
  #placeSigns(width, height, side) {
    const rem = parseFloat(getComputedStyle(document.documentElement).fontSize), room = (width - side) / 2 - SIGNS_LEFT * rem;
    this.display.toggleAttribute('data-signs-inside', room < LEAST_ROOM * rem);
    this.display.style.setProperty('--sign-room', `${Math.floor(room)}px`);
    // Where a box nine tenths of the radius wide lies within the circle.
    const { radius } = this.view;
    this.display.style.setProperty('--circle-box', `${Math.floor(0.9 * radius)}px`);
    this.display.style.setProperty('--circle-top', `${Math.ceil((height - side) / 2 + marginOf(side) + 0.11 * radius)}px`);
  }

  // A change of the pixel ratio alone (zoom, another screen) resizes nothing but is told here.
  #watchPixelRatio() {
    matchMedia(`(resolution: ${window.devicePixelRatio}dppx)`)
      .addEventListener('change', () => { this.layOut(); this.#watchPixelRatio(); }, { once: true });
  }
}
