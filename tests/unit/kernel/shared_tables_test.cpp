#include "echo/kernel/shared_tables.hpp"

#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <memory>
#include <thread>
#include <vector>

namespace skerry::echo {
namespace {

using Numbers = std::vector<int>;

TEST(SharedTables, GivesTheSameTableForTheSameKeyAndAnotherForAnother) {
  SharedTables<int, Numbers> tables;
  int made = 0;
  const auto of = [&](int key) {
    return tables.get(key, [&] {
      ++made;
      return Numbers(3, key);
    });
  };
  const auto first = of(7), other = of(8), again = of(7);
  EXPECT_EQ(first, again);
  EXPECT_NE(first, other);
  EXPECT_EQ(*other, Numbers(3, 8));
  EXPECT_EQ(made, 2);
}

TEST(SharedTables, FreesATableWithItsLastHolder) {
  struct Counted {
    explicit Counted(int& count) : all(count) { ++all; }
    Counted(const Counted& from) : all(from.all) { ++all; }
    ~Counted() { --all; }
    int& all;
  };
  int in_use = 0;
  SharedTables<int, Counted> tables;
  auto one = tables.get(1, [&] { return Counted(in_use); });
  auto two = tables.get(1, [&] { return Counted(in_use); });
  EXPECT_EQ(in_use, 1);
  one.reset();
  EXPECT_EQ(in_use, 1);
  two.reset();
  EXPECT_EQ(in_use, 0);
  EXPECT_NE(tables.get(1, [&] { return Counted(in_use); }), nullptr);
  EXPECT_EQ(in_use, 0);
}

TEST(SharedTables, MakeEachTableOnceForManyThreads) {
  constexpr int kKeys = 5;
  SharedTables<int, Numbers> tables;
  std::atomic<int> made = 0;
  std::array<std::vector<std::shared_ptr<const Numbers>>, 4> held;
  std::vector<std::jthread> threads;
  for (auto& mine : held) {
    threads.emplace_back([&] {
      for (int key = 0; key < kKeys; ++key)
        mine.push_back(tables.get(key, [&] {
          ++made;
          return Numbers(1000, key);
        }));
    });
  }
  threads.clear();
  EXPECT_EQ(made, kKeys);
  for (const auto& mine : held) EXPECT_EQ(mine, held[0]);
}

TEST(SharedTables, NobodyWaitsForATableOfAnotherKey) {
  SharedTables<int, Numbers> tables;
  const auto outer =
      tables.get(1, [&] { return Numbers(tables.get(2, [] { return Numbers(4); })->size()); });
  EXPECT_EQ(outer->size(), 4u);
}

TEST(KeptTables, StayAsLongAsTheyAreAmongTheLastAskedFor) {
  KeptTables<int, Numbers, 2> tables;
  int made = 0;
  const auto ask = [&](int key) {
    tables.get(key, [&] {
      ++made;
      return Numbers(1, key);
    });
  };
  ask(1), ask(2), ask(1);
  EXPECT_EQ(made, 2);
  ask(3);  // 2 goes
  ask(1);
  EXPECT_EQ(made, 3);
  ask(2);
  EXPECT_EQ(made, 4);
}

}  // namespace
}  // namespace skerry::echo
