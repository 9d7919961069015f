// How large the picture may be, so that the data in its corners cover nothing of its circle.

const SMALLEST = 0.55;  // of what there is room for; below it the data may cover what is left

// width, height: of the area; corners: [{ width, height }] of the boxes in its corners; marginOf(side): of the bearing scale.
// Gives the side of the square in the area's middle.
export function fitSide(width, height, corners, marginOf) {
  const most = Math.max(200, Math.floor(Math.min(width, height)));
  let side = most;
  // From the centre to a box's nearest point; the ticks of the scale count as the circle.
  const clear = (side) => corners.every((box) => {
    const reach = side / 2 - 0.6 * marginOf(side);
    return Math.hypot(Math.max(0, width / 2 - box.width), Math.max(0, height / 2 - box.height)) >= reach;
  });
  while (side > most * SMALLEST && !clear(side)) side -= 2;
  return Math.floor(side);
}
