// Test patterns of a video channel, in place of the radar's video.
#pragma once

#include <span>

#include "server/board/board_settings.hpp"

namespace skerry::server {

// Half of the width of TestMode::target about the ARP, turns: 0.5 degrees.
inline constexpr double kTestTargetHalfWidth = 1.0 / 720.0;

// Codes of one sweep: 0 and full scale (2^bits - 1), but for the ramp:
//   ramp          sample i of trigger t reads (i + t) mod 2^bits
//   rings         full where i is a multiple of test_value, 0 left out
//   wedge         full from the ARP on, test_value tenths of a degree wide
//   target        full at sample test_value, kTestTargetHalfWidth to either side of the ARP
//   checkerboard  full where i / test_value + the 1/32 of the turn is odd
// turns: azimuth as the digitiser counts it, clockwise from the ARP, in [0, 1); faults move it.
// An inverted channel reads full scale minus that.  Requires test_mode != off, codes of
// format.samples.
void fill_test_pattern(const ChannelSettings& channel, std::uint64_t trigger, double turns,
                       std::span<std::uint16_t> codes);

}  // namespace skerry::server
