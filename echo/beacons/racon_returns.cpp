#include "echo/beacons/racon_returns.hpp"

#include <algorithm>

#include "echo/beacons/listening.hpp"
#include "echo/kernel/exact_math.hpp"
#include "echo/kernel/hash.hpp"
#include "protocol/quantity/bearing.hpp"
#include "protocol/quantity/plane_geometry.hpp"

namespace skerry::echo {
namespace {

constexpr double kBeside = 1.0;  // metres: nearer than that there is no bearing

std::uint32_t true_units(double degrees_clockwise) {
  return TrueBearing::from(degrees(degrees_clockwise)).units();
}

}  // namespace

bool RaconReturns::on_duty(const Racon& racon, ScenarioTime time) {
  const std::int64_t period = seconds_as_duration(racon.period_s).count();
  const std::int64_t on = seconds_as_duration(racon.on_s).count();
  if (period <= 0) return true;
  const auto phase =
      static_cast<std::int64_t>(mixed(0x7AC0, racon.identity) % static_cast<std::uint64_t>(period));
  const std::int64_t at = (time.time_since_epoch().count() % period + phase) % period;
  return (at < 0 ? at + period : at) < on;
}

bool RaconReturns::in_sector(const Racon& racon, std::uint32_t bearing_units) {
  const std::uint32_t from = true_units(racon.sector_from_deg),
                      to = true_units(racon.sector_to_deg);
  return from == to || bearing_units - from <= to - from;
}

void RaconReturns::prepare(const Listening& at) {
  replies_.clear();
  if (at.scene.racons.empty()) return;
  const bool x_band = at.model.set.band() == Band::x;
  const double last = at.last_range();
  const ScenarioTime time = at.time();
  for (const Racon& racon : at.scene.racons) {
    if (!(x_band ? racon.x_band : racon.s_band)) continue;
    const PlanePoint offset = racon.place - at.own_ship();
    const double range2 = dot(offset, offset);
    if (!(range2 < last * last)) continue;
    if (racon.side_lobe_suppression && !at.main_lobe.meets(offset, kBeside)) continue;
    if (!on_duty(racon, time)) continue;

    const Polar place = polar_of(offset);
    const double from = place.range_m + 0.5 * kLightSpeed * racon.delay_s;
    if (from >= last || !in_sector(racon, place.units + kUnitsPerHalfTurn)) continue;

    const double gain = ratio_from_decibels(racon.antenna_gain_db);
    double level = racon.side_lobe_suppression ? kSuppressedBelow : 0.0;
    const double way = static_cast<double>(at.propagation.one_way(place.range_m, racon.height_m));
    const double received = at.link.sent_watts(place.range_m) * gain * way;
    const double power = at.link.received(racon.power_w * gain, place.range_m) * way;
    if (!(received > 0.0) || !(power > 0.0)) continue;
    const double threshold = 1e-3 * ratio_from_decibels(racon.threshold_dbm);
    level = std::max({level, threshold / received, kLeastHeard / power});
    if (level > 1.0 || !at.reaches(place.units, level)) continue;
    if (at.behind_land(place, racon.height_m)) continue;

    Reply reply{};
    reply.code = marks_of(racon.code);
    if (reply.code.count == 0) continue;
    reply.bearing_units = place.units;
    reply.level = static_cast<float>(level);
    reply.power = static_cast<float>(std::min(power, kMostHeard));
    reply.from_cell = from / at.model.cell_m;
    reply.dot_cells = 0.5 * kLightSpeed * racon.length_s / (at.model.cell_m * reply.code.dots);
    replies_.push_back(reply);
  }
}

void RaconReturns::add(const AntennaPattern& pattern, const SpokeAim& aim, float factor,
                       std::span<float> power) const {
  for (const Reply& reply : replies_) {
    const float gain = pattern.one_way(aim.plane_units - reply.bearing_units);
    if (gain < reply.level) continue;
    const float value = reply.power * gain * factor;
    for (std::uint32_t i = 0; i < reply.code.count; ++i) {
      const auto [from, to] = reply.code.marks[i];
      add_span(reply.from_cell + from * reply.dot_cells, reply.from_cell + to * reply.dot_cells,
               value, power);
    }
  }
}

}  // namespace skerry::echo
