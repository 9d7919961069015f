// Readouts: the numbers beside the picture. Written a few times a second, and only where they changed.
import { later, t } from './language/language.js';
import { $, write } from './widgets.js';
import * as format from './format.js';

const LINK_TEXT = { connecting: later('Connecting'), greeting: later('Connecting'), live: later('Connected'), waiting: later('Disconnected') };

export function showLink(state, retryInS) {
  $('link').dataset.state = state;
  document.documentElement.dataset.link = state;
  write('link-text', state === 'waiting' && retryInS >= 1 ? t('Retry in {seconds} s', { seconds: Math.ceil(retryInS) }) : t(LINK_TEXT[state]));
}

export function showOwnShip(ship, headingDeg) {
  const place = ship?.noPosition ? undefined : ship;
  const bow = ship?.noHeading ? NaN : headingDeg ?? NaN;
  const motion = ship?.noMotion ? undefined : ship;
  write('latitude', format.position(place?.latitudeDeg, 'N', 'S', 2));
  write('longitude', format.position(place?.longitudeDeg, 'E', 'W', 3));
  write('latitude-short', format.position(place?.latitudeDeg, 'N', 'S', 2));
  write('longitude-short', format.position(place?.longitudeDeg, 'E', 'W', 3));
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
  const names = { noHeading: t('heading'), noPosition: t('position'), noLog: t('log'), noWind: t('wind'), noAis: 'AIS' };
  const missing = Object.entries(names).filter(([flag]) => ship?.[flag]).map(([, name]) => name);
  return missing.length > 0 ? t('No {sensors}', { sensors: missing.join(', ') }) : '';
}

export function showSensors(ship) {
  const text = missingSensors(ship);
  $('sensor-sign').hidden = text === '';
  write('sensor-sign', text);
}

export function showStream({ scan, rpm, spokeRate, lost, gaps, spoke }) {
  write('scan', scan === null ? format.NONE : String(scan));
  write('rpm', rpm === null ? format.NONE : rpm.toFixed(1));
  write('spoke-rate', format.count(spokeRate ?? NaN));
  write('lost', format.count(lost));
  $('lost').style.color = lost > 0 ? 'var(--warn)' : '';
  write('gaps', gaps.gaps === 0 ? '0' : t('{count}, {seconds} s in all', { count: format.count(gaps.gaps), seconds: gaps.seconds.toFixed(1) }));
  $('gaps').style.color = gaps.gaps > 0 ? 'var(--warn)' : '';
  write('format', spoke
    ? t('{format} bit, cells of {size} m', { format: `${spoke.spokesPerTurn} × ${spoke.cellCount} × ${spoke.bits}`, size: spoke.cellSizeM.toPrecision(3) })
    : format.NONE);
}
