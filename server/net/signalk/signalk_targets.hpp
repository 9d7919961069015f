// SignalkTargets: which ships a radar's displays are told of as tracked targets.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <vector>

#include "protocol/signalk/target.hpp"
#include "server/core/traffic.hpp"

namespace skerry::server {

// Ships and boats are acquired by themselves within the radar's range, everything else by hand;
// what was dropped stays so until it is acquired by hand or has left the range.  Targets are where
// they really are: no tracker's errors.  Thread: net-0.
class SignalkTargets {
 public:
  static constexpr std::size_t kMost = 100;  // the nearest

  // The targets as of now, by number.
  std::vector<signalk::Target> update(std::span<const TrafficItem> traffic,
                                      const signalk::Movement& own, double range_m, UtcTime now);
  // The number of what is nearest to that place, if something is near enough.
  std::optional<std::uint32_t> acquire(std::span<const TrafficItem> traffic,
                                       const signalk::Movement& own, double bearing_deg,
                                       double distance_m, UtcTime now);
  bool drop(std::uint32_t number);

 private:
  struct Known {
    UtcTime first_seen;
    bool by_hand = false;
  };
  std::map<std::uint32_t, Known> known_;
  std::set<std::uint32_t> dropped_;
};

}  // namespace skerry::server
