// A recorded spoke drawn out or in to another reach.
#pragma once

#include "protocol/video/spoke.hpp"

namespace skerry::server {

// The same echoes in as many cells that end at `reach`: a cell shows the strongest of those it
// lies over (with that one's Doppler class), and nothing beyond what was recorded.  No echo moves
// by more than a cell of the longer of the two.  Requires a reach above 0, a sixteenth of the range
// scale .. twice it.
Spoke reaching(const Spoke& spoke, Length reach);

}  // namespace skerry::server
