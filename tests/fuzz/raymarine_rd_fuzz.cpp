// Readers of the video and state of E-120 displays with analogue scanners.
#include "protocol/raymarine/rd_packets.hpp"
#include "tests/fuzz/fuzz_require.hpp"

namespace {

using namespace skerry;
using namespace skerry::raymarine;

void check_refusal(const WireError& error, std::span<const std::uint8_t> input) {
  fuzz::require(!error.text.empty(), "a refusal says why");
  fuzz::require(error.offset <= input.size() + 64, "a refusal's place is in the datagram");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::span<const std::uint8_t> input(data, size);
  const auto spokes = decode_rd_spokes(input);
  if (!spokes) {
    check_refusal(spokes.error(), input);
  } else {
    // A spoke has two headers, 52 bytes at least.
    fuzz::require(spokes->size() <= size / 52, "spokes are bounded by the datagram");
    for (const RdSpoke& spoke : *spokes) {
      fuzz::require(spoke.cells.size() == kRdCells, "every spoke has all cells");
      fuzz::require(spoke.azimuth < kRdSpokes, "an azimuth is within the turn");
      for (const std::uint8_t cell : spoke.cells) fuzz::require(cell < 16, "cells have four bits");
    }
  }
  const auto status = decode_rd_status(input);
  if (!status) {
    check_refusal(status.error(), input);
  } else {
    fuzz::require(status->range_index < kRdRanges, "a range is one of the table");
  }
  return 0;
}
