// FarEchoes: what comes back after the next pulse has gone, as the radar shows it.
#pragma once

#include <cstdint>
#include <vector>

#include "echo/beacons/second_trace.hpp"
#include "echo/propagation/propagation.hpp"
#include "echo/radar/radar_model.hpp"
#include "echo/scene/spoke_aim.hpp"
#include "echo/targets/point_echo.hpp"
#include "echo/targets/sector_view.hpp"
#include "echo/targets/target_medium.hpp"

namespace skerry::echo {

// Ships, buoys and coast beyond the unambiguous range, each a single point, folded to where they
// show (second_trace.hpp).  Only what a duct or great strength brings over the horizon stands out
// of the noise and is made.  Nothing is done where the scene's artefacts.second_trace is off, or
// nothing lies that far.
// Error: ships are one point in their middle, turbines and structures are left out; nothing beyond
// kFarthest is followed, so that PRF below 1000 Hz have no second trace.
// Cost: a comparison for each ship and point; the coast's vertices once every kAnewAfter.
class FarEchoes {
 public:
  static constexpr double kFarthest = 150e3;     // metres
  static constexpr double kCoastHeight = 100.0;  // of far shores over the water, metres
  // The far coast is made anew when the own ship has sailed that far: a thirtieth of a degree.
  static constexpr double kAnewAfter = 30.0;

  explicit FarEchoes(const RadarModel& model);

  // Adds what spokes first to last (less than half a turn) see to `out`.  `propagation` must reach
  // kFarthest.  Thread: the radar's.
  void append(const Scene& scene, const Propagation& propagation, const SpokeAim& first,
              const SpokeAim& last, const HiddenHeight& hidden, std::vector<PointEcho>& out,
              PrfJitter jitter = {});

 private:
  struct Shore {
    PlanePoint place;
    PointEcho echo;
  };
  struct Look;
  void add_ships(const Look& look);
  void add_points(const Look& look);
  void add_coast(const Look& look);
  void add(const Look& look, const Polar& at, double height_m, double power, std::uint32_t body);
  bool in_reach(PlanePoint from_own_ship) const;

  RadarModel model_;
  std::uint32_t reach_units_;
  double nearest_m_, farthest_m_;
  CoastPicturePtr made_of_;  // that shores_ are of
  PlanePoint made_at_;
  std::vector<Shore> shores_;
  std::vector<PointEcho> found_;
};

}  // namespace skerry::echo
