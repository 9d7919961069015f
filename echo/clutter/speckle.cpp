#include "echo/clutter/speckle.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <vector>

#include "echo/clutter/lattice_field.hpp"
#include "echo/kernel/exact_math.hpp"
#include "echo/kernel/hash.hpp"

namespace skerry::echo {
namespace {

constexpr int kNoCorrelation = std::numeric_limits<int>::min();

// Eighths of an octave over one.
int step_of(double length) {
  if (!(length >= 0.25)) return kNoCorrelation;
  const double cut = std::min(length, kLongestCorrelation);
  return static_cast<int>(std::floor(8.0 * exact_log2(cut) + 0.5));
}
double length_of_step(int step) { return step == kNoCorrelation ? 0.0 : exact_exp2(step / 8.0); }

}  // namespace

Speckle::Speckle(double spokes, double cells, std::uint64_t seed) {
  const std::vector<float> field = lattice_field(cells, spokes, mixed(seed, 1));
  const std::vector<float> other = lattice_field(cells, spokes, mixed(seed, 2));
  tile_.reserve(field.size() + kLongestRow);
  for (std::size_t i = 0; i < field.size(); ++i) {
    tile_.push_back(field[i] * field[i] + other[i] * other[i]);
  }
  give_exponential_law(tile_);
  tile_.insert(tile_.end(), tile_.begin(), tile_.begin() + kLongestRow);
}

std::span<const float> Speckle::row(std::uint64_t key, std::uint32_t scan, std::uint32_t spoke,
                                    std::uint32_t count, std::uint32_t from) const {
  const auto start = static_cast<std::uint32_t>(mixed(key, scan)) & ~15u;
  const std::uint32_t first = (start + spoke * kLatticeStep) & kLatticeMask;
  // The tile is larger than the nearer caches, and the next row far from this one.
  const float* const next = tile_.data() + ((first + kLatticeStep) & kLatticeMask);
  for (std::uint32_t i = from; i < count; i += 16) __builtin_prefetch(next + i, 0, 2);
  return std::span(tile_).subspan(first, std::min(count, kLongestRow));
}

std::shared_ptr<const Speckle> speckle_for(double spokes, double cells) {
  struct Kept {
    int spokes, cells;
    std::shared_ptr<const Speckle> speckle;
  };
  constexpr std::size_t kMostKept = 16;
  static std::mutex mutex;
  static std::vector<Kept> kept;  // last used first
  const int s = step_of(spokes), c = step_of(cells);
  const std::lock_guard lock(mutex);
  auto found = std::find_if(kept.begin(), kept.end(),
                            [&](const Kept& k) { return k.spokes == s && k.cells == c; });
  if (found == kept.end()) {
    if (kept.size() == kMostKept) kept.pop_back();
    kept.push_back(
        {s, c, std::make_shared<const Speckle>(length_of_step(s), length_of_step(c), 0x5EEDull)});
    found = kept.end() - 1;
  }
  std::rotate(kept.begin(), found, found + 1);
  return kept.front().speckle;
}

SpeckleLengths speckle_lengths(const RadarModel& model, double lifetime_s) {
  const double spokes_per_turn = model.geometry.spokes_per_turn;
  const double beam = 0.849 * model.set.beam_width_deg / 360.0 * spokes_per_turn;
  const double time =
      lifetime_s / model.clock.with_spokes(model.geometry.spokes_per_turn).seconds_per_spoke();
  return {beam * time / std::sqrt(beam * beam + time * time), 0.632 * model.pulse_cells};
}

}  // namespace skerry::echo
