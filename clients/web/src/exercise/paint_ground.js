// What lies still on the chart: land, grid, scale, rain. Positions on the canvas in CSS pixels.
import { gridStep, scaleBar, wrapLongitude } from './chart_view.js';
import { NAUTICAL_MILE_M } from '../view_geometry.js';

const GRID_PX = 110,
  BAR_PX = 150;

export function paintCoast(context, view, coast, colours, pixelRatio) {
  context.fillStyle = colours.water;
  context.fillRect(0, 0, view.width, view.height);
  if (!coast.shown) return;
  const { scale, x, y } = coast.transform(view);
  context.save();
  context.setTransform(scale * pixelRatio, 0, 0, scale * pixelRatio, x * pixelRatio, y * pixelRatio);
  context.strokeStyle = colours.shore;
  context.lineWidth = 1.1 / scale;
  context.lineJoin = 'round';
  for (const { path, water } of coast.areas) {
    context.fillStyle = water ? colours.water : colours.land;
    context.fill(path);
    context.stroke(path);
  }
  context.stroke(coast.shore);
  context.restore();
}

// Whole degrees and minutes, with as many decimals as the grid's step needs.
function angleText(minutes, step, positive, negative) {
  const size = Math.abs(minutes),
    degrees = Math.floor((size + 1e-6) / 60),
    left = Math.abs(size - 60 * degrees);
  const digits = step >= 1 ? 0 : step >= 0.1 ? 1 : 2;
  return `${degrees}°${left.toFixed(digits).padStart(digits ? digits + 3 : 2, '0')}′${minutes < 0 ? negative : positive}`;
}

export function paintGrid(context, view, colours) {
  const topLeft = view.fromPixel(0, 0),
    bottomRight = view.fromPixel(view.width, view.height);
  const perMinute = (view.scale * Math.PI) / 180 / 60;
  const step = gridStep(perMinute, GRID_PX);
  context.strokeStyle = colours.grid;
  context.fillStyle = colours.gridText;
  context.lineWidth = 1;
  context.font = '11px system-ui, sans-serif';
  context.textBaseline = 'bottom';
  context.textAlign = 'left';
  context.beginPath();
  const labels = [];
  const west = topLeft.longitudeDeg * 60,
    east = west + view.width / perMinute;
  for (let n = Math.ceil(west / step); n * step <= east; ++n) {
    const x = Math.round((n * step - west) * perMinute) + 0.5;
    context.moveTo(x, 0);
    context.lineTo(x, view.height);
    labels.push([angleText(wrapLongitude((n * step) / 60) * 60, step, 'E', 'W'), x + 3, view.height - 3]);
  }
  for (let n = Math.ceil((bottomRight.latitudeDeg * 60) / step); n * step <= topLeft.latitudeDeg * 60; ++n) {
    const y = Math.round(view.toPixel({ latitudeDeg: (n * step) / 60, longitudeDeg: view.longitudeDeg }).y) + 0.5;
    context.moveTo(0, y);
    context.lineTo(view.width, y);
    if (y > 90 && y < view.height - 60) labels.push([angleText(n * step, step, 'N', 'S'), 4, y - 2]);
  }
  context.stroke();
  for (const [text, x, y] of labels) context.fillText(text, x, y);
}

export function paintScale(context, view, colours) {
  const bar = scaleBar(view.metresPerPixel, BAR_PX);
  const length = bar.metres / view.metresPerPixel,
    x = 14,
    y = view.height - 30;
  context.strokeStyle = context.fillStyle = colours.label;
  context.lineWidth = 2;
  context.beginPath();
  context.moveTo(x, y - 6);
  context.lineTo(x, y);
  context.lineTo(x + length, y);
  context.lineTo(x + length, y - 6);
  context.stroke();
  context.font = '12px system-ui, sans-serif';
  context.textAlign = 'center';
  context.textBaseline = 'bottom';
  context.fillText(bar.text, x + length / 2, y - 5);
}

export function paintRain(context, view, world, colours) {
  for (const cell of world?.rain ?? []) {
    const { x, y } = view.toPixel(cell);
    const radius = (cell.radiusNm * NAUTICAL_MILE_M) / view.metresPerPixel;
    context.beginPath();
    context.arc(x, y, radius, 0, 2 * Math.PI);
    context.globalAlpha = Math.min(0.35, 0.1 + cell.rateMmH / 120);
    context.fillStyle = colours.rain;
    context.fill();
    context.globalAlpha = 1;
    context.strokeStyle = colours.rain;
    context.lineWidth = 1.2;
    context.setLineDash([6, 4]);
    context.stroke();
    context.setLineDash([]);
    if (radius < 14) continue;
    context.fillStyle = colours.rain;
    context.font = '11px system-ui, sans-serif';
    context.textAlign = 'center';
    context.textBaseline = 'middle';
    context.fillText(`${cell.id}: ${Number(cell.rateMmH.toFixed(1))} mm/h`, x, y + radius * 0.7);
  }
}
