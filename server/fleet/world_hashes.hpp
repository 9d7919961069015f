// WorldHashes: whether all hosts have the same world.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "server/fleet/log_event.hpp"

namespace skerry::fleet {

using WorldDigest = std::array<std::uint8_t, 32>;  // SHA-256 of the world after a tick

// A table of what each host says its world is at a tick, once a second.  Hosts that ran free beyond
// their grants or must come back leave their ticks out: they are known to differ.
// Bounded: the newest kMostTicks ticks and kMostHosts hosts; others are not looked at.
// Thread: one at a time.
class WorldHashes {
 public:
  static constexpr std::size_t kMostTicks = 64;
  static constexpr std::size_t kMostHosts = 64;

  struct Difference {
    Tick tick = 0;
    // Who is alone against more hosts than say the same as he.  If no group is larger than all
    // others, all who disagree: which of them is right, only the log played anew can tell.
    std::vector<std::string> hosts;
    bool is_certain = false;  // the others are more
    std::string text;
  };

  // Difference, if this entry shows one; each tick's is told anew with each entry.
  std::optional<Difference> add(const std::string& host, Tick tick, const WorldDigest& digest);

  // Of the ticks that are held.
  std::optional<Difference> at(Tick tick) const;
  std::size_t ticks() const { return table_.size(); }

 private:
  std::map<Tick, std::map<std::string, WorldDigest>> table_;
};

}  // namespace skerry::fleet
