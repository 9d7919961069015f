// Zones as they lie in the picture: guard zones and areas of exclusion about own ship.
import { t } from '../language/language.js';
import { NAUTICAL_MILE_M, wrapDeg } from '../view_geometry.js';
import { text } from './symbols.js';
import { ACQUIRES } from './wire.js';

const STEP_DEG = 2;
export const zoneWord = (kind) => (kind === ACQUIRES ? t('Guard') : t('Exclude'));

// Degrees clockwise from the one end to the other; equal ends are all round.
export const widthDeg = ({ fromDeg, toDeg }) => wrapDeg(toDeg - fromDeg) || 360;

// Zone of a drag from one corner to the other. turnedDeg: how far the pointer went about own ship, clockwise positive.
export function zoneOfDrag(from, to, turnedDeg) {
  const nm = [from.rangeM, to.rangeM].map((m) => m / NAUTICAL_MILE_M).sort((a, b) => a - b);
  const ends = Math.abs(turnedDeg) >= 360 ? [0, 0]
    : turnedDeg >= 0 ? [from.bearingDeg, wrapDeg(from.bearingDeg + turnedDeg)] : [wrapDeg(from.bearingDeg + turnedDeg), from.bearingDeg];
  const round = (value, digits) => Number(value.toFixed(digits));
  return { innerNm: round(nm[0], 2), outerNm: round(nm[1], 2), fromDeg: round(ends[0], 1) % 360, toDeg: round(ends[1], 1) % 360 };
}

function arc(view, rangeM, fromDeg, spanDeg) {
  const steps = Math.max(1, Math.ceil(Math.abs(spanDeg) / STEP_DEG));
  return Array.from({ length: steps + 1 }, (_, i) => view.toPixel(fromDeg + (spanDeg * i) / steps, rangeM));
}

// headingDeg: null where it is not known; zones from the bow are not drawn then.
export function drawZone(c, view, zone, headingDeg, { colour, mm }) {
  if (zone.relative && headingDeg === null) return;
  const from = zone.fromDeg + (zone.relative ? headingDeg : 0);
  const span = widthDeg(zone);
  const outer = arc(view, zone.outerNm * NAUTICAL_MILE_M, from, span);
  const inner = arc(view, zone.innerNm * NAUTICAL_MILE_M, from + span, -span);
  c.strokeStyle = colour;
  c.lineWidth = 1.5;
  c.setLineDash(zone.kind === ACQUIRES ? [10, 4] : [2, 4]);
  c.beginPath();
  const line = (points, joined) => points.forEach(({ x, y }, i) => (i === 0 && !joined ? c.moveTo(x, y) : c.lineTo(x, y)));
  line(outer, false);
  line(inner, span < 360);
  if (span < 360) c.closePath();
  c.stroke();
  c.setLineDash([]);
  const at = view.toPixel(from + Math.min(span / 2, 20), zone.outerNm * NAUTICAL_MILE_M);
  const towards = view.own;
  const away = Math.hypot(at.x - towards.x, at.y - towards.y) || 1;
  const inset = Math.min(away / 2, 2.4 * mm);
  text(c, `${zoneWord(zone.kind)} ${zone.number || ''}`.trim(), at.x + ((towards.x - at.x) / away) * inset, at.y + ((towards.y - at.y) / away) * inset,
    colour, Math.max(11, 3 * mm), { align: 'center' });
}
