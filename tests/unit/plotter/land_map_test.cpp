// What the map learns of land, of ships and of the sea, and forgets.
#include "server/plotter/plots/land_map.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "server/plotter/plots/plot_extractor.hpp"
#include "tests/unit/plotter/made_spokes.hpp"

namespace skerry::server {
namespace {

constexpr double kReach = 5556.0;
constexpr std::uint64_t kTurn = std::uint64_t{1} << 32;

TrueBearing toward(double bearing_deg) { return TrueBearing::from(degrees(bearing_deg)); }

// So many metres from 60 N 10 E.
GeoPoint place(double east_m, double north_m) {
  return {60.0 + north_m / 111120.0, 10.0 + east_m / 111120.0 / std::cos(60.0 * kRadiansPerDegree)};
}

// A block of land, as a ship at `ship` sees it: by rows of 0.35 degrees.
void see_land(LandMap& map, PlanePoint ship, PlanePoint from, PlanePoint to) {
  const GeoPoint at = place(ship.east_m, ship.north_m);
  for (int i = 0; i < 1024; ++i) {
    const double deg = i * 360.0 / 1024.0;
    double first = 0.0, last = -1.0;
    for (double range = 5.0; range < kReach; range += 10.0) {
      const double east = ship.east_m + range * std::sin(deg * kRadiansPerDegree);
      const double north = ship.north_m + range * std::cos(deg * kRadiansPerDegree);
      if (east < from.east_m || east > to.east_m || north < from.north_m || north > to.north_m)
        continue;
      if (last < 0.0) first = range;
      last = range;
    }
    if (last >= 0.0) map.add_echo(at, toward(deg), kRadiansPerTurn / 1024.0, first, last, true);
  }
}

struct Marks {
  double on_land = 0.0, clutter = 0.0;
};

Marks marks_of(const LandMap& map, const GeoPoint& own_ship, TrueBearing bearing, double range_m) {
  const LandMap::Spot spot = map.spot(own_ship, bearing, range_m);
  return {map.on_land(spot, 0.0), map.clutter(spot)};
}

Marks marks_at(const LandMap& map, PlanePoint ship, PlanePoint there) {
  const PlanePoint way = there - ship;
  const double deg = std::atan2(way.east_m, way.north_m) * kDegreesPerRadian;
  return marks_of(map, place(ship.east_m, ship.north_m), toward(deg), length_of(way));
}

// A point at `there`, in one row, seen from 60 N 10 E; a turn.
void see_point(LandMap& map, PlanePoint there) {
  map.go_on(place(0.0, 0.0), kTurn, kReach);
  const double deg = std::atan2(there.east_m, there.north_m) * kDegreesPerRadian;
  const double range_m = length_of(there);
  map.add_echo(place(0.0, 0.0), toward(deg), 0.001, range_m, range_m + 5.0, false);
}

int spans_at(const LandMap& map, PlanePoint there) {
  const double deg = std::atan2(there.east_m, there.north_m) * kDegreesPerRadian;
  int spans = 0;
  for (auto stood = map.stood(map.spot(place(0.0, 0.0), toward(deg), length_of(there))); stood != 0;
       stood &= stood - 1)
    ++spans;
  return spans;
}

bool by_standing_at(const LandMap& map, PlanePoint there) {
  const double deg = std::atan2(there.east_m, there.north_m) * kDegreesPerRadian;
  return map.is_by_standing(map.spot(place(0.0, 0.0), toward(deg), length_of(there)));
}

TEST(LandMap, RemembersForTenMinutesWhereAnEchoStood) {
  LandMap map;
  const PlanePoint islet{2025.0, 1025.0};
  for (int turn = 0; turn < 80; ++turn) see_point(map, islet);
  EXPECT_GE(spans_at(map, islet), 10);
  EXPECT_EQ(spans_at(map, {2325.0, 1025.0}), 0);
  EXPECT_TRUE(by_standing_at(map, {2325.0, 1025.0})) << "300 m beside it";
  EXPECT_FALSE(by_standing_at(map, {3025.0, 1025.0})) << "1000 m beside it";
  for (int turn = 0; turn < 100; ++turn) map.go_on(place(0.0, 0.0), kTurn, kReach);
  EXPECT_GE(spans_at(map, islet), 10) << "four minutes later";
  EXPECT_FALSE(by_standing_at(map, {2325.0, 1025.0})) << "it stands no more";
  for (int turn = 0; turn < 160; ++turn) map.go_on(place(0.0, 0.0), kTurn, kReach);
  EXPECT_EQ(spans_at(map, islet), 0);
}

TEST(LandMap, AShipThatGoesByStandsNowhereForLong) {
  LandMap map;
  // 10 knots: 12.9 m a turn.
  for (int turn = 0; turn < 80; ++turn) see_point(map, {2000.0 + 12.9 * turn, 1000.0});
  for (int turn = 0; turn < 80; ++turn)
    EXPECT_LE(spans_at(map, {2000.0 + 12.9 * turn, 1000.0}), 2) << turn;
  EXPECT_FALSE(by_standing_at(map, {2500.0, 1000.0}));
}

TEST(LandMap, WhatComesAndGoesStandsNowhere) {
  LandMap map;
  for (int turn = 0; turn < 80; ++turn) {
    if (turn % 5 == 0)
      see_point(map, {2025.0, 1025.0});
    else
      map.go_on(place(0.0, 0.0), kTurn, kReach);
  }
  EXPECT_EQ(spans_at(map, {2025.0, 1025.0}), 0);
}

TEST(LandMap, LearnsLandInSomeTurnsAndForgetsItInMore) {
  LandMap map;
  const PlanePoint ship{0.0, 0.0}, inside{2500.0, 300.0};
  const auto turn = [&](bool land) {
    map.go_on(place(0.0, 0.0), kTurn, kReach);
    if (land) see_land(map, ship, {2000.0, 0.0}, {3000.0, 600.0});
  };
  turn(true);
  EXPECT_LT(marks_at(map, ship, inside).on_land, 0.2);
  for (int i = 1; i < 6; ++i) turn(true);
  EXPECT_GE(marks_at(map, ship, inside).on_land, 0.5);
  for (int i = 6; i < 12; ++i) turn(true);
  EXPECT_EQ(marks_at(map, ship, inside).on_land, 1.0);
  EXPECT_EQ(marks_at(map, ship, {1900.0, 300.0}).on_land, 0.0) << "100 m before it";
  EXPECT_EQ(marks_at(map, ship, {1980.0, 300.0}).on_land, 0.5) << "20 m before it";
  for (int i = 0; i < 11; ++i) turn(false);
  EXPECT_LT(marks_at(map, ship, inside).on_land, 0.5);
  for (int i = 0; i < 5; ++i) turn(false);
  EXPECT_EQ(marks_at(map, ship, inside).on_land, 0.0);
}

TEST(LandMap, HasNoHolesInLandOnAnyRange) {
  for (const double reach : {1000.0, 5556.0, 11112.0, 44448.0}) {
    LandMap map;
    for (int i = 0; i < 12; ++i) {
      map.go_on(place(0.0, 0.0), kTurn, reach);
      // Of a radar of few spokes.
      for (int row = 0; row < 250; ++row)
        map.add_echo(place(0.0, 0.0), toward(row * 1.44), 1.44 * kRadiansPerDegree, 0.5 * reach,
                     0.98 * reach, true);
    }
    for (double deg = 0.0; deg < 360.0; deg += 0.37)
      for (double range = 0.55; range < 0.95; range += 0.013)
        ASSERT_EQ(marks_of(map, place(0.0, 0.0), toward(deg), range * reach).on_land, 1.0)
            << reach << " " << deg << " " << range;
  }
}

TEST(LandMap, LiesStillWhileOwnShipMoves) {
  LandMap map;
  PlanePoint ship{0.0, 0.0};
  double least = 1.0;
  for (int i = 0; i < 200; ++i) {
    ship = ship + PlanePoint{20.0, 15.0};  // 10 m/s
    map.go_on(place(ship.east_m, ship.north_m), kTurn, kReach);
    see_land(map, ship, {3000.0, 3000.0}, {3600.0, 3500.0});
    if (i > 15) least = std::min(least, marks_at(map, ship, {3300.0, 3250.0}).on_land);
  }
  EXPECT_EQ(least, 1.0);
  EXPECT_EQ(marks_at(map, ship, {2700.0, 3250.0}).on_land, 0.0);
  EXPECT_EQ(marks_at(map, ship, {3900.0, 3250.0}).on_land, 0.0);
}

TEST(LandMap, IsNotShipsAtAnchorButIsAHarbourFullOfThem) {
  LandMap map;
  const GeoPoint ship = place(0.0, 0.0);
  const auto see = [&](double bearing_deg, double range_m) {
    map.add_plot(map.spot(ship, toward(bearing_deg), range_m), true);
    for (int row = -2; row <= 2; ++row)  // 1.7 degrees, 90 m
      map.add_echo(ship, toward(bearing_deg + 0.35 * row), 0.35 * kRadiansPerDegree, range_m - 20.0,
                   range_m + 20.0, false);
  };
  for (int turn = 0; turn < 30; ++turn) {
    map.go_on(ship, kTurn, kReach);
    for (int i = 0; i < 4; ++i) see(90.0 + 4.0 * i, 3000.0);  // 210 m apart
    for (int i = 0; i < 25; ++i) see(200.0 + i % 5 * 2.5, 2800.0 + i / 5 * 110.0);
    for (const double deg : {90.0, 94.0, 98.0}) {
      EXPECT_LT(marks_of(map, ship, toward(deg), 3000.0).on_land, 0.5);
      EXPECT_EQ(marks_of(map, ship, toward(deg), 3000.0).clutter, 0.0);
    }
  }
  EXPECT_EQ(marks_of(map, ship, toward(205.0), 3020.0).on_land, 1.0);
  EXPECT_EQ(marks_of(map, ship, toward(205.0), 3020.0).clutter, 0.0) << "it stays";
}

TEST(LandMap, CallsThatClutterWhichComesAndGoes) {
  LandMap map;
  const GeoPoint ship = place(0.0, 0.0);
  std::uint64_t state = 1;
  double in_sea = 0.0, at_mover = 0.0;
  for (int turn = 0; turn < 60; ++turn) {
    map.go_on(ship, kTurn, kReach);
    for (int i = 0; i < 80; ++i) {  // within 1200 x 1000 m: 24 within 300 m of a place
      const double deg = 45.0 + 10.0 * next_draw(state);
      map.add_plot(map.spot(ship, toward(deg), 2000.0 + 200.0 * next_draw(state)), true);
    }
    const double mover_m = 1000.0 + 25.0 * turn;
    at_mover = std::max(at_mover, marks_of(map, ship, toward(200.0), mover_m).clutter);
    map.add_plot(map.spot(ship, toward(200.0), mover_m), true);
    map.add_plot(map.spot(ship, toward(203.0), mover_m), true);
    in_sea = marks_of(map, ship, toward(45.0), 2000.0).clutter;
  }
  EXPECT_GT(in_sea, 0.9);
  EXPECT_EQ(at_mover, 0.0) << "two ships under way are no clutter";
  EXPECT_EQ(marks_of(map, ship, toward(300.0), 2000.0).clutter, 0.0);
  EXPECT_LT(marks_of(map, ship, toward(45.0), 2000.0).on_land, 0.5);
}

TEST(LandMap, TakesPlacesAndRangesThatAreNone) {
  LandMap map;
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = HUGE_VAL;
  const std::vector<GeoPoint> places{{nan, 0.0},  {60.0, 10.0},   {inf, -inf},    {60.0, nan},
                                     {90.0, 0.0}, {-90.0, 180.0}, {1e300, 1e300}, {60.0, 10.0}};
  for (int turn = 0; turn < 40; ++turn) {
    const GeoPoint& at = places[static_cast<std::size_t>(turn) % places.size()];
    map.go_on(at, kTurn * (turn % 3), turn % 2 == 0 ? 1.0 : 1e6);
    map.add_plot(map.spot(at, toward(10.0 * turn), 1000.0), true);
    map.add_echo(at, toward(10.0 * turn), 0.05, 0.0, turn % 2 == 0 ? 1.0 : 1e6, true);
    const Marks marks = marks_of(map, at, toward(20.0), 500.0);
    EXPECT_TRUE(marks.on_land >= 0.0 && marks.on_land <= 1.0);
    EXPECT_TRUE(marks.clutter >= 0.0 && marks.clutter <= 1.0);
  }
}

TEST(LandMap, BeginsAnewWhereOwnShipJumpsOrCellsGrow) {
  LandMap map;
  const auto learn = [&] {
    for (int i = 0; i < 12; ++i) {
      map.go_on(place(0.0, 0.0), kTurn, kReach);
      see_land(map, {0.0, 0.0}, {2000.0, 0.0}, {3000.0, 600.0});
    }
    ASSERT_EQ(marks_at(map, {0.0, 0.0}, {2500.0, 300.0}).on_land, 1.0);
  };
  learn();
  map.go_on(place(1500.0, 0.0), 0, kReach);
  EXPECT_EQ(marks_at(map, {1500.0, 0.0}, {2500.0, 300.0}).on_land, 1.0) << "a step";
  map.go_on(place(0.0, 0.0), 0, kReach);
  map.go_on(place(40000.0, 0.0), 0, kReach);
  map.go_on(place(0.0, 0.0), 0, kReach);
  EXPECT_EQ(marks_at(map, {0.0, 0.0}, {2500.0, 300.0}).on_land, 0.0) << "a jump";
  learn();
  map.go_on(place(0.0, 0.0), 0, 0.5 * kReach);
  EXPECT_EQ(marks_at(map, {0.0, 0.0}, {2500.0, 300.0}).on_land, 1.0) << "cells as before";
  map.go_on(place(0.0, 0.0), 0, 2.0 * kReach);
  EXPECT_EQ(map.cell_m(), 100.0);
  EXPECT_EQ(marks_at(map, {0.0, 0.0}, {2500.0, 300.0}).on_land, 0.0) << "cells of 100 m";
}

// Through the extractor: a coast, a ship at anchor, one that passes the coast at 100 m, and a
// beacon on the shore.
TEST(LandMap, MarksWhatIsOnLandAndLetsShipsPass) {
  MadeRadar radar;
  PlotExtractor extractor;
  double anchored = 0.0, passing = 0.0, beacon = 0.0;
  int passing_seen = 0, anchored_seen = 0;
  const std::uint64_t spokes = radar.geometry.spokes_per_turn;
  constexpr std::uint64_t kTurns = 24;
  for (std::uint64_t turn = 0; turn < kTurns; ++turn) {
    const double passing_deg = 70.0 + 0.6 * static_cast<double>(turn);
    radar.echoes = {{90.0, 3000.0, 220.0, 600.0, 2500.0},
                    {200.0, 2000.0, 200.0, 60.0, 20.0},
                    {passing_deg, 2590.0, 200.0, 20.0, 20.0},
                    {100.0, 2670.0, 220.0}};
    std::vector<Plot> plots;
    for (std::uint64_t i = 0; i < spokes; ++i) extractor.add(radar.spoke(turn * spokes + i), plots);
    if (turn < 12) continue;
    for (const Plot& plot : plots) {
      const double deg = plot.bearing.in_degrees();
      if (plot.extended) continue;
      if (std::fabs(deg - 200.0) < 1.0) {
        ++anchored_seen;
        anchored = std::max(anchored, plot.on_land);
      } else if (std::fabs(deg - passing_deg) < 0.7 && std::fabs(plot.range_m - 2590.0) < 30.0) {
        ++passing_seen;
        passing = std::max(passing, plot.on_land);
      } else if (std::fabs(deg - 100.0) < 1.0 && plot.range_m < 2690.0) {
        beacon = std::max(beacon, plot.on_land);
      }
      EXPECT_EQ(plot.clutter, 0.0);
    }
  }
  EXPECT_EQ(anchored_seen, 12);
  EXPECT_EQ(anchored, 0.0);
  EXPECT_EQ(passing_seen, 12);
  EXPECT_LT(passing, 0.5);
  EXPECT_GE(beacon, 0.5);
}

// Spikes of the sea come and go; a ship among them is stronger, and a buoy no stronger than they
// are stays.
TEST(LandMap, RaisesTheBarInClutterAndNotOverShips) {
  struct Seen {
    int spikes = 0, ship = 0, buoy = 0;
  };
  const auto run = [](bool bars, std::uint64_t draw, Seen& seen) {
    MadeRadar radar;
    PlotExtractor::Rule rule;
    rule.bars = bars;
    PlotExtractor extractor(rule);
    std::uint64_t state = draw;
    const std::uint64_t spokes = radar.geometry.spokes_per_turn;
    for (std::uint64_t turn = 0; turn < 35; ++turn) {
      radar.echoes = {{45.0, 2000.0, 120.0}, {56.0, 2060.0, 48.0}};
      for (int i = 0; i < 50; ++i)
        radar.echoes.push_back({45.0 + 11.0 * next_draw(state), 2000.0 + 350.0 * next_draw(state),
                                45.0 + 3.0 * next_draw(state)});
      std::vector<Plot> plots;
      for (std::uint64_t i = 0; i < spokes; ++i)
        extractor.add(radar.spoke(turn * spokes + i), plots);
      if (turn < 20) continue;
      for (const Plot& plot : plots) {
        const bool buoy = std::fabs(plot.bearing.in_degrees() - 56.0) < 0.3 &&
                          std::fabs(plot.range_m - 2060.0) < 10.0;
        const bool ship = plot.greatest > 100;
        (ship ? seen.ship : buoy ? seen.buoy : seen.spikes) += 1;
        EXPECT_TRUE(!ship || plot.on_land < 0.5);
      }
    }
  };
  Seen with, without;
  for (const std::uint64_t draw : {5u, 6u, 7u}) {
    run(true, draw, with);
    run(false, draw, without);
  }
  EXPECT_GT(without.spikes, 900);
  EXPECT_LT(with.spikes, without.spikes / 10);
  EXPECT_EQ(with.ship, 45) << "once a turn";
  EXPECT_GE(with.buoy, 30);
}

// A weak boat under way in the open: nothing raises a bar over it.
TEST(LandMap, RaisesNoBarOverAWeakBoat) {
  MadeRadar radar;
  PlotExtractor extractor;
  std::size_t seen = 0;
  for (std::uint64_t turn = 0; turn < 40; ++turn) {
    radar.echoes = {{45.0, 1500.0 + 15.0 * static_cast<double>(turn), 50.0}};
    std::vector<Plot> plots;
    for (std::uint64_t i = 0; i < 2048; ++i) extractor.add(radar.spoke(turn * 2048 + i), plots);
    seen += plots.size();
    for (const Plot& plot : plots) {
      EXPECT_EQ(plot.clutter, 0.0);
      EXPECT_EQ(plot.on_land, 0.0);
    }
  }
  EXPECT_GE(seen, 37u) << extractor.counts().in_clutter << " below a bar";
}

}  // namespace
}  // namespace skerry::server
