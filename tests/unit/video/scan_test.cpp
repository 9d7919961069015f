#include "protocol/video/scan.hpp"

#include <gtest/gtest.h>

#include "tests/unit/picture/synthetic_scan.hpp"

namespace skerry {
namespace {

constexpr std::uint32_t kSpokes = kSmall.spokes_per_turn;

std::optional<Scan> feed_range(ScanAssembler& assembler, std::uint32_t scan, std::uint32_t from,
                               std::uint32_t to) {
  std::optional<Scan> finished;
  for (std::uint32_t i = from; i < to; ++i) {
    if (auto one = assembler.feed(spoke_of(kSmall, scan, i))) {
      EXPECT_FALSE(finished) << "two scans handed out";
      finished = std::move(one);
    }
  }
  return finished;
}

TEST(ScanAssembler, HandsOutAScanWithItsLastSpoke) {
  ScanAssembler assembler;
  EXPECT_FALSE(feed_range(assembler, 3, 0, kSpokes - 1));
  const auto scan = assembler.feed(spoke_of(kSmall, 3, kSpokes - 1));
  ASSERT_TRUE(scan);
  EXPECT_EQ(scan->number, 3u);
  EXPECT_TRUE(scan->is_complete());
  EXPECT_EQ(scan->newest()->header.index, kSpokes - 1);
  for (std::uint32_t i = 0; i < kSpokes; ++i) EXPECT_EQ(scan->spokes[i]->header.index, i);
  EXPECT_EQ(assembler.unfinished().received, 0u);
}

TEST(ScanAssembler, HandsOutAnIncompleteScanWhenTheNextBegins) {
  ScanAssembler assembler;
  EXPECT_FALSE(feed_range(assembler, 3, 0, 100));
  EXPECT_FALSE(feed_range(assembler, 3, 110, kSpokes));
  const auto scan = assembler.feed(spoke_of(kSmall, 4, 0));
  ASSERT_TRUE(scan);
  EXPECT_EQ(scan->number, 3u);
  EXPECT_EQ(scan->missing(), 10u);
  EXPECT_FALSE(scan->spokes[105]);
  EXPECT_TRUE(scan->spokes[110]);
  EXPECT_EQ(assembler.unfinished().number, 4u);
  EXPECT_EQ(assembler.unfinished().received, 1u);
}

TEST(ScanAssembler, ShowsThatReceptionBeganInTheMiddleOfATurn) {
  ScanAssembler assembler;
  EXPECT_FALSE(feed_range(assembler, 9, 200, kSpokes));
  const auto first = feed_range(assembler, 10, 0, 1);
  ASSERT_TRUE(first);
  EXPECT_EQ(first->missing(), 200u);
  const auto second = feed_range(assembler, 10, 1, kSpokes);
  ASSERT_TRUE(second);
  EXPECT_TRUE(second->is_complete());
}

TEST(ScanAssembler, TakesSpokesInAnyOrderAndDropsDuplicates) {
  ScanAssembler assembler;
  for (std::uint32_t i = 0; i < kSpokes; i += 2) {
    EXPECT_FALSE(assembler.feed(spoke_of(kSmall, 0, i)));
    EXPECT_FALSE(assembler.feed(spoke_of(kSmall, 0, i)));
  }
  std::optional<Scan> scan;
  for (std::uint32_t i = 1; i < kSpokes; i += 2) scan = assembler.feed(spoke_of(kSmall, 0, i));
  ASSERT_TRUE(scan);
  EXPECT_TRUE(scan->is_complete());
  EXPECT_EQ(assembler.dropped(), kSpokes / 2);
}

TEST(ScanAssembler, DropsSpokesOfAScanAlreadyHandedOut) {
  ScanAssembler assembler;
  feed_range(assembler, 3, 0, kSpokes - 1);
  ASSERT_TRUE(assembler.feed(spoke_of(kSmall, 4, 0)));
  EXPECT_FALSE(assembler.feed(spoke_of(kSmall, 3, kSpokes - 1)));
  EXPECT_EQ(assembler.dropped(), 1u);
  EXPECT_EQ(assembler.unfinished().number, 4u);
  const auto scan = feed_range(assembler, 4, 1, kSpokes);
  ASSERT_TRUE(scan);
  EXPECT_TRUE(scan->is_complete());
}

TEST(ScanAssembler, BeginsANewScanWhenTheGeometryChanges) {
  ScanAssembler assembler;
  feed_range(assembler, 3, 0, 50);
  const ScanGeometry finer{.spokes_per_turn = 512, .cells = 256, .bits = 8};
  const auto scan = assembler.feed(spoke_of(finer, 3, 400));
  ASSERT_TRUE(scan);
  EXPECT_EQ(scan->received, 50u);
  EXPECT_EQ(assembler.unfinished().geometry, finer);
}

TEST(Scan, KnowsWhetherTheRangeScaleChanged) {
  Scan scan = empty_scan(kSmall, 0.0);
  EXPECT_TRUE(scan.has_one_range_scale());
  scan.spokes[10]->header.range_scale = *RangeScale::find(3.0);
  EXPECT_FALSE(scan.has_one_range_scale());
  EXPECT_FALSE(Scan{}.has_one_range_scale());
  EXPECT_EQ(Scan{}.newest(), nullptr);
}

}  // namespace
}  // namespace skerry
