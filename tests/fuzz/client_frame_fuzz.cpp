// A server reads any bytes of a client.
#include "protocol/wire/radar.pb.h"
#include "tests/fuzz/frame_properties.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  skerry::fuzz::check_stream<skerry::wire::ClientMessage>(
      {data, size}, skerry::kMaxClientFrame, [](const skerry::wire::ClientMessage&) {});
  return 0;
}
