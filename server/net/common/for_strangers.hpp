// What clients on other hosts that have shown no good token are not told.
#pragma once

#include "protocol/wire/radar.pb.h"

namespace skerry::server {

// Empties what names a folder of the server or an address of somebody else, and texts that may.
// That there is a problem stays known.
void leave_out_for_strangers(wire::RecorderState& state);
void leave_out_for_strangers(wire::PlaybackState& state);
void leave_out_for_strangers(wire::HopStatus& hop);
void leave_out_for_strangers(wire::Status& status);

}  // namespace skerry::server
