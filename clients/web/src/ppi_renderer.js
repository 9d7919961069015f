// PpiRenderer: the polar memory drawn as a plan position indicator, with WebGL2.
//
// Two passes. The first turns polar memory into a disc of the screen's own pixels, taking the
// strongest cell each pixel touches; only the wedge the antenna has just passed is made anew, so a
// frame costs little at any number of spokes and cells. The second colours the disc every frame: age,
// afterglow, sweep. Both are exact at each pixel's own bearing and range; nothing is interpolated.
// While own ship sails over the picture (true motion) the disc stays: each row lies where it was seen from.
import { SIDE as TRAILS_SIDE, TILE } from './picture/true_trails.js';
import { ROW_LOOK_FRAGMENT, screenFragment, SCREEN_VERTEX, WEDGE_FRAGMENT, WEDGE_VERTEX } from './shaders.js';

const MAX_WEDGE_RAD = Math.PI / 6;
const EDGE_PX = 2;  // a wedge reaches so far beyond its rows: half a pixel's diagonal, and rounding

export class PpiRenderer {
  // Error: throws if the browser has no WebGL2.
  constructor(canvas) {
    this.canvas = canvas;
    this.gl = canvas.getContext('webgl2', { alpha: true, antialias: false, depth: false });
    if (!this.gl) throw new Error('WebGL2 is not available');
    this.maxRows = Math.min(8192, this.gl.getParameter(this.gl.MAX_TEXTURE_SIZE));
    canvas.addEventListener('webglcontextlost', (event) => event.preventDefault());
    canvas.addEventListener('webglcontextrestored', () => this.#create());
    this.#create();
  }

  #create() {
    const gl = this.gl;
    this.wedge = program(gl, WEDGE_VERTEX, WEDGE_FRAGMENT);
    this.rowLook = program(gl, SCREEN_VERTEX, ROW_LOOK_FRAGMENT);
    this.screens = new Map();  // variants of the last pass, made when needed
    this.#screen({ trueTrails: false, videoLimit: false });
    this.textures = {
      cells: texture(gl), doppler: texture(gl), meta: texture(gl), disc: texture(gl), colours: texture(gl), trails: texture(gl),
      rowLook: texture(gl),
    };
    this.framebuffer = gl.createFramebuffer();
    this.rowFramebuffer = gl.createFramebuffer();
    this.corners = gl.createBuffer();
    this.emptyArray = gl.createVertexArray();
    this.wedgeArray = gl.createVertexArray();
    gl.bindVertexArray(this.wedgeArray);
    gl.bindBuffer(gl.ARRAY_BUFFER, this.corners);
    const corner = gl.getAttribLocation(this.wedge.program, 'corner');
    gl.enableVertexAttribArray(corner);
    gl.vertexAttribPointer(corner, 2, gl.FLOAT, false, 0, 0);
    gl.pixelStorei(gl.UNPACK_ALIGNMENT, 1);
    this.generation = -1;  // of the store whose shape the textures have
    this.discSide = 0;
    this.drawn = null;     // what the disc was made for
    this.colours = null;
    this.trails = null;    // the TrueTrails that the texture has
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
    this.#updateDisc(store, view, side, runs);
    if (look.trueTrails) this.#uploadTrails(look.trueTrails);
    this.#lookAtRows(Math.max(1, store.rows), look);
    this.#colourDisc(view, side, look);
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
      this.#target(this.rowFramebuffer, this.textures.rowLook, rows, 1);
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

  #updateDisc(store, view, side, runs) {
    const gl = this.gl;
    const metresPerPixel = view.rangeM / (view.radius * view.pixelRatio);
    const own = ownOnDisc(view);
    const wanted = { upDeg: view.upDeg, metresPerPixel, jumps: view.jumps };
    const halfPixelDeg = 28 / (view.radius * view.pixelRatio);
    const turned = this.drawn && Math.abs(((wanted.upDeg - this.drawn.upDeg + 540) % 360) - 180);
    const keep = this.drawn && this.drawn.metresPerPixel === metresPerPixel && this.drawn.jumps === view.jumps &&
      turned <= halfPixelDeg;
    if (keep && runs.length === 0) return;
    if (keep) wanted.upDeg = this.drawn.upDeg;

    const corners = [];
    if (keep) {
      for (const [first, count] of runs) {
        addWedges(corners, (first - 0.5) / store.rows, (first + count - 0.5) / store.rows,
                  wanted.upDeg / 360, side, own);
      }
    } else {
      const h = side / 2;
      corners.push(-h, -h, h, -h, h, h, -h, -h, h, h, -h, h);
    }
    this.drawn = wanted;

    gl.bindFramebuffer(gl.FRAMEBUFFER, this.framebuffer);
    gl.viewport(0, 0, side, side);
    gl.disable(gl.BLEND);
    const { program, at } = this.wedge;
    gl.useProgram(program);
    gl.uniform1f(at('halfSide'), side / 2);
    gl.uniform2f(at('own'), own.x, own.y);
    gl.uniform1f(at('metresPerPixel'), metresPerPixel);
    gl.uniform1f(at('upTurn'), wanted.upDeg / 360);
    gl.uniform1i(at('hasDoppler'), store.doppler ? 1 : 0);
    this.#bind(at, { cells: this.textures.cells, meta: this.textures.meta, doppler: this.textures.doppler });
    gl.bindVertexArray(this.wedgeArray);
    gl.bindBuffer(gl.ARRAY_BUFFER, this.corners);
    gl.bufferData(gl.ARRAY_BUFFER, new Float32Array(corners), gl.STREAM_DRAW);
    gl.drawArrays(gl.TRIANGLES, 0, corners.length / 2);
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
  }

