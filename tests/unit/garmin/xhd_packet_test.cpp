#include <gtest/gtest.h>

#include "protocol/garmin/xhd_packet.hpp"
#include "protocol/garmin/xhd_spoke.hpp"

namespace skerry::garmin {
namespace {

SpokePacket small_spoke(const Bytes& cells) { return {800, 1852, 2093, cells}; }

TEST(XhdPacket, ANumberOfOneTwoOrFourBytesComesBack) {
  for (const int octets : {1, 2, 4}) {
    const Bytes bytes = encode_packet(Type::alignment, octets, -3);
    ASSERT_EQ(bytes.size(), 8u + static_cast<std::size_t>(octets));
    const auto packet = decode_packet(bytes);
    ASSERT_TRUE(packet.ok());
    EXPECT_TRUE(packet->is(Type::alignment));
    EXPECT_EQ(packet->signed_number(), -3);
  }
}

TEST(XhdPacket, LengthsThatContradictTheDatagramAreRefused) {
  Bytes bytes = encode_packet(Type::gain, 2, 5600);
  bytes.push_back(0);
  EXPECT_EQ(decode_packet(bytes).error().kind, WireErrorKind::oversized);
  bytes.resize(9);
  EXPECT_EQ(decode_packet(bytes).error().kind, WireErrorKind::truncated);
  bytes.resize(7);
  EXPECT_EQ(decode_packet(bytes).error().kind, WireErrorKind::truncated);
  EXPECT_EQ(decode_packet({}).error().kind, WireErrorKind::truncated);
}

TEST(XhdPacket, ACommandIsReadWhateverTheSizeOfItsNumber) {
  for (const int octets : {1, 2, 4}) {
    const auto command = decode_command(encode_packet(Type::gain_auto, octets, 2));
    ASSERT_TRUE(command.ok());
    EXPECT_EQ(command->type, Type::gain_auto);
    EXPECT_EQ(command->value, 2);
    EXPECT_FALSE(command->clamped);
  }
  EXPECT_EQ(decode_command(encode_packet(Type::no_transmit_to, 4, -5440))->value, -5440);
}

TEST(XhdPacket, ACommandOutOfRangeIsClamped) {
  const auto gain = decode_command(encode_packet(Type::gain, 4, 1'000'000));
  EXPECT_EQ(gain->value, 10'000);
  EXPECT_TRUE(gain->clamped);
  const auto alignment = decode_command(encode_packet(Type::alignment, 4, -2'000'000'000));
  EXPECT_EQ(alignment->value, -180 * 32);
  EXPECT_EQ(decode_command(encode_packet(Type::range, 4, 0))->value, 1);
}

TEST(XhdPacket, WhatIsNoCommandIsRefused) {
  EXPECT_EQ(decode_command(encode_packet(Type::scanner_state, 1, 5)).error().kind,
            WireErrorKind::unknown_kind);
  const Bytes three = {1, 2, 3};
  EXPECT_EQ(decode_command(encode_packet(0x925, three)).error().kind, WireErrorKind::malformed);
  EXPECT_EQ(decode_command(encode_packet(0x919, {})).error().kind, WireErrorKind::malformed);
}

TEST(XhdSpoke, EveryCutIsRefused) {
  const Bytes cells(100, 7);
  Bytes bytes;
  append_spoke(bytes, small_spoke(cells));
  ASSERT_TRUE(decode_spoke(bytes).ok());
  for (std::size_t length = 0; length < bytes.size(); ++length) {
    const auto spoke = decode_spoke(std::span(bytes).first(length));
    ASSERT_FALSE(spoke.ok()) << length;
    EXPECT_EQ(spoke.error().kind, WireErrorKind::truncated);
  }
}

TEST(XhdSpoke, ContradictionsAndValuesOutOfRangeAreRefused) {
  const Bytes cells(100, 7);
  Bytes good;
  append_spoke(good, small_spoke(cells));
  const auto with = [&](std::size_t offset, std::uint8_t value) {
    Bytes bytes = good;
    bytes[offset] = value;
    return decode_spoke(bytes);
  };
  EXPECT_EQ(with(0, 0x99).error().kind, WireErrorKind::unknown_kind);
  EXPECT_EQ(with(13, 0xFF).error().kind, WireErrorKind::out_of_range);
  EXPECT_EQ(with(27, 0x03).error().kind, WireErrorKind::out_of_range);
  EXPECT_EQ(with(26, 101).error().kind, WireErrorKind::malformed);
  EXPECT_EQ(with(30, 99).error().kind, WireErrorKind::malformed);
  EXPECT_EQ(with(10, 99).error().kind, WireErrorKind::malformed);
  EXPECT_EQ(with(14, 1)->cells.size(), 100u) << "what is unknown is skipped";
}

}  // namespace
}  // namespace skerry::garmin
