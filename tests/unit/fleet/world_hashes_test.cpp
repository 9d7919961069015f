#include "server/fleet/world_hashes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace skerry::fleet {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

WorldDigest digest(std::uint8_t first) { return {first}; }

TEST(WorldHashes, NamesWhoDiffersFromMost) {
  WorldHashes hashes;
  EXPECT_FALSE(hashes.add("a", 10, digest(1)));
  EXPECT_FALSE(hashes.add("b", 10, digest(1)));
  const auto difference = hashes.add("c", 10, digest(2));
  ASSERT_TRUE(difference);
  EXPECT_THAT(difference->hosts, ElementsAre("c"));
  EXPECT_TRUE(difference->is_certain);
  EXPECT_EQ(difference->tick, 10u);
  EXPECT_THAT(difference->text, HasSubstr("tick 10"));
  EXPECT_THAT(difference->text, HasSubstr("of c differs"));
}

TEST(WorldHashes, NamesBothIfNeitherHasMore) {
  WorldHashes hashes;
  (void)hashes.add("b", 10, digest(1));
  const auto two = hashes.add("a", 10, digest(2));
  ASSERT_TRUE(two);
  EXPECT_THAT(two->hosts, ElementsAre("a", "b"));
  EXPECT_FALSE(two->is_certain);
  (void)hashes.add("c", 10, digest(1));
  const auto four = hashes.add("d", 10, digest(2));
  ASSERT_TRUE(four);
  EXPECT_THAT(four->hosts, ElementsAre("a", "b", "c", "d"));
  // The last byte counts as well.
  WorldDigest last{};
  last.back() = 1;
  (void)hashes.add("a", 11, WorldDigest{});
  EXPECT_TRUE(hashes.add("b", 11, last));
}

TEST(WorldHashes, ComparesHostsAtTheSameTickAlone) {
  WorldHashes hashes;
  EXPECT_FALSE(hashes.add("a", 10, digest(1)));
  EXPECT_FALSE(hashes.add("b", 20, digest(2)));
  EXPECT_FALSE(hashes.at(15));
  // A host that came back says it anew.
  EXPECT_TRUE(hashes.add("b", 10, digest(3)));
  EXPECT_FALSE(hashes.add("b", 10, digest(1)));
}

TEST(WorldHashes, KeepsTheNewestTicksAndSoManyHosts) {
  WorldHashes hashes;
  for (Tick tick = 1; tick <= 1000; ++tick) (void)hashes.add("a", tick, digest(1));
  EXPECT_EQ(hashes.ticks(), WorldHashes::kMostTicks);
  EXPECT_FALSE(hashes.add("b", 1, digest(2)));
  EXPECT_TRUE(hashes.add("b", 1000, digest(2)));
  for (int i = 0; i < 1000; ++i) (void)hashes.add("host" + std::to_string(i), 999, digest(1));
  EXPECT_FALSE(hashes.add("one too many", 999, digest(2)));
}

}  // namespace
}  // namespace skerry::fleet
