// ColourPass: the disc in colours, as the second shader of shaders.js has it, in whole numbers: red, green and blue
// of a pixel in one (0xBBGGRR, as ImageData has them where the lowest byte comes first). Sums of two or three bytes
// stay below 256. Error: at most 3 of 255 beside the shader's for the same disc; held by canvas.test.mjs.
import { SWEEP_MOST } from '../picture/row_look.js';
import { SIDE as TRAILS_SIDE } from '../picture/true_trails.js';
import { ROW_SHIFT } from './polar_pass.js';

const OPAQUE = 0xff000000;
const GRADIENT = 1024;  // steps of the sea's colour from the centre to the edge

function packed(colour, by = 1) {
  const [r, g, b] = colour.map((part) => Math.round(255 * by * part));
  return r | (g << 8) | (b << 16);
}

// weight: 0..256 of the colour over what is there.
function mix(under, over, weight) {
  const rest = 256 - weight;
  const redBlue = Math.imul(under & 0xff00ff, rest) + Math.imul(over & 0xff00ff, weight) + 0x800080;
  const green = Math.imul(under & 0xff00, rest) + Math.imul(over & 0xff00, weight) + 0x8000;
  return ((redBlue >>> 8) & 0xff00ff) | ((green >>> 8) & 0xff00);
}

const toWeight = (part) => Math.floor(256 * Math.min(1, Math.max(0, part)) + 0.5);

export class ColourPass {
  // circle: circleSpans() of what is coloured, inner: of what no part of the page's colour is in.
  constructor(side, radius, circle, inner) {
    Object.assign(this, { side, radius, circle, inner });
    this.image = new ImageData(side, side);
    this.pixels = new Uint32Array(this.image.data.buffer);
    this.ground = new Uint32Array(side * side);  // sea, and where the video ends
    this.sweeps = new Uint32Array(256);
    this.echoes = new Uint32Array(1024);         // by Doppler class and strength, opacity highest
    this.key = '';
  }

  // Before pixels are coloured. colours: of setEchoColours(); own, video: as of disc.js; looks: RowLook's bytes.
  begin(disc, looks, look, colours, own, video) {
    const { palette } = look;
    this.disc = disc;
    this.looks = new Uint32Array(looks.buffer);
    this.trailPart = (0.8 * look.trails * 256) / (255 * 255);
    this.trueTrailPart = 0.8 * look.trails * 256;
    const limit = video.isSeen ? [own.x, own.y, video.px] : null;
    // A quarter of a pixel is not seen.
    const seen = limit?.map((v) => Math.round(4 * v));
    const key = JSON.stringify([palette.sea, palette.back, palette.brilliance, look.echo, seen]);
    if (key === this.key && colours === this.colours) return;
    Object.assign(this, { key, colours, back: packed(palette.back), trailColour: packed(palette.trail) });
    for (let light = 0; light < 256; ++light) this.sweeps[light] = packed(palette.sweep, (light / 255) * SWEEP_MOST);
    const by = palette.brilliance * look.echo;
    for (let i = 0; i < colours.length / 4; ++i) {
      const [r, g, b, opacity] = colours.subarray(4 * i, 4 * i + 4);
      this.echoes[i] = (packed([r / 255, g / 255, b / 255], by) | (opacity << 24)) >>> 0;
    }
    this.pixels.fill((OPAQUE | this.back) >>> 0);
    this.#lay(palette, limit);
  }

  #lay(palette, limit) {
    const { side, radius, circle, ground } = this, half = side / 2;
    const [x0, y0, end] = limit ?? [0, 0, 0];
    const sea = new Uint32Array(GRADIENT + 2);
    for (let k = 0; k < sea.length; ++k) {
      const t = Math.min(1, k / GRADIENT), s = t * t * (3 - 2 * t);
      sea[k] = packed(palette.sea.map((v, c) => v + s * (palette.seaEdge[c] - v)));
    }
    const beyond = packed(palette.seaEdge, 0.4);
    for (let y = 0; y < side; ++y) {
      const up = half - y - 0.5;
      for (let x = circle[2 * y], i = y * side + x; x < circle[2 * y + 1]; ++x, ++i) {
        const right = x + 0.5 - half;
        let colour = sea[Math.floor((GRADIENT * Math.sqrt(right * right + up * up)) / radius + 0.5)];
        if (limit !== null) {
          const over = Math.sqrt((right - x0) * (right - x0) + (up - y0) * (up - y0)) - end;
          if (over > 0) colour = mix(colour, beyond, toWeight(over));
          if (over > -1 && over < 1) colour += packed(palette.sweep, 0.45 * (1 - Math.abs(over)));
        }
        ground[i] = colour;
      }
    }
  }

  // Colours the pixels from..to of line y; trails: { own, ownCell, eastward, northward, nowTick, lifeTicks, cells }
  // of true trails, or null.
  colour(y, from, to, trails) {
    const { disc, looks, pixels, ground, sweeps, echoes, trailColour, trailPart, side } = this;
    for (let i = y * side + from, end = y * side + to; i < end; ++i) {
      const d = disc[i], look = looks[d >>> ROW_SHIFT];
      let c = ground[i] + sweeps[(look >>> 16) & 255];
      const trail = (d >>> 8) & 255;
      if (trails === null && trail > 0 && trail < 255) {
        c = mix(c, trailColour, Math.floor(trail * ((look >>> 8) & 255) * trailPart + 0.5));
      } else if (trails !== null && trail < 255) {
        const weight = this.#trueTrail(i - y * side, y, trails);
        if (weight > 0) c = mix(c, trailColour, weight);
      }
      const echo = echoes[d & 255 | ((d >>> 8) & 0x300)];
      const weight = Math.floor((echo >>> 24) * (look & 255) * (256 / 65025) + 0.5);
      if (weight > 0) c = mix(c, echo, weight);
      pixels[i] = OPAQUE | c;
    }
    this.#rim(y, from, Math.min(to, this.inner[2 * y]));
    this.#rim(y, Math.max(from, this.inner[2 * y + 1], this.inner[2 * y]), to);
  }

  #trueTrail(x, y, { own, ownCell, eastward, northward, nowTick, lifeTicks, cells }) {
    const half = this.side / 2, right = x + 0.5 - half - own.x, up = half - y - 0.5 - own.y;
    const east = right * eastward[0] + up * eastward[1], north = right * northward[0] + up * northward[1];
    const reach = TRAILS_SIDE / 2 - 1;
    if (east >= reach || east <= -reach || north >= reach || north <= -reach) return 0;
    const column = Math.floor(ownCell[0] + east) & (TRAILS_SIDE - 1);
    const row = Math.floor(ownCell[1] + north) & (TRAILS_SIDE - 1);
    const tick = cells[row * TRAILS_SIDE + column];
    if (tick === 0) return 0;
    const fresh = lifeTicks < 0 ? 0.8 : Math.min(1, Math.max(0, 1 - (nowTick - tick) / lifeTicks));
    return Math.floor(this.trueTrailPart * fresh + 0.5);
  }

  // The circle's edge is part picture, part page.
  #rim(y, from, to) {
    const { side, radius, pixels, back } = this, up = side / 2 - y - 0.5;
    for (let x = from; x < to; ++x) {
      const inside = radius + 0.5 - Math.hypot(x + 0.5 - side / 2, up), i = y * side + x;
      pixels[i] = OPAQUE | mix(back, pixels[i] & 0xffffff, toWeight(inside));
    }
  }
}
