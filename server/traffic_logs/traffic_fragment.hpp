// TrafficFragment: logged ships as targets of a scenario, in YAML, for its key `include`.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "protocol/quantity/time.hpp"
#include "server/traffic_logs/track_book.hpp"

namespace skerry::server {

struct FragmentRules {
  // Of targets: pieces of ships.  Of more, the ships with the fewest fixes are left out.
  std::size_t most_targets = 500;
  // Of bytes: what a scenario may have, less room for the rest of it.
  std::size_t most_bytes = 900'000;
  std::size_t most_waypoints = 18'000;
};

struct TrafficFragment {
  std::string yaml;
  UtcTime begin{};  // the exercise's minute 0
  double length_min = 0.0;
  std::size_t ships = 0, targets = 0, waypoints = 0;
  std::uint64_t fixes = 0;       // that the targets are made of
  double worst_m = 0.0;          // that one of these is off
  std::size_t ships_beyond = 0;  // left out by the rules
};

// `begin`: the exercise's minute 0; without it, the first fix.  Each piece becomes a target with
// `as_logged`.  Names become printable ASCII; sizes outside of the scenario's ranges are left to
// the class.  `origin`: a line about where it is from, for the head of the file.
TrafficFragment traffic_fragment(std::vector<LoggedShip> ships, std::optional<UtcTime> begin,
                                 const FragmentRules& rules, const std::string& origin);

// "2021-01-05T01:51:55Z"; fractions of a second are dropped.
std::string utc_text(UtcTime utc);

}  // namespace skerry::server
