#include "protocol/quantity/time.hpp"

#include <gtest/gtest.h>

namespace skerry {
namespace {

using namespace std::chrono_literals;

static_assert(!std::is_convertible_v<ScenarioTime, UtcTime>);

TEST(Duration, SecondsRoundToTheNearestNanosecond) {
  EXPECT_EQ(seconds_as_duration(2.5), 2500ms);
  EXPECT_EQ(seconds_as_duration(-2.5), -2500ms);
  EXPECT_EQ(seconds_as_duration(1.6e-9), 2ns);
  EXPECT_EQ(seconds_as_duration(-1.6e-9), -2ns);
  EXPECT_EQ(in_seconds(1500ms), 1.5);
}

TEST(Duration, ScenarioTimesDifferByADuration) {
  EXPECT_EQ((ScenarioTime(3s) + 2s) - ScenarioTime(1s), 4s);
}

}  // namespace
}  // namespace skerry
