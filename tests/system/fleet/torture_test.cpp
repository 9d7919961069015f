#include "tests/system/fleet/torture.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>

namespace skerry::fleet {
namespace {

TEST(Fleet, KeepsOneLogWhateverDies) {
  TorturePlan plan;
  const TortureReport report = torture(plan);
  std::printf("%s", report.text().c_str());
  EXPECT_THAT(report.contradictions, testing::IsEmpty());
  // It was at work, and was disturbed.
  EXPECT_GT(report.done, 50u);
  EXPECT_GT(report.seen, 50u);
  EXPECT_GT(report.deposed, 0u);
  EXPECT_GT(report.epochs, 1u);
  EXPECT_GT(report.members_killed + report.members_stopped, 3u);
}

}  // namespace
}  // namespace skerry::fleet
