// A reader of captures.
#include "protocol/pcap/capture_reader.hpp"
#include "tests/fuzz/fuzz_require.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace skerry;
  std::size_t datagrams = 0, octets = 0;
  const auto counts = pcap::read_capture({data, size}, [&](const pcap::Datagram& each) {
    ++datagrams;
    octets += each.payload.size();
  });
  fuzz::require(octets <= size, "every octet of the file is in at most one datagram");
  if (!counts.ok()) {
    fuzz::require(!counts.error().text.empty(), "a refusal says why");
    fuzz::require(counts.error().offset <= size, "a refusal's place is in the file");
    return 0;
  }
  fuzz::require(counts->datagrams == datagrams, "datagrams are counted");
  fuzz::require(counts->frames >= counts->datagrams + counts->others, "each is of a frame");
  return 0;
}
