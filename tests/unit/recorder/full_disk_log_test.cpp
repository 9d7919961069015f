#include "server/recorder/full_disk_log.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace skerry::server {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using testing::HasSubstr;

DiskState disk(bool is_full) {
  DiskState state;
  state.is_full = is_full;
  state.free_bytes = 300u << 20;
  return state;
}

TEST(FullDiskLog, TellsBeginAndEndWithWhatIsMissing) {
  FullDiskLog log;
  FullDiskLog::Steady now{};
  EXPECT_FALSE(log.look(disk(false), 7, now));
  const auto begin = log.look(disk(true), 7, now += seconds(1));
  ASSERT_TRUE(begin);
  EXPECT_THAT(*begin, HasSubstr("the disk is full (300 MiB free)"));
  for (int i = 0; i < 100; ++i) EXPECT_FALSE(log.look(disk(true), 8, now += milliseconds(50)));
  EXPECT_FALSE(log.look(disk(false), 1007, now += milliseconds(50)));
  const auto end = log.look(disk(false), 1007, now += FullDiskLog::kCalm);
  ASSERT_TRUE(end);
  EXPECT_THAT(*end,
              HasSubstr("room again: it took nothing for 5.0 s, and 1000 spokes are missing"));
  EXPECT_FALSE(log.look(disk(false), 1007, now += seconds(60)));
  EXPECT_FALSE(log.end(1007));
}

TEST(FullDiskLog, IsQuietWhereRoomComesAndGoes) {
  FullDiskLog log;
  FullDiskLog::Steady now{};
  EXPECT_TRUE(log.look(disk(true), 0, now));
  for (int i = 0; i < 100; ++i) EXPECT_FALSE(log.look(disk(i % 2 == 0), 10, now += seconds(1)));
  const auto end = log.end(10);
  ASSERT_TRUE(end);
  EXPECT_THAT(*end, HasSubstr("10 spokes are missing"));
}

TEST(FullDiskLog, TellsAtTheEndThatItIsStillFull) {
  FullDiskLog log;
  EXPECT_TRUE(log.look(disk(true), 0, {}));
  EXPECT_THAT(log.end(5).value_or(""), HasSubstr("still full at the end"));
}

}  // namespace
}  // namespace skerry::server
