// ship_shares: which own ships a host should take, or give up, as it sees the fleet.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace skerry::fleet {

// The name that the holder of an own ship holds.
std::string ship_name(std::size_t ship);
std::optional<std::size_t> ship_of(std::string_view name);

struct Shares {
  std::vector<std::size_t> take;       // free, in the order of preference
  std::optional<std::size_t> give_up;  // one at a time
};

// Pure, and the same on all hosts but for `host`.  No host takes more than its share, the ships by
// the hosts that are present, rounded up; so a lost host's ships go to all others.  Every host has
// an order of preference of its own (hashes of its name and the ship's number): hosts that take
// ships at once seldom try the same.  A host that has more than its share gives up the one it likes
// least, if nothing is free to be taken; so does one that has its share where another has less than
// the share rounded down.
// `holders`: of each ship, a host or nobody.  `present`: hosts, this one among them.
Shares shares_of(const std::string& host, const std::vector<std::string>& holders,
                 const std::set<std::string>& present);

}  // namespace skerry::fleet
