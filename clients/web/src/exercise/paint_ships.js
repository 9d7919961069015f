// Ships on the chart: outline or symbol, name, vector, track and route. Own ships are round, targets pointed.
import { keyOf } from './exercise.js';
import { after } from './place.js';
import { byRank, placeNames } from './ship_names.js';

const OUTLINE_PX = 16; // a shorter ship is a symbol
const RAD = Math.PI / 180;
const FONT = '12px system-ui, sans-serif';

function line(context, points) {
  context.beginPath();
  points.forEach(({ x, y }, i) => (i === 0 ? context.moveTo(x, y) : context.lineTo(x, y)));
  context.stroke();
}

function outline(context, ship, view) {
  const length = ship.lengthM / view.metresPerPixel,
    beam = Math.max(3, ship.beamM / view.metresPerPixel);
  context.beginPath();
  context.moveTo(0, -length / 2);
  context.lineTo(beam / 2, -length / 2 + Math.min(length / 3, beam));
  context.lineTo(beam / 2, length / 2);
  context.lineTo(-beam / 2, length / 2);
  context.lineTo(-beam / 2, -length / 2 + Math.min(length / 3, beam));
  context.closePath();
}

function symbol(context, ship) {
  context.beginPath();
  if (ship.own) {
    context.arc(0, 0, 7, 0, 2 * Math.PI);
    context.moveTo(3.5, 0);
    context.arc(0, 0, 3.5, 0, 2 * Math.PI);
    context.moveTo(0, -7);
    context.lineTo(0, -16);
  } else {
    context.moveTo(0, -9);
    context.lineTo(5.5, 7);
    context.lineTo(-5.5, 7);
    context.closePath();
  }
}

const colourOf = (ship, colours) => (ship.sart ? colours.sart : ship.own ? colours.own : colours.target);

function paintShip(context, view, ship, at, { colours, chosen }) {
  context.save();
  context.translate(at.x, at.y);
  if (chosen) {
    context.strokeStyle = colours.chosen;
    context.lineWidth = 2;
    const r = 14;
    for (const [sx, sy] of [
      [-1, -1],
      [1, -1],
      [1, 1],
      [-1, 1],
    ])
      line(context, [
        { x: sx * r, y: sy * (r - 6) },
        { x: sx * r, y: sy * r },
        { x: sx * (r - 6), y: sy * r },
      ]);
  }
  if (ship.givesWayNow) {
    context.strokeStyle = colours.warn;
    context.lineWidth = 2;
    context.setLineDash([4, 3]);
    context.beginPath();
    context.arc(0, 0, 19, 0, 2 * Math.PI);
    context.stroke();
    context.setLineDash([]);
  }
  context.rotate(ship.headingDeg * RAD);
  context.globalAlpha = ship.removed ? 0.45 : 1;
  const isOutline = ship.lengthM / view.metresPerPixel >= OUTLINE_PX;
  if (isOutline) outline(context, ship, view);
  else symbol(context, ship);
  context.strokeStyle = colourOf(ship, colours);
  context.lineWidth = 1.7;
  context.setLineDash(ship.removed ? [3, 3] : []);
  if (!ship.own || isOutline) {
    context.fillStyle = colours.water;
    context.fill();
  }
  context.stroke();
  if (isOutline && ship.own)
    line(context, [
      { x: 0, y: -ship.lengthM / view.metresPerPixel / 2 },
      { x: 0, y: -ship.lengthM / view.metresPerPixel / 2 - 12 },
    ]);
  context.restore();
}

function paintVector(context, view, ship, at, minutes, colours) {
  if (minutes <= 0 || ship.speedKn < 0.1 || ship.removed) return;
  const to = view.toPixel(after(ship, ship.courseOverGroundDeg, ship.speedKn, minutes));
  context.strokeStyle = colourOf(ship, colours);
  context.lineWidth = 1.4;
  context.setLineDash([7, 3]);
  line(context, [at, to]);
  context.setLineDash([]);
}

function paintTrack(context, view, exercise, ship, lengthS, colours) {
  context.strokeStyle = ship.own ? colours.ownTrack : colours.track;
  context.lineWidth = 1.3;
  const parts = exercise.tracks.partsOf(keyOf(ship), lengthS);
  parts.at(-1)?.push(ship);
  for (const part of parts)
    line(
      context,
      part.map((place) => view.toPixel(place)),
    );
}

