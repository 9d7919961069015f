// One-way links: between the own radar and what answers or sends by itself.
#pragma once

#include <cstdint>

#include "echo/radar/radar_model.hpp"
#include "echo/targets/sector_view.hpp"
#include "echo/targets/target_medium.hpp"

namespace skerry::echo {

// Friis: EIRP G lambda^2 / ((4 pi)^2 R^2) (SOURCES.md "Beacons"), so both fall as R^-2.  Free
// space: propagation and the own antenna's pattern are the caller's.  Half of the set's losses lie
// on each way.  Ranges below kNearest count as that.
class OneWayLink {
 public:
  static constexpr double kNearest = 10.0;  // m: far-field formulas end about there

  explicit OneWayLink(const RadarModel& model);

  // Signal over noise on own antenna's axis, from a sender of that EIRP.
  double received(double eirp_w, double range_m) const;
  double received_at_1m(double eirp_w) const { return eirp_w * received_1m_; }
  // Power that an isotropic antenna takes in there, on own beam's axis, watts.
  double sent_watts(double range_m) const;

 private:
  double received_1m_;  // of 1 W at 1 m
  double sent_1m_;
};

// Whether land hides that place.  Its own cell and the one before do not count.  Beyond
// `known_to_m`, to where `hidden` knows the land, the shadow goes on straight; the Earth's curve is
// the propagation's.
bool behind_land(const HiddenHeight& hidden, Polar place, double height_m, double antenna_height_m,
                 double cell_m, double known_to_m);

// An upper bound of the own beam's pattern toward a bearing, from anywhere in a sector.  So a
// sender that cannot be heard is left out early.
class BeamBound {
 public:
  explicit BeamBound(const RadarSet& set);
  // `off_units`: least bearing off the axis in the sector.
  float most(std::uint32_t off_units) const {
    return off_units <= main_units_ ? 1.0f : off_units <= near_units_ ? near_ : far_;
  }
  std::uint32_t main_units() const { return main_units_; }

 private:
  std::uint32_t main_units_, near_units_;
  float near_, far_;
};

// Spokes from one bearing to another, clockwise or anticlockwise, less than half a turn.
struct Sector {
  std::uint32_t middle_units = 0, half_units = 0;
  Sector(std::uint32_t first_units, std::uint32_t last_units);
  // Least bearing between one of its spokes and that one; 0 within.
  std::uint32_t off(std::uint32_t bearing_units) const {
    const auto turn = static_cast<std::int32_t>(bearing_units - middle_units);
    const std::uint32_t away =
        turn < 0 ? 0u - static_cast<std::uint32_t>(turn) : static_cast<std::uint32_t>(turn);
    return away > half_units ? away - half_units : 0u;
  }
};

}  // namespace skerry::echo
