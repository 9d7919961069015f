#include "echo/measure/picture_patches.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace skerry::echo {
namespace {

constexpr std::uint32_t kSide = PicturePatch::kSide;
constexpr std::array<std::uint32_t, 5> kPatchLags = {1, 2, 4, 8, 16};
constexpr float kLeastOccupancy = 0.05f, kMostOccupancy = 0.98f;

constexpr std::array<std::string_view, kPatchFeatures> kFeatureNames = {
    "edges across spokes",
    "edges across cells",
    "holes of one spoke",
    "specks of one spoke",
    "holes of one cell",
    "specks of one cell",
    "run in range p10",
    "run in range p50",
    "run in range p90",
    "run in bearing p10",
    "run in bearing p50",
    "run in bearing p90",
    "gap in range p50",
    "gap in bearing p50",
    "mask, spoke lag 1",
    "mask, spoke lag 2",
    "mask, spoke lag 4",
    "mask, spoke lag 8",
    "mask, spoke lag 16",
    "mask, range lag 1",
    "mask, range lag 2",
    "mask, range lag 4",
    "mask, range lag 8",
    "mask, range lag 16",
    "patches of echo",
    "largest patch",
    "share in small patches",
    "perimeter",
    "levels 1 to 3",
    "levels 4 to 7",
    "levels 8 to 11",
    "levels 12 to 14",
    "level 15",
    "spoke lag 1",
    "spoke lag 2",
    "spoke lag 4",
    "spoke lag 8",
    "spoke lag 16",
    "range lag 1",
    "range lag 2",
    "range lag 4",
    "range lag 8",
    "range lag 16",
    "step from spoke to spoke",
    "step from cell to cell",
    "first level in range",
    "second level in range",
    "last level in range",
    "first level in bearing",
    "cells to level 12",
};

// Levels 0 to 15 of one patch.
struct Levels {
  std::array<std::uint8_t, kSide * kSide> at_spoke_cell;
  std::uint8_t at(std::uint32_t s, std::uint32_t c) const { return at_spoke_cell[s * kSide + c]; }
};

// Along spokes or along cells: the same code for both.
struct Along {
  const Levels& levels;
  bool range;  // else across spokes
  std::uint8_t at(std::uint32_t line, std::uint32_t step) const {
    return range ? levels.at(line, step) : levels.at(step, line);
  }
};

struct Runs {
  std::vector<float> on, gaps;  // cells
  double holes = 0.0, specks = 0.0, edges = 0.0;
};

Runs runs_of(const Along& way) {
  Runs runs;
  for (std::uint32_t line = 0; line < kSide; ++line) {
    std::uint32_t from = 0;
    for (std::uint32_t k = 1; k <= kSide; ++k) {
      const bool on = way.at(line, from) > 0;
      if (k < kSide && (way.at(line, k) > 0) == on) continue;
      const std::uint32_t length = k - from;
      const bool inside = from > 0 && k < kSide;
      if (k < kSide) runs.edges += 1.0;
      if (on) runs.on.push_back(static_cast<float>(length));
      if (!on && inside) runs.gaps.push_back(static_cast<float>(length));
      if (length == 1 && inside) (on ? runs.specks : runs.holes) += 1.0;
      from = k;
    }
  }
  return runs;
}

float log_quantile(std::vector<float>& values, double share) {
  if (values.empty()) return 0.0f;
  const auto at = values.begin() +
                  static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1) + 0.5);
  std::nth_element(values.begin(), at, values.end());
  return static_cast<float>(std::log2(static_cast<double>(*at)));
}

// Correlation of what `value` gives of two cells `lag` apart; 0 where it has no spread.  `both`:
// only of pairs that both echo.
template <typename Value>
float lag_correlation(const Along& way, std::uint32_t lag, bool both, Value value) {
  double n = 0.0, x = 0.0, y = 0.0, xx = 0.0, yy = 0.0, xy = 0.0;
  for (std::uint32_t line = 0; line < kSide; ++line) {
    for (std::uint32_t k = 0; k + lag < kSide; ++k) {
      const std::uint8_t first = way.at(line, k), second = way.at(line, k + lag);
      if (both && (first == 0 || second == 0)) continue;
      const double a = value(first), b = value(second);
      n += 1.0, x += a, y += b, xx += a * a, yy += b * b, xy += a * b;
    }
  }
  const double spread = n > 1.0 ? (xx - x * x / n) * (yy - y * y / n) : 0.0;
  return spread > 1e-9 ? static_cast<float>((xy - x * y / n) / std::sqrt(spread)) : 0.0f;
}

// Mean difference of two neighbours that both echo.
float mean_step(const Along& way) {
  double n = 0.0, sum = 0.0;
  for (std::uint32_t line = 0; line < kSide; ++line) {
    for (std::uint32_t k = 0; k + 1 < kSide; ++k) {
      const int a = way.at(line, k), b = way.at(line, k + 1);
      if (a == 0 || b == 0) continue;
      n += 1.0, sum += std::abs(a - b);
    }
  }
  return n > 0.0 ? static_cast<float>(sum / n) : 0.0f;
}

