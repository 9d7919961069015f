// Positions on the command line, found in a recording.
#pragma once

#include <string>
#include <string_view>

#include "protocol/recording/position.hpp"
#include "protocol/recording/reader.hpp"

namespace skerry::client {

// The place in time that `text` (parse_position()) names in that recording: of a mark, the first of
// that name.  Error: one sentence; of an unknown mark, which there are.
Result<UtcTime, std::string> find_position(std::string_view text,
                                           const recording::Summary& summary);

// "1:02:03.500"; below an hour "2:03.500".
std::string playing_time_text(Duration since_begin);

}  // namespace skerry::client
