// The numbers of the page, and the drawings beside them.
import * as format from '../format.js';
import { $, write } from '../widgets.js';
import { Compass } from './compass.js';
import { ShipPlan } from './ship_plan.js';
import { side } from './sides.js';
import { TurnGauge } from './turn_gauge.js';
import { relativeWind } from './relative_wind.js';
import { WindDial } from './wind_dial.js';

const { NONE } = format;

const compass = (deg, kn) => (Number.isFinite(kn) ? `${format.bearing(deg, 0)}° ${format.fixed(kn, 1)} kn` : NONE);
const metres = (m) => (!Number.isFinite(m) ? NONE : m < 1852 ? `${Math.round(m)} m` : format.distance(m));

export class Readings {
  constructor() {
    this.compass = new Compass($('compass'));
    this.turn = new TurnGauge($('turn-gauge'));
    this.plan = new ShipPlan($('ship-plan'));
    this.wind = new WindDial($('wind-dial'));
  }

  reset() {
    this.turn.reset();
  }

  // ship: OwnShip, or null while nothing is known; world: World, or null before it is told.
  show(ship, world) {
    const con = ship?.con ?? null;
    const motion = ship && !ship.noMotion ? ship : null;
    const place = ship && !ship.noPosition ? ship : null;
    const headingDeg = ship && !ship.noHeading ? ship.headingDeg : NaN;
    const moves = motion?.speedOverGroundKn >= 0.05;
    this.compass.show({
      headingDeg, orderDeg: con ? (con.steering === 1 ? con.headingOrderDeg : NaN) : ship?.orderedCourseDeg ?? NaN,
      courseDeg: moves ? motion.courseOverGroundDeg : NaN,
    });
    this.turn.show(motion?.rateOfTurnDegMin ?? NaN, con?.turnRateDegMin ?? 0);
    write('turn', side(motion?.rateOfTurnDegMin, 1));
    write('stw', format.fixed(ship?.noLog ? NaN : con?.waterAheadKn ?? motion?.speedKn, 1).replace('-', '\u2212'));
    write('sog', format.fixed(motion?.speedOverGroundKn, 1));
    write('cog', moves ? format.bearing(motion.courseOverGroundDeg) : NONE);
    write('latitude', format.position(place?.latitudeDeg, 'N', 'S', 2));
    write('longitude', format.position(place?.longitudeDeg, 'E', 'W', 3));
    write('visibility', ship && world ? format.visibility(world.visibilityNm) : NONE);
    write('utc', ship ? format.utcClock(ship.utcNs / 1e6).slice(11, 19) || NONE : NONE);
    write('ordered-course', format.bearing(ship?.orderedCourseDeg));
    write('ordered-speed', format.fixed(ship?.orderedSpeedKn, 1));
    this.#showCon(this.#sensed(con, ship), headingDeg);
  }

  // The con as far as her sensors tell it: what they do not is not known, never 0.
  #sensed(con, ship) {
    if (!con) return null;
    const none = {};
    if (ship.noLog) Object.assign(none, { waterAheadKn: NaN, waterStarboardKn: NaN });
    if (ship.noMotion || ship.noPosition) Object.assign(none, { groundAheadKn: NaN, groundStarboardKn: NaN });
    if (ship.noWind) Object.assign(none, { windFromDeg: NaN, windKn: NaN });
    if (ship.noPosition) Object.assign(none, { waypointM: NaN, crossTrackM: NaN });
    return { ...con, ...none };
  }

  #showCon(con, headingDeg) {
    this.plan.show(con);
    write('depth', format.fixed(con?.depthBelowKeelM, con?.depthBelowKeelM < 100 ? 1 : 0).replace('-', '\u2212'));
    write('water-ahead', format.fixed(con?.waterAheadKn, 1).replace('-', '\u2212'));
    write('ground-ahead', format.fixed(con?.groundAheadKn, 1).replace('-', '\u2212'));
    write('water-athwart', side(con?.waterStarboardKn, 1));
    write('ground-athwart', side(con?.groundStarboardKn, 1));
    write('roll', side(con?.rollDeg, 1));
    write('draught', format.fixed(con?.draughtM, 1));
    const relative = con ? relativeWind(con, headingDeg) : null;
    this.wind.show(con, headingDeg, relative);
    write('wind-true', con ? compass(con.windFromDeg, con.windKn) : NONE);
    write('wind-relative', Number.isFinite(relative?.kn) ? `${side(relative.fromDeg, 0).replace(/ /, '° ')} ${format.fixed(relative.kn, 1)} kn` : NONE);
    write('current', con ? compass(con.currentSetDeg, con.currentKn) : NONE);
    const onWay = con?.waypoint > 0;
    write('waypoint', onWay ? `${con.waypoint} of ${con.waypoints}` : NONE);
    write('waypoint-distance', onWay ? metres(con.waypointM) : NONE);
    write('cross-track', onWay && Number.isFinite(con.crossTrackM) ? `${side(con.crossTrackM, 0).replace(' ', ' m ')}${Math.round(con.crossTrackM) === 0 ? ' m' : ''}` : NONE);
  }
}
