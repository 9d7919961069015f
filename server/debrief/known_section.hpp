// The part of the page on what sets knew.
#pragma once

#include <string>

#include "server/debrief/debrief.hpp"

namespace skerry::server {

// HTML; everything from outside is escaped.  Requires `known` of at least one view.
std::string known_section(const Debrief& debrief);

}  // namespace skerry::server
