// Control ranges: what may stand in a Set message.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "protocol/wire/radar.pb.h"
#include "protocol/wire/schema.hpp"

namespace skerry::server {

// The reply that refuses the first thing wrong with it: UNKNOWN for a field this server does not
// know (of `set` or anything in it), OUT_OF_RANGE with the allowed range for a value outside its
// own, REFUSED for locks that are not the instructor's.  Nothing if all is well; what depends on
// the state of the radars is not looked at.
std::optional<wire::Reply> refusal_of(const wire::Set& set);

// The part of it that looks at values, for any message that carries controls of such a schema.
std::optional<wire::Reply> refusal_of_values(const wire::Message& set,
                                             const wire::Descriptor& controls);

// The limit that radar.proto states.
inline constexpr int kMaxSectorsSet = 4;

// The fields of Set, and of the controls it carries, that change something; each may be locked.
std::vector<std::string> control_names(const wire::Descriptor& set,
                                       const wire::Descriptor& controls);
std::vector<std::string> control_names();
bool is_control(const std::string& name);

wire::Reply refusal(wire::Reply::Code code, std::string text);

}  // namespace skerry::server
