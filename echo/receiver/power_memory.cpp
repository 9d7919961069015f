#include "echo/receiver/power_memory.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "echo/kernel/exact_math.hpp"

namespace skerry::echo {
namespace {

// t^n between two whole n by straight lines between their values.
SharpeningLaw sharpening_law(double power) {
  SharpeningLaw law{};
  const auto below = static_cast<std::size_t>(std::min(std::floor(power), kMostSharpening - 1.0));
  const double part = power - static_cast<double>(below);
  law[below] = static_cast<float>(1.0 - part);
  law[below + 1] = static_cast<float>(part);
  return law;
}

}  // namespace

PowerStages power_stages(const RadarSet& set, std::uint32_t spokes_per_turn,
                         const ViewControls& controls) {
  PowerStages stages;
  if (controls.target_separation > 0.0) {
    const double half_beam = 0.5 * set.beam_width_deg / 360.0 * spokes_per_turn;
    stages.reach =
        static_cast<std::uint32_t>(std::clamp(std::ceil(half_beam), 1.0, 1.0 * kMostReach));
    stages.law = sharpening_law(kMostSharpening * controls.target_separation / 100.0);
  }
  if (controls.side_lobe_suppression > 0.0) {
    const double lobes_db = 2.0 * std::max(set.near_side_lobe_db, set.far_side_lobe_db);
    const double more_db = kSideLobeSpanDb * (controls.side_lobe_suppression - 50.0) / 50.0;
    stages.side_lobe_share = static_cast<float>(ratio_from_decibels(lobes_db + more_db));
  }
  if (controls.target_boost > 0.0) {
    stages.boost =
        static_cast<float>(ratio_from_decibels(kMostBoostDb * controls.target_boost / 100.0) - 1.0);
  }
  return stages;
}

void PowerMemory::set_up(const PowerStages& stages, std::uint32_t cells,
                         std::uint32_t spokes_per_turn) {
  const bool same_cells = cells == cells_ && spokes_per_turn == spokes_per_turn_;
  const bool same_reach = same_cells && stages.reach == stages_.reach;
  const bool same_turns =
      same_cells && (stages.side_lobe_share > 0.0f) == (stages_.side_lobe_share > 0.0f);
  stages_ = stages;
  cells_ = cells;
  spokes_per_turn_ = spokes_per_turn;
  // Rows must not lie a multiple of 4 KiB apart.
  pitch_ = (cells_ + 15) / 16 * 16 + 16;
  if (!same_reach) {
    before_.assign(stages.reach * pitch_, 0.0f);
    known_ = 0;
  }
  if (!same_turns) {
    this_turn_.assign(stages.side_lobe_share > 0.0f ? cells_ : 0, 0.0f);
    last_turn_ = this_turn_;
  }
}

void PowerMemory::forget() {
  known_ = 0;
  std::fill(this_turn_.begin(), this_turn_.end(), 0.0f);
  std::fill(last_turn_.begin(), last_turn_.end(), 0.0f);
}

void PowerMemory::condition(std::uint64_t first, std::uint32_t count, const Rows& rows,
                            std::size_t begin, std::size_t columns, std::span<float> out,
                            std::size_t out_pitch) {
  thread_local std::vector<const float*> all;  // the kept ones that are known, then these
  thread_local AlignedFloats most;
  all.clear();
  for (std::uint32_t k = 0; k < known_; ++k)
    all.push_back(before_.data() + (stages_.reach - known_ + k) * pitch_ + begin);
  for (std::uint32_t k = 0; k < rows.count; ++k)
    all.push_back(rows.cells.data() + k * rows.pitch + begin);
  most.resize(columns);
  for (std::uint32_t k = 0; k < count; ++k) {
    const std::size_t at = known_ + k;
    const std::span power(all[at], columns);
    const auto row = out.subspan(k * out_pitch + begin, columns);
    std::copy(power.begin(), power.end(), row.begin());
    if (stages_.reach > 0) {
      std::copy(power.begin(), power.end(), most.begin());
      const std::size_t from = at > stages_.reach ? at - stages_.reach : 0;
      const std::size_t end = std::min(all.size(), at + stages_.reach + 1);
      for (std::size_t j = from; j < end; ++j) keep_most(most, {all[j], columns});
      sharpen_row(row, most, stages_.law);
    }
    if (stages_.side_lobe_share > 0.0f) {
      const auto now = std::span(this_turn_).subspan(begin, columns);
      const auto last = std::span(last_turn_).subspan(begin, columns);
      if ((first + k) % spokes_per_turn_ == 0) {
        std::copy(now.begin(), now.end(), last.begin());
        std::fill(now.begin(), now.end(), 0.0f);
      }
      keep_most(now, power);
      suppress_row(row, power, now, last, stages_.side_lobe_share);
    }
    if (stages_.boost > 0.0f)
      boost_row(row, stages_.boost, static_cast<float>(ratio_from_decibels(kBoostKneeDb)));
  }
  if (stages_.reach > 0) keep_last(std::span(all).first(known_ + count), begin, columns);
}

// Oldest first: what is copied over has been copied before, or is not needed.
void PowerMemory::keep_last(std::span<const float* const> rows, std::size_t begin,
                            std::size_t columns) {
  const std::size_t kept = std::min<std::size_t>(rows.size(), stages_.reach);
  for (std::size_t k = 0; k < kept; ++k) {
    float* const to = before_.data() + (stages_.reach - kept + k) * pitch_ + begin;
    const float* const from = rows[rows.size() - kept + k];
    if (from != to) std::copy_n(from, columns, to);
  }
}

void PowerMemory::end_spokes(std::uint32_t count) {
  known_ = std::min(stages_.reach, known_ + count);
}

}  // namespace skerry::echo
