// What another server's Hello says of its radars, and whether a relay can serve them.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "protocol/wire/radar.pb.h"

namespace skerry::server {

inline constexpr int kMostRadars = 256;
// Servers before this one.  Each costs a round trip, and a loop shows at once.
inline constexpr int kMostHops = 8;

// Why a relay with this identity cannot serve what that server has: a loop, too many relays in a
// row, no radars, or such as this version does not know.  `name`: of the server, "host:port".
std::optional<std::string> why_not_relayed(const wire::Hello& hello, const std::string& identity,
                                           const std::string& name);

// Whether that server is the relay with this identity, or relays it.
bool is_in_loop(const wire::Hello& hello, const std::string& identity);

// Whether it is that of a relay that waits for its own server (WaitingRoom).
bool is_waiting(const wire::Hello& hello);

// Its radars, with numbers that the rest of the server relies on; none has a board here.
std::vector<wire::RadarInfo> radars_of(const wire::Hello& hello);

// Of each radar that was there `before` whether it is the same one `now`: of that name on an own
// ship of that name.  Rights hang on the own ship's.
std::vector<bool> still_there(const std::vector<wire::RadarInfo>& before,
                              const std::vector<wire::RadarInfo>& now);
// What has changed, and what becomes of it; empty: nothing.
std::string changes_told(const std::vector<wire::RadarInfo>& before,
                         const std::vector<wire::RadarInfo>& now);

}  // namespace skerry::server
