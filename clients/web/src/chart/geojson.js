// Maps as GeoJSON (RFC 7946). A file comes from anywhere: it is taken whole or refused with what is wrong, and where.
import { t } from '../language/language.js';
import { cleanText, KINDS, MOST_ITEMS, MOST_PLACES } from './map_items.js';

export const MOST_BYTES = 1 << 20;
const DIGITS = 1e7;  // of a degree: a centimetre

export class MapFileError extends Error {}

export function toGeoJson(name, items) {
  const pair = ({ latitudeDeg, longitudeDeg }) => [Math.round(longitudeDeg * DIGITS) / DIGITS, Math.round(latitudeDeg * DIGITS) / DIGITS];
  return JSON.stringify({
    type: 'FeatureCollection',
    name,
    features: items.map(({ type, kind, text, places, utc }) => ({
      type: 'Feature',
      properties: { kind, text, ...(utc ? { utc } : {}) },
      geometry: type === 'point' ? { type: 'Point', coordinates: pair(places[0]) } : { type: 'LineString', coordinates: places.map(pair) },
    })),
  }, null, 1);
}

// Items without ids. Error: MapFileError.
export function fromGeoJson(text) {
  if (typeof text !== 'string') refuse(t('it is no text'));
  if (text.length > MOST_BYTES) refuse(t('it is larger than {size} MB', { size: MOST_BYTES / (1 << 20) }));
  let file;
  try {
    file = JSON.parse(text);
  } catch {
    refuse(t('it is not JSON'));
  }
  if (!isObject(file) || file.type !== 'FeatureCollection') refuse(t('expected an object of type FeatureCollection'));
  if (!Array.isArray(file.features)) refuse(t('its "features" are no list'));
  if (file.features.length > MOST_ITEMS) refuse(t('it has {n} features, at most {most} are taken', { n: file.features.length, most: MOST_ITEMS }));
  let places = 0;
  const items = file.features.map((feature, i) => {
    const item = itemOf(feature, t('feature {number}', { number: i + 1 }));
    places += item.places.length;
    if (places > MOST_PLACES) refuse(t('it has more than {most} points in all', { most: MOST_PLACES }));
    return item;
  });
  return items;
}

const isObject = (value) => value !== null && typeof value === 'object' && !Array.isArray(value);

function refuse(what) {
  throw new MapFileError(what);
}

function itemOf(feature, where) {
  if (!isObject(feature) || feature.type !== 'Feature') refuse(`${where}: ${t('expected an object of type Feature')}`);
  const { geometry } = feature;
  if (!isObject(geometry)) refuse(`${where}: ${t('it has no geometry')}`);
  const properties = feature.properties ?? {};
  if (!isObject(properties)) refuse(`${where}: ${t('its properties are no object')}`);
  const kind = properties.kind ?? 'note';
  if (!KINDS.includes(kind)) refuse(`${where}: ${t('kind {kind}; expected {kinds}', { kind: quoted(kind), kinds: KINDS.join(', ') })}`);
  const { text = properties.name ?? '', utc = '' } = properties;
  if (typeof text !== 'string') refuse(`${where}: ${t('its text is no text')}`);
  if (utc !== '' && (typeof utc !== 'string' || !/^\d{4}-\d\d-\d\dT\d\d:\d\d:\d\d(\.\d{1,3})?Z$/.test(utc))) {
    refuse(`${where}: ${t('utc {utc}; expected a time such as 2026-11-27T10:15:00Z', { utc: quoted(utc) })}`);
  }
  const shared = { kind, text: cleanText(text), utc };
  if (geometry.type === 'Point') return { type: 'point', ...shared, places: [placeOf(geometry.coordinates, where)] };
  if (geometry.type !== 'LineString') refuse(`${where}: ${t('geometry {type}; expected Point or LineString', { type: quoted(geometry.type) })}`);
  if (!Array.isArray(geometry.coordinates) || geometry.coordinates.length < 2) refuse(`${where}: ${t('a line has two points or more')}`);
  if (geometry.coordinates.length > MOST_PLACES) refuse(`${where}: ${t('more than {most} points', { most: MOST_PLACES })}`);
  return { type: 'line', ...shared, places: geometry.coordinates.map((pair, i) => placeOf(pair, `${where}, ${t('point {number}', { number: i + 1 })}`)) };
}

// A value of a file, in a sentence: cut, whatever it is.
function quoted(value) {
  return cleanText(JSON.stringify(value) ?? t('nothing')).slice(0, 40);
}

function placeOf(pair, where) {
  if (!Array.isArray(pair) || pair.length < 2 || pair.length > 3) refuse(`${where}: ${t('a position is [longitude, latitude]')}`);
  const [longitudeDeg, latitudeDeg] = pair;
  // JSON has no NaN, but 1e999 is read as infinite.
  if (!pair.every((value) => typeof value === 'number' && Number.isFinite(value))) refuse(`${where}: ${t('a position has numbers only')}`);
  if (Math.abs(latitudeDeg) > 90) refuse(`${where}: ${t('latitude {deg}; expected -90 to 90', { deg: latitudeDeg })}`);
  if (Math.abs(longitudeDeg) > 180) refuse(`${where}: ${t('longitude {deg}; expected -180 to 180', { deg: longitudeDeg })}`);
  return { latitudeDeg, longitudeDeg };
}
