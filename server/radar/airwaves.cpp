#include "server/radar/airwaves.hpp"

#include <utility>

#include "echo/kernel/hash.hpp"

namespace skerry::server {

echo::Emitter emitter_of(const echo::RadarSet& set, const echo::Pulse& pulse,
                         std::uint64_t identity) {
  echo::Emitter emitter;
  emitter.height_m = set.antenna_height_m;
  emitter.frequency_hz = set.frequency_hz;
  emitter.power_w = set.peak_power_w;
  emitter.antenna_gain_db = set.antenna_gain_db;
  emitter.side_lobe_db = set.near_side_lobe_db;
  emitter.beam_width_deg = set.beam_width_deg;
  emitter.pulse_s = pulse.length_s;
  emitter.prf_hz =
      pulse.prf_hz * (1.0 + kRateSpread * (2.0 * echo::as_unit(echo::mixed(identity)) - 1.0));
  emitter.rpm = set.rpm;
  emitter.identity = identity;
  return emitter;
}

EmissionsPtr Airwaves::get() const {
  const std::lock_guard lock(mutex_);
  return emissions_;
}

void Airwaves::set(std::size_t radar, const Emission& emission) {
  EmissionsPtr before;  // released outside the lock
  const std::lock_guard lock(mutex_);
  if (emissions_->at(radar) == emission) return;
  auto changed = std::make_shared<std::vector<Emission>>(*emissions_);
  (*changed)[radar] = emission;
  before = std::exchange(emissions_, std::move(changed));
}

}  // namespace skerry::server
