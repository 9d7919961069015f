#include "echo/spoke_land.hpp"

#include <algorithm>

#include "echo/kernel/hash.hpp"

namespace skerry::echo {
namespace {

// Rock, trees and houses keep their phases for as long as a beam takes to pass: what is renewed
// from turn to turn (SOURCES.md "Pictures (g)") is a matter of the ship's own way.
constexpr double kLandLifetime = 1.0;  // seconds
// Share of land's mean power that comes from what stands out in its cell and stays: a Rician cell.
// Turns then correlate as land's do (SOURCES.md "Pictures (g)").
constexpr double kSteadyLand = 0.35;
constexpr std::uint64_t kLandSpeckle = 0x1A4D5;

}  // namespace

SpokeLand::SpokeLand(const RadarModel& model)
    : radar_(model.radar), spokes_per_turn_(model.geometry.spokes_per_turn) {
  const SpeckleLengths lengths = speckle_lengths(model, kLandLifetime);
  speckle_ = speckle_for(lengths.spokes, lengths.cells);
}

SpeckledRow SpokeLand::speckled(std::uint64_t seed, std::span<const MovedRun> runs,
                                const SpokeAim& aim, std::span<float> row) const {
  return {speckle_->packed_row(
              {mixed(seed, radar_, kLandSpeckle), aim.scan, aim.index, spokes_per_turn_},
              runs.back().first + runs.back().count, runs.front().first),
          row};
}

void SpokeLand::lay(std::uint64_t seed, std::span<const MovedRun> runs,
                    std::span<const SpokeAim> aims, std::span<const std::span<float>> rows) const {
  constexpr auto kFluctuates = static_cast<float>(1.0 - kSteadyLand);
  if (runs.empty()) {
    for (const std::span<float> row : rows) std::fill(row.begin(), row.end(), 0.0f);
  } else if (rows.size() == 1) {
    lay_moved(runs, kFluctuates, speckled(seed, runs, aims[0], rows[0]));
  } else {
    lay_moved(runs, kFluctuates, speckled(seed, runs, aims[0], rows[0]),
              speckled(seed, runs, aims[1], rows[1]));
  }
}

}  // namespace skerry::echo
