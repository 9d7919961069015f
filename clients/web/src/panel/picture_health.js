// Who draws the picture, and in words why it is not WebGL2 or why there is none. A graphics context that the browser
// took away comes back by itself, as a rule within seconds; if not, the processor draws on.
import { later, t } from '../language/language.js';

const NO_WEBGL = later('Drawn without WebGL: this browser has no WebGL2. The processor draws the picture, with more work for it.');
const NO_MORE_WEBGL = later('Drawn without WebGL: the browser has taken the graphics away and not given them back. Reload the page to try again.');
const ASKED = later('Drawn without WebGL: as the address of this page asks.');
const LOST = later('The browser has taken the graphics away: there is no radar picture. It comes back by itself.');
const WAIT_MS = 5000;

// Stands for the renderer where there is none. maxRows: a store that nobody draws need not be large.
class NoRenderer {
  maxRows = 64;

  draw() {}

  setEchoColours() {}

  readPixels() {
    return { width: 0, height: 0, data: new Uint8Array(0) };
  }
}

export class PictureHealth {
  // make: { webgl, plain }: each makes a renderer of a canvas, or throws if it cannot; wanted: '2d' for the plain
  // one, 'webgl2' or null for WebGL2 where there is any.
  constructor(canvas, make, wanted) {
    Object.assign(this, { canvas, make, text: '' });
    this.note = '';       // to be told once
    this.noted = null;    // told of a note that comes later
    this.colours = null;
    if (wanted === '2d') {
      this.#drawPlain(ASKED);
      return;
    }
    canvas.addEventListener('webglcontextlost', () => this.#lost());
    canvas.addEventListener('webglcontextrestored', () => this.#restored());
    try {
      this.renderer = make.webgl(canvas);
    } catch (error) {
      if (/WebGL2 is not available/.test(error.message)) this.#drawPlain(NO_WEBGL);
      else this.#drawNothing(error);
    }
  }

  // As of the renderer, who may be another one later.
  setEchoColours(bytes) {
    this.colours = bytes;
    this.renderer.setEchoColours(bytes);
  }

  #lost() {
    this.text = t(LOST);
    // What a lost canvas shows is up to the browser: white, as a rule.
    this.canvas.style.visibility = 'hidden';
    this.timer = setTimeout(() => {
      // A canvas that was WebGL's is never another's.
      const next = this.canvas.cloneNode();
      next.style.visibility = '';
      this.canvas.replaceWith(next);
      this.canvas = next;
      this.text = '';
      this.#drawPlain(NO_MORE_WEBGL);
    }, WAIT_MS);
  }

  #restored() {
    clearTimeout(this.timer);
    this.text = '';
    this.canvas.style.visibility = '';
  }

  #drawPlain(why) {
    try {
      this.renderer = this.make.plain(this.canvas);
      if (this.colours) this.renderer.setEchoColours(this.colours);
      this.note = t(why);
      this.noted?.(this.note);
    } catch (error) {
      this.#drawNothing(error);
    }
  }

  #drawNothing(error) {
    this.renderer = new NoRenderer();
    this.text = t('This browser cannot draw the radar picture: {why}. Controls and numbers work.', { why: error.message });
  }
}
