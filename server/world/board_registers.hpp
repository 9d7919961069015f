// Board registers: the settings of a radar's interface board as a scenario gives them.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "server/world/radar_sets.hpp"
#include "server/world/scenario.pb.h"

namespace skerry::server {

// Addresses and values (protocol/board/registers.hpp), each allowed by itself.
using RegisterValues = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

// The registers that `radar.board` sets, and no others.  `index_of`: a radar's index in the server,
// by its name. Requires a board without complaint.
RegisterValues board_registers(const scenario::Radar& radar,
                               const std::function<std::uint32_t(const std::string&)>& index_of);

// All contradictions in `radar.board`, each at a key of scenario::Radar that is given or would be:
// two channels that cannot be, sweeps longer than triggers are apart, a FIFO below one sweep, sums
// wider than 16 bits, a pulse the set does not have or that would be on for too long.  The pulse is
// the one on the air at the start.  Sources are not looked at.  The rules are those by which the
// board itself judges (protocol/board/contradiction.hpp).
// Requires a set without complaint, known by name.
std::vector<SetComplaint> complaints_of_board(const scenario::Radar& radar);

inline constexpr int kMaxBoardSectors = 2;

}  // namespace skerry::server
