#include "server/core/latest.hpp"

#include <gtest/gtest.h>

#include <string>
#include <thread>

namespace skerry::server {
namespace {

TEST(Latest, IsEmptyUntilTheFirstSet) {
  Latest<int> latest;
  EXPECT_EQ(latest.get(), nullptr);
  latest.set(7);
  EXPECT_EQ(*latest.get(), 7);
}

TEST(Latest, AReaderKeepsTheValueItGot) {
  Latest<std::string> latest(std::string("old"));
  const auto held = latest.get();
  latest.set(std::string("new"));
  EXPECT_EQ(*held, "old");
  EXPECT_EQ(*latest.get(), "new");
}

TEST(Latest, ReadersOfAnotherThreadSeeOnlyWholeValuesThatNeverGoBack) {
  struct Pair {
    int a = 0;
    int b = 0;
  };
  constexpr int kLast = 20'000;
  Latest<Pair> latest(Pair{});
  std::thread writer([&latest] {
    for (int i = 1; i <= kLast; ++i) latest.set(Pair{i, -i});
  });
  for (int previous = 0; previous < kLast;) {
    const auto value = latest.get();
    EXPECT_EQ(value->a, -value->b);
    EXPECT_GE(value->a, previous);
    previous = value->a;
  }
  writer.join();
}

}  // namespace
}  // namespace skerry::server
