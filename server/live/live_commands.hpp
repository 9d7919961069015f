// What a change of settings is to a real radar: the commands that its own display would send.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/navico/model.hpp"
#include "protocol/quantity/result.hpp"
#include "protocol/quantity/time.hpp"
#include "protocol/wire/radar.pb.h"
#include "protocol/wire/wire_error.hpp"
#include "server/live/live_source.hpp"

namespace skerry::server {

using Commands = Result<std::vector<Bytes>, std::string>;

// The commands in the order in which they are to leave.  Controls go out as each radar has them: a
// level of 0 to 100 as 0 to 255 (Navico), in hundredths (xHD) or whole (Quantum); what has a few
// steps as the nearest of them; a range as the scale's length.  `now`: what is in force, for parts
// of a command that `set` leaves as they are.  `model`: of a Navico.
// Error: the first part of `set` that such a radar has no command for, or whose value it cannot
// have; then nothing is to be sent.
// Source: README.md of protocol/navico, protocol/garmin and protocol/raymarine.
Commands live_commands(const LiveKind& kind, navico::Model model, const wire::Set& set,
                       const wire::Settings& now);

// The radar falls back to standby unless a display sends these so often; 0: it does not.
struct StayAlive {
  Duration every{};
  std::vector<Bytes> packets;
};
StayAlive stay_alive_of(const LiveKind& kind);

// Of one family each.
Commands navico_commands(navico::Model model, const wire::Set& set, const wire::Settings& now);
Commands garmin_commands(const wire::Set& set, const wire::Settings& now);
Commands quantum_commands(const wire::Set& set, const wire::Settings& now);

// For these: what of a Set changes something, and the refusal of what is left of it in the end.
wire::Set changes_of(const wire::Set& set);
std::optional<std::string> lacking_in(const wire::Set& rest, std::string_view radar);

}  // namespace skerry::server
