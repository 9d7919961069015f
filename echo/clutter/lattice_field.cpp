#include "echo/clutter/lattice_field.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <memory>
#include <mutex>
#include <numbers>

#include "echo/kernel/azimuth_sum.hpp"
#include "echo/kernel/exact_math.hpp"
#include "echo/kernel/hash.hpp"

namespace skerry::echo {
namespace {

// Box and Muller: two Gaussian values of two hashes.
std::vector<float> make_white_normals(std::uint64_t seed) {
  std::vector<float> white(kLatticeSize);
  for (std::uint32_t i = 0; i < kLatticeSize; i += 2) {
    const double u = as_unit(mixed(seed, i)) + 0x1p-54;
    const double radius = std::sqrt(-2.0 * std::numbers::ln2 * exact_log2(u));
    const SinCos turn = sin_cos_units(static_cast<std::uint32_t>(mixed(seed, i + 1) >> 32));
    white[i] = static_cast<float>(radius * turn.cos);
    white[i + 1] = static_cast<float>(radius * turn.sin);
  }
  return white;
}

// All speckle is made of two seeds' values: those of the seeds used last are kept.
std::shared_ptr<const std::vector<float>> white_normals(std::uint64_t seed) {
  struct Kept {
    std::uint64_t seed;
    std::shared_ptr<const std::vector<float>> values;
  };
  constexpr std::size_t kMostKept = 3;
  static std::mutex mutex;
  static std::vector<Kept> kept;  // last used first
  const std::lock_guard lock(mutex);
  auto found =
      std::find_if(kept.begin(), kept.end(), [&](const Kept& k) { return k.seed == seed; });
  if (found == kept.end()) {
    if (kept.size() == kMostKept) kept.pop_back();
    kept.push_back({seed, std::make_shared<const std::vector<float>>(make_white_normals(seed))});
    found = kept.end() - 1;
  }
  std::rotate(kept.begin(), found, found + 1);
  return kept.front().values;
}

// Weights -half .. half of exp(-2 (d / length)^2), whose autocorrelation is exp(-(d / length)^2).
std::vector<float> gaussian_weights(double length) {
  std::vector<float> one_side = {1.0f};
  for (int d = 1; length > 0.0; ++d) {
    const double weight = exact_exp2(-2.0 * std::numbers::log2e * d * d / (length * length));
    if (weight < 1e-4) break;
    one_side.push_back(static_cast<float>(weight));
  }
  std::vector<float> weights(one_side.rbegin(), one_side.rend());
  weights.insert(weights.end(), one_side.begin() + 1, one_side.end());
  return weights;
}

// out[i] = sum over k of weights[k] * in[i + (k - half) * step], indices modulo the ring.
std::vector<float> filtered(std::span<const float> in, double length, std::uint32_t step) {
  const std::vector<float> weights = gaussian_weights(length);
  if (weights.size() == 1) return {in.begin(), in.end()};
  constexpr std::uint32_t kBlock = 4096;
  std::vector<float> ring(in.begin(), in.end());
  ring.insert(ring.end(), in.begin(), in.begin() + kBlock);
  std::vector<float> out(kLatticeSize);
  std::vector<WeightedRay> taps(weights.size());
  const auto half = static_cast<std::uint32_t>(weights.size() / 2);
  for (std::uint32_t first = 0; first < kLatticeSize; first += kBlock) {
    for (std::uint32_t k = 0; k < taps.size(); ++k) {
      taps[k] = {ring.data() + ((first + (k - half) * step) & kLatticeMask), weights[k]};
    }
    sum_rays(taps, std::span(out).subspan(first, kBlock));
  }
  return out;
}

}  // namespace

std::vector<float> lattice_field(double along, double across, std::uint64_t seed) {
  std::vector<float> field =
      filtered(*white_normals(seed), std::clamp(along, 0.0, kLongestCorrelation), 1);
  field = filtered(field, std::clamp(across, 0.0, kLongestCorrelation), kLatticeStep);
  double sum = 0.0, squares = 0.0;
  for (const float v : field) sum += v;
  const double mean = sum / kLatticeSize;
  for (const float v : field) squares += (v - mean) * (v - mean);
  const double scale = 1.0 / std::sqrt(squares / kLatticeSize);
  for (float& v : field) v = static_cast<float>((v - mean) * scale);
  return field;
}

void give_exponential_law(std::span<float> values) {
  constexpr int kLowBits = 16;
  std::vector<std::uint32_t> below((std::size_t{1} << (32 - kLowBits)) + 1, 0);
  for (const float v : values) ++below[(std::bit_cast<std::uint32_t>(v) >> kLowBits) + 1];
  for (std::size_t b = 1; b < below.size(); ++b) below[b] += below[b - 1];
  const double share = 1.0 / static_cast<double>(values.size());
  for (float& v : values) {
    const auto bits = std::bit_cast<std::uint32_t>(v);
    const std::uint32_t bin = bits >> kLowBits;
    const double within = ((bits & ((1u << kLowBits) - 1)) + 0.5) * (1.0 / (1u << kLowBits));
    const double rank = below[bin] + within * (below[bin + 1] - below[bin]);
    // The ends are half a rank away from 0 and 1, so the value is finite and positive.
    const double above = 1.0 - std::clamp(rank * share, 0.5 * share, 1.0 - 0.5 * share);
    v = static_cast<float>(-std::numbers::ln2 * exact_log2(above));
  }
}

}  // namespace skerry::echo
