// Numbers, times and reach of played spokes: pure functions.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "server/playback/play_clock.hpp"
#include "server/relayed/relayed_view.hpp"
#include "server/relayed/sendable_text.hpp"
#include "server/relayed/spoke_reach.hpp"
#include "server/relayed/spoke_stamp.hpp"

namespace skerry::server {
namespace {

using namespace std::chrono_literals;

TEST(PlayClock, AMomentIsDueItsShareOfTheRateAfterTheAnchor) {
  PlayClock clock;
  const PlayClock::SteadyTime steady(1000s);
  const UtcTime moment(500s);
  for (const double rate : {0.1, 1.0, 16.0, 100.0}) {
    clock.set(moment, steady, rate);
    EXPECT_EQ(clock.due(moment), steady);
    EXPECT_NEAR(in_seconds(clock.due(moment + 10s) - steady), 10.0 / rate, 1e-6);
    EXPECT_NEAR(in_seconds(clock.at(steady + 3s) - moment), 3.0 * rate, 1e-6);
  }
}

TEST(PlayClock, NothingADayLateAddsUpToAMicrosecond) {
  PlayClock clock;
  clock.set(UtcTime(1'795'341'600s), PlayClock::SteadyTime(77s), 0.3);
  for (int hour = 1; hour <= 24; ++hour) {
    const UtcTime moment = UtcTime(1'795'341'600s) + std::chrono::hours(hour);
    EXPECT_LT(std::abs((clock.at(clock.due(moment)) - moment).count()), 1000);
  }
}

TEST(PlayClock, ATimeThatOnlyAHostileFileHasDoesNotOverflow) {
  PlayClock clock;
  clock.set(UtcTime(0s), PlayClock::SteadyTime(0s), 0.1);
  EXPECT_GT(clock.due(UtcTime(Duration(std::numeric_limits<std::int64_t>::max()))),
            PlayClock::SteadyTime(std::chrono::hours(24 * 365)));
}

SpokeHeader header(std::uint64_t sequence, std::uint32_t scan) {
  SpokeHeader out;
  out.geometry = {256, 128, 8};
  out.sequence = sequence;
  out.scan = scan;
  return out;
}

TEST(SpokeStamp, NumbersGrowAsRecordedAndKeepAGapOfLessThanATurn) {
  SpokeStamp stamp;
  SpokeHeader spoke = header(1'000'000, 70);
  stamp.put_on(spoke);
  EXPECT_EQ(spoke.sequence, 0u);
  EXPECT_EQ(spoke.scan, 0u);
  spoke = header(1'000'001, 70);
  stamp.put_on(spoke);
  EXPECT_EQ(spoke.sequence, 1u);
  EXPECT_EQ(spoke.scan, 0u);
  spoke = header(1'000'101, 71);
  stamp.put_on(spoke);
  EXPECT_EQ(spoke.sequence, 101u);
  EXPECT_EQ(spoke.scan, 1u);
  spoke = header(1'000'900, 74);  // more than a turn is missing: the source's count, not a loss
  stamp.put_on(spoke);
  EXPECT_EQ(spoke.sequence, 102u);
  EXPECT_EQ(spoke.scan, 4u);
}

TEST(SpokeStamp, NumbersNeverGoBackWhateverIsRecorded) {
  SpokeStamp stamp;
  std::uint64_t last_sequence = 0;
  std::uint32_t last_scan = 0;
  bool first = true;
  const std::uint64_t sequences[] = {7, 8, 8, 3, UINT64_MAX, 0, 1, 500'000, 2, 2};
  const std::uint32_t scans[] = {3, 3, 2, 9, UINT32_MAX, 0, 4'000'000'000u, 1, 1, 0};
  for (int round = 0; round < 3; ++round) {
    for (std::size_t i = 0; i < std::size(sequences); ++i) {
      SpokeHeader spoke = header(sequences[i], scans[i]);
      stamp.put_on(spoke);
      if (!first) {
        EXPECT_GT(spoke.sequence, last_sequence);
        EXPECT_GE(spoke.scan, last_scan);
      }
      first = false;
      last_sequence = spoke.sequence;
      last_scan = spoke.scan;
    }
    stamp.begin_anew();
  }
}

TEST(SpokeStamp, AJumpBackBeginsAnotherTurn) {
  SpokeStamp stamp;
  SpokeHeader spoke = header(100, 5);
  stamp.put_on(spoke);
  stamp.begin_anew();
  spoke = header(100, 5);
  stamp.put_on(spoke);
  EXPECT_EQ(spoke.sequence, 1u);
  EXPECT_EQ(spoke.scan, 1u);
}

Spoke spoke_of(std::vector<std::uint8_t> cells) {
  Spoke spoke;
  spoke.header.range_scale = *RangeScale::find(6.0);
  spoke.header.geometry = {256, static_cast<std::uint32_t>(cells.size()), 8};
  spoke.cells = std::move(cells);
  return spoke;
}

TEST(SpokeReach, AShorterReachShowsTheNearerCellsLarger) {
  const Spoke spoke = spoke_of({1, 2, 3, 4, 5, 6, 7, 8});
  const Spoke half = reaching(spoke, spoke.header.reach() / 2.0);
  EXPECT_EQ(half.cells, (std::vector<std::uint8_t>{1, 1, 2, 2, 3, 3, 4, 4}));
  EXPECT_EQ(half.header.cell_size() * 2.0, spoke.header.cell_size());
}

TEST(SpokeReach, ALongerReachKeepsThePeaksAndShowsNothingBeyond) {
  Spoke spoke = spoke_of({1, 9, 3, 4, 200, 6, 7, 8});
  spoke.doppler.assign(8, DopplerClass::none);
  spoke.doppler[4] = DopplerClass::receding;
  const Spoke twice = reaching(spoke, spoke.header.reach() * 2.0);
  EXPECT_EQ(twice.cells, (std::vector<std::uint8_t>{9, 4, 200, 8, 0, 0, 0, 0}));
  EXPECT_EQ(twice.doppler[2], DopplerClass::receding);
  EXPECT_EQ(twice.doppler[1], DopplerClass::none);
}

TEST(SpokeReach, NoEchoIsLostAndNoneMovesByMoreThanACell) {
  for (const double share : {0.0625, 0.3, 0.77, 1.125, 1.72, 1.95, 2.0}) {
    for (std::size_t at = 0; at < 300; at += 7) {
      std::vector<std::uint8_t> cells(300, 0);
      cells[at] = 255;
      const Spoke spoke = spoke_of(std::move(cells));
      const Spoke out = reaching(spoke, spoke.header.reach() * share);
      const double middle_m =
          (static_cast<double>(at) + 0.5) * spoke.header.cell_size().in_metres();
      const double cell_m = std::max(spoke.header.cell_size(), out.header.cell_size()).in_metres();
      bool seen = false;
      for (std::size_t cell = 0; cell < out.cells.size(); ++cell) {
        if (out.cells[cell] == 0) continue;
        seen = true;
        const double here_m =
            (static_cast<double>(cell) + 0.5) * out.header.cell_size().in_metres();
        EXPECT_LE(std::abs(here_m - middle_m), cell_m * 1.0001) << share << " " << at;
      }
      EXPECT_EQ(seen, middle_m < out.header.reach().in_metres()) << share << " " << at;
    }
  }
}

TEST(WantedReach, StaysTheSameMultipleOfTheRangeScaleWithinWhatASpokeMaySay) {
  const RangeScale six = *RangeScale::find(6.0), twelve = *RangeScale::find(12.0);
  const WantedReach reach{1.72 * six.length().in_metres(), six};
  EXPECT_DOUBLE_EQ(reach.on(six) / six.length(), 1.72);
  EXPECT_DOUBLE_EQ(reach.on(twelve) / twelve.length(), 1.72);
  EXPECT_EQ((WantedReach{0.0, six}.on(twelve)), twelve.length());
}

TEST(SendableText, IsUtf8OfAtMostSoManyBytesInWholeCharacters) {
  EXPECT_EQ(sendable("Bj\xC3\xB8rn", 100), "Bj\xC3\xB8rn");
  EXPECT_EQ(sendable("Bj\xC3\xB8rn", 3), "Bj");
  EXPECT_EQ(sendable("a\xFF\xC0\x80z", 100), "a???z");
  EXPECT_EQ(sendable("\xED\xA0\x80", 100), "???") << "a surrogate is no character";
  EXPECT_EQ(sendable("\xF0\x9F\x9A\xA2!", 100), "\xF0\x9F\x9A\xA2!");
  EXPECT_EQ(sendable("\xE2\x82", 100), "??") << "cut off";
}

}  // namespace
}  // namespace skerry::server
