// Tide and streams of a scenario, and what they do to ships.
#include "server/world/waters/waters.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "server/world/scenario.hpp"
#include "server/world/short_way.hpp"
#include "server/world/world.hpp"
#include "tests/unit/world/refusal.hpp"

namespace skerry::server {
namespace {

constexpr double kKnot = 1852.0 / 3600.0;

Duration hours(double h) {
  return std::chrono::duration_cast<Duration>(std::chrono::duration<double, std::ratio<3600>>(h));
}

scenario::Scenario with(const std::string& more) {
  return parse_scenario(
      "name: s\nown_ships:\n  - {name: F, ship_class: coaster, position: {lat: 60, "
      "lon: 5}, speed_kn: 8, radars: [{}]}\n" +
          more + "\n",
      "f");
}

// A diamond whose stream is due east, `knots` at springs at every hour, half of it at neaps.
std::string diamond(const char* name, double lat, double lon, double knots) {
  std::string yaml = "  - {name: " + std::string(name) + ", lat: " + std::to_string(lat) +
                     ", lon: " + std::to_string(lon) + ", hours: [";
  for (int i = 0; i < 13; ++i) {
    yaml += (i == 0 ? "" : ", ") + ("{set_deg: 90, springs_kn: " + std::to_string(knots) +
                                    ", neaps_kn: " + std::to_string(0.5 * knots) + "}");
  }
  return yaml + "]}\n";
}

TEST(Tide, IsTheSumOfItsConstituents) {
  const Waters waters(
      with("sea: {tide: [{name: m2, amplitude_m: 1.6, phase_deg: 40}, {name: s2, "
           "amplitude_m: 0.55, phase_deg: 80}, {name: o1, amplitude_m: 0.1, "
           "phase_deg: 300}, {name: ms4, amplitude_m: 0.2}]}"));
  const struct {
    double speed, amplitude, phase;
  } parts[] = {{28.9841042, 1.6, 40}, {30, 0.55, 80}, {13.9430356, 0.1, 300}, {58.9841042, 0.2, 0}};
  double worst = 0.0;
  for (double h = 0.0; h < 24.0 * 30.0; h += 0.37) {
    double reference = 0.0;
    for (const auto& part : parts) {
      reference +=
          part.amplitude * std::cos((part.speed * h + part.phase) * std::numbers::pi / 180);
    }
    worst = std::max(worst, std::abs(waters.tide().height_m(hours(h)) - reference));
    EXPECT_NEAR(waters.tide().over_coastline_m(hours(h)), waters.tide().height_m(hours(h)) - 2.15,
                1e-12);
  }
  EXPECT_LT(worst, 1e-10);
}

TEST(Tide, KnowsTheHourAndTheMoonsAge) {
  const Tide tide(with("sea: {tide: [{name: m2, amplitude_m: 1.5, phase_deg: 90}, {name: s2, "
                       "amplitude_m: 0.5, phase_deg: 90}]}")
                      .sea());
  const double quarter = 90.0 / 28.9841042;
  EXPECT_NEAR(tide.hours_from_high_water(hours(0.0)), quarter, 1e-9);
  EXPECT_NEAR(tide.hours_from_high_water(hours(3.0 * quarter)), 0.0, 1e-9);
  EXPECT_NEAR(tide.hours_from_high_water(hours(3.0 * quarter - 6.0)), -6.0, 1e-9);
  EXPECT_NEAR(tide.springs(hours(0.0)), 1.0, 1e-12);
  const double week = 180.0 / (30.0 - 28.9841042);  // 7.4 days
  EXPECT_NEAR(tide.springs(hours(week)), 0.0, 1e-9);
  EXPECT_NEAR(tide.springs(hours(2.0 * week)), 1.0, 1e-9);
}

TEST(Tide, OfAPlainRangeIsAsItAlwaysWas) {
  const Tide tide(with("sea: {tide_range_m: 4, high_water_h: 1}").sea());
  EXPECT_EQ(tide.over_coastline_m(hours(1.0)), 0.0);
  EXPECT_NEAR(tide.over_coastline_m(hours(1.0 + 0.5 * kTideHours)), -4.0, 1e-9);
  EXPECT_NEAR(tide.hours_from_high_water(hours(3.0)), 2.0, 1e-12);
  EXPECT_EQ(tide.springs(hours(3.0)), 1.0);
}

TEST(Streams, AreThoseOfTheDiamondAtIt) {
  std::string rows;
  for (int i = 0; i < 13; ++i) {
    rows += (i == 0 ? "" : ", ") + ("{set_deg: " + std::to_string(30 * i % 360) + ", springs_kn: " +
                                    std::to_string(1 + 0.1 * i) + ", neaps_kn: 0.5}");
  }
  const Waters waters(
      with("sea: {high_water_h: 6}\ntidal_diamonds:\n  - {name: A, lat: 60, lon: 5, "
           "hours: [" +
           rows + "]}\n" + diamond("B", 60.2, 5.0, 4.0)));
  for (int i = 0; i < 13; ++i) {
    const Stream stream = waters.stream({60.0, 5.0}, hours(i));
    const double set = 30.0 * i * std::numbers::pi / 180.0, mps = (1.0 + 0.1 * i) * kKnot;
    EXPECT_NEAR(stream.north_mps, mps * std::cos(set), 1e-6) << i;
    EXPECT_NEAR(stream.east_mps, mps * std::sin(set), 1e-6) << i;
  }
  // Between two hours: the mean of both as vectors.
  const Stream a = waters.stream({60.0, 5.0}, hours(2.0)),
               b = waters.stream({60.0, 5.0}, hours(3.0));
  const Stream half = waters.stream({60.0, 5.0}, hours(2.5));
  EXPECT_NEAR(half.north_mps, 0.5 * (a.north_mps + b.north_mps), 1e-9);
  EXPECT_NEAR(half.east_mps, 0.5 * (a.east_mps + b.east_mps), 1e-9);
  // From tide to tide without a jump.
  Stream before = waters.stream({60.1, 5.1}, hours(0.0));
  for (double h = 0.01; h < 30.0; h += 0.01) {
    const Stream now = waters.stream({60.1, 5.1}, hours(h));
    ASSERT_LT(std::hypot(now.north_mps - before.north_mps, now.east_mps - before.east_mps), 0.12)
        << h;
    before = now;
  }
}

// Another simulator divides degrees by 60 there, so that all within 3.6 NM weigh the same.
TEST(Streams, TheNearerDiamondWeighsMoreAlsoWithinAMile) {
  const Waters waters(with("tidal_diamonds:\n" + diamond("A", 60.0, 5.0, 1.0) +
                           diamond("B", 60.0, 5.0333333, 3.0)));  // 1 NM to the east
  const auto knots = [&](double lon) { return waters.stream({60.0, lon}, {}).east_mps / kKnot; };
  EXPECT_NEAR(knots(5.0), 1.0, 1e-4);
  EXPECT_NEAR(knots(5.0333333), 3.0, 1e-4);
  EXPECT_NEAR(knots(5.01666665), 2.0, 1e-4);
  EXPECT_NEAR(knots(5.01111110), (4.0 * 1.0 + 1.0 * 3.0) / 5.0, 1e-3);  // a third of the way
  EXPECT_NEAR(Waters(with("tidal_diamonds:\n" + diamond("A", 0.0, 179.99, 1.0) +
                          diamond("B", 0.0, -179.99, 3.0)))
                      .stream({0.0, 180.0}, {})
                      .east_mps /
                  kKnot,
              2.0, 1e-6);
}

TEST(Streams, AreHalfAsStrongAtNeapsWhereTheDiamondSaysSo) {
  const double week = 180.0 / (30.0 - 28.9841042);
  const Waters waters(
      with("sea: {tide: [{name: m2, amplitude_m: 1}, {name: s2, amplitude_m: "
           "0.4}]}\ntidal_diamonds:\n" +
           diamond("A", 60.0, 5.0, 2.0)));
  EXPECT_NEAR(waters.stream({60.0, 5.0}, {}).east_mps, 2.0 * kKnot, 1e-6);
  EXPECT_NEAR(waters.stream({60.0, 5.0}, hours(week)).east_mps, kKnot, 1e-6);
}

TEST(Streams, CarryAShipAndTheTideLiftsHer) {
  World still(with("sea: {depth_m: 20}"));
  World flows(
      with("sea: {depth_m: 20, current_set_deg: 0, current_kn: 1, tide: [{name: m2, "
           "amplitude_m: 2, phase_deg: 180}]}\ntidal_diamonds:\n" +
           diamond("A", 60.0, 5.0, 3.0)));
  for (int i = 0; i < 36'000; ++i) {
    still.step();
    flows.step();
  }
  const ShipState a = still.state().own_ships.front();
  const ShipState b = flows.state().own_ships.front();
  const ShortWay apart = short_way_between(a.position, b.position);
  // Meridians run together: 0.2 % on her way north.
  EXPECT_NEAR(apart.east_m, 3.0 * 1852.0 * (1.0 - 0.0020), 2.0);
  EXPECT_NEAR(apart.north_m, 1852.0, 40.0) << "less water under her keel at first: she is slower";
  ASSERT_TRUE(b.con);
  EXPECT_NEAR(b.con->current_mps / kKnot, std::sqrt(10.0), 1e-3);
  EXPECT_NEAR(b.con->current_set_deg, 71.565, 1e-2);
  const double height = -2.0 * std::cos(28.9841042 * std::numbers::pi / 180.0);
  EXPECT_NEAR(b.con->depth_below_keel_m - a.con->depth_below_keel_m, height, 1e-3);
  EXPECT_NEAR(flows.state().water_level_m, height - 2.0, 1e-3);
}

TEST(Waters, MistakesAreToldTogether) {
  const std::string told = refusal(
      "name: s\nown_ships: [{name: F, position: {lat: 60, lon: 5}, radars: [{}]}]\n"
      "sea: {tide_range_m: 2, depth_m: 5, tide: [{name: m2, amplitude_m: 2}, {name: m2, "
      "amplitude_m: 2}]}\ntidal_diamonds:\n" +
      diamond("A", 60, 5, 1) + diamond("A", 60, 6, 1) +
      "  - {name: C, lat: 60, lon: 5, hours: [{set_deg: 1}]}");
  EXPECT_EQ(told,
            "3:21: sea.tide_range_m: given beside sea.tide; allowed: one of the two\n"
            "test.yaml:3:33: sea.depth_m: 5 m below the mean level, and the tide falls 4.00 m; "
            "allowed: at least 2 m at low water\n"
            "test.yaml:3:78: sea.tide[1].name: m2 is given twice; allowed: each constituent once\n"
            "test.yaml:6:12: tidal_diamonds[1].name: \"A\" is the name of tidal_diamonds[0] too; "
            "names must differ\n"
            "test.yaml:7:39: tidal_diamonds[2].hours: 1 given; expected 13: from 6 h before high "
            "water to 6 h after it\ntest.yaml: 5 errors");
}

TEST(Waters, ATideBeyondWhatAShoreCanShowIsRefused) {
  const std::string head =
      "name: s\nown_ships: [{name: F, position: {lat: 60, lon: 5}, radars: [{}]}]\n";
  EXPECT_EQ(refusal(head + "sea: {tide: [{name: m2, amplitude_m: 8}]}"), "");
  EXPECT_EQ(refusal(head + "sea: {tide: [{name: m2, amplitude_m: 8}, {name: k1, amplitude_m: 2}]}"),
            "3:13: sea.tide: the water goes from 18.00 m below mean high water springs to 2.00 m "
            "above it; allowed: 17 m below to 15 m above");
}

}  // namespace
}  // namespace skerry::server
