// OwnMotion: how far own ship has gone over ground or through the water, by what the spokes carry. True motion and true
// trails stand on it.
import { t } from '../language/language.js';
import { NAUTICAL_MILE_M } from '../view_geometry.js';
import { offsetM } from './places.js';

const UNITS_TO_RAD = (2 * Math.PI) / 4294967296;
// Between two spokes a ship moves less; more is a jump of the position, which is no motion.
const MOST_STEP_M = 60, MOST_MPS = 60;

// What the picture is stabilised to: { kind: 'ground' | 'water' | 'none', source, lost }, where `lost` says why it is not what was
// chosen, or ''. Over ground by own ship's position; through the water by log and heading.
export function stabilisation(chosen, ship, headingKnown) {
  const ground = ship && !ship.noPosition, water = ship && !ship.noLog && !ship.noMotion && headingKnown;
  if (chosen === 'ground' && ground) return { kind: 'ground', source: t('position'), lost: '' };
  if (chosen === 'water' && water) return { kind: 'water', source: t('log, heading'), lost: '' };
  const lost = !ship ? t('no own ship') : chosen === 'ground' ? t('position lost') : headingKnown ? t('log lost') : t('heading lost');
  if (ground) return { kind: 'ground', source: t('position'), lost };
  if (water) return { kind: 'water', source: t('log, heading'), lost };
  return { kind: 'none', source: '', lost };
}

export class OwnMotion {
  constructor() {
    this.eastM = 0;
    this.northM = 0;
    this.jumps = 0;   // of the position
    this.last = null;
  }

  // kind: of stabilisation(); speedKn: through the water.
  take(spoke, kind, speedKn) {
    const now = { kind, utcS: spoke.utcNs / 1e9, latitudeDeg: spoke.latitudeDeg, longitudeDeg: spoke.longitudeDeg };
    const last = this.last;
    this.last = now;
    if (last === null || last.kind !== kind) return;
    const seconds = now.utcS - last.utcS;
    // A playback that goes back, or a gap: nobody knows what was sailed.
    const known = seconds >= 0 && seconds < 30;
    if (kind === 'ground') {
      const { eastM, northM } = offsetM(last, now);
      const stepM = Math.hypot(eastM, northM);
      if (!known || !(stepM <= MOST_STEP_M + MOST_MPS * seconds)) this.jumps += 1;
      else this.#move(eastM, northM);
    } else if (kind === 'water' && known && Number.isFinite(speedKn)) {
      const gone = (speedKn * NAUTICAL_MILE_M * seconds) / 3600, heading = spoke.heading * UNITS_TO_RAD;
      this.#move(gone * Math.sin(heading), gone * Math.cos(heading));
    }
  }

  #move(eastM, northM) {
    this.eastM += eastM;
    this.northM += northM;
  }
}
