// ShipShadow: what ships hide from the radar.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "echo/radar/radar_model.hpp"
#include "echo/scene/spoke_aim.hpp"
#include "echo/targets/sector_view.hpp"

namespace skerry::echo {

// Cells of one spoke that a ship shadows at the water's level, and the power that is left of them.
struct ShadowedCells {
  std::uint32_t first_cell = 0, last_cell = 0;  // last one included
  float factor = 1.0f;
};

// A hull is a box of her length and beam as seen from the antenna, with a top at 0.7 of her height
// (masts and gaps let through).  It takes away the share of the one-way beam that it covers, out
// and back: factor = (1 - covered)^2; what bends around its edges is left out.  The shadow begins
// behind the hull and ends where the line of sight over the top meets the curved sea; over a ship
// as high as the antenna it has no end.
class ShipShadow {
 public:
  explicit ShipShadow(const RadarModel& model, double effective_earth_m);

  // `met`: the hulls that the beam may meet in the sector, by index.  Thread: the radar's.
  void prepare(const Scene& scene, const SectorView& view, std::span<const std::uint32_t> met);
  std::uint32_t reach_units() const { return reach_units_; }
  bool any() const { return !hulls_.empty(); }

  // Thread of all others: any, after prepare().
  void shadows(const SpokeAim& aim, std::vector<ShadowedCells>& out) const;
  // Takes it out of `power`.  Bound: land behind, however high, is dimmed as the water is.
  void apply(const SpokeAim& aim, std::span<float> power) const;

  // Share of a body from the water up to `height_m` that is still seen over the ships before it,
  // 0 to 1; the hull `not_by` throws none.
  float seen(std::uint32_t plane_units, double range_m, double height_m,
             std::uint32_t not_by = ~0u) const;

 private:
  struct Shading {
    std::uint32_t hull;
    std::uint32_t units, half_units;  // bearing and half-width seen
    double near_m, far_m;             // of the shadow; far: infinite if it has no end
    double slope;                     // by which the line over the top falls per metre
  };
  double covered(std::int64_t from, std::int64_t to) const;  // of the beam, off its axis
  float left_of(const Shading& shading, std::uint32_t plane_units) const;

  RadarModel model_;
  double earth_m_;
  std::uint32_t reach_units_ = 0;
  std::vector<float> gathered_;  // of the one-way beam from its left end, 0 to 1
  std::vector<Shading> hulls_;
};

}  // namespace skerry::echo
