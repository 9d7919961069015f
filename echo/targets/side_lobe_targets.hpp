// SideLobeTargets: what is strong enough to be seen through the side lobes, all round.
#pragma once

#include <cstddef>
#include <cstdint>

#include "echo/radar/radar_model.hpp"
#include "echo/scene/spoke_aim.hpp"
#include "echo/targets/point_echo.hpp"
#include "echo/targets/sector_view.hpp"
#include "echo/targets/ship_shadow.hpp"
#include "echo/targets/target_medium.hpp"

namespace skerry::echo {

// Made anew eight times a turn, so that a target is up to 0.31 s late in its own side lobes (6 m at
// 20 m/s).  A ship is up to three points along the line of sight, each Swerling 1.
class SideLobeTargets {
 public:
  explicit SideLobeTargets(const RadarModel& model);

  // Thread: the radar's.
  void update(const Scene& scene, const SpokeAim& first, const SectorView& view,
              const TargetMedium& medium, const HiddenHeight& hidden);
  const StrongEchoes& strong() const { return strong_; }

 private:
  // A target that echoes as one, before shadows and propagation.
  struct Whole {
    PlanePoint from_own_ship;
    double section_m2 = 0.0, height_m = 1.0, depth_m = 0.0;
    bool from_the_water = true;
    Fluctuation fluctuation = Fluctuation::rayleigh;
    std::uint64_t identity = 0;
    std::uint32_t body = 0;
  };
  void add(const Scene& scene, const SectorView& view, const TargetMedium& medium,
           const HiddenHeight& hidden, const Whole& whole);

  RadarModel model_;
  float least_power_;  // that stands out in the highest side lobe
  std::uint64_t block_ = ~std::uint64_t{0};
  std::size_t made_for_ = 0;  // targets there were
  StrongEchoes strong_;
};

}  // namespace skerry::echo
