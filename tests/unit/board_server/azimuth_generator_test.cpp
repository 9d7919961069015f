#include "server/board/azimuth_generator.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "echo/kernel/hash.hpp"

namespace skerry::server {
namespace {

std::vector<AzimuthGenerator::Pulse> pulses_of(AzimuthGenerator& azimuth, std::size_t count) {
  std::vector<AzimuthGenerator::Pulse> pulses;
  for (std::size_t i = 0; i < count; ++i, azimuth.pop()) pulses.push_back(azimuth.next());
  return pulses;
}

// 12,500 ticks to an ACP, 51,200,000 to a turn.
RotationSettings whole() { return {.clock_hz = 20'480'000, .seed = 11}; }
constexpr double kWholeTurn = 51'200'000.0;

double off_by(Azimuth azimuth, double turns) { return (azimuth.in_turns() - turns) * kWholeTurn; }

TEST(AzimuthGenerator, AtOneAzimuthAcpThenArpThenHeading) {
  AzimuthGenerator azimuth(whole());
  const auto pulses = pulses_of(azimuth, 4);
  EXPECT_EQ(pulses[0].line, AzimuthLine::acp);
  EXPECT_EQ(pulses[1].line, AzimuthLine::arp);
  EXPECT_EQ(pulses[2].line, AzimuthLine::heading);
  EXPECT_EQ(pulses[2].tick, 0u);
  EXPECT_EQ(pulses[3].line, AzimuthLine::acp);
  EXPECT_EQ(pulses[3].tick, 12'500u);
}

TEST(AzimuthGenerator, TheArpStandsWhereItsErrorPutsIt) {
  for (const std::int32_t error : {-32'768, -8, 0, 16, 24, 32'767}) {
    RotationSettings settings = whole();
    settings.arp_error = error;
    AzimuthGenerator azimuth(settings);
    std::vector<Tick> arps;
    while (arps.size() < 3) {
      if (azimuth.next().line == AzimuthLine::arp) arps.push_back(azimuth.next().tick);
      azimuth.pop();
    }
    const double place = (error < 0 ? 65'536 + error : error) / 65'536.0;
    for (std::size_t n = 0; n < 3; ++n) {
      EXPECT_NEAR(static_cast<double>(arps[n]), (static_cast<double>(n) + place) * kWholeTurn, 0.5);
    }
  }
}

TEST(AzimuthGenerator, WhereItPointsIsTheInverseOfWhenItPasses) {
  for (const std::uint32_t disturbed : {0u, 1u}) {
    RotationSettings settings = whole();
    settings.acp_per_turn = 450;
    settings.wow_ppm = disturbed * 100'000;
    settings.wow_per_turn = 3;
    settings.gust_ppm = disturbed * 300'000;
    AzimuthGenerator azimuth(settings);
    azimuth.skip_turns(1000);
    double worst = 0.0;
    for (std::uint32_t acp = 0; acp < 2000;) {
      const AzimuthGenerator::Pulse pulse = azimuth.next();
      azimuth.pop();
      if (pulse.line != AzimuthLine::acp) continue;
      // Half a tick of rounding, at the highest speed.
      worst = std::max(worst, std::fabs(off_by(azimuth.at(pulse.tick), 1000.0 + acp++ / 450.0)));
    }
    std::printf("worst: %.4f ticks\n", worst);
    EXPECT_LE(worst, disturbed != 0 ? 0.75 : 0.5001);
  }
}

TEST(AzimuthGenerator, DisturbedAzimuthsNeverGoBack) {
  for (const std::uint32_t waves : {1u, 7u, 64u}) {
    RotationSettings settings{.clock_hz = 1'000'000, .milli_rpm = 60'000, .acp_per_turn = 16'384};
    settings.wow_ppm = 100'000;
    settings.wow_per_turn = waves;
    settings.gust_ppm = 300'000;
    settings.seed = waves;
    AzimuthGenerator azimuth(settings);
    azimuth.inject({.missing_acp = 500, .extra_acp = 500, .missing_arp = 1, .stall = 1234}, 0);
    Tick last = 0;
    Azimuth pointed;
    for (int i = 0; i < 100'000; ++i, azimuth.pop()) {
      const Tick tick = azimuth.next().tick;
      ASSERT_GE(tick, last);
      last = tick;
      const Azimuth now = azimuth.at(tick + static_cast<Tick>(i % 60));
      if (i % 60 == 0) {
        ASSERT_GE(now, pointed);
        pointed = now;
      }
    }
  }
}

// Speed over the mean, from ACP to ACP, for so many turns: least and greatest of each turn.
struct Speeds {
  double least = 1e9, greatest = 0.0;
};
std::vector<Speeds> speeds_of(const RotationSettings& settings, int turns) {
  AzimuthGenerator azimuth(settings);
  std::vector<Speeds> speeds;
  const double even = settings.clock_hz * 60'000.0 / settings.milli_rpm / settings.acp_per_turn;
  Tick last = 0;
  for (int turn = 0; turn < turns; ++turn) {
    Speeds found;
    for (std::uint32_t acp = 0; acp < settings.acp_per_turn;) {
      const AzimuthGenerator::Pulse pulse = azimuth.next();
      azimuth.pop();
      if (pulse.line != AzimuthLine::acp) continue;
      ++acp;
      if (pulse.tick == 0) continue;
      const double speed = even / static_cast<double>(pulse.tick - last);
      found.least = std::min(found.least, speed);
      found.greatest = std::max(found.greatest, speed);
      last = pulse.tick;
    }
    speeds.push_back(found);
  }
  return speeds;
}

TEST(AzimuthGenerator, WowDeviatesAsMuchAsAsked) {
  for (const std::uint32_t ppm : {1000u, 20'000u, 100'000u}) {
    RotationSettings settings{.clock_hz = 125'000'000, .acp_per_turn = 1024};
    settings.wow_ppm = ppm;
    settings.wow_per_turn = 5;
    const double w = ppm * 1e-6;
    for (const Speeds& turn : speeds_of(settings, 3)) {
      EXPECT_NEAR(turn.greatest, 1.0 + w, 2e-3 * w + 1e-5);
      // The slow half of a wave is longer.
      EXPECT_NEAR(turn.least, (1.0 + w) / (1.0 + 2.0 * w), 2e-3 * w + 1e-5);
    }
  }
}

TEST(AzimuthGenerator, GustsVaryAndNeverExceedWhatWasAsked) {
  RotationSettings settings{.clock_hz = 20'480'000, .acp_per_turn = 512, .gust_ppm = 300'000};
  settings.seed = 5;
  double greatest = 0.0, sum = 0.0;
  const auto turns = speeds_of(settings, 400);
  for (const Speeds& turn : turns) {
    greatest = std::max(greatest, turn.greatest);
    sum += turn.greatest - 1.0;
    ASSERT_LE(turn.greatest, 1.3);
    ASSERT_GE(turn.least, 1.0 / 1.3);
  }
  EXPECT_GT(greatest, 1.28);
  // Strength uniform in [0, 1): mean of u a / (1 - u a), a = 0.3 / 1.3, is 0.137.
  EXPECT_NEAR(sum / static_cast<double>(turns.size()), 0.137, 0.02);
}

TEST(AzimuthGenerator, DisturbancesLeaveTheBowsTimeAlone) {
  RotationSettings settings = whole();
  settings.wow_ppm = 100'000;
  settings.wow_per_turn = 2;
  settings.gust_ppm = 300'000;
  AzimuthGenerator azimuth(settings);
  azimuth.skip_turns(1'000'000);
  EXPECT_EQ(azimuth.next().tick, 51'200'000ull * 1'000'000);
}

TEST(AzimuthGenerator, AStallShiftsAllThatFollows) {
  AzimuthGenerator azimuth(whole());
  pulses_of(azimuth, 103);  // up to ACP 100
  azimuth.inject({.stall = 1'000'000}, 0);
  EXPECT_TRUE(azimuth.disturbed(1'250'000));
  const auto pulses = pulses_of(azimuth, 3);
  EXPECT_EQ(pulses[0].tick, 101u * 12'500u);
  EXPECT_EQ(pulses[1].tick, 102u * 12'500u + 1'000'000u);
  EXPECT_EQ(pulses[2].tick, 103u * 12'500u + 1'000'000u);
  EXPECT_NEAR(off_by(azimuth.at(1'262'500), 101.0 / 4096), 0.0, 1e-6);
  EXPECT_NEAR(off_by(azimuth.at(2'262'499), 101.0 / 4096), 0.0, 1e-6);
  EXPECT_NEAR(off_by(azimuth.at(2'262'500 + 6250), 101.5 / 4096), 0.0, 1e-6);
  EXPECT_EQ(azimuth.left(1'762'500).stall, 500'000u);
  EXPECT_EQ(azimuth.left(2'262'500).stall, 0u);
}

TEST(AzimuthGenerator, OtherSettingsGoOnFromWhereItPoints) {
  AzimuthGenerator azimuth(whole());
  Tick now = 0;
  RotationSettings settings = whole();
  for (std::uint64_t i = 1; i < 200; ++i) {
    // About a quarter of a turn with each.
    const Tick until = now + settings.clock_hz * 60'000ull / settings.milli_rpm / 4;
    Tick last = now;
    while (azimuth.next().tick < until) {
      ASSERT_GE(azimuth.next().tick, last);
      last = azimuth.next().tick;
      azimuth.pop();
    }
    const Azimuth before = azimuth.at(until);
    const std::uint64_t random = echo::mixed(i);
    settings.clock_hz = 10'000'000 + static_cast<std::uint32_t>(random % 3) * 30'000'000;
    settings.milli_rpm = 12'000 + static_cast<std::uint32_t>(random >> 8 & 0x7FFF);
    settings.acp_per_turn = 360 + static_cast<std::uint32_t>(random >> 24 & 0x1FFF);
    settings.wow_ppm = static_cast<std::uint32_t>(random >> 40 & 0xFFFF);
    settings.gust_ppm = static_cast<std::uint32_t>(random >> 44 & 0xFFFF);
    now = echo::mixed(i, 1) % (1ull << 50);  // of the new clock
    azimuth.set(settings, until, now);
    EXPECT_NEAR(azimuth.at(now).in_turns(), before.in_turns(), 1e-9);
    ASSERT_GE(azimuth.next().tick, now);
    // The next ACP lies at most one of them ahead.
    EXPECT_LT(static_cast<double>(azimuth.next().tick - now),
              1.6 * settings.clock_hz * 60'000.0 / settings.milli_rpm / settings.acp_per_turn);
  }
}

}  // namespace
}  // namespace skerry::server
