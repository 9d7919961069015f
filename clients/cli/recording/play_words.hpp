// Orders to a playback in words: "seek 1:30".
#pragma once

#include <string>
#include <string_view>

#include "protocol/quantity/result.hpp"
#include "protocol/wire/recorder.pb.h"

namespace skerry::client {

struct PlayWords {
  enum class What { ask, state, marks, help, quit };
  What what = What::state;
  wire::Playback request;  // to ask for
};

// play, pause, seek PLACE, mark NAME, rate R, loop on|off, step [N], back [N],
// state, marks, help, quit; nothing at all is state.  Numbers' ranges are the server's to check.
// Error: what was not understood, and what was expected.
Result<PlayWords, std::string> parse_play_words(std::string_view line);

// One line per word, for help.
std::string play_words_help();

// "0:01:30.0 of 0:10:00.0  plays  2x  in a loop"
std::string playback_line(const wire::PlaybackState& state);
// One line each: place and name; what there is to say if there is none.
std::string marks_text(const wire::PlaybackState& state);

}  // namespace skerry::client
