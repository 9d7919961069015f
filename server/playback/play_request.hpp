// A client's request to a playback, checked.
#pragma once

#include "protocol/quantity/result.hpp"
#include "protocol/recording/reader.hpp"
#include "protocol/wire/radar.pb.h"
#include "protocol/wire/recorder.pb.h"
#include "server/playback/player.hpp"

namespace skerry::server {

// The order that `request` is, all of it or the refusal: OUT_OF_RANGE names the value and its
// range, UNKNOWN a mark that is not in the recording or a field that this server does not know.
Result<PlayOrder, wire::Reply> play_order(const wire::Playback& request,
                                          const recording::Summary& summary);

// "1:02:03.4", for the log.
std::string place_text(Duration since_begin);

}  // namespace skerry::server
