// What every reader of a board works out of its registers and sweeps.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "clients/board/board_client.hpp"

namespace skerry::client {

// The largest code that a channel gives, 1 .. 65535.
std::uint32_t largest_code(const board::ChannelFormat& format);

// The registers of FAULT_REASON, to be read in one access, and the text in their values: printable
// ASCII, "" where there is no fault of that kind.
std::vector<BoardClient::Operation> fault_reason_reads();
std::string fault_reason_text(std::span<const BoardClient::Value> values);

// "1000 to 60000 0.001 rpm", "8 to 14 bits in steps of 2", "0, or 256 to 16384": what may be
// written there.
std::string allowed_values(const board::RegisterInfo& info);

}  // namespace skerry::client
