#include "server/radar/tables_ahead.hpp"

#include <gtest/gtest.h>

#include <future>
#include <memory>
#include <new>
#include <thread>
#include <vector>

namespace skerry::server {
namespace {

TablesAhead::Wish wish_for(double nm) { return {*RangeScale::find(nm), {}}; }

// Asks until it is granted, as sector after sector does.
void await(TablesAhead& tables, const TablesAhead::Wish& wish, const TablesAhead::Make& make) {
  while (!tables.ready(wish, [&] { return make; })) std::this_thread::yield();
}

TEST(TablesAhead, AreHeldFromWhenTheyAreMadeUntilTheyAreLetGo) {
  std::weak_ptr<const void> made;
  TablesAhead tables;
  await(tables, wish_for(3.0), [&]() -> std::shared_ptr<const void> {
    auto table = std::make_shared<std::vector<int>>(10);
    made = table;
    return table;
  });
  EXPECT_FALSE(made.expired());
  tables.let_go();
  EXPECT_TRUE(made.expired());
}

TEST(TablesAhead, AWishWaitsForItsTablesAndForNoOthers) {
  std::promise<void> may_go_on;
  int made = 0;
  TablesAhead tables;
  const auto slow = [&]() -> std::shared_ptr<const void> {
    may_go_on.get_future().wait();
    return std::make_shared<int>(++made);
  };
  EXPECT_FALSE(tables.ready(wish_for(3.0), [&] { return TablesAhead::Make(slow); }));
  const auto quick = [&]() -> std::shared_ptr<const void> { return std::make_shared<int>(++made); };
  // Another wish meanwhile is served behind it.
  EXPECT_FALSE(tables.ready(wish_for(6.0), [&] { return TablesAhead::Make(quick); }));
  may_go_on.set_value();
  await(tables, wish_for(6.0), quick);
  EXPECT_EQ(made, 2);
  // And the one of before is made anew.
  await(tables, wish_for(3.0), quick);
  EXPECT_EQ(made, 3);
}

TEST(TablesAhead, WhatCannotBeMadeIsTriedAgain) {
  int tried = 0;
  TablesAhead tables;
  await(tables, wish_for(3.0), [&]() -> std::shared_ptr<const void> {
    if (++tried < 3) throw std::bad_alloc();
    return std::make_shared<int>(tried);
  });
  EXPECT_EQ(tried, 3);
}

TEST(TablesAhead, AWishHasPatienceOfItsOwn) {
  constexpr std::chrono::milliseconds kPatience{200};
  std::promise<void> may_go_on;
  TablesAhead tables(kPatience);
  const auto slow = [&]() -> std::shared_ptr<const void> {
    may_go_on.get_future().wait();
    return std::make_shared<int>(1);
  };
  const auto ask = [&](double nm) {
    return tables.ready(wish_for(nm), [&] { return TablesAhead::Make(slow); });
  };
  const auto wait = [&] { std::this_thread::sleep_for(kPatience + std::chrono::milliseconds(10)); };
  EXPECT_FALSE(ask(3.0));
  wait();
  EXPECT_TRUE(ask(3.0));
  EXPECT_FALSE(ask(6.0));
  wait();
  EXPECT_FALSE(ask(12.0));  // one that is not the one that waited
  wait();
  EXPECT_TRUE(ask(12.0));
  may_go_on.set_value();
}

TEST(TablesAhead, TheSameWishIsMadeOnce) {
  int made = 0;
  TablesAhead tables;
  const auto make = [&]() -> std::shared_ptr<const void> { return std::make_shared<int>(++made); };
  await(tables, wish_for(3.0), make);
  await(tables, wish_for(3.0), make);
  EXPECT_EQ(made, 1);
}

}  // namespace
}  // namespace skerry::server
