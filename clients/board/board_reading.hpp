// Values that every reader of a board computes from its registers and sweeps.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "clients/board/board_client.hpp"

namespace skerry::client {

// The registers of FAULT_REASON, to be read in one access, and the text in their values: printable
// ASCII, "" where there is no fault of that kind.
std::vector<BoardClient::Operation> fault_reason_reads();
std::string fault_reason_text(std::span<const BoardClient::Value> values);

// The server's number for it; one that this library does not know is a refusal all the same.
board::RegisterError error_of(wire::BoardError error);

}  // namespace skerry::client
