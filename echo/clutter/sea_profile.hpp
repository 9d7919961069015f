// SeaProfile: what of sea clutter depends on range alone.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "echo/clutter/swell_wave.hpp"
#include "echo/kernel/clutter_row.hpp"
#include "echo/radar/radar_model.hpp"
#include "echo/scene/weather.hpp"

namespace skerry::echo {

// Mean clutter beyond this range is less than this times the noise, even upwind, and left out: that
// is at most 0.043 dB of the noise's mean, and 0.4 dB where the texture is 10 times its mean.
inline constexpr double kLeastSeaClutter = 0.01;

// Tables of one radar on one range scale over one sea.  Immutable; any thread.
class SeaProfile {
 public:
  // How the texture is sampled.
  struct Sampling {
    double clutter_width = 0.02;  // of the antenna's pattern, radians (antenna_pattern.hpp)
    double shortest_length_m = 2.0, longest_length_m = 4.0;  // of its correlation
    double node_radians = 0.02;                              // between the bearings of its samples
    double row_share = 0.0;                                  // between its rows, of that
    std::uint32_t row_spokes = 1;
  };
  // Empty for sea state 0.
  SeaProfile(const RadarModel& model, const Atmosphere& atmosphere, const SeaSurface& sea,
             const Sampling& sampling);
  SeaProfile() = default;

  // Cells with clutter: 0 .. reach() - 1.
  std::uint32_t reach() const { return static_cast<std::uint32_t>(mean_.size()); }
  // One texture sample in so many cells (a power of two up to 16: no further apart than a quarter
  // of its correlation or a fifth of the pulse), so many samples, averaged over so many (the
  // pulse).
  std::uint32_t cells_per_sample() const { return cells_per_sample_; }
  std::uint32_t samples() const { return static_cast<std::uint32_t>(spread_.size()); }
  static constexpr std::uint32_t kMostPerPulse = 64;
  std::uint32_t samples_per_pulse() const { return samples_per_pulse_; }

  // Clutter over noise, averaged over fluctuation and the wind's direction, by cell:
  // unit_snr sigma0 (R clutter width c tau/2 / cos psi) / R^4, gas and vertical beam.
  const std::vector<float>& mean() const { return mean_; }
  // Octaves upwind over crosswind, by sample.
  const std::vector<float>& spread() const { return spread_; }
  // Squared distance between neighbouring bearings of the texture, by sample, m2.
  const std::vector<float>& apart2() const { return apart2_; }

  // Laws of the texture and waves of the swell of every block of kSamplesPerLaw samples, on a
  // bearing from the plane's north.  Without swell they are the same all round, and there are no
  // waves.
  struct Look {
    std::vector<RankLaw> laws;
    std::vector<WaveBlock> waves;
  };
  Look look(double bearing_deg) const;
  // Shape nu of the clutter in the middle of a block: texture and swell together.  The texture's
  // own law is made spikier by what is lost where samples and rows are joined by straight lines
  // (sea_profile.hpp), so that the variance comes out right over all cells.
  double shape(std::size_t block, double bearing_deg) const;

 private:
  struct Block {
    double grazing_rad = 0.0, area_m2 = 0.0;
    double row_correlation = 1.0;  // of the field
  };
  std::vector<float> mean_, spread_, apart2_;
  std::vector<Block> blocks_;
  std::uint32_t cells_per_sample_ = 1, samples_per_pulse_ = 1, row_spokes_ = 1;
  double sample_correlation_ = 1.0;  // of the field averaged over the pulse, from one to the next
  Polarisation polarisation_ = Polarisation::hh;
  double swell_from_deg_ = 0.0;
  SwellWave swell_{Swell{}};
};

// Shared by radars that differ in nothing of all this.  Any thread.
std::shared_ptr<const SeaProfile> sea_profile_for(const RadarModel& model,
                                                  const Atmosphere& atmosphere,
                                                  const SeaSurface& sea,
                                                  const SeaProfile::Sampling& sampling);

}  // namespace skerry::echo
