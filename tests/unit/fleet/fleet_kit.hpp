// What tests of the fleet share.
#pragma once

#include <chrono>
#include <string>

#include "server/fleet/holding.hpp"
#include "server/fleet/order_store.hpp"
#include "tests/unit/fleet/memory_store.hpp"

namespace skerry::fleet {

using std::chrono::milliseconds;
using std::chrono::seconds;

inline constexpr const char* kExercise = "kattegat-7";
inline const HostTime kBegin{seconds(1000)};

inline OrderWish order_wish(const std::string& id, Epoch epoch, Revision grant, Tick tick) {
  return {id, "host-a", "rudder for " + id, epoch, grant, tick};
}

// One host: its way to the store and what it has of the exercise.
struct Host {
  Host(MemoryCluster& cluster, HostTime& time, const std::string& name, std::uint64_t seed = 1)
      : keys(cluster, time, seed),
        orders(keys, mark, kExercise),
        leader(keys, mark, {kExercise, kLeader, name, seconds(2)}) {}

  StoreMark mark;
  MemoryStore keys;
  OrderStore orders;
  Holding leader;
};

// A store with an exercise, and a host that leads it and has granted to tick 3.
struct Led {
  MemoryCluster cluster;
  HostTime time = kBegin;
  Host host{cluster, time, "host-a"};
  Epoch epoch = 0;
  Revision grant = 0;

  Led() {
    (void)host.orders.open("born-1", in(seconds(1)));
    (void)host.leader.step(in(seconds(1)));
    epoch = host.leader.held(time).value_or(0);
    grant = host.orders.grant({epoch, 0, 3, Duration{0}}, in(seconds(1))).value().revision;
  }
  HostTime in(Duration d) const { return time + d; }
};

}  // namespace skerry::fleet
