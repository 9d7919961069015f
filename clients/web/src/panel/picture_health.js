// Whether the picture can be drawn, and in words why not. Without WebGL2 the console works all the same, only that it has
// no picture; a graphics context that the browser took away comes back by itself, as a rule within seconds.
import { later, t } from '../language/language.js';

const NO_WEBGL = later('This browser cannot draw the radar picture: it has no WebGL2. Controls and numbers work. Turn on hardware acceleration, or use another browser.');
const LOST = later('The browser has taken the graphics away: there is no radar picture. It comes back by itself.');
const LOST_LONG = later('The browser has taken the graphics away: there is no radar picture. Reload the page.');
const LONG_MS = 15000;

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
  // make(canvas): the renderer; it throws if it cannot.
  constructor(canvas, make) {
    this.text = '';
    canvas.addEventListener('webglcontextlost', () => {
      this.text = t(LOST);
      // What a lost canvas shows is up to the browser: white, as a rule.
      canvas.style.visibility = 'hidden';
      this.timer = setTimeout(() => { this.text = t(LOST_LONG); }, LONG_MS);
    });
    canvas.addEventListener('webglcontextrestored', () => {
      clearTimeout(this.timer);
      this.text = '';
      canvas.style.visibility = '';
    });
    try {
      this.renderer = make(canvas);
    } catch (error) {
      this.renderer = new NoRenderer();
      this.text = /WebGL2 is not available/.test(error.message) ? t(NO_WEBGL)
        : t('This browser cannot draw the radar picture: {why}. Controls and numbers work.', { why: error.message });
    }
  }
}
