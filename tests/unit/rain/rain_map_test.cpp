#include "echo/rain/rain_map.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <thread>

#include "echo/kernel/isa.hpp"
#include "tests/unit/rain/rain_reference.hpp"

namespace skerry::echo {
namespace {

constexpr double kRadii[] = {185.0, 1000.0, 4000.0, 20000.0, 92600.0};

// The mean of what falls where rain falls, read between the values a third of one apart.  Bound: 6
// % less than the area's rate, 1 % more: what is read beside a wet value counts as wet as well.
TEST(RainMap, MeanOverWhereItRainsIsTheRate) {
  double least = 1e9, most = 0.0;
  for (const RainKind kind : kFractalRain) {
    for (const double radius : kRadii) {
      for (std::uint64_t seed = 1; seed <= 4; ++seed) {
        const RainMap map({seed, kind, radius, static_cast<std::int64_t>(1000 * seed)});
        const GridView grid = map.level(0);
        double sum = 0.0, wet = 0.0;
        for (double r = 1.0 / 6.0; r < grid.rows - 1.0; r += 1.0 / 3.0) {
          for (double c = 1.0 / 6.0; c < grid.columns - 1.0; c += 1.0 / 3.0) {
            const double share = grid_reference(grid, c, r);
            sum += share;
            wet += share > 0.0 ? 1.0 : 0.0;
          }
        }
        least = std::min(least, sum / wet), most = std::max(most, sum / wet);
      }
    }
  }
  std::printf("rain: mean over the wet part %.3f to %.3f of the rate\n", least, most);
  EXPECT_GT(least, 0.99);
  EXPECT_LT(most, 1.01);
}

TEST(RainMap, StaysInsideItsRadiusAndUnderThirtyTimesItsRate) {
  double greatest = 0.0, farthest = 0.0;
  for (const RainKind kind : kFractalRain) {
    for (std::uint64_t seed = 1; seed <= 30; ++seed) {
      const RainMap map({seed, kind, 4000.0, 77});
      const GridView grid = map.level(0);
      greatest = std::max(greatest, map.greatest());
      EXPECT_GT(map.wet_share(), 0.02);
      for (std::uint32_t r = 0; r < grid.rows; ++r) {
        for (std::uint32_t c = 0; c < grid.columns; ++c) {
          ASSERT_GE(grid.at(c, r), 0.0f);
          if (grid.at(c, r) == 0.0f) continue;
          const double right = (r - 0.5 * (grid.rows - 1.0)) * map.row_m();
          const double along =
              (c - 0.5 * (grid.columns - 1.0)) * map.column_m() + map.form().shear * right;
          farthest = std::max(farthest, std::sqrt(along * along + right * right) / 4000.0);
        }
      }
    }
  }
  std::printf("rain: at most %.1f times its rate, up to %.3f of its radius\n", greatest, farthest);
  EXPECT_LT(greatest, 30.0);
  EXPECT_LT(farthest, 1.0);
}

TEST(RainMap, ChangesLittleFromStepToStep) {
  double worst = 0.0;
  for (const RainKind kind : kFractalRain) {
    for (const double radius : kRadii) {
      for (std::int64_t step = 500; step < 510; ++step) {
        const RainMap one({9, kind, radius, step}), other({9, kind, radius, step + 1});
        double squares = 0.0, count = 0.0;
        for (std::uint32_t i = 0; i < one.level(0).rows * one.level(0).columns; ++i) {
          const double a = static_cast<double>(one.level(0).values[i]);
          const double b = static_cast<double>(other.level(0).values[i]);
          if (a < 0.1 || b < 0.1) continue;
          squares += std::log2(a / b) * std::log2(a / b);
          count += 1.0;
        }
        worst = std::max(worst, std::sqrt(squares / count));
      }
    }
  }
  std::printf("rain: from step to step %.3f octaves\n", worst);
  EXPECT_LT(worst, 0.15);
}

// Showers grow where it was dry and end where it was wet, within a life; over twelve areas.
TEST(RainMap, GrowsAndDecays) {
  double wet = 0.0, still = 0.0, fresh = 0.0;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    RainCell cell;
    cell.identity = seed;
    cell.kind = RainKind::shower;
    cell.radius_m = kLifeRadius;
    const RainMap before(rain_map_key(cell, 3000.0)), after(rain_map_key(cell, 4200.0));
    for (std::uint32_t i = 0; i < before.level(0).rows * before.level(0).columns; ++i) {
      const bool was = before.level(0).values[i] > 0.0f, is = after.level(0).values[i] > 0.0f;
      wet += was ? 1.0 : 0.0;
      still += was && is ? 1.0 : 0.0;
      fresh += !was && is ? 1.0 : 0.0;
    }
  }
  std::printf("showers: %.2f of them still there after a life, %.2f as many fresh ones\n",
              still / wet, fresh / wet);
  EXPECT_LT(still / wet, 0.6);
  EXPECT_GT(fresh / wet, 0.4);
}

TEST(RainMap, CoarserLevelsKeepTheMean) {
  const RainMap map({3, RainKind::cell, 4000.0, 9});
  ASSERT_GE(map.levels(), 4u);
  double first = 0.0;
  for (std::size_t l = 0; l < map.levels(); ++l) {
    const GridView grid = map.level(l);
    double sum = 0.0;
    for (std::uint32_t i = 0; i < grid.rows * grid.columns; ++i)
      sum += static_cast<double>(grid.values[i]);
    sum /= grid.rows * grid.columns;
    if (l == 0) first = sum;
    EXPECT_NEAR(sum / first, 1.0, 1e-5);
  }
}

// The map is a function of its key alone: not of the instruction set, not of who asks when.
TEST(RainMap, HasTheSameBitsOnEveryInstructionSetAndThread) {
  std::vector<RainMapKey> keys;
  for (const RainKind kind : kFractalRain)
    for (std::int64_t step = 0; step < 5; ++step) keys.push_back({11, kind, 3000.0, step});
  const auto values_of = [](const RainMap& map) {
    const GridView grid = map.level(0);
    return std::vector<float>(grid.values, grid.values + grid.rows * grid.columns);
  };
  std::vector<std::vector<float>> expected;
  for (const RainMapKey& key : keys) expected.push_back(values_of(RainMap(key)));
  for (const Isa isa : {Isa::baseline, Isa::avx2, Isa::avx512}) {
    force_isa(isa);
    for (std::size_t i = 0; i < keys.size(); ++i)
      EXPECT_EQ(values_of(RainMap(keys[i])), expected[i]) << name_of(isa);
  }
  force_isa(best_isa());
  for (const std::size_t threads : {1u, 2u, 3u, 8u}) {
    std::vector<int> wrong(threads, 0);
    {
      std::vector<std::jthread> asking;
      for (std::size_t t = 0; t < threads; ++t) {
        asking.emplace_back([&, t] {
          for (std::size_t i = 0; i < keys.size(); ++i) {
            const std::size_t k = (i * 7 + t * 3) % keys.size();
            wrong[t] += values_of(*rain_map_for(keys[k])) != expected[k] ? 1 : 0;
          }
        });
      }
    }
    for (const int count : wrong) EXPECT_EQ(count, 0);
  }
}

// An exercise of hours shall not fill the memory with rain that has fallen.
TEST(RainMap, OfPastStepsAreLetGo) {
  RainMapKey key{.identity = 0x5EED, .kind = RainKind::cell, .radius_m = 4000.0, .step = 0};
  std::vector<std::weak_ptr<const RainMap>> maps;
  for (; key.step < 6; ++key.step) maps.push_back(rain_map_for(key));
  for (std::size_t step = 0; step < 4; ++step) EXPECT_TRUE(maps[step].expired()) << step;
  EXPECT_FALSE(maps[4].expired());
  EXPECT_FALSE(maps[5].expired());
  key.step = 5;
  key.radius_m = 3000.0;  // an instructor has changed it
  const std::weak_ptr<const RainMap> changed = rain_map_for(key);
  EXPECT_TRUE(maps[5].expired());
  EXPECT_FALSE(changed.expired());
}

}  // namespace
}  // namespace skerry::echo
