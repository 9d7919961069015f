// ship_shares: which own ships a host should take, or give up, as it sees the fleet.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace skerry::fleet {

// "ship/3": the name that the holder of own ship 3 holds, and its number again; nothing: no such
// name.
std::string ship_name(std::size_t ship);
std::optional<std::size_t> ship_of(std::string_view name);

struct Shares {
  std::vector<std::size_t> take;       // free, in the order of preference
  std::optional<std::size_t> give_up;  // one at a time
};

// Pure, and the same on all hosts but for `host`.  No host takes more than its share, the ships by
// the hosts that are present, rounded up; so a lost host's ships go to all others.  Every host has
// an order of preference of its own (hashes of its name and the ship's number): hosts that take
// ships at once seldom try the same.  If no ship is free, a host gives
// up the one it likes least, one per call: if it has more than the share rounded up while another
// has less than that, or more than the share rounded down while another has less than that.
// `holders`: of each ship by its number from 0, a host; empty: nobody.  `present`: hosts, this one
// among them.
Shares shares_of(const std::string& host, const std::vector<std::string>& holders,
                 const std::set<std::string>& present);

}  // namespace skerry::fleet
