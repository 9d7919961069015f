#include "echo/artefacts/minimum_range.hpp"

#include <algorithm>

#include "echo/kernel/exact_math.hpp"

namespace skerry::echo {
namespace {
constexpr double kSeenDb = 0.01;  // less is nothing
}

MinimumRange::MinimumRange(const RadarModel& model) {
  factors_.assign(model.blind_cells, 0.0f);
  constexpr double kLog2E = 1.4426950408889634;
  const double octaves_per_cell = kLog2E * 2.0 * model.cell_m / (kLightSpeed * kTailSeconds);
  // A cell's loss is that in its middle.
  for (std::uint32_t cell = 0; model.blind_cells + cell < model.geometry.cells; ++cell) {
    const double loss_db = kTailDb * exact_exp2(std::max(-100.0, -octaves_per_cell * (cell + 0.5)));
    if (loss_db < kSeenDb) break;
    factors_.push_back(static_cast<float>(ratio_from_decibels(-loss_db)));
  }
}

void MinimumRange::apply(const Artefacts& artefacts, std::span<float> power) const {
  if (!artefacts.minimum_range) return;
  const std::size_t count = std::min(power.size(), factors_.size());
  for (std::size_t i = 0; i < count; ++i) power[i] *= factors_[i];
}

}  // namespace skerry::echo
