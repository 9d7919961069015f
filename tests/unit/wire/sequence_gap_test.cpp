#include "protocol/wire/sequence_gap.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

namespace skerry {
namespace {

LossCounter counted(const std::vector<std::uint64_t>& sequence) {
  LossCounter counter;
  for (const std::uint64_t each : sequence) counter.take(each);
  return counter;
}

TEST(LossCounter, LosesNothingInAWholeStream) {
  const LossCounter counter = counted({100, 101, 102, 103});
  EXPECT_EQ(counter.received(), 4u);
  EXPECT_EQ(counter.lost(), 0u);
}

TEST(LossCounter, CountsWhatIsMissingBetweenFirstAndNewest) {
  const LossCounter counter = counted({100, 101, 105, 110});
  EXPECT_EQ(counter.received(), 4u);
  EXPECT_EQ(counter.lost(), 3u + 4u);
}

TEST(LossCounter, TakesBackALossThatWasOnlyLate) {
  const LossCounter counter = counted({100, 103, 102});
  EXPECT_EQ(counter.received(), 3u);
  EXPECT_EQ(counter.lost(), 1u);
  EXPECT_EQ(counter.late(), 1u);
  EXPECT_EQ(counter.duplicates(), 0u);
}

TEST(LossCounter, TellsDuplicatesFromLateOnes) {
  LossCounter counter = counted({100, 103});
  EXPECT_TRUE(counter.take(102));
  EXPECT_FALSE(counter.take(102));
  EXPECT_FALSE(counter.take(103));
  EXPECT_EQ(counter.duplicates(), 2u);
  EXPECT_EQ(counter.late(), 1u);
  EXPECT_EQ(counter.received() + counter.lost(), 4u);
}

TEST(LossCounter, LeavesOutWhatCameBeforeItsFirst) {
  const LossCounter counter = counted({100, 99, 101});
  EXPECT_EQ(counter.received(), 2u);
  EXPECT_EQ(counter.lost(), 0u);
  EXPECT_EQ(counter.late(), 1u);
}

TEST(LossCounter, BeginsANewRunWhenTheSenderStartedAgain) {
  const LossCounter counter = counted({1'000'000, 1'000'001, 0, 1, 3});
  EXPECT_EQ(counter.restarts(), 1u);
  EXPECT_EQ(counter.received(), 5u);
  EXPECT_EQ(counter.lost(), 1u);
}

TEST(LossCounter, BothSidesOfTheWindow) {
  const std::uint64_t newest = 10'000;
  const LossCounter within =
      counted({newest - LossCounter::kWindow - 5, newest, newest - LossCounter::kWindow});
  EXPECT_EQ(within.restarts(), 0u);
  EXPECT_EQ(within.late(), 1u);
  const LossCounter beyond =
      counted({newest - LossCounter::kWindow - 5, newest, newest - LossCounter::kWindow - 1});
  EXPECT_EQ(beyond.restarts(), 1u);
}

TEST(LossCounter, AccountsForEverySpokeUnderLossReorderAndDuplicates) {
  std::mt19937 random(5);
  for (int round = 0; round < 50; ++round) {
    std::vector<std::uint64_t> sent;
    std::uint64_t missing = 0;
    constexpr std::uint64_t kFirst = 42, kLast = 5042;
    for (std::uint64_t s = kFirst; s <= kLast; ++s) {
      const bool end = s == kFirst || s == kLast;
      if (!end && random() % 10 == 0) {
        ++missing;
        continue;
      }
      sent.push_back(s);
      if (random() % 20 == 0) sent.push_back(s);
    }
    const std::uint64_t duplicates = sent.size() + missing - (kLast - kFirst + 1);
    for (std::size_t i = 2; i + 50 < sent.size(); i += 50) {
      std::shuffle(sent.begin() + i, sent.begin() + i + 50, random);
    }
    const LossCounter counter = counted(sent);
    ASSERT_EQ(counter.lost(), missing);
    ASSERT_EQ(counter.duplicates(), duplicates);
    ASSERT_EQ(counter.received(), kLast - kFirst + 1 - missing);
  }
}

}  // namespace
}  // namespace skerry
