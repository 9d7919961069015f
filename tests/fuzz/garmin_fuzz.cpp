// A reader of Garmin xHD packets, and the way there and back of what it read.
#include <algorithm>

#include "protocol/garmin/xhd_packet.hpp"
#include "protocol/garmin/xhd_spoke.hpp"
#include "tests/fuzz/fuzz_require.hpp"

namespace {

using namespace skerry;

void check_refusal(const WireError& error, std::span<const std::uint8_t> input) {
  fuzz::require(!error.text.empty(), "a refusal says why");
  fuzz::require(error.offset <= std::max<std::size_t>(input.size(), 36),
                "a refusal's place is in the datagram");
}

void check_packet(std::span<const std::uint8_t> input) {
  const auto packet = garmin::decode_packet(input);
  if (!packet) return check_refusal(packet.error(), input);
  const Bytes again = garmin::encode_packet(packet->type, packet->payload);
  fuzz::require(std::equal(again.begin(), again.end(), input.begin(), input.end()),
                "a packet comes back byte by byte");
}

void check_command(std::span<const std::uint8_t> input) {
  const auto command = garmin::decode_command(input);
  if (!command) return check_refusal(command.error(), input);
  const auto* range = garmin::find_command(static_cast<std::uint32_t>(command->type));
  fuzz::require(range != nullptr, "a command is one of those there are");
  fuzz::require(command->value >= range->least && command->value <= range->greatest,
                "its value is within its range");
}

void check_spoke(std::span<const std::uint8_t> input) {
  const auto spoke = garmin::decode_spoke(input);
  if (!spoke) return check_refusal(spoke.error(), input);
  fuzz::require(spoke->cells.size() <= garmin::kMaxCells, "cells are bounded");
  Bytes bytes;
  garmin::append_spoke(bytes, *spoke);
  const auto again = garmin::decode_spoke(bytes);
  fuzz::require(again.ok() && again->angle == spoke->angle && again->range_m == spoke->range_m &&
                    again->span_m == spoke->span_m &&
                    std::equal(again->cells.begin(), again->cells.end(), spoke->cells.begin(),
                               spoke->cells.end()),
                "a spoke comes back the same");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  check_packet({data, size});
  check_command({data, size});
  check_spoke({data, size});
  return 0;
}
