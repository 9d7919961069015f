// A client reads any bytes of a server, down to the spoke.
#include "protocol/thin/thin_decoder.hpp"
#include "protocol/wire/spoke_message.hpp"
#include "tests/fuzz/frame_properties.hpp"
#include "tests/unit/wire/test_spoke.hpp"

namespace {

using namespace skerry;

void check_spoke(const wire::Spoke& message) {
  const auto spoke = from_message(message);
  if (!spoke.ok()) {
    fuzz::require(!spoke.error().text.empty(), "a refusal says why");
    return;
  }
  fuzz::require(spoke->header.geometry.valid(), "an accepted geometry is valid");
  fuzz::require(spoke->cells.size() == spoke->header.geometry.cells, "there is a byte per cell");
  fuzz::require(spoke->header.index < spoke->header.geometry.spokes_per_turn,
                "the index is within the turn");

  Bytes frame;
  append_spoke_frame(frame, *spoke);
  const auto body = frame_body(frame);
  wire::ServerMessage again;
  fuzz::require(again.ParseFromArray(body.data(), static_cast<int>(body.size())),
                "a frame of a spoke can be read");
  const auto back = from_message(again.spoke());
  fuzz::require(back.ok(), "a spoke that was accepted is accepted again");
  fuzz::require(difference(*spoke, *back).empty(), "a spoke comes back the same");
}

void check_thin_spokes(const wire::ThinSpokes& message) {
  const auto spokes = from_message(message);
  if (!spokes.ok()) {
    fuzz::require(!spokes.error().text.empty(), "a refusal says why");
    return;
  }
  fuzz::require(spokes->size() == message.count(), "there are as many spokes as it says");
  for (const Spoke& spoke : *spokes) {
    wire::Spoke again;
    to_message(spoke, again);
    check_spoke(again);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::check_stream<wire::ServerMessage>({data, size}, kMaxServerFrame,
                                          [](const wire::ServerMessage& message) {
                                            if (message.has_spoke()) check_spoke(message.spoke());
                                            if (message.has_thin_spokes())
                                              check_thin_spokes(message.thin_spokes());
                                          });
  return 0;
}
