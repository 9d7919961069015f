// What always stands beside the picture: how it stands, the cursor, the measuring tools, the receiver, the clock.
import * as format from '../format.js';
import { t } from '../language/language.js';
import { NAUTICAL_MILE_M, ringsFor, wrapDeg } from '../view_geometry.js';
import { $, write } from '../widgets.js';
import { stabilisationText, trailText } from './standing.js';
import { trueBearing } from './tools.js';

export function showStanding({ standing, picture, view, videoM }) {
  const rangeNm = view.rangeM / NAUTICAL_MILE_M;
  write('range-now', format.rangeNm(rangeNm > 0 ? Number(rangeNm.toFixed(4)) : NaN));
  write('ring-spacing', rangeNm > 0 ? format.rangeNm(ringsFor(Number(rangeNm.toFixed(4))).spacingNm) : format.NONE);
  write('orientation', standing.label);
  $('orientation').classList.toggle('lost', standing.lost);
  write('motion', standing.motionLabel);
  write('stabilisation', stabilisationText(standing.stabilisation));
  $('stabilisation').classList.toggle('lost', standing.stabilisation.lost !== '');
  write('trail-state', trailText(standing.trailMode, picture.trailS));
  const off = Math.hypot(view.ownAt.x, view.ownAt.y);
  $('own-place').hidden = off === 0;
  write('own-place', t('Off-centre {percent} %', { percent: Math.round(off * 100) }));
  const short = videoM > 0 && videoM < view.rangeM * (1 + off) * 0.995;
  $('video-limit').hidden = !short;
  write('video-limit', short ? t('Video to {range} NM', { range: format.rangeNm(videoM / NAUTICAL_MILE_M) }) : '');
}

// speedKn: of own ship, over what the picture is stabilised to; NaN if not known.
export function showCursor(markers, headingDeg, speedKn) {
  const at = markers.at();
  const { bowDeg } = markers.now;
  const place = at && markers.placeOf(at);
  write('cursor-range', at ? format.distance(at.rangeM) : format.NONE);
  write('cursor-metres', at && at.rangeM < NAUTICAL_MILE_M ? `${Math.round(at.rangeM)} m` : '');
  write('cursor-true', at && headingDeg !== null ? `${format.bearing(at.bearingDeg)}°` : format.NONE);
  write('cursor-relative', at ? `${format.bearing(wrapDeg(at.bearingDeg - bowDeg))}°` : format.NONE);
  write('cursor-latitude', format.position(place?.latitudeDeg, 'N', 'S', 2));
  write('cursor-longitude', format.position(place?.longitudeDeg, 'E', 'W', 3));
  write('cursor-ttg', at ? timeToGo(at.rangeM, speedKn) : format.NONE);
  const measured = markers.measurement();
  $('measure-box').hidden = !measured;
  if (measured) {
    write('measure-range', format.distance(measured.rangeM));
    const lost = headingDeg === null;
    write('measure-bearing', `${format.bearing(lost ? measured.bearingDeg - bowDeg : measured.bearingDeg)}°`);
    write('measure-frame', lost ? 'R' : 'T');
  }
}

// Minutes and seconds at that speed; a dash if she lies still.
export function timeToGo(rangeM, speedKn) {
  if (!(speedKn >= 0.1)) return format.NONE;
  return format.duration((rangeM / NAUTICAL_MILE_M / speedKn) * 3600);
}

// What the two bearing lines and range markers read stands in boxes with these ids.
export function buildTools() {
  const part = (tag, values, ...children) => {
    const made = Object.assign(document.createElement(tag), values);
    made.append(...children);
    return made;
  };
  const value = (id, className = '') => part('output', { id, className, textContent: format.NONE });
  for (const kind of ['ebl', 'vrm']) {
    for (const [suffix, name] of [['', `${kind.toUpperCase()} 1`], ['2', `${kind.toUpperCase()} 2`]]) {
      const id = kind + suffix, tag = part('span', { className: 'tag', textContent: name });
      const unit = (text, more = '') => part('span', { className: `unit ${more}`, textContent: text });
      const values = kind === 'vrm' ? [value(`${id}-range`)] : [value(`${id}-true`), unit('T'), ' ', value(`${id}-relative`, 'dim'), unit('R', 'dim')];
      $('tool-boxes').append(part('p', { id: `${id}-box`, hidden: true }, tag, ' ', ...values));
    }
  }
}

export function showTools(tools, markers, headingDeg) {
  const { bowDeg } = markers.now;
  for (const [n, suffix] of [[0, ''], [1, '2']]) {
    const ebl = tools.ebls[n], vrm = tools.vrms[n];
    $(`ebl${suffix}-box`).hidden = !ebl.on;
    $(`vrm${suffix}-box`).hidden = !vrm.on;
    for (const kind of ['ebl', 'vrm']) $(`${kind}${suffix}-box`).classList.toggle('active', n === tools.active);
    const bearing = trueBearing(ebl, bowDeg);
    write(`ebl${suffix}-true`, headingDeg === null ? format.NONE : `${format.bearing(bearing)}°`);
    write(`ebl${suffix}-relative`, `${format.bearing(wrapDeg(bearing - bowDeg))}°`);
    $(`ebl${suffix}-true`).classList.toggle('dim', ebl.frame !== 'true');
    $(`ebl${suffix}-relative`).classList.toggle('dim', ebl.frame === 'true');
    write(`vrm${suffix}-range`, format.distance(vrm.rangeM) + (vrm.rangeM < NAUTICAL_MILE_M ? `  ${Math.round(vrm.rangeM)} m` : '') +
      (ebl.origin !== null ? ` ${t('origin|off')}` : ''));
  }
  const on = tools.lines.flatMap((line, n) => (line.on ? [n + 1] : []));
  $('lines-box').hidden = on.length === 0;
  write('lines-on', on.join(' ') + (tools.areLinesOn ? '' : ` ${t('hidden')}`));
}

// A after a number: set by itself. What the radar does, and whether its receiver is set for all consoles or for this one.
export function showReceiver(settings, utcNs) {
  const level = (value, auto) => (Number.isFinite(value) ? `${Math.round(value)}${auto ? ' A' : ''}` : format.NONE);
  write('gain-short', level(settings?.gain, settings?.gainAuto));
  write('sea-short', level(settings?.sea, settings?.seaAuto));
  write('rain-short', level(settings?.rain, false));
  write('ir-short', level(settings?.interferenceRejection, false));
  write('scanner-short', settings ? (settings.standby ? 'STBY' : 'TX') : format.NONE);
  write('view-short', settings ? (settings.view === 0 ? t('shared view') : t('own view')) : format.NONE);
  write('tune-short', level(settings?.tune, settings?.tuneAuto));
  $('tune-bar').value = settings?.tune ?? 0;
  write('clock', utcNs > 0 ? format.utcClock(utcNs / 1e6).slice(11, 19) || format.NONE : format.NONE);
}
