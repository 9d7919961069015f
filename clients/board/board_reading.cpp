#include "clients/board/board_reading.hpp"

#include <algorithm>

#include "protocol/wire/printable_text.hpp"

namespace skerry::client {

std::vector<BoardClient::Operation> fault_reason_reads() {
  std::vector<BoardClient::Operation> reads;
  for (std::uint32_t at = 0; at < board::kFaultReasonBytes; at += 4) {
    reads.push_back({.address = board::address_of(board::Reg::fault_reason) + at});
  }
  return reads;
}

std::string fault_reason_text(std::span<const BoardClient::Value> values) {
  std::vector<std::uint32_t> words;
  for (const BoardClient::Value& value : values) words.push_back(value.value);
  return printable(board::fault_reason_text(words));
}

board::RegisterError error_of(wire::BoardError error) {
  switch (error) {
    case wire::BOARD_OK:
      return board::RegisterError::ok;
    case wire::BOARD_READ_ONLY:
      return board::RegisterError::read_only;
    case wire::BOARD_OUT_OF_RANGE:
      return board::RegisterError::out_of_range;
    case wire::BOARD_MISALIGNED:
      return board::RegisterError::misaligned;
    default:
      return board::RegisterError::unknown_register;
  }
}

}  // namespace skerry::client
