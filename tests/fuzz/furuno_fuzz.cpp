// A reader of Furuno's frames: what it reads is within its bounds, and both its ways agree.
#include "protocol/furuno/spoke_frame.hpp"
#include "tests/fuzz/fuzz_require.hpp"

using namespace skerry;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::span<const std::uint8_t> input(data, size);
  const auto frame = furuno::decode_spoke_frame(input);
  if (frame) {
    fuzz::require(furuno::is_spoke_frame(input), "what is read is recognised");
    fuzz::require(frame->sweeps.size() <= furuno::kMaxSweeps, "sweeps are bounded");
    for (const furuno::Sweep& sweep : frame->sweeps) {
      fuzz::require(sweep.cells.size() == frame->cells, "a sweep has the cells it says");
      fuzz::require(sweep.cells.size() <= furuno::kMaxCells, "cells are bounded");
      fuzz::require(sweep.angle < furuno::kAnglesPerTurn, "an angle is within a turn");
    }
  } else {
    fuzz::require(!frame.error().text.empty(), "a refusal says why");
    fuzz::require(frame.error().offset <= size + 24, "a refusal's place is near the datagram");
  }
  (void)furuno::decode_model(input);
  return 0;
}
