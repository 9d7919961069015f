// The shape of rain areas against the published law.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <vector>

#include "echo/rain/rain_map.hpp"
#include "tests/unit/rain/rain_reference.hpp"

namespace skerry::echo {
namespace {

struct Island {
  double area = 0.0, outline = 0.0, holes = 0.0;  // in values
};

// What joins the map's border, which is dry, over sides and corners.
std::vector<char> outside_of(const GridView& grid, float threshold) {
  const auto columns = static_cast<int>(grid.columns), rows = static_cast<int>(grid.rows);
  std::vector<char> outside(static_cast<std::size_t>(columns * rows), 0);
  std::vector<int> stack = {0};
  outside[0] = 1;
  while (!stack.empty()) {
    const int at = stack.back();
    stack.pop_back();
    for (int r = std::max(at / columns - 1, 0); r <= std::min(at / columns + 1, rows - 1); ++r) {
      for (int c = std::max(at % columns - 1, 0); c <= std::min(at % columns + 1, columns - 1);
           ++c) {
        const auto next = static_cast<std::size_t>(r * columns + c);
        if (outside[next] != 0 || grid.values[next] > threshold) continue;
        outside[next] = 1;
        stack.push_back(static_cast<int>(next));
      }
    }
  }
  return outside;
}

// Patches of values over a threshold that join at their sides.
std::vector<Island> islands_of(const GridView& grid, float threshold) {
  const auto columns = grid.columns, rows = grid.rows;
  const std::vector<char> outside = outside_of(grid, threshold);
  std::vector<char> seen(std::size_t{columns} * rows, 0);
  std::vector<std::uint32_t> stack;
  std::vector<Island> islands;
  for (std::uint32_t start = 0; start < columns * rows; ++start) {
    if (seen[start] != 0 || grid.values[start] <= threshold) continue;
    Island island;
    stack.assign(1, start);
    seen[start] = 1;
    while (!stack.empty()) {
      const std::uint32_t at = stack.back();
      stack.pop_back();
      island.area += 1.0;
      // The map's border is dry: every wet value has four neighbours.
      for (const std::uint32_t next : {at - 1, at + 1, at - columns, at + columns}) {
        if (grid.values[next] <= threshold) {
          (outside[next] != 0 ? island.outline : island.holes) += 1.0;
        } else if (seen[next] == 0) {
          seen[next] = 1;
          stack.push_back(next);
        }
      }
    }
    islands.push_back(island);
  }
  return islands;
}

// D of perimeters that go as the areas to the power of D / 2, by octaves of area, so that the few
// large ones weigh as much as the many small ones.
class AreaLaw {
 public:
  void add(double area, double perimeter) {
    Bin& bin = bins_[static_cast<std::size_t>(std::log2(area))];
    bin.area += std::log(area), bin.perimeter += std::log(perimeter), bin.count += 1.0;
  }
  double dimension() const {
    double n = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
    for (const Bin& bin : bins_) {
      if (bin.count < 10.0) continue;
      const double a = bin.area / bin.count, p = bin.perimeter / bin.count;
      n += 1.0, x += a, y += p, xx += a * a, xy += a * p;
    }
    return 2.0 * (n * xy - x * y) / (n * xx - x * x);
  }

 private:
  struct Bin {
    double area = 0.0, perimeter = 0.0, count = 0.0;
  };
  std::vector<Bin> bins_ = std::vector<Bin>(24);
};

// D = 1.35 +- 0.05 (Lovejoy 1982); bound 0.1.  Areas of 20 values and more over seven thresholds
// from 0 to 4 times the rate in 24 areas of 18 km radius of each kind; perimeters with those of
// holes, and without.
TEST(RainShape, AreasAndPerimetersAreRainsOwn) {
  for (const RainKind kind : kFractalRain) {
    AreaLaw with_holes, without;
    int patches = 0;
    for (std::uint64_t seed = 1; seed <= 24; ++seed) {
      const RainMap map({seed, kind, 18000.0, static_cast<std::int64_t>(seed * 100)});
      for (const float threshold : {0.0f, 0.1f, 0.25f, 0.5f, 1.0f, 2.0f, 4.0f}) {
        for (const Island& island : islands_of(map.level(0), threshold)) {
          if (island.area < 20.0) continue;
          ++patches;
          with_holes.add(island.area, island.outline + island.holes);
          if (island.outline > 0.0) without.add(island.area, island.outline);
        }
      }
    }
    std::printf("rain kind %d, %d patches: D %.3f with holes, %.3f without\n",
                static_cast<int>(kind), patches, with_holes.dimension(), without.dimension());
    EXPECT_NEAR(with_holes.dimension(), 1.35, 0.1);
    EXPECT_NEAR(without.dimension(), 1.35, 0.1);
  }
}

// Rates are log-normal: where the outline is flat, in the middle of an area, the logarithm of the
// rate has the spread that the form says, 20 % either way (the middle is a few grains wide).
TEST(RainShape, RatesAreLogNormal) {
  std::vector<double> octaves;
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    const RainMap map({seed, RainKind::cell, 4000.0, 50});
    const GridView grid = map.level(0);
    const double value = static_cast<double>(grid.at(grid.columns / 2, grid.rows / 2));
    if (value > 0.0) octaves.push_back(std::log2(value));
  }
  double mean = 0.0, squares = 0.0;
  for (const double v : octaves) mean += v / static_cast<double>(octaves.size());
  for (const double v : octaves) squares += (v - mean) * (v - mean);
  const double spread = std::sqrt(squares / static_cast<double>(octaves.size()));
  std::printf("rain: spread %.2f octaves in the middle of %zu areas, of 300\n", spread,
              octaves.size());
  EXPECT_NEAR(spread, rain_form(RainKind::cell).spread, 0.35);
}

}  // namespace
}  // namespace skerry::echo
