// What a change of settings is to a real radar: the commands that its own display would send.
#pragma once

#include <string>
#include <vector>

#include "protocol/navico/model.hpp"
#include "protocol/quantity/result.hpp"
#include "protocol/quantity/time.hpp"
#include "protocol/wire/radar.pb.h"
#include "protocol/wire/wire_error.hpp"

namespace skerry::server {

// The commands to a Navico radar, in the order in which they are to leave.  Levels of 0 to 100 go
// out as 0 to 255, or in the radar's few steps, the nearest of them; a range as the scale's length.
// `now`: what is in force, for the parts of a command that `set` leaves as they are.
// Error: the first part of `set` that such a radar has no command for, or whose value it cannot
// have; then nothing is to be sent.  Source: protocol/navico/README.md.
Result<std::vector<Bytes>, std::string> navico_commands(navico::Model model, const wire::Set& set,
                                                        const wire::Settings& now);

// What a display sends all the time, so that the radar does not fall back to standby.
inline constexpr Duration kStayAliveEvery = std::chrono::seconds(1);
std::vector<Bytes> navico_stay_alive();

}  // namespace skerry::server
