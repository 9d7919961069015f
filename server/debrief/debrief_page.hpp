// The debrief as one page that needs nothing else: no network, no other file.
#pragma once

#include <optional>
#include <string>

#include "protocol/wire/radar.pb.h"
#include "server/debrief/debrief.hpp"

namespace skerry::server {

// HTML with inline SVG; figures and tables need no script.  Everything from outside is escaped.
std::string debrief_page(const Debrief& debrief, const std::optional<wire::Coastline>& coast);

}  // namespace skerry::server