export function paintRoute(context, view, from, waypoints, colour, { first = 1, dash = [] } = {}) {
  if (waypoints.length === 0) return;
  const points = [from, ...waypoints].filter(Boolean).map((p) => view.toPixel(p));
  context.strokeStyle = context.fillStyle = colour;
  context.lineWidth = 1.5;
  context.setLineDash(dash);
  line(context, points);
  context.setLineDash([]);
  context.font = '11px system-ui, sans-serif';
  context.textAlign = 'left';
  context.textBaseline = 'bottom';
  points.slice(from ? 1 : 0).forEach(({ x, y }, i) => {
    context.beginPath();
    context.arc(x, y, 4, 0, 2 * Math.PI);
    context.stroke();
    context.fillText(String(first + i), x + 6, y - 4);
  });
}

const NAME_PX = 14; // high

function nameOf(ship) {
  const marks = [
    ship.givesWayNow && 'gives way',
    ship.removed && 'removed',
    ship.sart && 'SART',
    ship.aisOff && 'no AIS',
  ].filter(Boolean);
  return [ship.name, ...marks].join(' · ');
}

// Names that would lie over those of a higher rank are left out.
function paintNames(context, placed, view, colours) {
  context.font = FONT;
  context.textAlign = 'left';
  context.textBaseline = 'middle';
  context.lineWidth = 3;
  context.strokeStyle = colours.halo;
  const byShip = new Map(placed.map((each) => [each.ship, each]));
  const names = byRank([...byShip.keys()], (ship) => byShip.get(ship).chosen).map((ship) => {
    const { at, chosen } = byShip.get(ship);
    const clear = Math.max(ship.givesWayNow ? 21 : chosen ? 17 : 13, ship.beamM / view.metresPerPixel / 2 + 6);
    const text = nameOf(ship);
    return { ship, chosen, text, at, clear, width: context.measureText(text).width, height: NAME_PX };
  });
  placeNames(names).forEach((box, i) => {
    if (!box) return;
    const { ship, chosen, text } = names[i];
    context.strokeText(text, box.x, box.y + NAME_PX / 2);
    context.fillStyle = chosen
      ? colours.chosen
      : ship.givesWayNow
        ? colours.warn
        : ship.own
          ? colours.own
          : colours.label;
    context.fillText(text, box.x, box.y + NAME_PX / 2);
  });
}

// options: { colours, vectorMin, trackS, moved: Map of key to the place where a ship is being dragged }.
export function paintShips(context, view, exercise, { colours, vectorMin, trackS, moved }) {
  const near = (at, room) => at.x > -room && at.y > -room && at.x < view.width + room && at.y < view.height + room;
  const placed = [];
  for (const ship of exercise.ships) {
    const chosen = exercise.isChosen(ship);
    if (trackS > 0) paintTrack(context, view, exercise, ship, trackS, colours);
    if (ship.route.length > 0 && (chosen || ship.route.length <= 60)) {
      context.globalAlpha = chosen ? 1 : 0.4;
      const waypoints = ship.route.map(({ lat, lon }) => ({ latitudeDeg: lat, longitudeDeg: lon }));
      if (chosen) paintRoute(context, view, ship, waypoints, colours.route, { dash: ship.onCourse ? [2, 5] : [] });
      else {
        context.strokeStyle = colours.route;
        context.lineWidth = 1;
        line(
          context,
          [ship, ...waypoints].map((p) => view.toPixel(p)),
        );
      }
      context.globalAlpha = 1;
    }
    const at = view.toPixel(ship);
    if (near(at, 200)) placed.push({ ship, at, chosen });
  }
  // Selected ships lie above, and own ships above targets.
  placed.sort((a, b) => a.chosen - b.chosen || a.ship.own - b.ship.own);
  for (const { ship, at } of placed) paintVector(context, view, ship, at, vectorMin, colours);
  for (const { ship, at, chosen } of placed) paintShip(context, view, ship, at, { colours, chosen });
  paintNames(context, placed, view, colours);
  for (const [key, place] of moved) {
    const ship = exercise.byKey.get(key);
    if (!ship) continue;
    const to = view.toPixel(place);
    context.strokeStyle = colours.plan;
    context.setLineDash([3, 4]);
    context.lineWidth = 1.2;
    line(context, [view.toPixel(ship), to]);
    context.setLineDash([]);
    paintShip(context, view, { ...ship, givesWayNow: false }, to, {
      colours: { ...colours, own: colours.plan, target: colours.plan },
      chosen: false,
    });
  }
}

// The nearest ship within reach of a place on the screen, or null.
export function shipAt(exercise, view, x, y, reachPx) {
  let best = null,
    bestPx = reachPx;
  for (const ship of exercise.ships) {
    const at = view.toPixel(ship);
    const off = Math.hypot(at.x - x, at.y - y);
    if (off <= bestPx) {
      best = ship;
      bestPx = off;
    }
  }
  return best;
}
