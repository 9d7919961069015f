#include <gtest/gtest.h>

#include <limits>

#include "protocol/raymarine/quantum_command.hpp"
#include "protocol/raymarine/quantum_locator.hpp"
#include "protocol/raymarine/quantum_report.hpp"
#include "protocol/raymarine/quantum_spoke.hpp"
#include "protocol/raymarine/rd_packets.hpp"
#include "protocol/raymarine/run_length.hpp"

namespace skerry::raymarine {
namespace {

TEST(RunLength, EveryValueAndLengthComesBack) {
  for (int value = 0; value < 256; ++value) {
    for (std::size_t length = 1; length <= 600; length += length < 10 ? 1 : 61) {
      const Bytes plain(length, static_cast<std::uint8_t>(value));
      Bytes coded;
      append_runs(coded, plain);
      const auto back = decode_runs(coded, plain.size());
      ASSERT_TRUE(back.ok());
      ASSERT_EQ(*back, plain) << value << " x " << length;
    }
  }
}

TEST(RunLength, TheMarkItselfIsARun) {
  const Bytes plain = {1, kRunMark, 2};
  Bytes coded;
  append_runs(coded, plain);
  EXPECT_EQ(coded, (Bytes{1, kRunMark, 1, kRunMark, 2}));
}

TEST(RunLength, ARunThatIsCutOrTooLongIsRefused) {
  EXPECT_EQ(decode_runs(Bytes{kRunMark, 9}, 100).error().kind, WireErrorKind::truncated);
  EXPECT_EQ(decode_runs(Bytes{kRunMark}, 100).error().kind, WireErrorKind::truncated);
  const auto error = decode_runs(Bytes{0, kRunMark, 100, 7}, 100).error();
  EXPECT_EQ(error.kind, WireErrorKind::oversized);
  EXPECT_EQ(error.offset, 1u);
}

TEST(QuantumCommand, EveryControlComesBack) {
  for (int i = 0; i <= static_cast<int>(QuantumControl::bearing_offset); ++i) {
    const auto control = static_cast<QuantumControl>(i);
    const std::int32_t value = control == QuantumControl::stay_alive ? 0 : 1;
    const auto command = decode_quantum_command(encode_quantum_command(control, value));
    ASSERT_TRUE(command.ok()) << i;
    EXPECT_EQ(command->control, control);
    EXPECT_EQ(command->value, value);
    EXPECT_FALSE(command->clamped);
  }
  EXPECT_EQ(
      decode_quantum_command(encode_quantum_command(QuantumControl::bearing_offset, -123))->value,
      -123);
}

// Source of the bytes: raymarine/README.md.
TEST(QuantumCommand, BytesAreThoseOfADisplay) {
  EXPECT_EQ(encode_quantum_command(QuantumControl::transmit, 1),
            (Bytes{0x10, 0x00, 0x28, 0x00, 0x01, 0x00, 0x00, 0x00}));
  EXPECT_EQ(encode_quantum_command(QuantumControl::range_index, 7),
            (Bytes{0x01, 0x01, 0x28, 0x00, 0x00, 0x07, 0x00, 0x00}));
  EXPECT_EQ(encode_quantum_command(QuantumControl::gain, 40),
            (Bytes{0x02, 0x03, 0x28, 0x00, 0x00, 40, 0x00, 0x00}));
  EXPECT_EQ(encode_quantum_command(QuantumControl::stay_alive, 0),
            (Bytes{0, 0, 0x28, 0, 0x52, 0x61, 0x64, 0x61, 0x72, 0, 0, 0}));
}

TEST(QuantumCommand, TheOlderFormsThatDisplaysMixInAreRead) {
  const auto transmit = decode_quantum_command(Bytes{0x01, 0x80, 0x01, 0x00, 0x01, 0, 0, 0});
  EXPECT_EQ(transmit->control, QuantumControl::transmit);
  EXPECT_EQ(transmit->value, 1);
  const auto bearing =
      decode_quantum_command(Bytes{0x07, 0x82, 0x01, 0x00, 0xEC, 0xFF, 0xFF, 0xFF});
  EXPECT_EQ(bearing->control, QuantumControl::bearing_offset);
  EXPECT_EQ(bearing->value, -20);
}

TEST(QuantumCommand, WhatIsOutOfRangeIsClampedAndWhatIsCutRefused) {
  const auto gain = decode_quantum_command(Bytes{0x02, 0x03, 0x28, 0, 0, 255, 0, 0});
  EXPECT_EQ(gain->value, 100);
  EXPECT_TRUE(gain->clamped);
  EXPECT_EQ(decode_quantum_command(Bytes{0x01, 0x01, 0x28, 0, 0, 200, 0, 0})->value, 19);
  EXPECT_EQ(decode_quantum_command(Bytes{0x02, 0x03, 0x28, 0, 0}).error().kind,
            WireErrorKind::truncated);
  EXPECT_EQ(decode_quantum_command(Bytes{0x02}).error().kind, WireErrorKind::truncated);
  EXPECT_EQ(decode_quantum_command(Bytes{9, 9, 9, 9, 9, 9, 9, 9}).error().kind,
            WireErrorKind::unknown_kind);
}

TEST(QuantumSpoke, EveryCutIsRefused) {
  QuantumSpoke spoke{7, 103, 249, std::vector<std::uint8_t>(231, 0)};
  for (std::size_t i = 0; i < spoke.cells.size(); i += 3) spoke.cells[i] = kRunMark;
  Bytes bytes;
  append_quantum_spoke(bytes, spoke);
  ASSERT_EQ(decode_quantum_spoke(bytes)->cells, spoke.cells);
  for (std::size_t length = 0; length < bytes.size(); ++length) {
    EXPECT_FALSE(decode_quantum_spoke(std::span(bytes).first(length)).ok()) << length;
  }
}

TEST(QuantumSpoke, ValuesOutOfRangeAreRefused) {
  Bytes good;
  append_quantum_spoke(good, {7, 103, 249, std::vector<std::uint8_t>(231, 0)});
  const auto kind_with = [&](std::size_t offset, std::uint8_t value) {
    Bytes bytes = good;
    bytes[offset] = value;
    return decode_quantum_spoke(bytes).error().kind;
  };
  EXPECT_EQ(kind_with(0, 2), WireErrorKind::unknown_kind);
  EXPECT_EQ(kind_with(8, 253), WireErrorKind::out_of_range);
  EXPECT_EQ(kind_with(16, 250), WireErrorKind::out_of_range);
  EXPECT_EQ(kind_with(10, 251), WireErrorKind::out_of_range);
  EXPECT_EQ(kind_with(8, 100), WireErrorKind::oversized) << "more video than cells";
}

TEST(QuantumStatus, LengthsModesAndRangesThatCannotBeAreRefused) {
  const Bytes good = encode_quantum_status({});
  ASSERT_TRUE(decode_quantum_status(good).ok());
  for (std::size_t length = 0; length < good.size(); ++length) {
    EXPECT_EQ(decode_quantum_status(std::span(good).first(length)).error().kind,
              WireErrorKind::truncated);
  }
  Bytes bytes = good;
  bytes.push_back(0);
  EXPECT_EQ(decode_quantum_status(bytes).error().kind, WireErrorKind::oversized);
  bytes = good;
  bytes[20] = 20;
  EXPECT_EQ(decode_quantum_status(bytes).error().kind, WireErrorKind::out_of_range);
  bytes = good;
  bytes[21] = 4;
  EXPECT_EQ(decode_quantum_status(bytes).error().kind, WireErrorKind::out_of_range);
  bytes = good;
  bytes[0] = 3;
  EXPECT_EQ(decode_quantum_status(bytes).error().kind, WireErrorKind::unknown_kind);
}

TEST(QuantumLocator, OtherPacketsOfTheGroupAreRefused) {
  EXPECT_FALSE(decode_locator_addresses(Bytes(28)).ok());
  EXPECT_FALSE(decode_locator_addresses(Bytes(37)).ok());
  Bytes other(36);
  other[0] = 1;
  EXPECT_EQ(decode_locator_addresses(other).error().kind, WireErrorKind::unknown_kind);
  EXPECT_FALSE(decode_locator_name(Bytes(56)).ok());
}

TEST(QuantumInfo, TextsThatAreTooLongAreCut) {
  const auto read = decode_quantum_info(encode_quantum_info({"E70498999", "12345678"}));
  EXPECT_EQ(read->part_number, "E70498");
  EXPECT_EQ(read->serial_number, "1234567");
}

TEST(RdPackets, ACountOfSpokesThatCannotBeIsRefused) {
  Bytes frame(32);
  frame[0] = 0x03;
  frame[2] = 0x01;
  frame[12] = frame[13] = frame[14] = frame[15] = 0xFF;
  EXPECT_EQ(decode_rd_spokes(frame).error().kind, WireErrorKind::truncated);
  EXPECT_EQ(decode_rd_status(Bytes(300)).error().kind, WireErrorKind::unknown_kind);
}

}  // namespace
}  // namespace skerry::raymarine
