#include "echo/receiver/receiver_noise.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>
#include <numeric>
#include <utility>

#include "echo/kernel/exact_math.hpp"
#include "echo/kernel/hash.hpp"
#include "echo/radar/radar_set.hpp"
#include "echo/receiver/noise_torus.hpp"

namespace skerry::echo {
namespace {
constexpr std::uint64_t kSeed = 0x5EE0D;
constexpr double kStepsPerOctave = 16.0;
constexpr double kStretchPower = 1.0 / 3.0;
}  // namespace

double samples_in_cell(double cell_m, double bandwidth_hz) {
  return 2.0 * bandwidth_hz * cell_m / kLightSpeed;
}

// The torus, and behind its end its beginning again for the longest row.
std::vector<ReceiverNoise::Line> ReceiverNoise::lines(const std::vector<double>& values) {
  std::vector<Line> out((kPeriod + kMaxCells) / kLine);
  for (std::size_t i = 0; i < out.size() * kLine; ++i)
    out[i / kLine].values[i % kLine] = static_cast<float>(values[i % values.size()]);
  return out;
}

// A row adds three stretches, each of a third of the power.
ReceiverNoise::ReceiverNoise(double samples, Decimation decimation) {
  const double q = std::clamp(samples, kMinSamples, kMaxSamples);
  const ComplexTorus torus = q < 1.0 ? band_noise(kPeriod, q, kStretchPower, kSeed)
                                     : white_noise(kPeriod, kStretchPower, kSeed);
  re_ = lines(torus.re);
  im_ = lines(torus.im);
  if (q > 1.0) add_samples(q, decimation);
}

void ReceiverNoise::add_samples(double q, Decimation decimation) {
  const std::vector<double> beside = decimation == Decimation::peak
                                         ? peak_excess(kPeriod, q - 1.0, kSeed + 1)
                                         : gamma_values(kPeriod, q - 1.0, kSeed + 1);
  beside_ = lines(beside);
  mean_power_ = 1.0 + std::accumulate(beside.begin(), beside.end(), 0.0) / kPeriod;
  if (decimation == Decimation::mean) {
    gain_ = static_cast<float>(q);
    scale_octaves_ = exact_log2(q);
  }
  constexpr std::uint32_t kRows = 16;  // deviation of the mean: 0.02 dB
  double sum = 0.0;
  for (std::uint32_t i = 0; i < kRows; ++i) {
    const NoiseRow noise = row(noise_key(kSeed, 0, 0, i));
    for (std::uint32_t k = 0; k < kMaxCells; ++k)
      sum += exact_log2(std::max(1e-30, total_power_reference(0.0, 1.0, noise, k)));
  }
  mean_octaves_ = sum / (kRows * kMaxCells);
}

NoiseRow ReceiverNoise::row(NoiseKey key, std::uint32_t from) const {
  constexpr std::uint32_t kPlaces = kPeriod / kLine;
  const auto begin = [from](std::uint64_t place) {
    return (static_cast<std::uint32_t>(place % kPlaces) * kLine + from) % kPeriod;
  };
  const std::uint64_t more = mixed(key.first, key.second);
  const std::uint32_t a = begin(key.first), b = begin(key.second), c = begin(more);
  const float* beside = beside_.empty() ? nullptr : floats(beside_) + begin(more >> 32);
  return {floats(re_) + a, floats(im_) + a, floats(re_) + b, floats(im_) + b,
          floats(re_) + c, floats(im_) + c, beside};
}

std::shared_ptr<const ReceiverNoise> receiver_noise_for(double samples, Decimation decimation) {
  static std::mutex mutex;
  static std::map<std::pair<int, Decimation>, std::weak_ptr<const ReceiverNoise>> kept;
  const double q = std::clamp(samples, ReceiverNoise::kMinSamples, ReceiverNoise::kMaxSamples);
  const int step = static_cast<int>(std::floor(exact_log2(q) * kStepsPerOctave + 0.5));
  const std::lock_guard lock(mutex);
  // What is correlated is not decimated.
  std::weak_ptr<const ReceiverNoise>& slot =
      kept[{step, step <= 0 ? Decimation::peak : decimation}];
  std::shared_ptr<const ReceiverNoise> noise = slot.lock();
  if (!noise) {
    noise = std::make_shared<const ReceiverNoise>(exact_exp2(step / kStepsPerOctave), decimation);
    slot = noise;
  }
  return noise;
}

}  // namespace skerry::echo
