#include "server/traffic_logs/track_book.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "server/traffic_logs/thinned_track.hpp"
#include "tests/unit/traffic_logs/log_kit.hpp"

namespace skerry::server {
namespace {

constexpr std::uint32_t kShip = 219'000'001;
constexpr double kMetre_deg = 1.0 / 111'350.0;  // of latitude, at 55 deg

// A way that winds, with speeds that change: metres north and east of 55 N 11 E at a time.
GeoPoint winding(double seconds) {
  const double way = 5.0 * seconds + 400.0 * std::sin(seconds / 300.0);
  const double across = 900.0 * std::sin(seconds / 170.0) + 0.05 * seconds;
  return {55.0 + way * kMetre_deg, 11.0 + across * kMetre_deg / std::cos(0.96)};
}

std::vector<LogFix> winding_fixes(int count, double step_s) {
  std::vector<LogFix> fixes;
  for (int i = 0; i < count; ++i) {
    fixes.push_back(log_fix(static_cast<std::int64_t>(1000 * step_s * i), winding(step_s * i)));
  }
  return fixes;
}

// The error of each fix against the kept ones, reckoned anew.
double worst_of(const std::vector<LogFix>& fixes, const std::vector<LogFix>& kept) {
  double worst_m = 0.0;
  std::size_t leg = 0;
  for (const LogFix& fix : fixes) {
    while (leg + 2 < kept.size() && kept[leg + 1].utc_ms <= fix.utc_ms) ++leg;
    worst_m = std::max(worst_m, metres_off(kept[leg], kept[leg + 1], fix));
  }
  return worst_m;
}

TEST(ThinnedTrack, NoFixIsOffByMoreThanTheTolerance) {
  const auto fixes = winding_fixes(2000, 10);
  for (const double tolerance_m : {0.0, 1.0, 30.0, 300.0}) {
    const Thinned thinned = thin(fixes, tolerance_m);
    std::vector<LogFix> kept;
    for (const std::size_t i : thinned.kept) kept.push_back(fixes[i]);
    EXPECT_EQ(thinned.kept.front(), 0u);
    EXPECT_EQ(thinned.kept.back(), fixes.size() - 1);
    const double worst_m = worst_of(fixes, kept);
    EXPECT_LE(worst_m, tolerance_m);
    EXPECT_NEAR(worst_m, thinned.worst_m, 1e-6) << "and it says so";
    if (tolerance_m >= 30.0) {
      EXPECT_LT(kept.size(), fixes.size() / 5);
    }
  }
}

TEST(ThinnedTrack, TimeCountsAsWellAsPlace) {
  // On one straight line, but she stops for a while: the stop is kept.
  std::vector<LogFix> fixes;
  for (int i = 0; i <= 60; ++i) {
    const double metres = 5.0 * (std::min(i, 20) + std::max(i - 40, 0)) * 10.0;
    fixes.push_back(log_fix(10'000 * i, {55.0 + metres * kMetre_deg, 11.0}));
  }
  const Thinned thinned = thin(fixes, 30.0);
  EXPECT_EQ(thinned.kept, (std::vector<std::size_t>{0, 20, 40, 60}));
}

TEST(ThinnedTrack, CrossesTheDateLine) {
  const LogFix from = log_fix(0, {10, 179.99}), to = log_fix(20'000, {10, -179.99});
  EXPECT_LT(metres_off(from, to, log_fix(10'000, {10, -180.0})), 0.1);
}

TEST(TrackBook, ThinsWhileItReadsAndKeepsToTheTolerance) {
  TrackBook book{TrackRules{.tolerance_m = 20.0}};
  const int count = 5000;
  for (int i = 0; i < count; ++i) {
    const GeoPoint place = winding(10.0 * i);
    book.take(fix_at(kShip, 10.0 * i, place.latitude_deg, place.longitude_deg));
  }
  const auto ships = book.finish();
  ASSERT_EQ(ships.size(), 1u);
  EXPECT_EQ(ships[0].heard, static_cast<std::uint64_t>(count));
  std::vector<LogFix> kept, fixes = winding_fixes(count, 10);
  for (LogFix& fix : fixes) fix.utc_ms += kLogBegin_s * 1000;
  double said_m = 0.0;
  for (const LoggedPiece& piece : ships[0].pieces) {
    EXPECT_LE(piece.fixes.size(), TrackBook::kMostFixes);
    kept.insert(kept.end(), piece.fixes.begin() + (kept.empty() ? 0 : 1), piece.fixes.end());
    said_m = std::max(said_m, piece.worst_m);
  }
  EXPECT_LE(said_m, 20.0);
  EXPECT_NEAR(worst_of(fixes, kept), said_m, 1e-6);
}

TEST(TrackBook, LongTracksBecomePiecesThatFollowOnEachOther) {
  TrackBook book{TrackRules{.tolerance_m = 0.0}};
  for (int i = 0; i < 2500; ++i) {
    const GeoPoint place = winding(10.0 * i);
    book.take(fix_at(kShip, 10.0 * i, place.latitude_deg, place.longitude_deg));
  }
  const auto ships = book.finish();
  ASSERT_EQ(ships[0].pieces.size(), 3u);
  EXPECT_EQ(ships[0].pieces[0].fixes.back().utc_ms, ships[0].pieces[1].fixes.front().utc_ms);
  EXPECT_EQ(ships[0].pieces[1].fixes.back().utc_ms, ships[0].pieces[2].fixes.front().utc_ms);
  EXPECT_EQ(ships[0].heard, 2500u);
}

TEST(TrackBook, AGapEndsATrackAndSingleFixesAreNone) {
  TrackBook book{TrackRules{}};
  for (const double seconds : {0.0, 60.0, 960.0, 1861.0, 1900.0, 4000.0}) {
    book.take(fix_at(kShip, seconds, 55.0, 11.0));
  }
  book.take(fix_at(kShip + 1, 0, 55.0, 11.0));
  const auto ships = book.finish();
  ASSERT_EQ(ships.size(), 1u);
  ASSERT_EQ(ships[0].pieces.size(), 2u) << "15 min are no gap, one second more is";
  EXPECT_EQ(ships[0].pieces[0].heard, 3u);
  EXPECT_EQ(ships[0].pieces[1].heard, 2u);
  EXPECT_EQ(book.left_out().of(LeftOut::single), 2u);
  EXPECT_EQ(book.fixes(), 5u);
}

TEST(TrackBook, AJumpIsLeftOutUnlessTheShipIsThere) {
  TrackBook book{TrackRules{}};
  for (int i = 0; i < 10; ++i) book.take(fix_at(kShip, 10.0 * i, i == 4 ? 56.0 : 55.0, 11.0));
  EXPECT_EQ(book.left_out().of(LeftOut::jump), 1u);
  // From here on she is elsewhere: the third time, that is believed.
  for (int i = 10; i < 20; ++i) book.take(fix_at(kShip, 10.0 * i, 57.0, 11.0));
  EXPECT_EQ(book.left_out().of(LeftOut::jump), 3u);
  const auto ships = book.finish();
  ASSERT_EQ(ships[0].pieces.size(), 2u);
  EXPECT_EQ(ships[0].pieces[0].heard, 9u);
  EXPECT_EQ(ships[0].pieces[1].heard, 8u);
}

TEST(TrackBook, OneFixDatedADayAheadCostsTwoFixesAndNotTheLog) {
  TrackBook book{TrackRules{}};
  constexpr double kDay_s = 86'400.0;
  for (int i = 0; i < 100; ++i) {
    book.take(fix_at(kShip, 10.0 * i + (i == 40 ? kDay_s : 0.0), 55.0, 11.0));
  }
  EXPECT_EQ(book.left_out().of(LeftOut::time_back), 2u);
  EXPECT_EQ(book.left_out().of(LeftOut::single), 1u);
  const auto ships = book.finish();
  ASSERT_EQ(ships.size(), 1u);
  ASSERT_EQ(ships[0].pieces.size(), 2u);
  EXPECT_EQ(ships[0].heard, 97u);
  EXPECT_EQ(ships[0].pieces[1].fixes.front().utc_ms, 1000 * (kLogBegin_s + 430));
  EXPECT_EQ(ships[0].pieces[1].fixes.back().utc_ms, 1000 * (kLogBegin_s + 990));
}

TEST(TrackBook, TracksThatAreHeardOutOfOrderAreInTheOrderOfTimeAndDoNotOverlap) {
  TrackBook book{TrackRules{}};
  const auto sail = [&](double from_s, double to_s) {
    for (double at = from_s; at <= to_s; at += 10.0) book.take(fix_at(kShip, at, 55.0, 11.0));
  };
  sail(0, 100);
  sail(5000, 5300);  // dated ahead
  sail(200, 6000);   // and the log goes on, through the time that it had
  const auto ships = book.finish();
  ASSERT_EQ(ships.size(), 1u);
  const auto& pieces = ships[0].pieces;
  ASSERT_EQ(pieces.size(), 4u);
  for (std::size_t i = 1; i < pieces.size(); ++i) {
    EXPECT_LT(pieces[i - 1].fixes.back().utc_ms, pieces[i].fixes.front().utc_ms);
  }
  EXPECT_EQ(pieces[1].fixes.front().utc_ms, 1000 * (kLogBegin_s + 220));
  EXPECT_EQ(pieces[2].fixes.front().utc_ms, 1000 * (kLogBegin_s + 5000));
  EXPECT_EQ(pieces[3].fixes.back().utc_ms, 1000 * (kLogBegin_s + 6000));
}

TEST(TrackBook, ALogHeardTwiceIsNoSecondTrack) {
  TrackBook book{TrackRules{}};
  for (int station = 0; station < 2; ++station) {
    for (const double begin : {0.0, 2000.0}) {
      for (int i = 0; i < 10; ++i) book.take(fix_at(kShip, begin + 10.0 * i, 55.0, 11.0));
    }
  }
  const auto ships = book.finish();
  ASSERT_EQ(ships[0].pieces.size(), 2u);
  EXPECT_EQ(ships[0].heard, 20u);
  EXPECT_EQ(book.left_out().of(LeftOut::time_back), 20u);
}

TEST(TrackBook, TakesWhatIsInTheTimeAndTheAreaWanted) {
  TrackBook book{TrackRules{.from = log_time(100),
                            .until = log_time(200),
                            .area = TrackRules::Area{{55.0, 11.0}, 1852.0}}};
  for (int i = 0; i < 40; ++i) {
    book.take(fix_at(kShip, 10.0 * i, 55.0, 11.0));
    book.take(fix_at(kShip + 1, 10.0 * i, 55.0, 11.1));
  }
  EXPECT_EQ(book.left_out().of(LeftOut::out_of_time), 2u * 29);
  EXPECT_EQ(book.left_out().of(LeftOut::out_of_area), 11u);
  const auto ships = book.finish();
  ASSERT_EQ(ships.size(), 1u);
  EXPECT_EQ(ships[0].heard, 11u);
}

TEST(TrackBook, PlacesBeyondTheEarthAreNone) {
  TrackBook book{TrackRules{}};
  book.take(fix_at(kShip, 0, 91.0, 11.0));
  book.take(fix_at(kShip, 0, std::nan(""), 11.0));
  book.take(fix_at(kShip, 0, 55.0, 181.0));
  EXPECT_EQ(book.left_out().of(LeftOut::no_position), 3u);
}

}  // namespace
}  // namespace skerry::server
