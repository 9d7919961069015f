#include "protocol/wire/varint.hpp"

#include <gmock/gmock.h>
#include <google/protobuf/io/coded_stream.h>

#include <limits>

namespace skerry {
namespace {

using google::protobuf::io::CodedOutputStream;
using testing::ElementsAre;

Bytes varint(std::uint64_t value) {
  Bytes out;
  append_varint(out, value);
  return out;
}

TEST(Varint, IsLowGroupsFirstAsProtobufWritesIt) {
  EXPECT_THAT(varint(0), ElementsAre(0));
  EXPECT_THAT(varint(300), ElementsAre(0xAC, 0x02));
  for (int bits = 0; bits < 64; ++bits) {
    for (const std::uint64_t value :
         {std::uint64_t{1} << bits, (std::uint64_t{1} << bits) - 1, ~std::uint64_t{0} >> bits}) {
      std::uint8_t expected[kMaxVarintOctets];
      const auto* const end = CodedOutputStream::WriteVarint64ToArray(value, expected);
      const Bytes octets = varint(value);
      EXPECT_EQ(octets, Bytes(static_cast<const std::uint8_t*>(expected), end)) << value;
      const Varint read = read_varint(octets);
      EXPECT_EQ(read.value, value);
      EXPECT_EQ(read.octets, octets.size());
    }
  }
  EXPECT_EQ(varint(std::numeric_limits<std::uint32_t>::max()).size(), kMaxVarint32Octets);
  EXPECT_EQ(varint(std::numeric_limits<std::uint64_t>::max()).size(), kMaxVarintOctets);
}

TEST(Varint, IsNotReadIfCutOrTooLong) {
  EXPECT_EQ(read_varint({}).octets, 0u);
  const Bytes cut(9, 0x80), too_long(10, 0x80);
  EXPECT_EQ(read_varint(cut).octets, 0u);
  EXPECT_EQ(read_varint(too_long).octets, 0u);
  EXPECT_EQ(read_varint(varint(std::uint64_t{1} << 35), kMaxVarint32Octets).octets, 0u);
}

TEST(Varint, IsReadWithOctetsMoreThanItNeedsAndDropsBitsBeyond64) {
  const Bytes long_one = {0x81, 0x80, 0x00, 0x55};
  EXPECT_EQ(read_varint(long_one).value, 1u);
  EXPECT_EQ(read_varint(long_one).octets, 3u);
  Bytes beyond(10, 0xFF);
  beyond.back() = 0x7F;
  EXPECT_EQ(read_varint(beyond).value, ~std::uint64_t{0});
}

}  // namespace
}  // namespace skerry
