// Symbols of targets by IMO SN.1/Circ.243/Rev.2, at their sizes in mm. Each is drawn about (0, 0), so callers translate;
// `mm` is the number of pixels of one.
export const SIZES_MM = {
  acquiring: 5, tracked: 3, dangerous: 5, lostBeyond: 2.5, past: 1,
  sleeping: { base: 3, height: 4.5 }, activated: { base: 4, height: 6 }, dangerousAis: { base: 5, height: 7.5 },
};
const THIN = 1.25, THICK_MM = 0.6;
// Under every line, so that it stands out from bright echoes.
const HALO = 'rgba(0, 8, 14, 0.4)', HALO_PX = 2.5;
export const thick = (mm) => Math.max(2.25, THICK_MM * mm);

function stroked(c, { colour, width = THIN, dash = [] }, path) {
  c.setLineDash(dash);
  c.beginPath();
  path();
  c.strokeStyle = HALO;
  c.lineWidth = width + HALO_PX;
  c.stroke();
  c.strokeStyle = colour;
  c.lineWidth = width;
  c.stroke();
  c.setLineDash([]);
}

// dashes: of the circle's circumference, or none.
function circle(c, diameter, pen, dashes = 0) {
  const part = (Math.PI * diameter) / (2 * dashes);
  stroked(c, { ...pen, dash: dashes > 0 ? [part, part] : [] }, () => c.arc(0, 0, diameter / 2, 0, 2 * Math.PI));
}

// Lines from corner to corner, so far beyond the symbol.
function cross(c, halfWide, pen) {
  stroked(c, pen, () => {
    c.moveTo(-halfWide, -halfWide); c.lineTo(halfWide, halfWide);
    c.moveTo(-halfWide, halfWide); c.lineTo(halfWide, -halfWide);
  });
}

// An isosceles triangle, its middle at the place, the apex to `deg` clockwise from the top of the screen.
function triangle(c, { base, height }, mm, deg, pen, dash = []) {
  c.save();
  c.rotate((deg * Math.PI) / 180);
  stroked(c, { ...pen, dash }, () => {
    c.moveTo(0, (-height / 2) * mm);
    c.lineTo((base / 2) * mm, (height / 2) * mm);
    c.lineTo((-base / 2) * mm, (height / 2) * mm);
    c.closePath();
  });
  c.restore();
}

// The corners of a square about a symbol: it is selected.
export function selection(c, mm, colour, sideMm) {
  const half = (sideMm / 2) * mm, arm = half * 0.55;
  stroked(c, { colour, width: 1.5 }, () => {
    for (const [sx, sy] of [[1, 1], [1, -1], [-1, 1], [-1, -1]]) {
      c.moveTo(sx * half, sy * (half - arm));
      c.lineTo(sx * half, sy * half);
      c.lineTo(sx * (half - arm), sy * half);
    }
  });
}

// kind: 'acquiring', 'tracked', 'dangerous', 'frozen'; lost adds the crossed lines.
export function radarSymbol(c, mm, kind, isLost, { normal, danger }) {
  const { acquiring, tracked, dangerous, lostBeyond } = SIZES_MM;
  if (kind === 'acquiring') circle(c, acquiring * mm, { colour: normal }, 8);
  else if (kind === 'dangerous') circle(c, dangerous * mm, { colour: danger, width: thick(mm) });
  else if (kind === 'frozen') circle(c, tracked * mm, { colour: normal }, 5);
  else circle(c, tracked * mm, { colour: normal });
  if (isLost) {
    const radius = (kind === 'acquiring' || kind === 'dangerous' ? 5 : 3) / 2;
    cross(c, ((radius + lostBeyond) / Math.SQRT2) * mm, { colour: kind === 'dangerous' ? danger : normal, width: thick(mm) });
  }
}

// kind: 'sleeping', 'activated', 'dangerousAis'; deg: where the apex points on the screen; heads: a heading line is drawn.
export function aisSymbol(c, mm, kind, { deg, heads, isLost, isUnsure }, { normal, danger }) {
  const colour = kind === 'dangerousAis' ? danger : normal;
  const size = SIZES_MM[kind];
  // Dashed where no CPA can be had of it.
  triangle(c, size, mm, deg, { colour, width: kind === 'dangerousAis' ? thick(mm) : THIN }, isUnsure ? [mm * 0.7, mm * 0.5] : []);
  if (heads) {
    c.save();
    c.rotate((deg * Math.PI) / 180);
    stroked(c, { colour, width: 1 }, () => { c.moveTo(0, (-size.height / 2) * mm); c.lineTo(0, -2.5 * size.height * mm); });
    c.restore();
  }
  if (isLost) cross(c, ((size.height / 2 + SIZES_MM.lostBeyond) / Math.SQRT2) * mm, { colour, width: thick(mm) });
}

// Short dashes, gaps of two line widths. points: in pixels; heads: 1 or 2 arrowheads at the end, or none.
export function vector(c, points, { colour, width = 1.5 }, heads = 0) {
  stroked(c, { colour, width, dash: [4 * width, 2 * width] }, () => {
    points.forEach(({ x, y }, i) => (i === 0 ? c.moveTo(x, y) : c.lineTo(x, y)));
  });
  const [before, end] = points.slice(-2);
  const length = before && end ? Math.hypot(end.x - before.x, end.y - before.y) : 0;
  if (heads === 0 || length < 1) return;
  const ux = (end.x - before.x) / length, uy = (end.y - before.y) / length;
  stroked(c, { colour, width }, () => {
    for (let i = 0; i < heads; ++i) {
      const tip = { x: end.x - ux * 6 * i, y: end.y - uy * 6 * i };
      for (const side of [-1, 1]) {
        c.moveTo(tip.x - ux * 7 + side * uy * 4, tip.y - uy * 7 - side * ux * 4);
        c.lineTo(tip.x, tip.y);
      }
    }
  });
}

// A tick across a vector, at a whole minute.
export function tick(c, { x, y }, { x: toX, y: toY }, colour) {
  const length = Math.hypot(toX - x, toY - y);
  if (length < 1e-6) return;
  const ux = (toX - x) / length, uy = (toY - y) / length;
  stroked(c, { colour, width: 1 }, () => { c.moveTo(toX - uy * 3, toY + ux * 3); c.lineTo(toX + uy * 3, toY - ux * 3); });
}

export function dot(c, { x, y }, mm, colour) {
  c.fillStyle = colour;
  c.beginPath();
  c.arc(x, y, Math.max(1, (SIZES_MM.past / 2) * mm), 0, 2 * Math.PI);
  c.fill();
}

export function text(c, words, x, y, colour, sizePx, { align = 'left', weight = 600 } = {}) {
  c.fillStyle = colour;
  c.font = `${weight} ${sizePx}px system-ui, "Segoe UI", Roboto, "DejaVu Sans", sans-serif`;
  c.textAlign = align;
  c.textBaseline = 'middle';
  c.strokeStyle = HALO;
  c.lineWidth = HALO_PX;
  c.lineJoin = 'round';
  c.strokeText(words, x, y);
  c.lineJoin = 'miter';
  c.fillText(words, x, y);
}
