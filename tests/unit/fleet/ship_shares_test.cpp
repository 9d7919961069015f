// Which own ships a host takes and gives up: all are had, none by more hosts than one.
#include "server/fleet/ship_shares.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

namespace skerry::fleet {
namespace {

using testing::IsEmpty;
using testing::SizeIs;

TEST(ShipShares, NamesAreReadBack) {
  EXPECT_EQ(ship_of(ship_name(17)), 17u);
  for (const char* const name : {"leader", "ship/", "ship/x", "ship/1x", "host/ship/1", "ship/-1"})
    EXPECT_FALSE(ship_of(name)) << name;
}

TEST(ShipShares, AHostAloneTakesAll) {
  const std::vector<std::string> free(5);
  EXPECT_THAT(shares_of("a", free, {"a"}).take, SizeIs(5));
  EXPECT_FALSE(shares_of("a", std::vector<std::string>(5, "a"), {"a"}).give_up);
}

TEST(ShipShares, NoHostTakesMoreThanItsShare) {
  const std::vector<std::string> free(7);
  EXPECT_THAT(shares_of("a", free, {"a", "b", "c"}).take, SizeIs(3));
  std::vector<std::string> held(7);
  held[0] = held[1] = "a";
  EXPECT_THAT(shares_of("a", held, {"a", "b", "c"}).take, SizeIs(1));
}

TEST(ShipShares, HostsLikeDifferentShips) {
  const std::vector<std::string> free(30);
  const auto a = shares_of("a", free, {"a", "b", "c"}).take;
  const auto b = shares_of("b", free, {"a", "b", "c"}).take;
  ASSERT_THAT(a, SizeIs(10));
  EXPECT_NE(std::set(a.begin(), a.end()), std::set(b.begin(), b.end()));
}

// Hosts come and go; one ship at a time moves, as over the store; nothing moves without need.
TEST(ShipShares, ComeToRestEvenlyWhoeverComesAndGoes) {
  for (std::size_t ships : {1u, 2u, 7u, 30u}) {
    std::vector<std::string> holders(ships);
    for (const std::set<std::string>& present : std::vector<std::set<std::string>>{
             {"a"}, {"a", "b"}, {"a", "b", "c"}, {"b", "c"}, {"b", "c", "d", "e"}, {"e"}}) {
      for (std::string& holder : holders) {
        if (!present.contains(holder)) holder.clear();
      }
      std::size_t moves = 0;
      for (bool moved = true; moved;) {
        moved = false;
        ASSERT_LT(++moves, 200u) << ships;
        for (const std::string& host : present) {
          const Shares shares = shares_of(host, holders, present);
          for (const std::size_t ship : shares.take) {
            ASSERT_EQ(holders[ship], "");
            holders[ship] = host;
            moved = true;
          }
          if (!shares.give_up) continue;
          ASSERT_EQ(holders[*shares.give_up], host);
          holders[*shares.give_up].clear();
          moved = true;
        }
      }
      for (const std::string& host : present) {
        const auto has = static_cast<std::size_t>(std::count(holders.begin(), holders.end(), host));
        EXPECT_GE(has, ships / present.size());
        EXPECT_LE(has, (ships + present.size() - 1) / present.size());
      }
      EXPECT_EQ(std::count(holders.begin(), holders.end(), ""), 0);
    }
  }
}

}  // namespace
}  // namespace skerry::fleet
