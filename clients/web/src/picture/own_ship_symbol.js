// Own ship in the picture: her outline where it is large enough to be read, else a cross.
const RAD = Math.PI / 180;
// Length or beam on the screen from which the outline is drawn.
const LEAST_MM = 7.5;

// Pixels { length, beam } of the outline, or null if it is too small; pxPerMm: of the screen. Error: the radar's place aboard is not known; the
// outline lies around it as if it were amidships.
export function outlineOf(view, ship, pxPerMm) {
  if (!ship || !(ship.lengthM > 0) || !(ship.beamM > 0) || !(view.rangeM > 0)) return null;
  const scale = view.radius / view.rangeM;
  const length = ship.lengthM * scale, beam = ship.beamM * scale;
  return Math.max(length, beam) > LEAST_MM * pxPerMm ? { length, beam } : null;
}

export function drawOwnShip(c, view, { palette, ship, bowDeg, pxPerMm }, font) {
  const { own } = view;
  const outline = bowDeg === null ? null : outlineOf(view, ship, pxPerMm);
  c.strokeStyle = palette.ship;
  c.lineWidth = 1.25;
  c.save();
  c.translate(own.x, own.y);
  c.beginPath();
  if (outline) {
    c.rotate((bowDeg - view.upDeg) * RAD);
    const l = outline.length / 2, b = outline.beam / 2;
    c.moveTo(0, -l);
    c.lineTo(b, -l * 0.6);
    c.lineTo(b, l);
    c.lineTo(-b, l);
    c.lineTo(-b, -l * 0.6);
    c.closePath();
  }
  const s = outline ? 2.5 : Math.max(3, font * 0.3);
  c.moveTo(-s, 0); c.lineTo(s, 0);
  c.moveTo(0, -s); c.lineTo(0, s);
  c.stroke();
  c.restore();
}
