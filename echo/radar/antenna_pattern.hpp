// AntennaPattern: the horizontal pattern all round, main lobe and side lobes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "echo/radar/radar_set.hpp"
#include "protocol/quantity/bearing.hpp"

namespace skerry::echo {

// Power against the axis, 1 on it, the same on both sides.  To its first null, 1.25 beam widths
// off, it is the cosine taper of beam.hpp.  Beyond stand side lobes of the taper's spacing (0.83
// beam widths, a whole number of them to 10 deg and from there to 180): the first, and now and then
// another, touches the set's near or far level, the others lie up to 24 dB below by a hash of
// their number, with nulls between.  A real antenna's lobes are its own; these are plausible ones.
//
// From a table, straight between its nodes: in voltage within two beam widths (128 nodes to a beam
// width), in power beyond (0.044 deg).
// Error against the formula: main lobe 3e-4 of the axis' voltage; side lobes 1.5 % of their level
// for beams of 0.75 to 6 deg, 8 % at 0.3 deg. Held by AntennaPattern.TablesStayWithinTheirBound.
// Immutable; any thread.
class AntennaPattern {
 public:
  // Requires a beam of 0.3 to 7.5 deg.
  explicit AntennaPattern(const RadarSet& set);

  // `off_units`: bearing off the axis, 2^32 = one turn, either sense.
  float one_way(std::uint32_t off_units) const {
    const std::uint32_t off = units_apart(off_units, 0);
    if (off < near_units_) {
      const float place = near_scale_ * static_cast<float>(off);
      const auto node = static_cast<std::size_t>(static_cast<std::int32_t>(place));
      const float share = place - static_cast<float>(static_cast<std::int32_t>(node));
      const float a = near_voltage_[node];
      const float voltage = a + share * (near_voltage_[node + 1] - a);
      return voltage * voltage;
    }
    constexpr int kRest = 31 - 12;  // kFar nodes to half a turn
    const std::size_t node = off >> kRest;
    const float share = static_cast<float>(static_cast<std::int32_t>(off & ((1u << kRest) - 1u))) *
                        (1.0f / (1 << kRest));
    const float a = far_power_[node];
    return a + share * (far_power_[node + 1] - a);
  }
  float two_way(std::uint32_t off_units) const {  // its square
    const float power = one_way(off_units);
    return power * power;
  }

  // Off the axis by more than this, two_way() stays below `level` (a ratio in (0, 1)).
  std::uint32_t reach_units(double level) const;
  // Width of the uniform beam that gathers as much of evenly spread clutter, radians: the integral
  // of two_way(), 0.75 beam widths (SOURCES.md "Sets").
  double clutter_width() const { return clutter_width_; }

 private:
  static constexpr std::size_t kNear = 256, kFar = 4096;
  std::uint32_t near_units_;  // two beam widths
  float near_scale_;          // nodes per unit
  double clutter_width_ = 0.0;
  std::vector<float> near_voltage_;  // 0 to two beam widths
  std::vector<float> far_power_;     // 0 to 180 deg
};

// The pattern of such a set, kept for all that ask: the sixteen used last.  Making one takes a few
// milliseconds.  Thread: any.
std::shared_ptr<const AntennaPattern> antenna_pattern_for(const RadarSet& set);

// The formula behind the table, one way.
double antenna_pattern_reference(const RadarSet& set, double off_degrees);

}  // namespace skerry::echo
