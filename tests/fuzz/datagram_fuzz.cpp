// A receiver of datagrams.  The input is a line of datagrams, each after its length in two bytes.
#include "protocol/wire/byte_order.hpp"
#include "protocol/wire/datagram.hpp"
#include "tests/fuzz/fuzz_require.hpp"

namespace {

using namespace skerry;

void check_header(std::span<const std::uint8_t> datagram) {
  const auto header = decode_datagram_header(datagram);
  if (!header.ok()) {
    fuzz::require(!header.error().text.empty(), "a refusal says why");
    return;
  }
  const std::size_t size = datagram.size() - header->header_size;
  fuzz::require(header->offset + size <= header->body_length, "a fragment lies in its body");
  if (header->header_size == kDatagramHeaderSize) {
    Bytes again;
    append_datagram_header(again, *header);
    fuzz::require(std::equal(again.begin(), again.end(), datagram.begin()),
                  "a header is written as it was read");
  }
}

// A body that was put together must survive being cut, shuffled and put together again.
void check_body(const Bytes& body, fuzz::Choices& choices) {
  fuzz::require(!body.empty() && body.size() <= kMaxDatagramBody, "a body is of allowed length");
  const std::size_t max = kMinDatagram + choices.below(kMaxDatagram - kMinDatagram + 1);
  std::vector<Bytes> line;
  Bytes scratch;
  for_each_datagram({1, 2, 3}, body, max, scratch,
                    [&](auto each) { line.emplace_back(each.begin(), each.end()); });
  for (std::size_t i = line.size(); i > 1; --i) std::swap(line[i - 1], line[choices.below(i)]);
  DatagramReassembler reassembler;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const auto whole = reassembler.feed(line[i]);
    fuzz::require(whole.ok(), "our own datagrams are accepted");
    fuzz::require(whole->has_value() == (i + 1 == line.size()), "the last one makes it whole");
    if (whole->has_value()) fuzz::require(**whole == body, "a body comes back the same");
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::span<const std::uint8_t> input(data, size);
  fuzz::Choices choices(input);
  ByteReader in(input);
  DatagramReassembler reassembler;
  std::uint64_t refused = 0, completed = 0;
  while (in.left() > 0) {
    const std::size_t length = in.big_endian<std::uint16_t>();
    const auto datagram = in.take(std::min(length, in.left()));
    check_header(datagram);
    const auto whole = reassembler.feed(datagram);
    refused += !whole.ok();
    if (whole.ok() && whole->has_value()) {
      ++completed;
      check_body(**whole, choices);
    }
    fuzz::require(reassembler.in_flight() <= DatagramReassembler::kInFlight, "memory is bounded");
  }
  fuzz::require(reassembler.refused() == refused, "every refusal is counted");
  fuzz::require(reassembler.completed() == completed, "every body is counted");
  return 0;
}
