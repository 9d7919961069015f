// A scene with its artefact and without, as video.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "tests/scenes/artefact_scenes.hpp"

namespace skerry {

// The differences of two videos.
struct Difference {
  double bearing_deg = 0.0, metres = 0.0;  // of the cell's middle, from the bow
  int gained = 0;                          // steps more with the artefact than without
};

class ShownScene {
 public:
  explicit ShownScene(const scenes::ArtefactScene& scene);

  const std::vector<std::uint8_t>& with() const { return with_; }
  double cell_m() const { return cell_m_; }
  ScanGeometry geometry() const { return geometry_; }
  RangeScale scale() const { return scale_; }

  std::vector<Difference> differences() const;

  int level(std::uint32_t spoke, std::uint32_t cell, bool with = true) const {
    return (with ? with_ : without_)[std::size_t{spoke} * geometry_.cells + cell];
  }
  // Spoke at a bearing, any number of turns.
  std::uint32_t spoke_at(double bearing_deg) const;
  std::uint32_t cell_at(double metres) const {
    return static_cast<std::uint32_t>(metres / cell_m_);
  }
  // Over bearings middle -+ half and ranges from .. to.
  double mean(double middle_deg, double half_deg, double from_m, double to_m,
              bool with = true) const;
  int peak(double middle_deg, double half_deg, double from_m, double to_m, bool with = true) const;

 private:
  template <typename Visit>
  void visit(double middle_deg, double half_deg, double from_m, double to_m, bool with,
             Visit&& each) const;

  ScanGeometry geometry_;
  RangeScale scale_;
  double cell_m_;
  std::vector<std::uint8_t> with_, without_;
};

// Degrees that one bearing is clockwise of another, -180 to 180.
inline double off_bearing(double bearing_deg, double from_deg) {
  return std::remainder(bearing_deg - from_deg, 360.0);
}

// The scene of that name, rendered once.
const ShownScene& shown(const std::string& name);

}  // namespace skerry
