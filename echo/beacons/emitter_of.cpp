#include "echo/beacons/emitter_of.hpp"

#include <algorithm>

#include "echo/beacons/pulse_train.hpp"
#include "echo/kernel/hash.hpp"
#include "protocol/quantity/bearing.hpp"

namespace skerry::echo {

Emitter emitter_of(const RadarSet& set, const Pulse& pulse, const EmitterState& state,
                   EmitterSpread spread) {
  const auto drawn = [&](std::uint64_t which) {
    return 2.0 * as_unit(mixed(0xE3177E2, state.identity, which)) - 1.0;
  };
  Emitter out;
  out.place = state.place;
  out.velocity = state.velocity;
  out.height_m = set.antenna_height_m;
  out.frequency_hz = set.frequency_hz + spread.frequency_hz * drawn(0);
  out.power_w = set.peak_power_w;
  out.antenna_gain_db = set.antenna_gain_db - 0.5 * set.losses_db;
  out.side_lobe_db = std::max(set.near_side_lobe_db, set.far_side_lobe_db);
  out.beam_width_deg = set.beam_width_deg;
  out.pulse_s = pulse.length_s;
  out.prf_hz = pulse.prf_hz * (1.0 + spread.prf * drawn(1));
  out.rpm = set.rpm;
  // Bearing of the beam at time 0, had it turned then: its bearing now less its turn since.
  const std::uint32_t turned = beam_units(0.0, set.rpm, state.antenna_start);
  const double bearing = state.bow_deg - turned * kDegreesPerUnit;
  out.bearing_deg = bearing < -360.0 ? bearing + 360.0 : bearing;
  out.identity = state.identity;
  return out;
}

}  // namespace skerry::echo
