// What stands in the log of an exercise.
#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "server/fleet/key_store.hpp"

namespace skerry::fleet {

// Number of a holding: the revision in which its key was created.  A later holder of the same name
// has a larger one, and no two ever have the same.
using Epoch = Revision;
// Of the exercise: World::kTick each.
using Tick = std::uint64_t;

struct OrderSeen {
  Revision revision = 0;
  Epoch epoch = 0;
  Tick tick = 0;  // the first it holds for
  std::string id, by, order;
  friend bool operator==(const OrderSeen&, const OrderSeen&) = default;
};

struct GrantSeen {
  Revision revision = 0;
  Epoch epoch = 0;
  Tick to = 0;
  Duration sent{0};  // the exercise's time by the leader's clock
  friend bool operator==(const GrantSeen&, const GrantSeen&) = default;
};

struct HolderSeen {
  Revision revision = 0;
  std::string name;
  std::string host;  // empty: nobody
  Epoch epoch = 0;
  friend bool operator==(const HolderSeen&, const HolderSeen&) = default;
};

// What a host tells of itself, once a second; no part of the log, so only the newest counts.
struct NoteSeen {
  Revision revision = 0;
  std::string host;
  std::string note;  // HostNote of log_messages.proto
  friend bool operator==(const NoteSeen&, const NoteSeen&) = default;
};

using LogEvent = std::variant<OrderSeen, GrantSeen, HolderSeen, NoteSeen>;

inline Revision revision_of(const LogEvent& event) {
  return std::visit([](const auto& seen) { return seen.revision; }, event);
}

// The name that the exercise's leader holds.
inline constexpr const char* kLeader = "leader";

}  // namespace skerry::fleet
