#include "echo/receiver/receiver_noise.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <numeric>
#include <utility>
#include <vector>

#include "echo/kernel/exact_math.hpp"
#include "echo/kernel/hash.hpp"
#include "echo/kernel/shared_tables.hpp"
#include "echo/radar/radar_set.hpp"

namespace skerry::echo {

struct ComplexTorus {
  std::vector<double> re, im;
};

// `period` (a power of two) independent complex Gaussians of mean power `power`: their powers are
// the (j + 1/2) / period quantiles of an exponential in random order, so their distribution is that
// of the law to 1 / period; phases are random.  Their sum is 0: it would be the same in every row.
ComplexTorus white_noise(std::uint32_t period, double power, std::uint64_t seed);

// The same through a rectangular filter `band` (0 to 1) of the sampling rate wide, made of its
// spectrum without its middle line; autocorrelation sin(pi band k) / (pi band k).  Mean power is
// `power` exactly.
ComplexTorus band_noise(std::uint32_t period, double band, double power, std::uint64_t seed);

// Quantiles of the law -ln Beta(2, b) and of the law Gamma(a, 1), at (j + 1/2) / period, in random
// order.  a, b in (0, 256].  Error: 1e-3 of the spread.
std::vector<double> peak_excess(std::uint32_t period, double b, std::uint64_t seed);
std::vector<double> gamma_values(std::uint32_t period, double a, std::uint64_t seed);

namespace {

// 0 .. n-1 in random order (Fisher and Yates).
std::vector<std::uint32_t> shuffled(std::uint32_t n, std::uint64_t seed) {
  std::vector<std::uint32_t> order(n);
  for (std::uint32_t i = 0; i < n; ++i) order[i] = i;
  for (std::uint32_t i = n; i > 1; --i) {
    std::swap(order[i - 1], order[static_cast<std::size_t>(mixed(seed, i) % i)]);
  }
  return order;
}

double natural_log(double x) { return exact_log2(x) * std::numbers::ln2; }
double natural_exp(double x) {
  return x < -690.0 ? 0.0 : exact_exp2(x * (1.0 / std::numbers::ln2));
}

// In place, decimation in time, sign +, without a factor.  The size is a power of two.
void transform(ComplexTorus& torus) {
  std::vector<double>&re = torus.re, &im = torus.im;
  const std::size_t n = re.size();
  for (std::size_t i = 1, j = 0; i < n; ++i) {
    std::size_t bit = n >> 1;
    for (; j & bit; bit >>= 1) j ^= bit;
    j ^= bit;
    if (i < j) {
      std::swap(re[i], re[j]);
      std::swap(im[i], im[j]);
    }
  }
  for (std::size_t half = 1; half < n; half *= 2) {
    for (std::size_t k = 0; k < half; ++k) {
      const SinCos w = sin_cos_units(static_cast<std::uint32_t>((std::uint64_t{k} << 31) / half));
      for (std::size_t i = k; i < n; i += 2 * half) {
        const std::size_t j = i + half;
        const double r = re[j] * w.cos - im[j] * w.sin, s = re[j] * w.sin + im[j] * w.cos;
        re[j] = re[i] - r;
        im[j] = im[i] - s;
        re[i] += r;
        im[i] += s;
      }
    }
  }
}

// A law as a table: at[k] rises, below[k] is the (not yet normalised) mass below it.
struct Law {
  std::vector<double> at, below;
};

std::vector<double> quantiles(const Law& law, std::uint32_t period, std::uint64_t seed) {
  const std::vector<std::uint32_t> order = shuffled(period, seed);
  std::vector<double> values(period);
  std::size_t k = 1;
  for (std::uint32_t j = 0; j < period; ++j) {
    const double mass = (j + 0.5) / period * law.below.back();
    while (k + 1 < law.below.size() && law.below[k] < mass) ++k;
    const double step = law.below[k] - law.below[k - 1];
    const double share = step > 0.0 ? (mass - law.below[k - 1]) / step : 0.0;
    values[order[j]] = law.at[k - 1] + share * (law.at[k] - law.at[k - 1]);
  }
  return values;
}

}  // namespace

ComplexTorus white_noise(std::uint32_t period, double power, std::uint64_t seed) {
  const std::vector<std::uint32_t> order = shuffled(period, mixed(seed, 1));
  ComplexTorus torus{std::vector<double>(period), std::vector<double>(period)};
  for (std::uint32_t i = 0; i < period; ++i) {
    const double amplitude = std::sqrt(-power * natural_log((order[i] + 0.5) / period));
    const SinCos phase = sin_cos_units(static_cast<std::uint32_t>(mixed(seed, 2, i) >> 32));
    torus.re[i] = amplitude * phase.cos;
    torus.im[i] = amplitude * phase.sin;
  }
  for (std::vector<double>* part : {&torus.re, &torus.im}) {
    double sum = 0.0;
    for (double v : *part) sum += v;
    for (double& v : *part) v -= sum / period;
  }
  return torus;
}

ComplexTorus band_noise(std::uint32_t period, double band, double power, std::uint64_t seed) {
  const auto lines =
      std::clamp(static_cast<std::uint32_t>(period * band + 0.5), std::uint32_t{2}, period);
  const ComplexTorus spectrum = white_noise(lines, 1.0, seed);
  ComplexTorus torus{std::vector<double>(period), std::vector<double>(period)};
  for (std::uint32_t k = 0; k < lines; ++k) {
    // Half of the lines above, half of them below the carrier.
    const std::uint32_t line = (k + period - lines / 2) % period;
    torus.re[line] = spectrum.re[k];
    torus.im[line] = spectrum.im[k];
  }
  torus.re[0] = torus.im[0] = 0.0;
  transform(torus);
  double sum = 0.0;
  for (std::uint32_t i = 0; i < period; ++i)
    sum += torus.re[i] * torus.re[i] + torus.im[i] * torus.im[i];
  const double scale = std::sqrt(power * period / sum);
  for (double& v : torus.re) v *= scale;
  for (double& v : torus.im) v *= scale;
  return torus;
}

// P(r) = P(-ln B < r) = (1 - e^-r)^b (1 + b e^-r), B of the law Beta(2, b).
std::vector<double> peak_excess(std::uint32_t period, double b, std::uint64_t seed) {
  constexpr int kSteps = 4096;
  Law law{{0.0}, {0.0}};
  const double top = 16.0 + natural_log(1.0 + b);
  for (int k = 1; k <= kSteps; ++k) {
    // Finer towards 0, where a small b puts most of the mass.
    const double share = static_cast<double>(k) / kSteps;
    const double r = top * share * share, e = natural_exp(-r);
    law.at.push_back(r);
    law.below.push_back(natural_exp(b * natural_log(1.0 - e)) * (1.0 + b * e));
  }
  return quantiles(law, period, seed);
}

// For a < 1 the density has a pole at 0; over y = x^a it is exp(-x) / a, which has none.
std::vector<double> gamma_values(std::uint32_t period, double a, std::uint64_t seed) {
  constexpr int kSteps = 8192;
  Law law{{0.0}, {0.0}};
  const double top = a + 8.0 * std::sqrt(a) + 16.0;
  const bool pole = a < 1.0;
  const double y_top = pole ? natural_exp(a * natural_log(top)) : top;
  const double peak = pole ? 0.0 : (a > 1.0 ? (a - 1.0) * (natural_log(a - 1.0) - 1.0) : 0.0);
  double before = pole || a == 1.0 ? 1.0 : 0.0;
  for (int k = 1; k <= kSteps; ++k) {
    const double y = y_top * k / kSteps;
    const double x = pole ? natural_exp(natural_log(y) / a) : y;
    const double density =
        pole ? natural_exp(-x) : natural_exp((a - 1.0) * natural_log(x) - x - peak);
    law.at.push_back(x);
    law.below.push_back(law.below.back() + 0.5 * (before + density));
    before = density;
  }
  return quantiles(law, period, seed);
}

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
  static SharedTables<std::pair<int, Decimation>, ReceiverNoise> tables;
  const double q = std::clamp(samples, ReceiverNoise::kMinSamples, ReceiverNoise::kMaxSamples);
  const int step = static_cast<int>(std::floor(exact_log2(q) * kStepsPerOctave + 0.5));
  // Correlated noise is not decimated.
  return tables.get({step, step <= 0 ? Decimation::peak : decimation},
                    [&] { return ReceiverNoise(exact_exp2(step / kStepsPerOctave), decimation); });
}

}  // namespace skerry::echo
