// PpiRenderer: the polar memory drawn as a plan position indicator, with WebGL2.
//
// Two passes. The first turns polar memory into a disc of the screen's own pixels, taking the
// strongest cell each pixel touches; only the wedge the antenna has just passed is made anew, so a
// frame costs little at any number of spokes and cells. The second colours the disc: age, afterglow, sweep. Where the processor draws,
// only sectors that look otherwise than they were painted are coloured anew (row_look.js).
// Both are exact at each pixel's own bearing and range; nothing is interpolated.
// While own ship sails over the picture (true motion) the disc stays: each row lies where it was seen from.
import { discFor, ownOnDisc, trailTurn, videoEnd } from './picture/disc.js';
import { drawsInSoftware } from './picture/layers.js';
import { RowLook } from './picture/row_look.js';
import { SIDE as TRAILS_SIDE, TILE } from './picture/true_trails.js';
import { screenFragment, WEDGE_FRAGMENT, WEDGE_VERTEX } from './shaders.js';

const MAX_WEDGE_RAD = Math.PI / 6;
const CORNER = 0;   // of the vertex shader: where its attribute is
const EDGE_PX = 2;  // a wedge reaches so far beyond its rows: half a pixel's diagonal, and rounding

export class PpiRenderer {
  kind = 'webgl2';

  // Error: throws if the browser has no WebGL2.
  constructor(canvas) {
    this.canvas = canvas;
    // What is painted once stays, in software. Nothing shows through it: a browser need not paint what is beneath.
    this.keeps = drawsInSoftware();
    this.gl = canvas.getContext('webgl2', { alpha: false, antialias: false, depth: false, preserveDrawingBuffer: this.keeps });
    if (!this.gl) throw new Error('WebGL2 is not available');
    this.maxRows = Math.min(8192, this.gl.getParameter(this.gl.MAX_TEXTURE_SIZE));
    canvas.addEventListener('webglcontextlost', (event) => event.preventDefault());
    canvas.addEventListener('webglcontextrestored', () => this.#create());
    this.#create();
  }

  #create() {
    const gl = this.gl;
    this.wedge = program(gl, WEDGE_VERTEX, WEDGE_FRAGMENT);
    this.screens = new Map();  // variants of the last pass, made when needed
    this.#screen({ trueTrails: false, videoLimit: false });
    this.textures = {
      cells: texture(gl), doppler: texture(gl), meta: texture(gl), disc: texture(gl), colours: texture(gl), trails: texture(gl),
      rowLook: texture(gl),
    };
    this.framebuffer = gl.createFramebuffer();
    this.corners = gl.createBuffer();
    gl.bindBuffer(gl.ARRAY_BUFFER, this.corners);
    gl.enableVertexAttribArray(CORNER);
    gl.vertexAttribPointer(CORNER, 2, gl.FLOAT, false, 0, 0);
    gl.pixelStorei(gl.UNPACK_ALIGNMENT, 1);
    this.generation = -1;  // of the store whose shape the textures have
    this.discSide = 0;
    this.drawn = null;     // what the disc was made for
    this.colours = null;
    this.trails = null;    // the TrueTrails that the texture has
    this.rows = new RowLook();
    this.painted = '';     // what the whole picture was painted for
  }

  setEchoColours(bytes) {
    this.colours = null;
    this.nextColours = bytes;
  }

  // view: ViewGeometry; look: { palette, afterglow, sweepRow (below 0: none), nowS, turnS, videoM (how far spokes reach),
  // echo and trails (brilliance, 0..1), trueTrails (TrueTrails, or null: those of the store), trailS }.
  draw(store, view, look) {
    const gl = this.gl;
    if (gl.isContextLost()) return;
    const side = Math.round(view.side * view.pixelRatio);
    if (this.canvas.width !== side) this.canvas.width = this.canvas.height = side;
    this.#fitTextures(store, side);
    const runs = store.takeDirtyRuns();
    this.#upload(store, runs);
    const isNew = this.#updateDisc(store, view, side, runs);
    if (look.trueTrails) this.#uploadTrails(look.trueTrails);
    this.rows.update(store.meta, look);
    // True trails fade everywhere.
    const key = JSON.stringify([side, view.radius, view.ownAt, view.rangeM, look.palette, look.videoM, look.echo, look.trails]);
    const isWhole = isNew || !this.keeps || look.trueTrails !== null || key !== this.painted;
    this.painted = key;
    const sectors = this.rows.take(runs, isWhole);
    if (sectors.length > 0) this.#colourDisc(view, side, look, isWhole ? null : sectors);
  }

