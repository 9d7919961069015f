// The search for a set, on costs of which the least is known, and what it prints.
#include <gtest/gtest.h>

#include <cmath>

#include "echo/chart/gshhg_reader.hpp"
#include "echo/picture_tool/made_pictures.hpp"
#include "echo/picture_tool/radar_fit.hpp"
#include "echo/radar/shipped_sets.hpp"
#include "server/world/radar_sets.hpp"
#include "server/world/scenario.hpp"
#include "tests/unit/picture_tool/picture_kit.hpp"

namespace skerry::echo {
namespace {

MadeRadar radar() { return radar_like(test::blobs(1), find_set("3G"), 1.77); }

// Squared steps from a point.
double bowl(const FitPoint& point, const FitPoint& least) {
  double sum = 0.0;
  for (std::size_t k = 0; k < kFitKnobs; ++k) {
    const double off = static_cast<double>(point[k]) - static_cast<double>(least[k]);
    sum += off * off;
  }
  return sum;
}

const auto never = [] { return false; };

TEST(RadarFit, FindsTheLeastOfABowl) {
  const FitGrid grid(radar());
  FitPoint least = grid.start();
  least[0] += 1, least[1] = 0, least[2] -= 2, least[5] += 1;
  const auto at = [&](const FitPoint& point) { return bowl(point, least); };
  const FitResult found = search_grid(grid, at, 1000, never);
  EXPECT_EQ(found.point, least);
  EXPECT_EQ(found.distance, 0.0);
  EXPECT_EQ(found.distance_before, bowl(grid.start(), least));
  EXPECT_TRUE(found.ended);
  EXPECT_LT(found.renders, 60u);
}

TEST(RadarFit, KeepsToItsBounds) {
  const FitGrid grid(radar());
  std::uint32_t asked = 0;
  const auto at = [&](const FitPoint& point) {
    ++asked;
    return -bowl(point, {});  // ever better towards the end of the grid
  };
  const FitResult found = search_grid(grid, at, 7, never);
  EXPECT_EQ(found.renders, 7u);
  EXPECT_EQ(asked, 7u);
  EXPECT_FALSE(found.ended);
  const FitResult stopped = search_grid(grid, at, 1000, [] { return true; });
  EXPECT_EQ(stopped.renders, 1u);
  EXPECT_EQ(stopped.point, grid.start());
  const FitResult all = search_grid(grid, at, 1000, never);
  EXPECT_TRUE(all.ended);
  EXPECT_TRUE(grid.sound(all.point));
}

TEST(RadarFit, ThePrintedSetIsTheFoundOne) {
  const FitGrid grid(radar());
  FitPoint point = grid.start();
  point[0] += 1, point[1] = point[1] == 0 ? 1 : 0, point[2] += 1;
  point[3] += 1, point[4] -= 1, point[5] -= 1;
  ASSERT_TRUE(grid.sound(point));
  const std::string yaml = scenario_of(grid, point);
  const auto scenario = server::parse_scenario(
      "name: Test\nown_ships:\n  - name: Test\n    position: {lat: 60, lon: 5}\n    radars:\n" +
          yaml,
      "test.yaml");
  const auto& lines = scenario.own_ships(0).radars(0);
  const RadarSet read = server::radar_set(lines), wanted = grid.at(point).set;
  EXPECT_EQ(read.name, wanted.name);
  EXPECT_NEAR(read.beam_width_deg, wanted.beam_width_deg, 1e-3 * wanted.beam_width_deg);
  EXPECT_NEAR(read.antenna_gain_db, wanted.antenna_gain_db, 0.01);
  EXPECT_EQ(read.video_range_db, wanted.video_range_db);
  EXPECT_EQ(read.integration, wanted.integration);
  ASSERT_EQ(read.pulses.size(), wanted.pulses.size());
  for (std::size_t p = 0; p < read.pulses.size(); ++p) {
    EXPECT_NEAR(read.pulses[p].length_s / wanted.pulses[p].length_s, 1.0, 1e-3);
    EXPECT_NEAR(read.pulses[p].bandwidth_hz / wanted.pulses[p].bandwidth_hz, 1.0, 1e-3);
  }
  EXPECT_EQ(lines.controls().gain(), grid.at(point).controls.gain);
  // Where nothing is turned, nothing but sizes and controls is said.
  EXPECT_EQ(scenario_of(grid, grid.start()).find("pulses"), std::string::npos);
}

TEST(RadarFit, DistanceCountsSpreadsUpToTheMost) {
  PictureStatistics real, ours, spread;
  for (const StatisticRow& row : statistic_rows()) spread.*row.of = 1.0;
  EXPECT_EQ(fit_distance(real, ours, spread), 0.0);
  ours.turn_lag1 = 100.0;
  EXPECT_EQ(fit_distance(real, ours, spread), 0.0);
  ours.ribbon_p50_m = 2.0;
  EXPECT_DOUBLE_EQ(fit_distance(real, ours, spread), 4.0 / 10.0);
  ours.ribbon_p50_m = std::nan("");
  EXPECT_DOUBLE_EQ(fit_distance(real, ours, spread), kMostOff * kMostOff / 10.0);
  real.ribbon_p50_m = std::nan("");
  EXPECT_EQ(fit_distance(real, ours, spread), 0.0);
}

TEST(MadePictures, AreOfPlacesAfloatWithAsMuchEcho) {
  std::optional<GshhgReader> chart;
  try {
    chart.emplace(GshhgReader::open(GshhgReader::find_finest()));
  } catch (const std::runtime_error& missing) {
    GTEST_SKIP() << missing.what();
  }
  const MadeRadar small = radar();
  const StandInWish wish{.count = 3, .seed = 5, .occupancy = 0.1, .most_tried = 40};
  const auto tell = [](const std::string&) {};
  const auto places = find_stand_ins(*chart, small, wish, tell);
  const auto again = find_stand_ins(*chart, small, wish, tell);
  ASSERT_EQ(places.size(), 3u);
  for (std::size_t k = 0; k < places.size(); ++k) {
    EXPECT_EQ(places[k].at, again[k].at);
    EXPECT_FALSE(places[k].scene->ashore);
    const TurnsOfPicture picture = make_picture(small, places[k], 2);
    EXPECT_EQ(picture.turns, make_picture(small, again[k], 2).turns);
    EXPECT_NE(picture.turns[0], picture.turns[1]);
    const PictureTurn turn = picture.turn(0, 5.0);
    EXPECT_GT(share_that_echoes({&turn, 1}), 0.05 * 0.99) << k;
    EXPECT_LT(share_that_echoes({&turn, 1}), 0.2 * 1.01) << k;
  }
}

TEST(MadePictures, RefuseSizesThatWeDoNotMake) {
  TurnsOfPicture real = test::blobs(1);
  real.spokes = 64;
  EXPECT_THROW(radar_like(real, find_set("3G"), 1.0), std::runtime_error);
  real = test::blobs(1);
  real.reach_m = 1e6;
  EXPECT_THROW(radar_like(real, find_set("3G"), 1.0), std::runtime_error);
}

}  // namespace
}  // namespace skerry::echo
