// Readouts: the numbers beside the picture. Written a few times a second, and only where they changed.
import { $, write } from './widgets.js';
import * as format from './format.js';
import { NAUTICAL_MILE_M, ringsFor, wrapDeg } from './view_geometry.js';

const LINK_TEXT = { connecting: 'Connecting', greeting: 'Connecting', live: 'Connected', waiting: 'Disconnected' };

export function showLink(state, retryInS) {
  $('link').dataset.state = state;
  document.documentElement.dataset.link = state;
  write('link-text', state === 'waiting' && retryInS >= 1 ? `Retry in ${Math.ceil(retryInS)} s` : LINK_TEXT[state]);
}

export function showOwnShip(ship, headingDeg) {
  const place = ship?.noPosition ? undefined : ship;
  const bow = ship?.noHeading ? NaN : headingDeg ?? NaN;
  const motion = ship?.noMotion ? undefined : ship;
  write('latitude', format.position(place?.latitudeDeg, 'N', 'S', 2));
  write('longitude', format.position(place?.longitudeDeg, 'E', 'W', 3));
  write('heading', format.bearing(bow));
  const speedKn = ship?.noLog ? NaN : motion?.speedKn;  // through the water
  write('speed', format.fixed(speedKn, 1));
  write('turn', format.rateOfTurn(motion?.rateOfTurnDegMin));
  write('heading-short', format.bearing(bow));
  write('speed-short', format.fixed(speedKn, 1));
  $('order-course').placeholder = format.bearing(ship?.orderedCourseDeg);
  $('order-speed').placeholder = format.fixed(ship?.orderedSpeedKn, 1);
}

// What the sensors do not tell: its dash alone might be overlooked.
export function missingSensors(ship) {
  const names = { noHeading: 'heading', noPosition: 'position', noLog: 'log', noWind: 'wind', noAis: 'AIS' };
  const missing = Object.entries(names).filter(([flag]) => ship?.[flag]).map(([, name]) => name);
  return missing.length > 0 ? `No ${missing.join(', ')}` : '';
}

export function showSensors(ship) {
  const text = missingSensors(ship);
  $('sensor-sign').hidden = text === '';
  write('sensor-sign', text);
}

// With an unknown heading the bow is up, whatever was chosen.
export function showOrientation(headUp, ship) {
  write('orientation', headUp || ship?.noHeading ? 'Head up' : 'North up');
}

export function showRange(rangeNm) {
  write('range-now', format.rangeNm(rangeNm));
  write('ring-spacing', rangeNm > 0 ? format.rangeNm(ringsFor(rangeNm).spacingNm) : format.NONE);
}

export function showMarkers(markers, headingDeg) {
  const relative = (deg) => (headingDeg === null ? NaN : wrapDeg(deg - headingDeg));
  const at = markers.at();
  write('cursor-range', at ? format.distance(at.rangeM) : format.NONE);
  write('cursor-metres', at && at.rangeM < NAUTICAL_MILE_M ? `${Math.round(at.rangeM)} m` : '');
  write('cursor-true', at ? `${format.bearing(at.bearingDeg)}°` : format.NONE);
  write('cursor-relative', at && headingDeg !== null ? `${format.bearing(relative(at.bearingDeg))}°` : format.NONE);
  $('ebl-box').hidden = !markers.ebl;
  if (markers.ebl) {
    write('ebl-true', `${format.bearing(markers.ebl.bearingDeg)}°`);
    write('ebl-relative', `${format.bearing(relative(markers.ebl.bearingDeg))}°`);
  }
  $('vrm-box').hidden = !markers.vrm;
  if (markers.vrm) {
    const near = markers.vrm.rangeM < NAUTICAL_MILE_M ? `  ${Math.round(markers.vrm.rangeM)} m` : '';
    write('vrm-range', format.distance(markers.vrm.rangeM) + near);
  }
}

export function showStream({ scan, rpm, spokeRate, lost, spoke }) {
  write('scan', scan === null ? format.NONE : String(scan));
  write('rpm', rpm === null ? format.NONE : rpm.toFixed(1));
  write('spoke-rate', format.count(spokeRate ?? NaN));
  write('lost', format.count(lost));
  $('lost').style.color = lost > 0 ? 'var(--warn)' : '';
  write('format', spoke
    ? `${spoke.spokesPerTurn} × ${spoke.cellCount} × ${spoke.bits} bit, cells of ${spoke.cellSizeM.toPrecision(3)} m`
    : format.NONE);
}