  #fitTextures(store, side) {
    const gl = this.gl;
    if (this.generation !== store.generation) {
      const rows = Math.max(1, store.rows), cols = Math.max(1, store.cols);
      gl.bindTexture(gl.TEXTURE_2D, this.textures.cells);
      gl.texImage2D(gl.TEXTURE_2D, 0, gl.RG8, cols, rows, 0, gl.RG, gl.UNSIGNED_BYTE, null);
      gl.bindTexture(gl.TEXTURE_2D, this.textures.doppler);
      const classes = store.doppler ? [store.dopplerCols, rows] : [1, 1];
      gl.texImage2D(gl.TEXTURE_2D, 0, gl.R8, ...classes, 0, gl.RED, gl.UNSIGNED_BYTE,
                    store.doppler ? null : new Uint8Array(1));
      gl.bindTexture(gl.TEXTURE_2D, this.textures.meta);
      gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA32F, rows, 1, 0, gl.RGBA, gl.FLOAT, null);
      gl.bindTexture(gl.TEXTURE_2D, this.textures.rowLook);
      gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA8, rows, 1, 0, gl.RGBA, gl.UNSIGNED_BYTE, null);
      this.rows.resize(rows);
      store.dirty.fill(1);
      this.generation = store.generation;
      this.drawn = null;
    }
    if (this.discSide !== side) {
      this.#target(this.framebuffer, this.textures.disc, side, side);
      this.discSide = side;
      this.drawn = null;
    }
    if (this.nextColours && this.colours !== this.nextColours) {
      gl.bindTexture(gl.TEXTURE_2D, this.textures.colours);
      gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA8, 256, 3, 0, gl.RGBA, gl.UNSIGNED_BYTE, this.nextColours);
      this.colours = this.nextColours;
      this.painted = '';
    }
  }

  // A texture that is drawn into.
  #target(framebuffer, drawnInto, width, height) {
    const gl = this.gl;
    gl.bindTexture(gl.TEXTURE_2D, drawnInto);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA8, width, height, 0, gl.RGBA, gl.UNSIGNED_BYTE, null);
    gl.bindFramebuffer(gl.FRAMEBUFFER, framebuffer);
    gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, drawnInto, 0);
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
  }

  #upload(store, runs) {
    const gl = this.gl;
    if (store.rows === 0) return;
    for (const [first, count] of runs) {
      gl.bindTexture(gl.TEXTURE_2D, this.textures.cells);
      gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, first, store.cols, count, gl.RG, gl.UNSIGNED_BYTE,
                       store.cells, first * store.cols * 2);
      if (store.doppler) {
        gl.bindTexture(gl.TEXTURE_2D, this.textures.doppler);
        gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, first, store.dopplerCols, count, gl.RED, gl.UNSIGNED_BYTE,
                         store.doppler, first * store.dopplerCols);
      }
      gl.bindTexture(gl.TEXTURE_2D, this.textures.meta);
      gl.texSubImage2D(gl.TEXTURE_2D, 0, first, 0, count, 1, gl.RGBA, gl.FLOAT, store.meta, first * 4);
    }
  }

  #uploadTrails(trails) {
    const gl = this.gl;
    gl.bindTexture(gl.TEXTURE_2D, this.textures.trails);
    if (this.trails !== trails) {
      gl.texImage2D(gl.TEXTURE_2D, 0, gl.R16UI, TRAILS_SIDE, TRAILS_SIDE, 0, gl.RED_INTEGER, gl.UNSIGNED_SHORT, null);
      trails.dirty.fill(1);
      this.trails = trails;
    }
    gl.pixelStorei(gl.UNPACK_ROW_LENGTH, TRAILS_SIDE);
    for (const [column, row] of trails.takeDirtyTiles()) {
      gl.texSubImage2D(gl.TEXTURE_2D, 0, column, row, TILE, TILE, gl.RED_INTEGER, gl.UNSIGNED_SHORT,
                       trails.cells, row * TRAILS_SIDE + column);
    }
    gl.pixelStorei(gl.UNPACK_ROW_LENGTH, 0);
  }

  // Whether the whole of it was made anew.
  #updateDisc(store, view, side, runs) {
    const gl = this.gl;
    const own = ownOnDisc(view), wanted = discFor(view, this.drawn);
    if (wanted.stays && runs.length === 0) return false;
    this.drawn = wanted;

    gl.bindFramebuffer(gl.FRAMEBUFFER, this.framebuffer);
    gl.viewport(0, 0, side, side);
    gl.disable(gl.BLEND);
    const { program, at } = this.wedge;
    gl.useProgram(program);
    gl.uniform1f(at('halfSide'), side / 2);
    gl.uniform2f(at('own'), own.x, own.y);
    gl.uniform1f(at('metresPerPixel'), wanted.metresPerPixel);
    gl.uniform1f(at('upTurn'), wanted.upDeg / 360);
    gl.uniform1i(at('hasDoppler'), store.doppler ? 1 : 0);
    this.#bind(at, { cells: this.textures.cells, meta: this.textures.meta, doppler: this.textures.doppler });
    this.#fill(view, side, wanted.stays ? runs : null, store.rows);
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    return !wanted.stays;
  }

  // Draws where the rows of these runs lie; null: everywhere.
  #fill(view, side, runs, rows) {
    const { gl } = this, h = side / 2, corners = [];
    if (runs === null) corners.push(-h, -h, h, -h, h, h, -h, -h, h, h, -h, h);
    else {
      const reach = view.radius * view.pixelRatio + EDGE_PX, own = ownOnDisc(view);
      for (const [first, count] of runs) addWedges(corners, (first - 0.5) / rows, (first + count - 0.5) / rows, this.drawn.upDeg / 360, reach, own);
    }
    gl.bufferData(gl.ARRAY_BUFFER, new Float32Array(corners), gl.STREAM_DRAW);
    gl.drawArrays(gl.TRIANGLES, 0, corners.length / 2);
  }

  #screen(variant) {
    const key = JSON.stringify(variant);
    if (!this.screens.has(key)) this.screens.set(key, program(this.gl, WEDGE_VERTEX, screenFragment(variant)));
    return this.screens.get(key);
  }

  // sectors: runs of rows; null: everywhere.
  #colourDisc(view, side, look, sectors) {
    const { gl, rows } = this;
    gl.bindTexture(gl.TEXTURE_2D, this.textures.rowLook);
    gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, 0, rows.rows, 1, gl.RGBA, gl.UNSIGNED_BYTE, rows.bytes);
    const own = ownOnDisc(view), video = videoEnd(view, look.videoM);
    const { trueTrails } = look;
    const { program, at } = this.#screen({ trueTrails: trueTrails !== null, videoLimit: video.isSeen });
    gl.viewport(0, 0, side, side);
    gl.useProgram(program);
    gl.uniform1f(at('halfSide'), side / 2);
    gl.uniform1f(at('radius'), view.radius * view.pixelRatio);
    gl.uniform2f(at('own'), own.x, own.y);
    gl.uniform1f(at('videoPx'), video.px);
    gl.uniform1f(at('trails'), look.trails);
    if (trueTrails) {
      const { cellM, own: cell, nowTick, lifeTicks } = trueTrails.look(look.nowS, look.trailS);
      const { eastward, northward } = trailTurn(view, cellM);
      gl.uniform2f(at('eastward'), ...eastward);
      gl.uniform2f(at('northward'), ...northward);
      gl.uniform2f(at('ownCell'), cell[0], cell[1]);
      gl.uniform1f(at('nowTick'), nowTick);
      gl.uniform1f(at('lifeTicks'), lifeTicks);
    }
    gl.uniform1f(at('brilliance'), look.palette.brilliance * look.echo);
    gl.uniform3fv(at('back'), look.palette.back);
    gl.uniform3fv(at('sea'), look.palette.sea);
    gl.uniform3fv(at('seaEdge'), look.palette.seaEdge);
    gl.uniform3fv(at('trailColour'), look.palette.trail);
    gl.uniform3fv(at('sweepColour'), look.palette.sweep);
    this.#bind(at, {
      disc: this.textures.disc, rowLook: this.textures.rowLook, echoColours: this.textures.colours,
      ...(trueTrails ? { trueTrails: this.textures.trails } : {}),
    });
    this.#fill(view, side, sectors, rows.rows);
  }

  #bind(at, samplers) {
    const gl = this.gl;
    Object.entries(samplers).forEach(([name, bound], unit) => {
      gl.activeTexture(gl.TEXTURE0 + unit);
      gl.bindTexture(gl.TEXTURE_2D, bound);
      gl.uniform1i(at(name), unit);
    });
    gl.activeTexture(gl.TEXTURE0);
  }

  // The canvas as RGBA, top row first. Only right after draw(), in the same task.
  readPixels() {
    const gl = this.gl;
    const side = this.canvas.width;
    const upsideDown = new Uint8Array(side * side * 4);
    gl.readPixels(0, 0, side, side, gl.RGBA, gl.UNSIGNED_BYTE, upsideDown);
    const out = new Uint8Array(upsideDown.length);
    for (let y = 0; y < side; ++y) {
      out.set(upsideDown.subarray((side - 1 - y) * side * 4, (side - y) * side * 4), y * side * 4);
    }
    return { width: side, height: side, data: out };
  }
}

