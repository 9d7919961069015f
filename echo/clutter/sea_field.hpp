// SeaField: where the sea is rough, fixed to the water and moving with the waves.
#pragma once

#include <cstdint>
#include <span>

#include "echo/kernel/clutter_row.hpp"
#include "echo/scene/weather.hpp"
#include "protocol/quantity/geo_point.hpp"

namespace skerry::echo {

// A Gaussian field over plane and time, zero mean and unit variance.  Two layers of one ring
// (lattice_field.hpp) are mixed at a time, the weights a cosine and a sine so that the variance
// stays; each lives for two epochs of kEpoch seconds and drifts downwind with the waves' group
// speed, 0.57 of the wind (half the phase speed of the Pierson-Moskowitz peak), give or take 20 %
// and 15 deg by layer.  In the frame of the waves it is forgotten (1/e) after 0.95 epochs.
// Correlation: exp(-(d / L)^2) with L 1.2 times (pi/2)(U^2/g) sqrt(3 cos^2 + 1) (SOURCES.md "Sea",
// angle to the wind), so that the gamma texture made of it falls to 1/e at that length: within 15 %
// for nu 0.2 to 1 up-, down- and crosswind; between them L is that of an ellipse, up to a quarter
// shorter than the law.  L is 2 m at least.  Sampled at the nearest of four values to L, in steps
// of 0.0375 (kPackedStep): 0.011 of the deviation, root mean square.
// Held by SeaField.MakesATextureOfTheLawsLength.
//
// Immutable; any thread.
class SeaField {
 public:
  static constexpr double kEpoch = 4.0;  // seconds

  SeaField(const SeaSurface& sea, std::uint64_t seed);

  // Samples at `first_m`, first_m + step_m, ... from `from` on a bearing given by its east and
  // north; of these, number `first` and those after it.  `seconds`: scenario time.
  void sample(PlanePoint from, double east, double north, double first_m, double step_m,
              double seconds, std::uint32_t first, std::span<float> out) const;
  void sample(PlanePoint from, double east, double north, double first_m, double step_m,
              double seconds, std::span<float> out) const {
    sample(from, east, north, first_m, step_m, seconds, 0, out);
  }

  // 1 / L^2 in that direction, 1/m2.
  double inverse_length2(double east, double north) const;
  double shortest_length_m() const { return crosswind_m_; }
  double longest_length_m() const { return downwind_m_; }

 private:
  FieldWalk walk_of_layer(std::int64_t layer, PlanePoint from, double east, double north,
                          double first_m, double step_m, double seconds) const;

  std::uint64_t seed_;
  double downwind_deg_;              // whither it blows, clockwise from the plane's north
  double downwind_m_, crosswind_m_;  // L
  double group_speed_;               // m/s
};

}  // namespace skerry::echo
