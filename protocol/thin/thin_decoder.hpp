// Thin spokes as spokes.
#pragma once

#include <vector>

#include "protocol/quantity/result.hpp"
#include "protocol/video/spoke.hpp"
#include "protocol/wire/radar.pb.h"
#include "protocol/wire/wire_error.hpp"

namespace skerry {

// The spokes of a message, 1 .. kMostThinSpokes, each as from_message(wire::Spoke) would give it.
// At most count * (cell_count + 1) / 2 bytes are unpacked, and only if the packed ones say that
// they hold as many. Error: as from_message() has it for what is wrong with a header; out_of_range
// for a count, bits that are not 4 or spokes behind the end of the turn; malformed or truncated for
// cells that are not those of so many spokes.  Thread: any.
Result<std::vector<Spoke>, WireError> from_message(const wire::ThinSpokes& message);

}  // namespace skerry
