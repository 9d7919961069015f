// Readers of ASTERIX CAT048, CAT062 and CAT010, and the way there and back of what they read.
#include <algorithm>

#include "protocol/asterix/cat010.hpp"
#include "protocol/asterix/cat048.hpp"
#include "protocol/asterix/cat062.hpp"
#include "tests/fuzz/fuzz_require.hpp"

namespace {

using namespace skerry;

constexpr std::size_t kSmallDatagram = 300;

template <typename Decode, typename Encode>
void check(std::span<const std::uint8_t> input, Decode decode, Encode encode) {
  const auto read = decode(input);
  if (!read.ok()) {
    fuzz::require(!read.error().text.empty(), "a refusal says why");
    fuzz::require(read.error().offset <= input.size(), "a refusal's place is in the datagram");
    return;
  }
  fuzz::require(read->size() <= input.size() / 3, "the output is bounded by the input");
  const std::vector<Bytes> sent = encode(*read, kSmallDatagram);
  std::decay_t<decltype(*read)> back;
  for (const Bytes& datagram : sent) {
    fuzz::require(datagram.size() <= kSmallDatagram, "datagrams are as long as they may be");
    const auto again = decode(datagram);
    fuzz::require(again.ok(), "what we write is read");
    back.insert(back.end(), again->begin(), again->end());
  }
  fuzz::require(back.size() == read->size(), "and every report of it");
  fuzz::require(encode(back, kSmallDatagram) == sent, "which comes back the same");
}

// As it is, and as one block of the category.
template <typename Decode, typename Encode>
void check_category(std::span<const std::uint8_t> input, std::uint8_t category, Decode decode,
                    Encode encode) {
  check(input, decode, encode);
  const std::size_t size = std::min<std::size_t>(input.size() + 3, 65'535);
  Bytes block{category, static_cast<std::uint8_t>(size >> 8), static_cast<std::uint8_t>(size)};
  block.insert(block.end(), input.begin(), input.begin() + static_cast<std::ptrdiff_t>(size - 3));
  check(block, decode, encode);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::span<const std::uint8_t> input(data, size);
  check_category(input, 48, decode_cat048, [](const auto& reports, std::size_t most) {
    return encode_cat048(reports, most);
  });
  check_category(input, 62, decode_cat062, [](const auto& reports, std::size_t most) {
    return encode_cat062(reports, most);
  });
  check_category(input, 10, decode_cat010, [](const auto& reports, std::size_t most) {
    return encode_cat010(reports, most);
  });
  return 0;
}