// How runs of three cells at least begin and end.
struct Flanks {
  float first = 0.0f, second = 0.0f, last = 0.0f, to_twelve = 0.0f;
};
Flanks flanks_of(const Along& way) {
  double begins = 0.0, first = 0.0, second = 0.0, ends = 0.0, last = 0.0, risen = 0.0, cells = 0.0;
  for (std::uint32_t line = 0; line < kSide; ++line) {
    for (std::uint32_t k = 1; k + 3 < kSide; ++k) {
      if (way.at(line, k - 1) == 0 && way.at(line, k) > 0 && way.at(line, k + 1) > 0 &&
          way.at(line, k + 2) > 0) {
        begins += 1.0, first += way.at(line, k), second += way.at(line, k + 1);
        for (std::uint32_t r = k; r < kSide && way.at(line, r) > 0; ++r) {
          if (way.at(line, r) < 12) continue;
          risen += 1.0, cells += r - k;
          break;
        }
      }
      if (k >= 2 && way.at(line, k) > 0 && way.at(line, k - 1) > 0 && way.at(line, k - 2) > 0 &&
          way.at(line, k + 1) == 0)
        ends += 1.0, last += way.at(line, k);
    }
  }
  const auto mean = [](double sum, double n) {
    return n > 0.0 ? static_cast<float>(sum / n) : 0.0f;
  };
  return {mean(first, begins), mean(second, begins), mean(last, ends), mean(cells, risen)};
}

// Sizes of what hangs together by sides.
std::vector<std::uint32_t> sizes_of_patches(const Levels& levels) {
  std::vector<std::uint32_t> sizes;
  std::array<bool, kSide * kSide> seen{};
  std::vector<std::uint32_t> open;
  for (std::uint32_t start = 0; start < kSide * kSide; ++start) {
    if (seen[start] || levels.at_spoke_cell[start] == 0) continue;
    std::uint32_t size = 0;
    const auto visit = [&](std::uint32_t at) {
      if (seen[at] || levels.at_spoke_cell[at] == 0) return;
      seen[at] = true;
      open.push_back(at);
    };
    visit(start);
    while (!open.empty()) {
      const std::uint32_t at = open.back();
      open.pop_back();
      ++size;
      if (at % kSide > 0) visit(at - 1);
      if (at % kSide + 1 < kSide) visit(at + 1);
      if (at >= kSide) visit(at - kSide);
      if (at + kSide < kSide * kSide) visit(at + kSide);
    }
    sizes.push_back(size);
  }
  return sizes;
}

PatchFeatures features_of(const Levels& levels, double on) {
  PatchFeatures out{};
  std::size_t at = 0;
  const auto add = [&](double value) { out[at++] = static_cast<float>(value); };
  const Along bearing{levels, false}, range{levels, true};
  Runs across = runs_of(bearing), along = runs_of(range);
  add(across.edges / on), add(along.edges / on);
  add(across.holes / on), add(across.specks / on), add(along.holes / on), add(along.specks / on);
  for (Runs* runs : {&along, &across}) {
    for (const double share : {0.1, 0.5, 0.9}) add(log_quantile(runs->on, share));
  }
  add(log_quantile(along.gaps, 0.5)), add(log_quantile(across.gaps, 0.5));
  const auto is_on = [](std::uint8_t v) { return v > 0 ? 1.0 : 0.0; };
  for (const Along* way : {&bearing, &range}) {
    for (const std::uint32_t lag : kPatchLags) add(lag_correlation(*way, lag, false, is_on));
  }
  const std::vector<std::uint32_t> sizes = sizes_of_patches(levels);
  add(std::log2(1.0 + static_cast<double>(sizes.size())));
  add(*std::max_element(sizes.begin(), sizes.end()) / on);
  add(std::accumulate(sizes.begin(), sizes.end(), 0.0,
                      [](double sum, std::uint32_t size) { return size < 8 ? sum + size : sum; }) /
      on);
  add((across.edges + along.edges) / std::sqrt(on));

  std::array<double, 16> by_level{};
  for (const std::uint8_t v : levels.at_spoke_cell) by_level[v] += 1.0;
  for (const auto& [from, to] : {std::pair{1, 3}, {4, 7}, {8, 11}, {12, 14}, {15, 15}})
    add(std::accumulate(by_level.begin() + from, by_level.begin() + to + 1, 0.0) / on);
  const auto level = [](std::uint8_t v) { return static_cast<double>(v); };
  for (const Along* way : {&bearing, &range}) {
    for (const std::uint32_t lag : kPatchLags) add(lag_correlation(*way, lag, true, level));
  }
  add(mean_step(bearing)), add(mean_step(range));
  const Flanks flanks = flanks_of(range);
  add(flanks.first), add(flanks.second), add(flanks.last);
  add(flanks_of(bearing).first);
  add(flanks.to_twelve);
  return out;
}

}  // namespace

std::string_view patch_feature_name(std::size_t feature) { return kFeatureNames.at(feature); }

std::vector<PicturePatch> patches_of(const PictureTurn& turn, std::uint32_t place, double from_m) {
  require_valid(turn, {});
  std::vector<PicturePatch> patches;
  const auto begin = static_cast<std::uint32_t>(std::max(0.0, std::ceil(from_m / turn.cell_m)));
  Levels levels;
  for (std::uint32_t s = 0; s + kSide <= turn.spokes; s += kSide) {
    for (std::uint32_t c = begin; c + kSide <= turn.cells; c += kSide) {
      double on = 0.0;
      for (std::uint32_t i = 0; i < kSide; ++i) {
        for (std::uint32_t k = 0; k < kSide; ++k) {
          const auto v =
              static_cast<std::uint8_t>(turn.at(s + i, c + k) * 16u / (turn.full_scale + 1u));
          levels.at_spoke_cell[i * kSide + k] = v;
          on += v > 0 ? 1.0 : 0.0;
        }
      }
      const auto occupancy = static_cast<float>(on / (kSide * kSide));
      if (occupancy < kLeastOccupancy || occupancy > kMostOccupancy) continue;
      patches.push_back({place, s * 4 / turn.spokes, s, c, occupancy, features_of(levels, on)});
    }
  }
  return patches;
}

}  // namespace skerry::echo
