#include "echo/clutter/speckle.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "echo/clutter/lattice_field.hpp"
#include "echo/kernel/exact_math.hpp"
#include "echo/kernel/hash.hpp"
#include "echo/kernel/shared_tables.hpp"
#include "echo/kernel/speckle_fade.hpp"
#include "echo/radar/range_response.hpp"

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

Speckle::Speckle(double spokes, double cells, std::uint64_t seed)
    : spokes_(std::min(spokes, kLongestCorrelation)) {
  const std::vector<float> field = lattice_field(cells, spokes, mixed(seed, 1));
  const std::vector<float> other = lattice_field(cells, spokes, mixed(seed, 2));
  in_phase_.assign(field.begin(), field.end());
  quadrature_.assign(other.begin(), other.end());
  tile_.reserve(field.size() + kLongestRow);
  for (std::size_t i = 0; i < field.size(); ++i) {
    tile_.push_back(field[i] * field[i] + other[i] * other[i]);
  }
  const AlignedFloats powers = tile_;
  give_exponential_law(tile_);
  learn_law(powers);
  for (AlignedFloats* ring : {&tile_, &in_phase_, &quadrature_}) {
    ring->reserve(ring->size() + kLongestRow);
    ring->insert(ring->end(), ring->begin(), ring->begin() + kLongestRow);
  }
  packed_.resize(tile_.size() + kRowPadding);
  std::transform(tile_.begin(), tile_.end(), packed_.begin(), packed_value);
}

// Means of the tile by steps of the power's root; a knot that no value came near has its
// neighbour's.
void Speckle::learn_law(std::span<const float> powers) {
  const float most = *std::max_element(powers.begin(), powers.end());
  to_knot_ = static_cast<float>(kLawKnots - 2) / std::sqrt(most);
  law_.assign(kLawKnots, 0.0f);
  std::vector<double> sums(kLawKnots, 0.0), counts(kLawKnots, 0.0);
  for (std::size_t i = 0; i < powers.size(); ++i) {
    const auto knot = static_cast<std::size_t>(std::sqrt(powers[i]) * to_knot_ + 0.5f);
    sums[knot] += static_cast<double>(tile_[i]), counts[knot] += 1.0;
  }
  float last = 0.0f;
  for (std::size_t k = 1; k < kLawKnots; ++k) {
    if (counts[k] > 0.0) last = static_cast<float>(sums[k] / counts[k]);
    law_[k] = last;
  }
}

std::uint32_t Speckle::fading_spokes(std::uint32_t spokes_per_turn) const {
  return std::min(static_cast<std::uint32_t>(3.0 * spokes_ + 0.5), spokes_per_turn / 4);
}

std::uint32_t Speckle::place_of(const Spoke& at) const {
  const auto start = static_cast<std::uint32_t>(mixed(at.key, at.scan)) & ~15u;
  return (start + at.spoke * kLatticeStep) & kLatticeMask;
}

// Voltages of this turn and of the next, whose spokes have come before it: turned from one to the
// other by equal angles, so that they stay Gaussian and neighbours as alike as elsewhere.
std::span<const float> Speckle::faded(const Spoke& at, std::uint32_t count,
                                      std::uint32_t from) const {
  const std::uint32_t fading = fading_spokes(at.spokes_per_turn);
  const std::uint32_t left = at.spokes_per_turn - at.spoke;  // fading .. 1
  const SinCos turn = sin_cos_units(
      static_cast<std::uint32_t>((std::uint64_t{fading + 1 - left} << 30) / (fading + 1)));
  const auto here = static_cast<float>(turn.cos), next = static_cast<float>(turn.sin);
  const std::uint32_t a = place_of(at);
  const std::uint32_t b = place_of({at.key, at.scan + 1, 0u - left, at.spokes_per_turn});
  thread_local std::array<AlignedFloats, 2> rows;
  AlignedFloats& row = rows[at.spoke % 2];
  row.resize(kLongestRow);
  const std::uint32_t end = std::min(count, kLongestRow);
  if (from < end) {
    const FadingRows rows_here{in_phase_.data() + a + from,
                               quadrature_.data() + a + from,
                               in_phase_.data() + b + from,
                               quadrature_.data() + b + from,
                               here,
                               next};
    fade_speckle(rows_here, {law_, to_knot_, 2e-6f, 13.0f},
                 std::span(row).subspan(from, end - from));
  }
  return std::span(row).first(end);
}

std::span<const float> Speckle::row(const Spoke& at, std::uint32_t count,
                                    std::uint32_t from) const {
  if (at.spoke + fading_spokes(at.spokes_per_turn) >= at.spokes_per_turn)
    return faded(at, count, from);
  const std::uint32_t first = place_of(at);
  // The tile is larger than the nearer caches, and the next row far from this one.
  const float* const next = tile_.data() + ((first + kLatticeStep) & kLatticeMask);
  for (std::uint32_t i = from; i < count; i += 16) __builtin_prefetch(next + i, 0, 2);
  return std::span(tile_).subspan(first, std::min(count, kLongestRow));
}

std::span<const PackedPower> Speckle::packed_row(const Spoke& at, std::uint32_t count,
                                                 std::uint32_t from) const {
  if (at.spoke + fading_spokes(at.spokes_per_turn) >= at.spokes_per_turn) {
    const std::span<const float> row = faded(at, count, from);
    thread_local std::array<std::vector<PackedPower>, 2> kept;
    std::vector<PackedPower>& packed = kept[at.spoke % 2];
    packed.resize(kLongestRow + kRowPadding);
    std::transform(row.begin() + from, row.end(), packed.begin() + from, packed_value);
    return packed;
  }
  const std::uint32_t first = place_of(at);
  const PackedPower* const next = packed_.data() + ((first + kLatticeStep) & kLatticeMask);
  for (std::uint32_t i = from; i < count; i += 32) __builtin_prefetch(next + i, 0, 2);
  return std::span(packed_).subspan(first, std::min(count, kLongestRow) + kRowPadding);
}

std::shared_ptr<const Speckle> speckle_for(double spokes, double cells) {
  static KeptTables<std::pair<int, int>, Speckle, 16> tables;
  const int s = step_of(spokes), c = step_of(cells);
  return tables.get({s, c},
                    [&] { return Speckle(length_of_step(s), length_of_step(c), 0x5EEDull); });
}

SpeckleLengths speckle_lengths(const RadarModel& model, double lifetime_s) {
  const double spokes_per_turn = model.geometry.spokes_per_turn;
  const double beam = 0.849 * model.set.beam_width_deg / 360.0 * spokes_per_turn;
  const double time =
      lifetime_s / model.clock.with_spokes(model.geometry.spokes_per_turn).seconds_per_spoke();
  return {beam * time / std::sqrt(beam * beam + time * time), coherence_cells(range_shape(model))};
}

}  // namespace skerry::echo
