// The two passes of the picture (see ppi_renderer.js).
import { SWEEP_MOST } from './picture/row_look.js';

// Of both passes.
export const WEDGE_VERTEX = `#version 300 es
uniform float halfSide;      // pixels
in vec2 corner;              // pixels from the centre, y up
void main() { gl_Position = vec4(corner / halfSide, 0.0, 1.0); }
`;

// Polar memory -> disc: for every pixel the strongest cell that its square touches, so that a small
// target never falls between the pixels. Output: echo; row high and, above it, the Doppler class of the
// strongest cell; row low; trail.
export const WEDGE_FRAGMENT = `#version 300 es
precision highp float;
precision highp int;
uniform mediump sampler2D cells;  // x: cell, y: row; r: echo, g: trail
uniform highp sampler2D meta;     // x: row; r: time s, g: cell size m, b: cells
uniform mediump sampler2D doppler;  // x: four cells, y: row; two bits a cell, the nearest lowest
uniform bool hasDoppler;
uniform float halfSide;           // pixels
uniform vec2 own;                 // own ship, pixels from the centre, y up
uniform float metresPerPixel;
uniform float upTurn;             // true bearing of the screen's top, in turns
out vec4 disc;

const int MAX_ROWS = 32, MAX_CELLS = 20;
const float TAU = 6.283185307179586;

void main() {
  vec2 p = gl_FragCoord.xy - vec2(halfSide) - own;
  int rows = textureSize(meta, 0).x;
  float r = length(p);
  float turn = fract(atan(p.x, p.y) / TAU + upTurn);
  float row = turn * float(rows);
  float halfRows = min(0.5 * float(rows), 0.5 / max(r, 0.25) / TAU * float(rows));
  int first = int(floor(row - halfRows + 0.5));
  int count = int(floor(row + halfRows + 0.5)) - first + 1;
  int taps = min(count, MAX_ROWS);
  float nearM = max(0.0, r - 0.5) * metresPerPixel, farM = (r + 0.5) * metresPerPixel;

  vec2 most = vec2(0.0);
  ivec2 strongest = ivec2(0);
  for (int i = 0; i < taps; ++i) {
    int y = (first + (i * count) / taps + rows) % rows;
    vec4 m = texelFetch(meta, ivec2(y, 0), 0);
    if (m.g <= 0.0) continue;
    int a = int(nearM / m.g), b = min(int(farM / m.g), int(m.b) - 1);
    int across = b - a + 1;
    int steps = min(across, MAX_CELLS);
    for (int j = 0; j < steps; ++j) {
      ivec2 at = ivec2(a + (j * across) / steps, y);
      vec2 cell = texelFetch(cells, at, 0).rg;
      if (cell.r > most.r) strongest = at;
      most = max(most, cell);
    }
  }
  int own = int(floor(row + 0.5)) % rows;
  int motion = 0;
  if (hasDoppler && most.r > 0.0) {
    int four = int(texelFetch(doppler, ivec2(strongest.x >> 2, strongest.y), 0).r * 255.0 + 0.5);
    motion = (four >> (2 * (strongest.x & 3))) & 3;
  }
  disc = vec4(most.r, float((motion << 6) | (own >> 8)) / 255.0, float(own & 255) / 255.0, most.g);
}
`;

// Disc -> screen: colours, with the look of the row. Each variant does only what it needs: software renderers work
// through both sides of every branch. trueTrails: those, instead of the trails around own ship; videoLimit: the spokes end within
// the picture.
export const screenFragment = ({ trueTrails, videoLimit }) => `#version 300 es
${trueTrails ? '#define TRUE_TRAILS' : ''}
${videoLimit ? '#define VIDEO_LIMIT' : ''}
precision highp float;
precision highp int;
uniform mediump sampler2D disc;
uniform mediump sampler2D rowLook;
uniform mediump sampler2D echoColours;
uniform float halfSide, radius;   // pixels
uniform vec2 own;                 // own ship, pixels from the centre, y up
uniform float trails;             // brilliance, 0..1
uniform float brilliance;
uniform vec3 back, sea, seaEdge, trailColour, sweepColour;  // back: the page's, around the circle
out vec4 colour;

#ifdef VIDEO_LIMIT
uniform float videoPx;            // no spoke reaches farther from own ship
#endif
#ifdef TRUE_TRAILS
uniform highp usampler2D trueTrails;  // see true_trails.js
uniform vec2 eastward, northward; // screen to cells of the true trails
uniform vec2 ownCell;
uniform float nowTick, lifeTicks; // lifeTicks below 0: trails stay

// How fresh the true trail is here, 0..1.
float trueTrail(vec2 fromOwn) {
  vec2 offset = vec2(dot(fromOwn, eastward), dot(fromOwn, northward));
  int side = textureSize(trueTrails, 0).x;
  if (max(abs(offset.x), abs(offset.y)) >= float(side / 2 - 1)) return 0.0;
  ivec2 cell = (ivec2(floor(ownCell + offset)) + ivec2(2 * side)) % side;
  uint tick = texelFetch(trueTrails, cell, 0).r;
  if (tick == 0u) return 0.0;
  return lifeTicks < 0.0 ? 0.8 : clamp(1.0 - (nowTick - float(tick)) / lifeTicks, 0.0, 1.0);
}
#endif

void main() {
  vec2 p = gl_FragCoord.xy - vec2(halfSide);
  float r = length(p);
  float inside = clamp(radius + 0.5 - r, 0.0, 1.0);
  if (inside <= 0.0) { colour = vec4(back, 1.0); return; }
  vec3 c = mix(sea, seaEdge, smoothstep(0.0, 1.0, r / radius));
#ifdef VIDEO_LIMIT
  float fromOwn = length(p - own);
  // Beyond the video nothing is known: not sea, and a thin line where it ends.
  c = mix(c, seaEdge * 0.4, clamp(fromOwn - videoPx, 0.0, 1.0));
  c += sweepColour * 0.45 * clamp(1.0 - abs(fromOwn - videoPx), 0.0, 1.0);
#endif

  ivec4 d = ivec4(texelFetch(disc, ivec2(gl_FragCoord.xy), 0) * 255.0 + 0.5);
  int row = min(((d.g & 63) << 8) | d.b, textureSize(rowLook, 0).x - 1);
  vec4 look = texelFetch(rowLook, ivec2(row, 0), 0);
  c += sweepColour * (look.b * ${SWEEP_MOST});
#ifdef TRUE_TRAILS
  if (d.a < 255) c = mix(c, trailColour, 0.8 * trails * trueTrail(p - own));
#else
  if (d.a < 255) c = mix(c, trailColour, 0.8 * trails * look.g * float(d.a) / 255.0);
#endif
  vec4 echo = texelFetch(echoColours, ivec2(d.r, d.g >> 6), 0);
  c = mix(c, echo.rgb * brilliance, echo.a * look.r);
  colour = vec4(mix(back, c, inside), 1.0);
}
`;
