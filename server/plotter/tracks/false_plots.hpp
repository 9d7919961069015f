// FalsePlots: how many plots there are that no target explains, by where they are.
#pragma once

#include <array>
#include <cstddef>

namespace skerry::server {

// Around own ship, in rings that double their radius and sectors of 45 deg, true bearings: sea
// clutter is near and to windward, rain somewhere.  A mean over some seven turns.
class FalsePlots {
 public:
  void add(double range_m, double bearing_deg);
  // The antenna has come to this bearing, clockwise from the last one.
  void pass(double bearing_deg);
  // Per square metre and turn, 1e-8 at least.
  double density_per_m2(double range_m, double bearing_deg) const;

 private:
  static constexpr std::size_t kRings = 10, kSectors = 8;
  static constexpr double kFirst_m = 250.0;  // the first ring ends here, the last one never
  static std::size_t ring_of(double range_m);
  static std::size_t sector_of(double bearing_deg);

  struct Cell {
    double mean = 0.0, now = 0.0;
  };
  std::array<std::array<Cell, kSectors>, kRings> cells_{};
  std::size_t sector_ = 0;
};

}  // namespace skerry::server
