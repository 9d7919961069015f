#include "echo/kernel/shelf.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <thread>
#include <vector>

namespace skerry::echo {
namespace {

TEST(Shelf, GivesFirstWhatWasPutBackLast) {
  Shelf<std::vector<int>> shelf;
  EXPECT_TRUE(shelf.take().empty());
  std::vector<int> first(10), second(20);
  const int* const last = second.data();
  shelf.put_back(std::move(first));
  shelf.put_back(std::move(second));
  const std::vector<int> taken = shelf.take();
  EXPECT_EQ(taken.data(), last);
  EXPECT_EQ(shelf.take().size(), 10u);
  EXPECT_EQ(shelf.count(), 0u);
}

TEST(Shelf, HoldsNoMoreThanWereInUseAtOnce) {
  Shelf<std::unique_ptr<int>> shelf;
  for (int i = 0; i < 1000; ++i) {
    std::unique_ptr<int> mine = shelf.take();
    if (!mine) mine = std::make_unique<int>(i);
    shelf.put_back(std::move(mine));
  }
  EXPECT_EQ(shelf.count(), 1u);
}

TEST(Shelf, GivesNothingToTwoThreadsAtOnce) {
  Shelf<std::unique_ptr<int>> shelf;
  std::vector<std::jthread> threads;
  for (int t = 0; t < 4; ++t) {
    threads.emplace_back([&] {
      for (int i = 0; i < 2000; ++i) {
        std::unique_ptr<int> mine = shelf.take();
        if (!mine) mine = std::make_unique<int>(0);
        const int before = *mine;
        *mine += 1;
        EXPECT_EQ(*mine, before + 1);
        shelf.put_back(std::move(mine));
      }
    });
  }
  threads.clear();
  int sum = 0;
  while (const auto thing = shelf.take()) sum += *thing;
  EXPECT_EQ(sum, 8000);
}

}  // namespace
}  // namespace skerry::echo
