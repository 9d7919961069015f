// What is drawn over the echoes lies on canvases that nobody sees, one for each part; what is seen is one canvas, on which they
// are laid in order. For each canvas that a browser shows it goes over the whole picture once more with every frame: five of them
// cost more than the echoes where there is no graphics processor.

// Whether WebGL, and with it the browser, draws with the processor alone. There a canvas in plain memory costs a third.
let software;
export function drawsInSoftware() {
  if (software !== undefined) return software;
  const gl = document.createElement('canvas').getContext('webgl2');
  const told = gl?.getExtension('WEBGL_debug_renderer_info');
  software = !gl || /swiftshader|llvmpipe|software/i.test(told ? gl.getParameter(told.UNMASKED_RENDERER_WEBGL) : '');
  gl?.getExtension('WEBGL_lose_context')?.loseContext();
  return software;
}

// How often a browser has lost what was on such canvases: a part of the key of whoever draws only what has changed.
let losses = 0;
export const canvasLosses = () => losses;

export function layerContext(canvas) {
  canvas.addEventListener('contextrestored', () => { losses += 1; });
  return canvas.getContext('2d', { willReadFrequently: drawsInSoftware() });
}

const versions = new WeakMap();

// To be called of a layer whenever it was drawn.
export function painted(canvas) {
  versions.set(canvas, (versions.get(canvas) ?? 0) + 1);
}

export class Layers {
  // shown: the canvas that is seen; layers: the others, the lowest first. Their style.opacity counts.
  constructor(shown, layers) {
    Object.assign(this, { shown, layers, drawn: '' });
    this.context = layerContext(shown);
  }

  // side: of the picture, device pixels. A layer of another size has not been drawn since.
  draw(side) {
    const key = JSON.stringify([side, losses, this.layers.map((canvas) => [versions.get(canvas) ?? 0, canvas.style.opacity])]);
    if (key === this.drawn) return;
    this.drawn = key;
    const { shown, context } = this;
    if (shown.width !== side) shown.width = shown.height = side;
    else context.clearRect(0, 0, side, side);
    for (const canvas of this.layers) {
      if (canvas.width !== side) continue;
      context.globalAlpha = canvas.style.opacity === '' ? 1 : Number(canvas.style.opacity);
      context.drawImage(canvas, 0, 0);
    }
  }
}