// Triangles that cover the bearings from..to (in turns) and EDGE_PX beyond, out to `radius` from the middle of the disc, seen from `own`.
export function addWedges(corners, from, to, upTurn, radius, own = { x: 0, y: 0 }) {
  const total = (to - from) * 2 * Math.PI;
  const parts = Math.ceil(total / MAX_WEDGE_RAD);
  for (let i = 0; i < parts; ++i) {
    const a = (from - upTurn) * 2 * Math.PI + (total * i) / parts;
    const b = a + total / parts;
    // With an arc's chord.
    const reach = 1.04 * (radius + Math.hypot(own.x, own.y));
    const left = { x: Math.sin(a), y: Math.cos(a) }, right = { x: Math.sin(b), y: Math.cos(b) };
    // Both edges moved outwards and begun behind the centre.
    const at = (d, outX, outY, along) => [d.x * along + outX * EDGE_PX, d.y * along + outY * EDGE_PX];
    const quad = [
      at(left, -left.y, left.x, -EDGE_PX), at(left, -left.y, left.x, reach),
      at(right, right.y, -right.x, reach), at(right, right.y, -right.x, -EDGE_PX),
    ];
    for (const k of [0, 1, 2, 0, 2, 3]) corners.push(quad[k][0] + own.x, quad[k][1] + own.y);
  }
}