  #lookAtRows(rows, look) {
    const gl = this.gl;
    const { program, at } = this.rowLook;
    gl.bindFramebuffer(gl.FRAMEBUFFER, this.rowFramebuffer);
    gl.viewport(0, 0, rows, 1);
    gl.disable(gl.BLEND);
    gl.useProgram(program);
    gl.uniform1f(at('now'), look.nowS);
    gl.uniform1f(at('turnS'), look.turnS);
    gl.uniform1f(at('afterglow'), look.afterglow);
    gl.uniform1f(at('sweepRow'), look.sweepRow);
    this.#bind(at, { meta: this.textures.meta });
    gl.bindVertexArray(this.emptyArray);
    gl.drawArrays(gl.TRIANGLES, 0, 3);
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
  }

  #screen(variant) {
    const key = JSON.stringify(variant);
    if (!this.screens.has(key)) this.screens.set(key, program(this.gl, SCREEN_VERTEX, screenFragment(variant)));
    return this.screens.get(key);
  }

  #colourDisc(view, side, look) {
    const gl = this.gl;
    const own = ownOnDisc(view), pixelsPerM = (view.radius * view.pixelRatio) / view.rangeM;
    const videoPx = look.videoM > 0 && view.rangeM > 0 ? look.videoM * pixelsPerM : Infinity;
    const { trueTrails } = look;
    const { program, at } = this.#screen({
      trueTrails: trueTrails !== null, videoLimit: videoPx < view.radius * view.pixelRatio + Math.hypot(own.x, own.y) - 0.5,
    });
    gl.viewport(0, 0, side, side);
    gl.useProgram(program);
    gl.uniform1f(at('halfSide'), side / 2);
    gl.uniform1f(at('radius'), view.radius * view.pixelRatio);
    gl.uniform2f(at('own'), own.x, own.y);
    gl.uniform1f(at('videoPx'), videoPx);
    gl.uniform1f(at('trails'), look.trails);
    if (trueTrails) {
      const { cellM, own: cell, nowTick, lifeTicks } = trueTrails.look(look.nowS, look.trailS);
      const up = (view.upDeg * Math.PI) / 180, cells = 1 / (pixelsPerM * cellM);
      gl.uniform2f(at('eastward'), cells * Math.cos(up), cells * Math.sin(up));
      gl.uniform2f(at('northward'), -cells * Math.sin(up), cells * Math.cos(up));
      gl.uniform2f(at('ownCell'), cell[0], cell[1]);
      gl.uniform1f(at('nowTick'), nowTick);
      gl.uniform1f(at('lifeTicks'), lifeTicks);
    }
    gl.uniform1f(at('brilliance'), look.palette.brilliance * look.echo);
    gl.uniform3fv(at('sea'), look.palette.sea);
    gl.uniform3fv(at('seaEdge'), look.palette.seaEdge);
    gl.uniform3fv(at('trailColour'), look.palette.trail);
    gl.uniform3fv(at('sweepColour'), look.palette.sweep);
    this.#bind(at, {
      disc: this.textures.disc, rowLook: this.textures.rowLook, echoColours: this.textures.colours,
      ...(trueTrails ? { trueTrails: this.textures.trails } : {}),
    });
    gl.bindVertexArray(this.emptyArray);
    gl.drawArrays(gl.TRIANGLES, 0, 3);
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

// Own ship in the disc's pixels from the centre, y up.
function ownOnDisc(view) {
  const scale = view.radius * view.pixelRatio;
  return { x: view.ownAt.x * scale, y: view.ownAt.y * scale };
}

// Triangles that cover the bearings from..to (in turns) and EDGE_PX beyond, for a disc of `side` seen from `own`.
export function addWedges(corners, from, to, upTurn, side, own = { x: 0, y: 0 }) {
  const total = (to - from) * 2 * Math.PI;
  const parts = Math.ceil(total / MAX_WEDGE_RAD);
  for (let i = 0; i < parts; ++i) {
    const a = (from - upTurn) * 2 * Math.PI + (total * i) / parts;
    const b = a + total / parts;
    // Beyond the corners of the square, with an arc's chord.
    const reach = side * 0.75 + 1.04 * Math.hypot(own.x, own.y);
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
