#include "echo/beacons/sart_returns.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "echo/beacons/listening.hpp"

namespace skerry::echo {

SweptAnswer swept_answer(double bandwidth_hz, double hz_per_s) {
  const double x =
      2.0 * std::numbers::ln2 / std::numbers::pi * hz_per_s / (bandwidth_hz * bandwidth_hz);
  const double wider = std::sqrt(1.0 + x * x);
  return {1.0 / wider, bandwidth_hz * wider / hz_per_s};
}

void SartReturns::prepare(const Listening& at) {
  replies_.clear();
  const double frequency = at.model.set.frequency_hz;
  if (at.scene.sarts.empty() || frequency < SartSweep::kLeastHz || frequency > SartSweep::kMostHz)
    return;
  constexpr double kBand = SartSweep::kMostHz - SartSweep::kLeastHz;
  const SweptAnswer slow = swept_answer(at.model.pulse.bandwidth_hz, kBand / SartSweep::kSlow);
  const SweptAnswer fast = swept_answer(at.model.pulse.bandwidth_hz, kBand / SartSweep::kFast);
  const double cells_per_second = 0.5 * kLightSpeed / at.model.cell_m;
  cycle_cells_ = SartSweep::kCycle * cells_per_second;
  slow_cells_ = slow.length_s * cells_per_second;
  fast_cells_ = fast.length_s * cells_per_second;

  for (const Sart& sart : at.scene.sarts) {
    const Polar place = polar_of(sart.place + sart.velocity * at.dt() - at.own_ship());
    if (!(place.range_m < at.last_range())) continue;
    const double way = static_cast<double>(at.propagation.one_way(place.range_m, sart.height_m));
    const double received = at.link.sent_watts(place.range_m) * way;
    const double power = at.link.received(SartSweep::kEirp, place.range_m) * way;
    if (!(received > 0.0) || !(power > 0.0)) continue;
    const double level =
        std::max(SartSweep::kThreshold / received, kLeastHeard / (power * slow.power));
    if (level > 1.0 || !at.reaches(place.units, level)) continue;
    if (at.behind_land(place, sart.height_m)) continue;

    const double near = std::min(1.0, kFastSeenWithin / std::max(place.range_m, 1.0));
    const double fade = near * near * near * near * near * near;
    Reply reply{};
    reply.bearing_units = place.units;
    reply.level = static_cast<float>(level);
    reply.slow = static_cast<float>(std::min(power * slow.power, kMostHeard));
    reply.fast = static_cast<float>(std::min(power * fast.power * fade, kMostHeard));
    const double first = place.range_m / at.model.cell_m;
    reply.slow_cell = first + SartSweep::slow_at(frequency) * cells_per_second;
    reply.fast_cell = first + SartSweep::fast_at(frequency) * cells_per_second;
    replies_.push_back(reply);
  }
}

void SartReturns::add(const AntennaPattern& pattern, const SpokeAim& aim,
                      std::span<float> power) const {
  for (const Reply& reply : replies_) {
    const float gain = pattern.one_way(aim.plane_units - reply.bearing_units);
    if (gain < reply.level) continue;
    const float slow = reply.slow * gain, fast = reply.fast * gain;
    const bool both = fast >= static_cast<float>(kLeastHeard);
    for (std::uint32_t k = 0; k < SartSweep::kCycles; ++k) {
      const double cycle = k * cycle_cells_;
      const double at = reply.slow_cell + cycle;
      add_span(at, at + slow_cells_, slow, power);
      if (!both) continue;
      const double quick = reply.fast_cell + cycle;
      add_span(quick, quick + fast_cells_, fast, power);
    }
  }
}

}  // namespace skerry::echo
