// Stage: what moves the picture as time goes: which way is up, where own ship stands in it, how she sails over it in true motion,
// and her true trails.
import { t } from '../language/language.js';
import { OwnMotion } from './own_motion.js';
import { clampPlace, lookAhead, resetPlace, sailed } from './own_place.js';
import { standingOf } from './standing.js';
import { TrueTrails } from './true_trails.js';

// Below it a course over ground is noise; the bow shows where she will go.
const LEAST_KN = 0.5;

export class Stage {
  // picture: PictureSettings; notify(text, kind): to the operator.
  constructor(picture, notify) {
    this.picture = picture;
    this.notify = notify;
    this.motion = new OwnMotion();
    this.trails = new TrueTrails();
    this.sailing = null;   // true motion: { at, eastM, northM } of the last frame
    this.jumps = 0;
    this.put = '';         // place by hand that the jumps have counted
    this.standing = standingOf(picture, { headingDeg: null, bowDeg: 0, ship: null });
  }

  takeSpoke(spoke, nowS, radar) {
    const { kind } = this.standing.stabilisation;
    this.motion.take(spoke, kind, radar.ownShip?.speedKn);
    if (this.picture.trailS !== 0 && kind !== 'none' && !this.standing.lost) this.trails.put(spoke, nowS, this.motion);
  }

  clear() {
    this.trails.clear();
    this.motion.last = null;
  }

  // Makes `view` that of this frame.
  frame(view, radar) {
    const { picture } = this;
    const old = this.standing;
    this.standing = standingOf(picture, { headingDeg: radar.headingDeg(), bowDeg: radar.bowDeg(), ship: radar.ownShip });
    const { standing } = this;
    // Trails over ground and through the water are not the same.
    if (old.stabilisation.kind !== standing.stabilisation.kind) this.trails.clear();
    this.radar = radar;
    view.rangeM = radar.rangeM();
    view.upDeg = standing.upDeg;
    if (view.rangeM > 0) this.trails.setRange(view.rangeM);
    if (standing.isTrue) {
      // With another way up, places on the screen mean nothing.
      if (this.sailing === null || standing.orientation !== old.orientation) this.reset();
      this.#sail(view);
    } else {
      if (this.sailing !== null) this.jumps += 1;
      this.sailing = null;
      const { x, y } = clampPlace({ x: picture.ownX, y: picture.ownY });
      if (this.put !== `${x} ${y}`) this.jumps += 1;
      this.put = `${x} ${y}`;
      view.ownAt = { x, y };
    }
    view.jumps = this.jumps;
  }

  #sail(view) {
    const { eastM, northM } = this.motion;
    const { at, reset } = sailed(this.sailing.at, eastM - this.sailing.eastM, northM - this.sailing.northM, view.upDeg, view.rangeM);
    Object.assign(this.sailing, { at, eastM, northM });
    if (reset) {
      this.reset();
      this.notify(t('True motion reset: own ship had come to 75 % of the radius'), 'info');
    }
    view.ownAt = { x: this.sailing.at.x, y: this.sailing.at.y };
  }

  // Degrees clockwise from the screen's top, where own ship goes.
  #courseUp() {
    const { standing, radar } = this;
    const ship = radar?.ownShip;
    const overGround = standing.stabilisation.kind === 'ground' && ship && !ship.noMotion && ship.speedOverGroundKn >= LEAST_KN;
    const course = overGround ? ship.courseOverGroundDeg : radar?.bowDeg() ?? 0;
    return course - standing.upDeg;
  }

  // Own ship's speed over what the picture is stabilised to; NaN if not known.
  speedKn() {
    const ship = this.radar?.ownShip, { kind } = this.standing.stabilisation;
    if (!ship || ship.noMotion) return NaN;
    if (kind === 'ground') return ship.speedOverGroundKn;
    return ship.noLog ? NaN : Math.abs(ship.speedKn);
  }

  // True motion begins anew where own ship sees most ahead.
  reset() {
    this.#begin(resetPlace(this.#courseUp()));
  }

  #begin(at) {
    this.sailing = { at, eastM: this.motion.eastM, northM: this.motion.northM };
    this.jumps += 1;
  }

  // Own ship at `at`, as of own_place.js; not beyond what is allowed, which is told.
  putOwn(at) {
    const { x, y, clamped } = clampPlace(at);
    if (clamped) this.notify(t('Own ship stands at most 75 % of the radius from the centre'), 'info');
    if (this.standing.isTrue) this.#begin({ x, y });
    else this.picture.change({ ownX: x, ownY: y });
  }

  // By so much from where she stands, in parts of the radius.
  moveOwn({ x, y }) {
    const { at } = this.sailing ?? { at: clampPlace({ x: this.picture.ownX, y: this.picture.ownY }) };
    this.putOwn({ x: at.x + x, y: at.y + y });
  }

  lookAhead() {
    if (this.standing.isTrue) this.reset();
    else this.putOwn(lookAhead(this.#courseUp()));
  }

  centre() {
    this.putOwn({ x: 0, y: 0 });
  }
}
