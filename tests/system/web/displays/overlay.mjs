// Compares a chart plotter's radar overlay with the bare cells of the server's own snapshot.

// scan: { spokes, cells, scale, data } as parsePgm() makes it, of rangeM and headingDeg.
function strongest(scan, rangeM, headingDeg, bearingDeg, atM, halfDeg, halfM) {
  let peak = 0;
  const first = Math.round(((bearingDeg - halfDeg - headingDeg) / 360) * scan.spokes);
  const last = Math.round(((bearingDeg + halfDeg - headingDeg) / 360) * scan.spokes);
  const near = Math.max(0, Math.floor(((atM - halfM) / rangeM) * scan.cells));
  const far = Math.min(scan.cells - 1, Math.ceil(((atM + halfM) / rangeM) * scan.cells));
  for (let s = first; s <= last; ++s) {
    const row = (((s % scan.spokes) + scan.spokes) % scan.spokes) * scan.cells;
    for (let c = near; c <= far; ++c) peak = Math.max(peak, scan.data[row + c] * scan.scale);
  }
  return peak;
}

// Places on a grid of 1 deg by 2 % of the range: strong in the overlay, strong in the scan, and how
// many of each the other has nothing of within the tolerance of 1 deg and 3 pixels.
export function compareOverlay(shot, isStrong, scan, rangeM, headingDeg) {
  const out = { overlay: 0, scan: 0, extra: 0, missing: 0 };
  const tolerance = 3 * shot.metresPerPixel;
  const reach = Math.min(rangeM, (Math.min(shot.width, shot.height) / 2 - 60) * shot.metresPerPixel);
  const drawn = (x, y) => x >= 0 && y >= 0 && x < shot.width && y < shot.height && isStrong(shot, x, y);
  for (let y = 0; y < shot.height; ++y) {
    for (let x = 0; x < shot.width; ++x) {
      const east = (x + 0.5 - shot.centre.x) * shot.metresPerPixel, north = (shot.centre.y - y - 0.5) * shot.metresPerPixel;
      const atM = Math.hypot(east, north);
      if (atM > 0.97 * reach || atM < 0.12 * reach) continue;  // the ship's symbol; the edge
      const bearing = (Math.atan2(east, north) * 180 / Math.PI + 360) % 360;
      if (drawn(x, y)) {
        out.overlay += 1;
        if (strongest(scan, rangeM, headingDeg, bearing, atM, 1, tolerance) < 110) out.extra += 1;
      }
      if (strongest(scan, rangeM, headingDeg, bearing, atM, 0.05, 0) >= 160) {
        out.scan += 1;
        let near = false;
        for (let dy = -3; dy <= 3 && !near; ++dy) for (let dx = -3; dx <= 3 && !near; ++dx) near = drawn(x + dx, y + dy);
        if (!near) out.missing += 1;
      }
    }
  }
  return out;
}

// Why the two are not the same picture; empty if they are.
export function differences(result) {
  const reasons = [];
  if (result.overlay < 2000 || result.scan < 2000) reasons.push(`empty: ${result.overlay} overlay, ${result.scan} scan pixels`);
  if (result.extra > 0.03 * result.overlay) reasons.push(`${result.extra} of ${result.overlay} overlay pixels have no echo`);
  if (result.missing > 0.03 * result.scan) reasons.push(`${result.missing} of ${result.scan} echo pixels are not drawn`);
  return reasons;
}
