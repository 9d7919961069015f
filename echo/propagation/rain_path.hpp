// RainPath: what rain does to one spoke, cell by cell.
#pragma once

#include <span>
#include <vector>

#include "echo/radar/radar_model.hpp"
#include "echo/scene/spoke_aim.hpp"

namespace skerry::echo {

// Rate along a spoke and the two-way attenuation up to each cell (P.838-3; physics.md B2).
// Nothing is done, and any() is false, where no cell of rain lies under the spoke.
class RainPath {
 public:
  void lay(const Scene& scene, const RadarModel& model, const SpokeAim& aim);
  bool any() const;
  std::span<const float> rate_mm_h() const;     // per cell
  std::span<const float> transmission() const;  // per cell, two-way power factor in (0, 1]
  double transmission_at(double range_m) const;

 private:
  std::vector<float> rate_, transmission_;
  bool any_ = false;
};

}  // namespace skerry::echo
