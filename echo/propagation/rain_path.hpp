// RainPath: what rain does to one spoke, cell by cell.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "echo/kernel/rain_row.hpp"
#include "echo/radar/radar_model.hpp"
#include "echo/radar/radar_set.hpp"
#include "echo/rain/rain_map.hpp"
#include "echo/rain/rain_profile.hpp"
#include "echo/scene/spoke_aim.hpp"

namespace skerry::echo {

// gamma = k R^alpha, dB/km one way, R in mm/h.  Source: ITU-R P.838-3, equations 1 to 3 and tables
// 1 to 4, for a level path; SOURCES.md "Vectors".  Frequency 1 to 1000 GHz.
struct RainLaw {
  double k = 0.0;
  double alpha = 1.0;
};
RainLaw rain_law(double frequency_hz, Polarisation polarisation);

// dB/km one way; 0 without rain.
double rain_db_per_km(const RainLaw& law, double rate_mm_h);

// Rate of an even area at a distance from its middle (as its square, m2), as a share of its rate: 1
// within half its radius, 0 from the radius on, a smoothstep of the squared distance between.
double rain_profile(double distance_squared, double radius_m);

// Rate along a spoke and the two-way attenuation up to each cell (P.838-3; SOURCES.md
// "Propagation"). Nothing is done, and any() is false, where no cell of rain lies under the spoke.
//
// Rate and attenuation are worked out at knots, a twentieth of the smallest even area's
// radius, 1.25 values of the finest map (echo/rain/rain_map.hpp) and 0.7 dB apart at most (or one
// cell), and go straight between.  Error, for areas of a radius of at least 4 cells and 200 mm/h:
// even ones, rate 0.02 of the greatest, transmission 0.02 of the attenuation in dB and 0.02 dB,
// held by RainPath.StaysWithinItsBoundOfTheIntegral; others, rate 0.04 of the greatest,
// transmission 0.03 and 0.05 dB, held by RainPath.TakesAndEchoesOneField.  Thread: one at a time.
class RainPath {
 public:
  // Works out the knots; lay() lays rows of cells, too.
  void trace(const Scene& scene, const RadarModel& model, const SpokeAim& aim);
  void lay(const Scene& scene, const RadarModel& model, const SpokeAim& aim);
  bool any() const { return any_; }
  // All of the following require any().
  // Cells with rain in them: [first_wet, end_wet).
  std::size_t first_wet() const { return first_; }
  std::size_t end_wet() const { return end_; }
  // From the first wet cell, every step() cells, to one at or behind the last: rate in mm/h and the
  // two-way power factor.  Behind the rain stays the last.
  std::size_t step() const { return step_; }
  std::span<const float> knot_rates() const { return knot_rates_; }
  std::span<const float> knot_transmissions() const { return knots_; }
  // After lay() alone.
  std::span<const float> rate_mm_h() const { return rate_; }  // per cell
  // Per cell, to its middle: two-way power factor in (0, 1].
  std::span<const float> transmission() const { return transmission_; }

 private:
  void find_rain(const Scene& scene, const RadarModel& model, const SpokeAim& aim);
  const RainMap& map_of(const RainCell& cell, double seconds);
  void take_law(const RadarModel& model);
  void lay_knots(double beam_width);
  bool leave_out_dry_ends();

  std::vector<CloudChord> clouds_;                // even areas under the spoke
  std::vector<RainChord> chords_;                 // and others
  std::vector<RainMapPtr> maps_;                  // those used last
  double from_m_ = 0.0, to_m_ = 0.0;              // of all areas
  double spacing_m_ = 0.0, greatest_rate_ = 0.0;  // the least that they ask for; of all together
  std::vector<float> knot_rates_, knots_;         // knots_: losses, then transmission
  std::vector<float> rate_, transmission_;
  std::size_t first_ = 0, end_ = 0;  // wet cells
  std::size_t step_ = 1;             // cells from knot to knot
  bool any_ = false;
  // For the radar last used.
  double frequency_hz_ = 0.0, cell_m_ = 1.0;
  Polarisation polarisation_ = Polarisation::hh;
  float alpha_ = 1.0f, log2_octaves_ = 0.0f;  // lost in a cell of 1 mm/h
};

}  // namespace skerry::echo
