// A recorder's state in words.
#pragma once

#include <cstdint>
#include <string>

#include "protocol/wire/recorder.pb.h"

namespace skerry::client {

// "1.25 GB": of 1000 each.
std::string bytes_text(double bytes);
// One line, without its end.
std::string recorder_line(const wire::RecorderState& state);
// Several lines, each with its end.
std::string recorder_text(const wire::RecorderState& state);

}  // namespace skerry::client
