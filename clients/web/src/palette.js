// Colours of the picture. The colours of the controls around it stand in style.css, by the same names.
// Colour stops of an echo: [strength 0..255, r, g, b, opacity 0..1].
const YELLOW = [
  [0, 70, 66, 10, 0], [20, 70, 66, 10, 0.04], [48, 104, 96, 10, 0.42], [96, 166, 148, 14, 0.9],
  [150, 222, 194, 28, 1], [210, 250, 224, 60, 1], [255, 255, 244, 150, 1],
];
const GREEN = [
  [0, 6, 70, 34, 0], [20, 6, 70, 34, 0.04], [48, 10, 100, 44, 0.42], [96, 26, 156, 62, 0.9],
  [150, 60, 206, 82, 1], [210, 120, 242, 116, 1], [255, 196, 255, 176, 1],
];
// One colour of nearly one hue: strength is told by brightness alone.
const AMBER = [
  [0, 90, 52, 4, 0], [20, 90, 52, 4, 0.04], [48, 122, 70, 6, 0.42], [96, 182, 102, 10, 0.9],
  [150, 232, 140, 20, 1], [210, 250, 168, 46, 1], [255, 255, 196, 96, 1],
];
// As far below an alarm's red in brightness as IEC 62288 asks of red video, and more.
const DARK_RED = [
  [0, 30, 0, 0, 0], [20, 30, 0, 0, 0.04], [48, 50, 0, 0, 0.5], [96, 82, 0, 0, 0.9],
  [150, 120, 0, 0, 1], [210, 136, 8, 0, 1], [255, 150, 16, 4, 1],
];
// Levels told apart by colour: weak blue, then green, yellow, and the strongest white; none is red.
const LEVELS = [
  [0, 20, 60, 120, 0], [20, 20, 60, 120, 0.04], [47, 30, 90, 170, 0.5], [48, 30, 110, 190, 0.9], [95, 40, 140, 210, 1],
  [96, 30, 150, 60, 1], [149, 60, 190, 80, 1], [150, 210, 190, 30, 1], [209, 240, 214, 50, 1], [210, 244, 244, 210, 1],
  [255, 255, 255, 240, 1],
];
// The one basic colour of each palette.
const BASIC = { day: YELLOW, dusk: AMBER, night: DARK_RED };
const ECHOES = { yellow: YELLOW, green: GREEN, amber: AMBER, levels: LEVELS };

const rgb = (hex) => [1, 3, 5].map((at) => parseInt(hex.slice(at, at + 2), 16) / 255);

// back: --back of common.css.
export const PALETTES = {
  day: {
    back: rgb('#0b1116'),
    sea: [0.020, 0.075, 0.135], seaEdge: [0.012, 0.050, 0.095], trail: [0.16, 0.50, 0.72],
    sweep: [0.30, 0.75, 0.85], brilliance: 1,
    ring: 'rgba(126, 196, 214, 0.42)', ringText: 'rgba(150, 212, 228, 0.75)',
    scale: '#8fc7d4', scaleText: '#d3eef4', heading: '#ff9d3c', north: '#d3eef4',
    ebl: '#4fe3ff', vrm: '#4fe3ff', cursor: '#ff9d3c', ship: '#f3f6f7', parallel: '#8fe07a', measure: '#e3b6ff',
    target: '#8fd3ff', targetText: '#cfeaff', danger: '#ff4538', zone: '#c9a2ff',
  },
  dusk: {
    back: rgb('#070b0f'),
    sea: [0.010, 0.038, 0.068], seaEdge: [0.006, 0.025, 0.048], trail: [0.11, 0.35, 0.52],
    sweep: [0.19, 0.52, 0.58], brilliance: 0.86,
    ring: 'rgba(90, 152, 166, 0.42)', ringText: 'rgba(116, 174, 188, 0.75)',
    scale: '#6199a5', scaleText: '#a0c7d0', heading: '#d47f2e', north: '#a0c7d0',
    ebl: '#37bad2', vrm: '#37bad2', cursor: '#d47f2e', ship: '#c6cfd2', parallel: '#6cb258', measure: '#b58fce',
    target: '#6ea9cf', targetText: '#a3c3d6', danger: '#e63c30', zone: '#9d7fcb',
  },
  night: {
    back: rgb('#030507'),
    sea: [0.004, 0.012, 0.018], seaEdge: [0.002, 0.006, 0.010], trail: [0.07, 0.22, 0.34],
    sweep: [0.10, 0.32, 0.34], brilliance: 0.72,
    ring: 'rgba(58, 112, 122, 0.45)', ringText: 'rgba(86, 138, 148, 0.75)',
    scale: '#39707a', scaleText: '#6fa2ac', heading: '#a8601c', north: '#6fa2ac',
    ebl: '#2193a8', vrm: '#2193a8', cursor: '#a8601c', ship: '#9aa5a8', parallel: '#457a36', measure: '#7f6291',
    target: '#3f7fa6', targetText: '#6f97ad', danger: '#c8322a', zone: '#75589f',
  },
};

// Echoes that come nearer, and that go away, in either palette.
const APPROACHING = [[0, 90, 10, 10, 0], [20, 90, 10, 10, 0.04], [48, 120, 16, 14, 0.5], [130, 214, 36, 30, 1], [255, 255, 96, 88, 1]];
const RECEDING = [[0, 10, 20, 90, 0], [20, 10, 20, 90, 0.04], [48, 16, 36, 120, 0.5], [130, 40, 92, 220, 1], [255, 112, 172, 255, 1]];

// 256 colours, straight alpha, for the echo strengths 0..255. name: 'basic' is the palette's own.
export function echoColours(name, paletteName = 'day') {
  return coloursOf(ECHOES[name] ?? BASIC[paletteName]);
}

// Three rows of them: echoes as they are, those that approach, those that recede.
export function echoColourTable(name, paletteName) {
  return Uint8Array.from([...echoColours(name, paletteName), ...coloursOf(APPROACHING), ...coloursOf(RECEDING)]);
}

function coloursOf(stops) {
  const out = new Uint8Array(256 * 4);
  for (let v = 0, s = 0; v < 256; ++v) {
    while (s + 2 < stops.length && v > stops[s + 1][0]) ++s;
    const [a, b] = [stops[s], stops[s + 1]];
    const t = (v - a[0]) / (b[0] - a[0]);
    for (let c = 0; c < 3; ++c) out[4 * v + c] = Math.round(a[c + 1] + t * (b[c + 1] - a[c + 1]));
    out[4 * v + 3] = Math.round(255 * (a[4] + t * (b[4] - a[4])));
  }
  return out;
}
