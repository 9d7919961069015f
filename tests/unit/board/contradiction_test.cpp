// Settings that contradict each other, at the very numbers where they begin to.
#include "protocol/board/contradiction.hpp"

#include <gtest/gtest.h>

namespace skerry::board {
namespace {

using Kind = Contradiction::Kind;

JudgedSettings good() {
  JudgedSettings settings;
  settings.pulse_codes = 4;
  settings.pulse_s = 0.08e-6;
  settings.channels[0].is_on = true;
  return settings;
}

void expect(const JudgedSettings& settings, Kind kind, std::uint64_t is, std::uint64_t most,
            std::size_t channel = 0) {
  const auto found = contradiction_in(settings);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->kind, kind);
  EXPECT_EQ(found->is, is);
  EXPECT_EQ(found->most, most);
  EXPECT_EQ(found->channel, channel);
}

TEST(Contradiction, IsNotInTheMapsOwnValues) { EXPECT_FALSE(contradiction_in(good())); }

TEST(Contradiction, JitterAndStaggerCountTwice) {
  // 6666 ticks; one trigger late by both and the next early by both.
  EXPECT_EQ(shortest_trigger_period(20'000'000, 3'000'000, 0, 0), 6666u);
  EXPECT_EQ(shortest_trigger_period(20'000'000, 3'000'000, 50'000, 0), 6666u - 2 * 333);
  EXPECT_EQ(shortest_trigger_period(20'000'000, 3'000'000, 50'000, 100'000),
            6666u - 2 * (333 + 666));
  JudgedSettings settings = good();
  settings.jitter_ppm = 50'000;
  settings.channels[0].samples = 6000;
  EXPECT_FALSE(contradiction_in(settings));
  settings.channels[0].samples = 6002;
  expect(settings, Kind::sweep_length, 6002, 6000);
}

TEST(Contradiction, BeginsOneBeyondWhatIsAllowed) {
  JudgedSettings settings = good();
  settings.delay_ticks = 6666 - 2048;
  EXPECT_FALSE(contradiction_in(settings));
  ++settings.delay_ticks;
  expect(settings, Kind::sweep_length, 6667, 6666);

  settings = good();
  settings.channels[0] = {true, 16, 4, 14, DecimationMode::sum};
  EXPECT_FALSE(contradiction_in(settings));
  ++settings.channels[0].decimation;
  expect(settings, Kind::sum_width, 81'915, 4);

  settings = good();
  settings.channels[0].test_mode = TestMode::target;
  settings.channels[0].test_value = 2047;
  EXPECT_FALSE(contradiction_in(settings));
  ++settings.channels[0].test_value;
  expect(settings, Kind::target, 2048, 2047);

  settings = good();
  settings.pulse_s = 1e-6;
  settings.prf_millihertz = 2'000'000;
  EXPECT_FALSE(contradiction_in(settings));
  settings.prf_millihertz += 1000;
  expect(settings, Kind::duty_cycle, 0, 2000);
  EXPECT_NEAR(contradiction_in(settings)->duty, 0.002001, 1e-12);

  settings = good();
  settings.pulse_code = 4;
  EXPECT_FALSE(contradiction_in(settings));
  settings.pulse_code = 5;
  expect(settings, Kind::pulse_code, 5, 4);
}

TEST(Contradiction, IsLookedForInChannelsThatAreOnAlone) {
  JudgedSettings settings = good();
  settings.channels[1] = {false, 16'384, 1, 12};
  settings.fifo_depth = 2048;
  EXPECT_FALSE(contradiction_in(settings));
  settings.channels[1].is_on = true;
  expect(settings, Kind::sweep_length, 16'384, 6666, 1);
  settings.channels[1].samples = 2;
  expect(settings, Kind::fifo_depth, 2050, 2048);
  settings.channels[0].is_on = settings.channels[1].is_on = false;
  EXPECT_FALSE(contradiction_in(settings));
}

}  // namespace
}  // namespace skerry::board
