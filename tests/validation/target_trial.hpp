// TargetTrial: one radar at sea, the targets that are put before it, and its video.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "tests/scenes/scenes.hpp"

namespace skerry::validation {

// Gain at which a cell of pure noise shows with probability 1e-4: threshold 9.643 dB.
inline constexpr double kGainForPfa = (22.9 - 9.6434) / 0.258;

// An own ship that lies still on an open sea, heading north.
class TargetTrial {
 public:
  struct Conditions {
    echo::RadarSet set;
    RangeScale scale;
    double antenna_height_m = 15.0;  // MSC.192(79) table 2
    double gain = kGainForPfa;
    double sea = 0.0;
    double integration = 0.0;
    ScanGeometry geometry = {};
  };
  using Fill = std::function<void(echo::Scene&)>;

  TargetTrial(const Conditions& conditions, const Fill& fill);

  const ScanGeometry& geometry() const { return geometry_; }
  double cell_m() const { return cell_m_; }
  PlanePoint own_ship() const { return scene_->own_ship; }

  // Video of `count` spokes from `first` of that scan on.
  std::vector<std::uint8_t> video(std::uint32_t scan, std::uint32_t first, std::uint32_t count);

  // Share of `scans` scans in which the cell at that range and bearing, over the middle of the
  // beam, is on.
  double detected(double range_m, double bearing_deg, std::uint32_t scans);

 private:
  ScanGeometry geometry_;
  double rpm_;
  double cell_m_;
  std::shared_ptr<echo::Scene> scene_;
  echo::SpokeRenderer renderer_;
};

// `range_m` away on `bearing_deg` from `from`.
PlanePoint off(PlanePoint from, double range_m, double bearing_deg);

}  // namespace skerry::validation
