// The measuring tools drawn: EBLs with the tick of their VRM, VRMs, parallel index lines, and what is measured from point to point.
const DASHES = [[0.6, 0.35], [1.1, 0.3, 0.2, 0.3]];  // by number, in sizes of the font

// c: context clipped to the picture; look: { palette, shapes, active, measured: { from, to } in pixels or null, font }.
export function drawTools(c, look) {
  const { palette, shapes, font, active } = look;
  const dash = (n) => DASHES[n].map((part) => part * font);
  for (const s of shapes.lines) {
    line(c, palette.parallel, 1.25, [], s.from, s.to);
    label(c, palette.parallel, `PI ${s.n + 1}`, middle(s), font);
  }
  for (const s of shapes.vrms) {
    c.strokeStyle = palette.vrm;
    c.lineWidth = s.n === active ? 1.6 : 1.1;
    c.setLineDash(dash(s.n));
    c.beginPath();
    c.arc(s.centre.x, s.centre.y, s.radius, 0, 2 * Math.PI);
    c.stroke();
    if (s.isOff) cross(c, palette.ebl, s.centre, font * 0.4);
  }
  for (const s of shapes.ebls) {
    line(c, palette.ebl, s.n === active ? 1.6 : 1.1, dash(s.n), s.from, s.to);
    if (s.isOff) cross(c, palette.ebl, s.centre, font * 0.4);
    if (s.tick) {
      const half = font * 0.5;
      line(c, palette.ebl, 1.5, [], { x: s.tick.x - s.way.y * half, y: s.tick.y + s.way.x * half },
           { x: s.tick.x + s.way.y * half, y: s.tick.y - s.way.x * half });
    }
  }
  if (look.measured) {
    const { from, to } = look.measured;
    line(c, palette.measure, 1.4, [font * 0.25, font * 0.25], from, to);
    cross(c, palette.measure, from, font * 0.35);
    cross(c, palette.measure, to, font * 0.35);
  }
}

function line(c, colour, width, dash, from, to) {
  c.strokeStyle = colour;
  c.lineWidth = width;
  c.setLineDash(dash);
  c.beginPath();
  c.moveTo(from.x, from.y);
  c.lineTo(to.x, to.y);
  c.stroke();
  c.setLineDash([]);
}

function cross(c, colour, { x, y }, size) {
  line(c, colour, 1.4, [], { x: x - size, y: y - size }, { x: x + size, y: y + size });
  line(c, colour, 1.4, [], { x: x - size, y: y + size }, { x: x + size, y: y - size });
}

const middle = ({ from, to }) => ({ x: from.x + (to.x - from.x) * 0.62, y: from.y + (to.y - from.y) * 0.62 });

function label(c, colour, text, { x, y }, font) {
  c.fillStyle = colour;
  c.font = `${font * 0.8}px system-ui, sans-serif`;
  c.textAlign = 'left';
  c.textBaseline = 'bottom';
  c.fillText(text, x + 3, y - 2);
}
