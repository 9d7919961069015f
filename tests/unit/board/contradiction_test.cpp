// Settings that contradict each other, at the very numbers where they begin to.
#include "protocol/board/contradiction.hpp"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

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
  const auto found = contradictions_in(settings);
  ASSERT_FALSE(found.empty());
  EXPECT_EQ(found.front().kind, kind);
  EXPECT_EQ(found.front().is, is);
  EXPECT_EQ(found.front().most, most);
  EXPECT_EQ(found.front().channel, channel);
}

TEST(Contradiction, IsNotInTheMapsOwnValues) { EXPECT_TRUE(contradictions_in(good()).empty()); }

TEST(Contradiction, JitterAndStaggerCountTwice) {
  // 6666 ticks; one trigger late by both and the next early by both.
  EXPECT_EQ(shortest_trigger_period(20'000'000, 3'000'000, 0, 0), 6666u);
  EXPECT_EQ(shortest_trigger_period(20'000'000, 3'000'000, 50'000, 0), 6666u - 2 * 333);
  EXPECT_EQ(shortest_trigger_period(20'000'000, 3'000'000, 50'000, 100'000),
            6666u - 2 * (333 + 666));
  JudgedSettings settings = good();
  settings.jitter_ppm = 50'000;
  settings.channels[0].samples = 6000;
  EXPECT_TRUE(contradictions_in(settings).empty());
  settings.channels[0].samples = 6002;
  expect(settings, Kind::sweep_length, 6002, 6000);
}

TEST(Contradiction, BeginsOneBeyondWhatIsAllowed) {
  JudgedSettings settings = good();
  settings.delay_ticks = 6666 - 2048;
  EXPECT_TRUE(contradictions_in(settings).empty());
  ++settings.delay_ticks;
  expect(settings, Kind::sweep_length, 6667, 6666);

  settings = good();
  settings.channels[0] = {true, 16, 4, 14, DecimationMode::sum};
  EXPECT_TRUE(contradictions_in(settings).empty());
  ++settings.channels[0].decimation;
  expect(settings, Kind::sum_width, 81'915, 4);

  settings = good();
  settings.channels[0].test_mode = TestMode::target;
  settings.channels[0].test_value = 2047;
  EXPECT_TRUE(contradictions_in(settings).empty());
  ++settings.channels[0].test_value;
  expect(settings, Kind::target, 2048, 2047);

  settings = good();
  settings.pulse_s = 1e-6;
  settings.prf_millihertz = 2'000'000;
  EXPECT_TRUE(contradictions_in(settings).empty());
  settings.prf_millihertz += 1000;
  expect(settings, Kind::duty_cycle, 0, 2000);
  EXPECT_NEAR(contradictions_in(settings).front().duty, 0.002001, 1e-12);

  settings = good();
  settings.pulse_code = 4;
  EXPECT_TRUE(contradictions_in(settings).empty());
  settings.pulse_code = 5;
  expect(settings, Kind::pulse_code, 5, 4);
}

TEST(Contradiction, IsLookedForInChannelsThatAreOnAlone) {
  JudgedSettings settings = good();
  settings.channels[1] = {false, 16'384, 1, 12};
  settings.fifo_depth = 2048;
  EXPECT_TRUE(contradictions_in(settings).empty());
  settings.channels[1].is_on = true;
  expect(settings, Kind::sweep_length, 16'384, 6666, 1);
  settings.channels[1].samples = 2;
  expect(settings, Kind::fifo_depth, 2050, 2048);
  settings.channels[0].is_on = settings.channels[1].is_on = false;
  EXPECT_TRUE(contradictions_in(settings).empty());
}

TEST(Contradiction, ComesWithAllOthers) {
  JudgedSettings settings = good();
  settings.fifo_depth = 2048;
  settings.pulse_s = 1e-6;
  settings.channels[0] = {true, 16'384, 5, 14, DecimationMode::sum, TestMode::target, 16'384};
  settings.channels[1] = {true, 16'384, 1, 12};
  std::vector<std::pair<Kind, std::size_t>> found;
  for (const Contradiction& each : contradictions_in(settings)) {
    found.emplace_back(each.kind, each.channel);
  }
  const std::vector<std::pair<Kind, std::size_t>> expected = {
      {Kind::duty_cycle, 0}, {Kind::sweep_length, 0}, {Kind::sum_width, 0},
      {Kind::target, 0},     {Kind::sweep_length, 1}, {Kind::fifo_depth, 0}};
  EXPECT_EQ(found, expected);
  settings.pulse_code = 5;
  ASSERT_EQ(contradictions_in(settings).size(), 1u) << "it has no length";
  EXPECT_EQ(contradictions_in(settings).front().kind, Kind::pulse_code);
}

}  // namespace
}  // namespace skerry::board
