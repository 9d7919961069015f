// The bearing scale on the picture's edge, as seen from own ship: each mark stands where the ray of its bearing meets the edge.
const RAD = Math.PI / 180;

// look: { palette, scaleUpDeg }; font: its size in pixels; family: its names.
export function drawScale(c, view, look, font, family) {
  const { centre, radius, own } = view;
  c.strokeStyle = look.palette.scale;
  c.lineWidth = 1.25;
  c.beginPath();
  c.arc(centre, centre, radius + 0.5, 0, 2 * Math.PI);
  c.stroke();
  const fine = radius > 260;
  c.lineWidth = 1;
  c.beginPath();
  for (let deg = 0; deg < 360; deg += fine ? 1 : 5) {
    if (tooClose(view, deg, look.scaleUpDeg)) continue;
    const length = font * (deg % 10 === 0 ? 0.8 : deg % 5 === 0 ? 0.55 : 0.3);
    const { x, y, s, k } = markAt(view, deg, look.scaleUpDeg);
    c.moveTo(x + s, y + k);
    c.lineTo(x + (1 + length) * s, y + (1 + length) * k);
  }
  c.stroke();
  c.fillStyle = look.palette.scaleText;
  c.textAlign = 'center';
  c.textBaseline = 'middle';
  const isOff = own.x !== centre || own.y !== centre;
  for (let deg = 0; deg < 360; deg += fine ? 10 : 30) {
    // Near own ship the numbers stand far apart, on the far side they crowd.
    if (isOff && deg % 30 !== 0 && spacingPx(view, deg, look.scaleUpDeg, 10) < font * 2.6) continue;
    const { x, y, s, k } = markAt(view, deg, look.scaleUpDeg);
    c.font = `${deg % 30 === 0 ? 600 : 400} ${font * (deg % 30 === 0 ? 0.95 : 0.8)}px ${family}`;
    c.fillText(String(deg).padStart(3, '0'), x + font * 1.7 * s, y + font * 1.7 * k);
  }
}

// Where a bearing of the scale meets the edge: { x, y }, and the unit vector outwards from the centre { s, k }.
export function markAt(view, deg, scaleUpDeg) {
  const onScreen = deg - scaleUpDeg;
  const r = view.edgePx(onScreen + view.upDeg);
  const { own, centre, radius } = view;
  const x = own.x + r * Math.sin(onScreen * RAD), y = own.y - r * Math.cos(onScreen * RAD);
  return { x, y, s: (x - centre) / radius, k: (y - centre) / radius };
}

function spacingPx(view, deg, scaleUpDeg, stepDeg) {
  const a = markAt(view, deg, scaleUpDeg), b = markAt(view, deg + stepDeg, scaleUpDeg);
  return Math.hypot(a.x - b.x, a.y - b.y);
}

// Marks of single degrees that would run into each other are left out.
function tooClose(view, deg, scaleUpDeg) {
  return deg % 5 !== 0 && (view.ownAt.x !== 0 || view.ownAt.y !== 0) && spacingPx(view, deg, scaleUpDeg, 1) < 3;
}
