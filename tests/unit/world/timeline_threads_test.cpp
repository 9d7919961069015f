// The world's time line under many threads, as radars and the network use it.
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <thread>
#include <vector>

#include "server/world/scenario.hpp"
#include "server/world/timeline.hpp"

namespace skerry::server {
namespace {

using namespace std::chrono_literals;

// Meant for TSan; the invariants are what each thread may rely on meanwhile.
TEST(Timeline, ServesManyThreadsAtOnce) {
  Timeline timeline{World(default_scenario())};
  std::atomic<bool> start{false};
  std::vector<std::jthread> threads;
  std::atomic<int> wrong{0};
  for (int thread = 0; thread < 3; ++thread) {
    threads.emplace_back([&, thread] {
      while (!start) std::this_thread::yield();
      for (int k = 0; k < 2000; ++k) {
        const ScenarioTime t = ScenarioTime(World::kTick * k) + 7ms * thread;
        const WorldStatePtr state = timeline.at(t);
        if (!state || state->own_ships.size() != 2) ++wrong;
        // Another thread may have gone on by more than is kept, never less.
        if (state && state->time + World::kTick <= t) ++wrong;
      }
    });
  }
  threads.emplace_back([&] {
    while (!start) std::this_thread::yield();
    ScenarioTime before{};
    std::uint64_t tick = 0;
    for (int k = 0; k < 2000; ++k) {
      const WorldStatePtr state = timeline.latest();
      if (!state || state->time < before) ++wrong;
      if (state) before = state->time;
      if (k % 20 == 0) {
        const std::uint64_t effective = timeline.order(0, k % 360, 5.0 + k % 7);
        if (effective < tick) ++wrong;
        tick = effective;
      }
    }
  });
  start = true;
  threads.clear();
  EXPECT_EQ(wrong, 0);
  EXPECT_EQ(timeline.latest()->time, ScenarioTime(World::kTick * 1999));
}

}  // namespace
}  // namespace skerry::server
