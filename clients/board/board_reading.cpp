#include "clients/board/board_reading.hpp"

#include <algorithm>

#include "clients/common/printable_text.hpp"

namespace skerry::client {

std::uint32_t largest_code(const board::ChannelFormat& format) {
  const std::uint64_t codes = (std::uint64_t{1} << format.bits) - 1;
  const std::uint64_t summed =
      format.mode == board::DecimationMode::sum ? codes * format.decimation : codes;
  return static_cast<std::uint32_t>(std::clamp<std::uint64_t>(summed, 1, 65535));
}

std::vector<BoardClient::Operation> fault_reason_reads() {
  std::vector<BoardClient::Operation> reads;
  for (std::uint32_t at = 0; at < board::kFaultReasonBytes; at += 4) {
    reads.push_back({.address = board::address_of(board::Reg::fault_reason) + at});
  }
  return reads;
}

std::string fault_reason_text(std::span<const BoardClient::Value> values) {
  std::string text;
  for (const BoardClient::Value& value : values) {
    for (int byte = 0; byte < 4; ++byte) {
      const auto c = static_cast<char>((value.value >> (8 * byte)) & 0xFFu);
      if (c == '\0') return printable(text);
      text += c;
    }
  }
  return printable(text);
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
