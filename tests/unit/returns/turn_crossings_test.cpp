#include "echo/returns/turn_crossings.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "tests/scenes/scenes.hpp"

namespace skerry::echo {
namespace {

// From the scene's place and from places off it, near islands too.
TEST(TurnCrossings, AreThoseOfEachRay) {
  constexpr std::uint32_t kRays = 2048;
  int compared = 0, others = 0;
  double worst = 0.0;
  for (const double nm : {0.75, 6.0}) {
    const RangeScale scale = *RangeScale::find(nm);
    const auto scene =
        scenes::scene_at(scenes::made_up_chart(scenes::kBergen, scale.length() * 1.3, 60, 7),
                         scenes::kBergen, scale, {});
    const double reach = scale.length().in_metres();
    for (int k = 0; k < 4; ++k) {
      const PlanePoint at = scene->own_ship + PlanePoint{k * 0.013 * reach, k * -0.021 * reach};
      const PolarIndex index(*scene->coast, at, 1.0);
      TurnCrossings turn;
      turn.begin(*scene->coast, at, kRays, reach);
      for (std::size_t vertices = 0; !turn.done(); vertices += 777)
        turn.work_to(*scene->coast, vertices);
      std::vector<Crossing> found, expected;
      double nearest = reach;
      for (std::uint32_t ray = 0; ray < kRays; ++ray) {
        turn.of(ray, found);
        find_crossings(*scene->coast, index, {at, ray << 21}, expected);
        std::erase_if(expected, [&](const Crossing& c) { return c.range_m >= reach; });
        if (!expected.empty()) nearest = std::min(nearest, expected.front().range_m);
        // A vertex that touches the ray may count or not; nothing else.
        if (found.size() != expected.size()) {
          ++others;
          continue;
        }
        for (std::size_t i = 0; i < found.size(); ++i) {
          if (found[i].edge != expected[i].edge) {
            ++others;
            continue;
          }
          EXPECT_EQ(found[i].into_land, expected[i].into_land);
          worst = std::max(worst, std::fabs(found[i].range_m - expected[i].range_m));
          ++compared;
        }
      }
      EXPECT_NEAR(turn.nearest_m(), nearest, 0.1);
    }
  }
  std::printf("%d crossings, off by %.3g m at most; %d on a vertex\n", compared, worst, others);
  EXPECT_GT(compared, 10'000);
  EXPECT_LE(others, compared / 1000);
  EXPECT_LE(worst, 0.1);
}

TEST(TurnCrossings, OfNoCoastAreNone) {
  const auto scene =
      scenes::scene_at(scenes::made_up_chart(scenes::kBergen, nautical_miles(8), 0, 7),
                       scenes::kBergen, *RangeScale::find(6.0), {});
  TurnCrossings turn;
  turn.begin(*scene->coast, scene->own_ship, 1024, 5000.0);
  EXPECT_TRUE(turn.done());
  std::vector<Crossing> found(3);
  turn.of(17, found);
  EXPECT_TRUE(found.empty());
  EXPECT_EQ(turn.nearest_m(), 5000.0);
}

}  // namespace
}  // namespace skerry::echo
