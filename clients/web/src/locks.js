// Locks: which controls only the instructor may change, and what that does to the panel.
import { $ } from './controls.js';

// The controls that the instructor locks with one box, by their names in radar.proto, and the elements of each.
const GROUPS = {
  'lock-range': { range_nm: ['range', 'range-less', 'range-more'], instrumented_range_m: [] },
  'lock-gain': { gain: ['gain'], gain_auto: ['gainAuto'] },
  'lock-sea': { sea: ['sea'], sea_auto: ['seaAuto'] },
  'lock-rain': { rain: ['rain'] },
  'lock-mode': { mode: ['mode'], doppler: ['doppler'], doppler_threshold_mps: ['dopplerThresholdMps'] },
  'lock-processing': {
    interference_rejection: ['interferenceRejection'], echo_stretch: ['echoStretch'], stretch_bearing: ['stretchBearing'],
    integration: ['integration'], decimation: ['decimation'], side_lobe_suppression: ['sideLobeSuppression'],
    side_lobe_auto: ['sideLobeAuto'], noise_rejection: ['noiseRejection'], target_separation: ['targetSeparation'],
    target_boost: ['targetBoost'],
  },
  'lock-transmitter': { transmit: ['transmit-on', 'transmit-off'], pulse: ['pulse'], tune: ['tune'], tune_auto: ['tuneAuto'] },
  'lock-antenna': {
    rotation_rpm: ['rotationRpm'], bearing_alignment_deg: ['bearingAlignmentDeg'], antenna_height_m: ['antennaHeightM'],
    blanked_sectors: ['blankedSectors'],
  },
  'lock-orders': { course_deg: ['order-course'], speed_kn: ['order-speed'] },
  'lock-world': { world: [] },
};

export class Locks {
  // set(values): sends them.  While the instructor's panel is open this console is the instructor's,
  // whom no lock holds.
  constructor(set) {
    this.locked = new Set();
    this.tuneAuto = false;
    this.driven = false;
    for (const [id, controls] of Object.entries(GROUPS)) {
      $(id).addEventListener('change', () => {
        set({ [$(id).checked ? 'lock' : 'unlock']: Object.keys(controls) });
        this.show();  // as the server has it, until it says otherwise
      });
    }
    $('instructor').addEventListener('toggle', () => this.show());
  }

  get isInstructor() {
    return $('instructor').open;
  }

  take(settings) {
    this.locked = new Set(settings.locked);
    this.tuneAuto = settings.tuneAuto;
    this.show();
  }

  takeOwnShip(ownShip) {
    if (ownShip.driven === this.driven) return;
    this.driven = ownShip.driven;
    this.show();
  }

  show() {
    for (const [id, controls] of Object.entries(GROUPS)) {
      const names = Object.keys(controls);
      $(id).checked = names.every((name) => this.locked.has(name));
      $(id).indeterminate = !$(id).checked && names.some((name) => this.locked.has(name));
      for (const name of names) for (const element of controls[name]) this.#show($(element), name);
    }
  }

  #show(element, name) {
    const locked = this.locked.has(name);
    element.classList.toggle('locked', locked);
    if (locked) element.title = 'Locked by the instructor';
    else if (element.title === 'Locked by the instructor') element.removeAttribute('title');
    // The range buttons and the tuning have a say of their own in when they serve.
    const idle = (name === 'tune' && this.tuneAuto) || (this.driven && (name === 'course_deg' || name === 'speed_kn'));
    if (name !== 'range_nm' || element.id === 'range') element.disabled = (locked && !this.isInstructor) || idle;
  }
}
