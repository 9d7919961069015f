// What a scenario may say of beacons and other radars.
#pragma once

#include <optional>
#include <string>

#include "echo/scene/beacons.hpp"

namespace skerry::echo {

// The first member that is out of its range, with the range it must be in; nothing where all is
// well.  NaN is out of every range.  Beacons that pass give finite powers.
std::optional<std::string> fault_of(const Racon& racon);
std::optional<std::string> fault_of(const Sart& sart);
std::optional<std::string> fault_of(const Emitter& emitter);

}  // namespace skerry::echo
