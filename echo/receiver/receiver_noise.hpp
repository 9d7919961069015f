// ReceiverNoise: thermal noise behind the receiver's filter, as a cell of a given length sees it.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "echo/kernel/coherent_receiver.hpp"
#include "echo/receiver/controls.hpp"

namespace skerry::echo {

// Independent noise samples in a cell: 2 B cell / c.  Below 1 neighbouring cells share noise.
double samples_in_cell(double cell_m, double bandwidth_hz);

// Complex Gaussian noise of unit mean power, a pure function of the key and the cell.
//
// samples <= 1: neighbouring cells are correlated as behind a rectangular filter of bandwidth B;
// the correlation of power k cells apart is (sin x / x)^2, x = pi k samples.  For samples = 0.62
// that is .23, .03 (SOURCES.md "Pictures (h)" measured .23, .04 of a Quantum 2).
// samples > 1: neighbouring cells are independent, and decimation acts on the samples:
//   peak: power of pure noise is the largest of `samples` exponentials.  That is one exponential
//     plus `beside` = -ln Beta(2, samples - 1) (Renyi's representation of order statistics), which
//     holds for any real number of samples;
//   mean: |sqrt(samples * power) + n|^2 + beside, beside of the law Gamma(samples - 1), is
//   `samples`
//     times the mean of that many, with an echo or without; gain() and scale_octaves() say so.
//
// Made from a torus of kPeriod values: a spoke is the sum of three stretches of it that begin where
// the key says, one as it is, one turned by 90 degrees, one mirrored, so that they stay unrelated
// even where they begin at the same place.  They begin with a cache line, so there
// are 2^33 different spokes.
// Error: KS distance 0.003 of its law; its tail within 20 % at 1e-6, 10 % at 1e-5; `samples` is
// rounded to 1/16 octave by receiver_noise_for.  Under peak decimation an echo and the peaks of
// noise beside it are added, where in truth the largest sample is kept: in a cell of four samples
// at most 0.6 dB too much for a point in one of them (0.4 at 10 dB, 0.05 at 20 dB over noise), and
// at most 1.3 dB too little for a steady echo in all of them.  Held by ReceiverNoise.*. Immutable;
// any thread.
class ReceiverNoise {
 public:
  static constexpr std::uint32_t kPeriod = 1u << 15;
  static constexpr std::uint32_t kMaxCells = 4096;
  static constexpr double kMinSamples = 1.0 / 256.0, kMaxSamples = 256.0;

  // samples: clamped to kMinSamples .. kMaxSamples.
  ReceiverNoise(double samples, Decimation decimation);

  // Noise of a spoke, kMaxCells of it, from cell `from` on: longer rows are had by pieces that join
  // without a seam, and repeat after kPeriod cells.  Valid while this lives.
  NoiseRow row(NoiseKey key, std::uint32_t from = 0) const;

  // Factor on the echo's power before the noise is added.
  float gain() const { return gain_; }
  // log2 of mean noise in a row over mean noise of one sample: 0 but for mean decimation, where the
  // row is `samples` times too strong, and that has to be taken off again behind the logarithm.
  double scale_octaves() const { return scale_octaves_; }
  // Means of a row's power and of its log2 without echo.
  double mean_power() const { return mean_power_; }
  double mean_octaves() const { return mean_octaves_; }

 private:
  static constexpr std::uint32_t kLine = 16;
  struct alignas(64) Line {
    std::array<float, 16> values;
  };
  void add_samples(double samples, Decimation decimation);
  static std::vector<Line> lines(const std::vector<double>& values);
  static const float* floats(const std::vector<Line>& lines) { return lines.front().values.data(); }

  float gain_ = 1.0f;
  double scale_octaves_ = 0.0;
  double mean_power_ = 1.0;
  double mean_octaves_ = -0.83274618;  // of an exponential: -Euler's constant / ln 2
  std::vector<Line> re_, im_, beside_;
};

// The noise of so many samples in a cell, rounded to 1/16 octave; shared by all who ask while
// somebody holds it.  Any thread.
std::shared_ptr<const ReceiverNoise> receiver_noise_for(double samples, Decimation decimation);

}  // namespace skerry::echo
