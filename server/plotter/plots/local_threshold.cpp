#include "server/plotter/plots/local_threshold.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

namespace skerry::server {
namespace {

constexpr std::uint32_t kFine = 16;  // means and steps are in 16ths of a level

void require(bool right, std::string_view name, std::string_view range) {
  if (!right) throw std::invalid_argument(fmt::format("{}: must be {}", name, range));
}

// Inserts into a sorted list of `count` values.
void insert(std::array<std::uint16_t, 2 * LocalThreshold::kMostAround>& sorted, std::size_t count,
            std::uint16_t value) {
  std::size_t at = count;
  for (; at > 0 && sorted[at - 1] > value; --at) sorted[at] = sorted[at - 1];
  sorted[at] = value;
}

}  // namespace

LocalThreshold::LocalThreshold(const Rule& rule) : rule_(rule) {
  require(rule.around >= 1 && rule.around <= kMostAround, "around", "1 to 8 blocks");
  require(rule.guard < rule.around, "guard", "less than around");
  require(rule.rank >= 0.0 && rule.rank <= 1.0, "rank", "0 to 1");
  require(rule.roughnesses >= 0.0 && rule.roughnesses <= 100.0, "roughnesses", "0 to 100");
  require(rule.least_step >= 1, "least_step", "at least 1 level");
}

void LocalThreshold::measure(std::span<const std::uint8_t> levels) {
  const std::size_t blocks = (levels.size() + kBlock - 1) / kBlock;
  means_.resize(blocks);
  steps_.resize(blocks);
  for (std::size_t b = 0; b < blocks; ++b) {
    const std::uint8_t* cells = levels.data() + b * kBlock;
    const std::size_t count = std::min<std::size_t>(kBlock, levels.size() - b * kBlock);
    std::uint32_t sum = 0, steps = 0;
    if (count == kBlock) {
      for (std::uint32_t i = 0; i < kBlock; ++i) sum += cells[i];
      for (std::uint32_t i = 0; i + 1 < kBlock; ++i)
        steps += static_cast<std::uint32_t>(std::abs(cells[i + 1] - cells[i]));
    } else {
      for (std::size_t i = 0; i < count; ++i) sum += cells[i];
      for (std::size_t i = 0; i + 1 < count; ++i)
        steps += static_cast<std::uint32_t>(std::abs(cells[i + 1] - cells[i]));
      sum = sum * kBlock / static_cast<std::uint32_t>(count);
      steps =
          steps * (kBlock - 1) / static_cast<std::uint32_t>(std::max<std::size_t>(count, 2) - 1);
    }
    means_[b] = static_cast<std::uint16_t>(sum * kFine / kBlock);
    steps_[b] = static_cast<std::uint16_t>(steps * kFine / (kBlock - 1));
  }
}

void LocalThreshold::set_thresholds() {
  const std::size_t blocks = means_.size();
  backgrounds_.resize(blocks);
  thresholds_.resize(blocks);
  const auto roughnesses = static_cast<std::uint32_t>(rule_.roughnesses * 256.0 + 0.5);
  for (std::size_t b = 0; b < blocks; ++b) {
    std::array<std::uint16_t, 2 * kMostAround> means, steps;
    std::size_t count = 0;
    const auto take = [&](std::size_t from, std::size_t to) {
      for (std::size_t i = from; i < to; ++i, ++count) {
        insert(means, count, means_[i]);
        insert(steps, count, steps_[i]);
      }
    };
    take(b > rule_.around ? b - rule_.around : 0, b > rule_.guard ? b - rule_.guard : 0);
    take(std::min(blocks, b + rule_.guard + 1), std::min(blocks, b + rule_.around + 1));
    std::uint32_t background = 0, roughness = 0;
    if (count > 0) {
      const auto at = static_cast<std::size_t>(rule_.rank * static_cast<double>(count - 1) + 0.5);
      background = std::min<std::uint32_t>(means[at], rule_.most_background * kFine);
      roughness = steps[at];
    }
    const std::uint32_t over =
        std::max<std::uint32_t>(rule_.least_step * kFine, (roughness * roughnesses) >> 8);
    backgrounds_[b] = static_cast<std::uint8_t>(background / kFine);
    thresholds_[b] = static_cast<std::uint8_t>(std::min((background + over) / kFine, 255u));
  }
}

void LocalThreshold::find(std::span<const std::uint8_t> levels, std::vector<Run>& out) {
  measure(levels);
  set_thresholds();
  bool open = false;
  for (std::size_t b = 0; b < thresholds_.size(); ++b) {
    const std::size_t first = b * kBlock;
    const std::size_t count = std::min<std::size_t>(kBlock, levels.size() - first);
    const std::uint8_t* cells = levels.data() + first;
    const std::uint8_t threshold = thresholds_[b];
    std::uint8_t greatest = 0;
    for (std::size_t i = 0; i < count; ++i) greatest = std::max(greatest, cells[i]);
    if (greatest <= threshold) {
      open = false;
      continue;
    }
    for (std::size_t i = 0; i < count; ++i) {
      if (cells[i] <= threshold) {
        open = false;
      } else if (open) {
        out.back().end = static_cast<std::uint32_t>(first + i + 1);
      } else {
        out.push_back(
            {static_cast<std::uint32_t>(first + i), static_cast<std::uint32_t>(first + i + 1)});
        open = true;
      }
    }
  }
}

}  // namespace skerry::server
