// FarLobes: what the side lobes far from the axis bring in.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "echo/kernel/aligned_floats.hpp"
#include "echo/radar/antenna_pattern.hpp"
#include "echo/radar/radar_model.hpp"
#include "echo/scene/spoke_aim.hpp"
#include "echo/targets/point_echo.hpp"

namespace skerry::echo {

// Bodies more than `near_units` off the sector, each spread evenly over the cells it fills, at the
// level the pattern has in the middle of every 1.4 deg: side lobes are about as wide.  So a lobe
// has the right level and place within 0.7 deg, and no shape.  What stands out there by less than a
// twentieth of the noise is left out.  Cost: once for each 1.4 deg the cells of all bodies, and for
// each spoke one addition of what is not empty.
class FarLobes {
 public:
  explicit FarLobes(const RadarModel& model);

  // Uses all of `strong` except the bodies `met`.  Thread: the radar's.
  void prepare(const AntennaPattern& pattern, const StrongEchoes& strong,
               std::span<const std::uint32_t> met, std::uint32_t near_units, const SpokeAim& first,
               const SpokeAim& last);
  void clear() { begins_.clear(); }

  // Thread: any.
  void add(const SpokeAim& aim, std::span<float> power) const;

 private:
  struct Point {
    std::uint32_t units, body;
    std::uint32_t cell, full;  // first cell; cells filled wholly after it
    float power, lead, tail;   // shares of the first and the last cell
  };
  void lay(const StrongEchoes& strong);
  void take(std::size_t row, std::size_t first_run, std::size_t last_run);
  void find_runs(std::uint32_t rows);

  RadarModel model_;
  float least_power_;
  std::uint32_t lobe_spokes_;  // spokes of 1.4 deg
  std::uint64_t laid_ = ~std::uint64_t{0};
  std::vector<Point> points_;  // of version laid_

  std::uint64_t first_spoke_ = 0;
  std::uint32_t row_spokes_ = 16;  // spokes that share a row
  std::size_t pitch_ = 0;
  // What lies outside the runs that are not empty is never read.
  struct Run {
    std::uint32_t first, count;  // cells
  };
  AlignedFloats rows_;
  std::vector<std::uint8_t> taken_;  // sixteen cells each: whether any is not empty
  std::vector<Run> runs_;            // of all rows
  std::vector<std::size_t> begins_;  // of a row's runs, and the end of the last's
};

}  // namespace skerry::echo
