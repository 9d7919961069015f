#include "echo/receiver/automatic_controls.hpp"

#include <algorithm>
#include <array>

#include "echo/kernel/coherent_receiver.hpp"
#include "echo/receiver/log_video.hpp"
#include "protocol/quantity/length.hpp"

namespace skerry::echo {

void AutoGain::add(double level_db) {
  const double place = std::clamp((level_db - kLowestDb) / kStepDb, 0.0, kClasses - 1.0);
  ++counts_[static_cast<std::size_t>(place)];
  ++bins_;
}

void AutoGain::finish_turn() {
  if (bins_ > 0) {
    std::uint64_t below = 0;
    std::size_t at = 0;
    while (at + 1 < kClasses && 2 * (below + counts_[at]) < bins_) below += counts_[at++];
    const double now = kLowestDb + kStepDb * (static_cast<double>(at) + 0.5);
    median_db_ = median_db_ ? 0.5 * (*median_db_ + now) : now;
  }
  drop_turn();
}

void AutoGain::drop_turn() {
  counts_.fill(0);
  bins_ = 0;
}

double AutoGain::threshold_db() const {
  return std::clamp(median_db_.value_or(0.0) + kOverMedianDb, kLeastDb, kMostDb);
}

AutoSea::AutoSea(std::uint32_t spokes_per_turn, std::uint32_t cells, double cell_m,
                 std::uint32_t blind_cells, double noise_octaves)
    : spokes_(spokes_per_turn),
      bins_(cells / static_cast<std::uint32_t>(kLevelCells)),
      first_bin_(std::min(bins_ - 1, blind_cells / static_cast<std::uint32_t>(kLevelCells))),
      reach_bins_(static_cast<std::uint32_t>(
          std::min<double>(bins_, nautical_miles(kReachNm).in_metres() / (cell_m * kLevelCells)))),
      noise_octaves_(noise_octaves),
      sectors_(kBearings, Sector{false, std::vector<double>(bins_)}),
      sums_(bins_) {}

std::uint32_t AutoSea::sector_of(std::uint32_t spoke_in_turn) const {
  return static_cast<std::uint32_t>(std::uint64_t{spoke_in_turn} * kBearings / spokes_);
}

std::uint32_t AutoSea::first_spoke_of(std::uint32_t sector) const {
  return static_cast<std::uint32_t>((std::uint64_t{sector} * spokes_ + kBearings - 1) / kBearings);
}

bool AutoSea::samples(std::uint32_t spoke_in_turn) const {
  const std::uint32_t step = std::max(1u, spokes_ / (kBearings * 8));
  return (spoke_in_turn - first_spoke_of(sector_of(spoke_in_turn))) % step == 0;
}

void AutoSea::add(std::span<const std::int32_t> sums) {
  for (std::uint32_t b = 0; b < bins_; ++b) sums_[b] += sums[b];
  ++sampled_;
}

void AutoSea::drop_sector() {
  std::fill(sums_.begin(), sums_.end(), 0);
  sampled_ = 0;
}

void AutoSea::finish_sector(std::uint32_t sector) {
  Sector& s = sectors_[sector];
  if (sampled_ > 0) {
    const double share = 1.0 / (256.0 * static_cast<double>(kLevelCells) * sampled_);
    for (std::uint32_t b = 0; b < bins_; ++b) {
      const double now =
          (static_cast<double>(sums_[b]) * share - noise_octaves_) * kDecibelsPerOctave;
      s.level_db[b] = s.known ? 0.5 * (s.level_db[b] + now) : now;
    }
    s.known = true;
  }
  drop_sector();
  if (sector + 1 == kBearings) learn_turn();
}

void AutoSea::learn_turn() {
  for (const Sector& s : sectors_) {
    if (!s.known) return;
  }
  turn_db_.resize(bins_);
  std::array<double, kBearings> levels{};
  for (std::uint32_t b = 0; b < bins_; ++b) {
    for (std::uint32_t k = 0; k < kBearings; ++k) levels[k] = sectors_[k].level_db[b];
    std::nth_element(levels.begin(), levels.begin() + kBearings / 2, levels.end());
    turn_db_[b] = levels[kBearings / 2];
  }
}

bool AutoSea::knows(std::uint32_t sector) const {
  return sectors_[sector].known || sectors_[(sector + kBearings - 1) % kBearings].known;
}

void AutoSea::attenuation(std::uint32_t sector, double trim_db, double most_db,
                          std::span<double> db) const {
  std::fill(db.begin(), db.end(), 0.0);
  std::array<double, 3> weights{};
  double known = 0.0;
  for (std::uint32_t k = 0; k < 3; ++k) {
    weights[k] = sectors_[(sector + kBearings - 1 + k) % kBearings].known ? 1.0 : 0.0;
    known += weights[k];
  }
  if (known == 0.0) return;
  const auto level = [&](std::uint32_t b) {
    double sum = 0.0;
    for (std::uint32_t k = 0; k < 3; ++k)
      sum += weights[k] * sectors_[(sector + kBearings - 1 + k) % kBearings].level_db[b];
    const double mean = sum / known;
    return turn_db_.empty() ? mean : std::min(mean, turn_db_[b] + kAboveTurnDb);
  };
  double so_far = most_db;
  for (std::uint32_t b = first_bin_; b < reach_bins_; ++b) {
    const double smooth =
        (level(b > first_bin_ ? b - 1 : b) + level(b) + level(b + 1 < reach_bins_ ? b + 1 : b)) /
        3.0;
    const double wanted = smooth < kDeadDb ? 0.0 : smooth + trim_db;
    so_far = std::clamp(wanted, 0.0, so_far);
    db[b] = so_far;
  }
  // Before the first bin looked at, as much as in it.
  std::fill(db.begin(), db.begin() + first_bin_, db[first_bin_]);
}

}  // namespace skerry::echo
