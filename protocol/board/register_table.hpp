// The rows of the register map, in the words of BOARD.md.
#pragma once

#include <span>

#include "protocol/board/registers.hpp"

namespace skerry::board {

// The registers of all_registers(), made once.
std::span<const RegisterInfo> register_table();
// FAULT_REASON_0 and so on, ascending.
std::span<const RegisterInfo> fault_reason_table();

}  // namespace skerry::board
