// Measures places in a captured canvas: the console's picture by its pixels alone.
//
// shot: { width, data (RGBA), side, centre, radiusPx, pixelRatio, upDeg, rangeM } as browser.mjs makes it.

// A strong echo in either echo colour: green is bright and far above blue.
export function isEcho(shot, x, y) {
  const i = 4 * (Math.round(y - 0.5) * shot.width + Math.round(x - 0.5));
  const [r, g, b] = shot.data.subarray(i, i + 3);
  return g > 130 && g > b + 60 && r > 40;
}

// The pixel of a true bearing and a range in the shot itself: the page may have another size by now.
export const place = (shot, bearingDeg, rangeM) => {
  const angle = (bearingDeg - shot.upDeg) * Math.PI / 180;
  const r = (rangeM / shot.rangeM) * shot.radiusPx;
  return { x: ((shot.own ?? shot.centre).x + r * Math.sin(angle)) * shot.pixelRatio, y: ((shot.own ?? shot.centre).y - r * Math.cos(angle)) * shot.pixelRatio };
};

// Range of the first echo on a bearing from fromM on, or null.
export function leadingEdge(shot, bearingDeg, fromM = 0) {
  const stepM = shot.rangeM / shot.radiusPx / shot.pixelRatio / 4;
  for (let rangeM = fromM; rangeM < shot.rangeM * 0.995; rangeM += stepM) {
    const { x, y } = place(shot, bearingDeg, rangeM);
    if (isEcho(shot, x, y)) return rangeM;
  }
  return null;
}

// The middle of the echo pixels within halfDeg and halfM of a place; null if there are none.
export function blobAt(shot, bearingDeg, rangeM, halfDeg, halfM) {
  const angle = bearingDeg * Math.PI / 180;
  let east = 0, north = 0, pixels = 0;
  const middle = place(shot, bearingDeg, rangeM);
  const reach = ((halfM + (rangeM + halfM) * halfDeg * Math.PI / 180) / shot.rangeM) * shot.radiusPx * shot.pixelRatio + 2;
  const [left, top] = [middle.x, middle.y].map((at) => Math.max(0, Math.floor(at - reach)));
  const [right, bottom] = [middle.x, middle.y].map((at) => Math.min(shot.width, Math.ceil(at + reach)));
  for (let y = top; y < bottom; ++y) {
    for (let x = left; x < right; ++x) {
      const at = placeOf(shot, x + 0.5, y + 0.5);
      if (Math.abs(at.rangeM - rangeM) > halfM || Math.abs(((at.bearingDeg - bearingDeg + 540) % 360) - 180) > halfDeg) continue;
      if (!isEcho(shot, x + 0.5, y + 0.5)) continue;
      // Along and across, so that a blob over north has a middle.
      const off = (at.bearingDeg * Math.PI / 180) - angle;
      east += at.rangeM * Math.sin(off);
      north += at.rangeM * Math.cos(off);
      pixels += 1;
    }
  }
  if (pixels === 0) return null;
  return { pixels, rangeM: Math.hypot(east, north) / pixels,
           bearingDeg: (bearingDeg + Math.atan2(east, north) * 180 / Math.PI + 360) % 360 };
}

export function placeOf(shot, x, y) {
  const dx = x / shot.pixelRatio - (shot.own ?? shot.centre).x, dy = (shot.own ?? shot.centre).y - y / shot.pixelRatio;
  return { rangeM: (Math.hypot(dx, dy) / shot.radiusPx) * shot.rangeM,
           bearingDeg: (Math.atan2(dx, dy) * 180 / Math.PI + shot.upDeg + 720) % 360 };
}

export function echoPixels(shot) {
  let count = 0;
  for (let y = 0; y < shot.width; ++y) {
    for (let x = 0; x < shot.width; ++x) count += isEcho(shot, x + 0.5, y + 0.5) ? 1 : 0;
  }
  return count;
}

export const angleBetween = (a, b) => Math.abs(((a - b + 540) % 360) - 180);
