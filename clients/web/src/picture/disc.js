// What both renderers take from a view: where own ship lies in the disc's own pixels, whether a disc that was made
// stays, and where the video ends in it.

// Own ship in the disc's pixels from the centre, y up.
export function ownOnDisc(view) {
  const scale = view.radius * view.pixelRatio;
  return { x: view.ownAt.x * scale, y: view.ownAt.y * scale };
}

// What the disc is to be made for; stays: whether that which was made for `drawn` (null: none) needs only what is new
// in it. It turns when it would be half a pixel beside at the edge.
export function discFor(view, drawn) {
  const radius = view.radius * view.pixelRatio;
  const metresPerPixel = view.rangeM / radius;
  const turned = drawn && Math.abs(((view.upDeg - drawn.upDeg + 540) % 360) - 180);
  const stays = drawn !== null && drawn.metresPerPixel === metresPerPixel && drawn.jumps === view.jumps &&
    turned <= 28 / radius;
  return { upDeg: stays ? drawn.upDeg : view.upDeg, metresPerPixel, jumps: view.jumps, stays };
}

// Pixels from own ship beyond which no spoke reaches; isSeen: within the circle.
export function videoEnd(view, videoM) {
  const radius = view.radius * view.pixelRatio, own = ownOnDisc(view);
  const px = videoM > 0 && view.rangeM > 0 ? (videoM * radius) / view.rangeM : Infinity;
  return { px, isSeen: px < radius + Math.hypot(own.x, own.y) - 0.5 };
}

// From the screen's pixels, y up from own ship, to cells of the true trails (true_trails.js): the two rows of the turn.
export function trailTurn(view, cellM) {
  const up = (view.upDeg * Math.PI) / 180, cells = view.rangeM / (view.radius * view.pixelRatio * cellM);
  const along = cells * Math.cos(up), across = cells * Math.sin(up);
  return { eastward: [along, across], northward: [-across, along] };
}
