// Where own ship is now: her newest spoke says it, or else the OwnShip message; from then on she goes on by course and speed over
// ground.
import { NAUTICAL_MILE_M } from '../view_geometry.js';
import { placeAt } from './earth.js';

const KNOT_MPS = NAUTICAL_MILE_M / 3600;
const LONGEST_S = 10;  // what is older is not moved on further

export class OwnPosition {
  constructor() {
    this.forget();
  }

  forget() {
    this.told = null;  // { latitudeDeg, longitudeDeg, atS, of }
    this.ship = null;
  }

  // The newest of both, as RadarConsole has them; null: none. pace: seconds of the exercise in one of the clock's, 0 if it stands
  // still.
  place({ spoke, lastSpokeS, ownShip }, nowS, pace = 1) {
    if (ownShip?.noPosition) { this.forget(); return null; }
    if (ownShip && ownShip !== this.ship) {
      this.ship = ownShip;
      this.shipS = nowS;
    }
    if (!ownShip) this.ship = null;
    const isTold = spoke && (spoke.latitudeDeg !== 0 || spoke.longitudeDeg !== 0);
    const [from, atS] = isTold && (!this.ship || lastSpokeS > this.shipS - 1) ? [spoke, lastSpokeS] : [this.ship, this.shipS];
    if (!from) return null;
    const { latitudeDeg, longitudeDeg } = from;
    const seconds = Math.max(0, Math.min(LONGEST_S, nowS - atS)) * pace;
    const knots = this.ship && !this.ship.noMotion ? this.ship.speedOverGroundKn : 0;
    if (!(seconds > 0 && knots > 0)) return { latitudeDeg, longitudeDeg };
    return placeAt({ latitudeDeg, longitudeDeg }, this.ship.courseOverGroundDeg, knots * KNOT_MPS * seconds);
  }
}