function texture(gl) {
  const made = gl.createTexture();
  gl.bindTexture(gl.TEXTURE_2D, made);
  for (const filter of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) {
    gl.texParameteri(gl.TEXTURE_2D, filter, gl.NEAREST);
  }
  for (const wrap of [gl.TEXTURE_WRAP_S, gl.TEXTURE_WRAP_T]) {
    gl.texParameteri(gl.TEXTURE_2D, wrap, gl.CLAMP_TO_EDGE);
  }
  return made;
}

function program(gl, vertex, fragment) {
  const made = gl.createProgram();
  for (const [type, source] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
    const shader = gl.createShader(type);
    gl.shaderSource(shader, source);
    gl.compileShader(shader);
    if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS) && !gl.isContextLost()) {
      throw new Error(`shader: ${gl.getShaderInfoLog(shader)}`);
    }
    gl.attachShader(made, shader);
    gl.deleteShader(shader);
  }
  gl.bindAttribLocation(made, CORNER, 'corner');
  gl.linkProgram(made);
  if (!gl.getProgramParameter(made, gl.LINK_STATUS) && !gl.isContextLost()) {
    throw new Error(`shaders: ${gl.getProgramInfoLog(made)}`);
  }
  const places = new Map();
  const at = (name) => {
    if (!places.has(name)) places.set(name, gl.getUniformLocation(made, name));
    return places.get(name);
  };
  return { program: made, at };
}
