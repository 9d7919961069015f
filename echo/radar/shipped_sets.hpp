// The radar sets that come with the program.
#pragma once

#include <span>
#include <string_view>

#include "echo/radar/radar_set.hpp"

namespace skerry::echo {

// The first is the default.  All pass faults_of().  Figures are marked [read], [computed] or
// [unverified] as in SOURCES.md; see shipped_sets.cpp.
std::span<const RadarSet> shipped_sets();

// The set of exactly that name.  Throws std::invalid_argument, listing the names there are.
RadarSet find_set(std::string_view name);

}  // namespace skerry::echo
