#include "protocol/board/sweep_record.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/unit/board/test_records.hpp"

namespace skerry::board {
namespace {

// Decodes what it encodes, the numbers of bytes agreeing.
template <typename T>
void expect_round_trip(const T& value, std::uint64_t sequence) {
  Bytes bytes = {1, 2, 3};  // records are appended to what is there
  append_record(bytes, sequence, value);
  ASSERT_EQ((bytes.size() - 3) % kRecordAlignment, 0u);
  ASSERT_LE(bytes.size() - 3, kMaxRecordBytes);
  const auto decoded = decode_record(std::span(bytes).subspan(3));
  ASSERT_TRUE(decoded.ok()) << decoded.error().text;
  EXPECT_EQ(decoded->sequence, sequence);
  EXPECT_EQ(decoded->size, bytes.size() - 3);
  ASSERT_TRUE(std::holds_alternative<T>(decoded->record));
  EXPECT_TRUE(std::get<T>(decoded->record) == value);
}

TEST(SweepRecord, ComesBackWhateverItsChannelsAndBits) {
  std::uint32_t seed = 1;
  for (const std::uint32_t a : {0u, 2u, 30u, 32u, 34u, 2048u, 16'383u, 16'384u}) {
    for (const std::uint32_t b : {0u, 2u, 31u, 33u, 512u, 16'384u}) {
      for (const int bits : {8, 10, 12, 14}) {
        expect_round_trip(test_sweep(seed, a, b, static_cast<std::uint8_t>(bits)),
                          (std::uint64_t{seed} << 33) + seed);
        ++seed;
      }
    }
  }
}

TEST(SweepRecord, OfASumHasSixteenBits) {
  Sweep sweep = test_sweep(7, 64, 64, 14);
  for (ChannelFormat& channel : sweep.meta.channels) channel.mode = DecimationMode::sum;
  sweep.samples[0][5] = 0xFFFF;
  expect_round_trip(sweep, 1);
}

TEST(SweepRecord, OfTheLargestSizeFillsTheLimitExactly) {
  Bytes bytes;
  append_record(bytes, 1, test_sweep(1, kMaxSamples, kMaxSamples));
  EXPECT_EQ(bytes.size(), kMaxRecordBytes);
}

TEST(SweepRecord, NeverTakesMoreSamplesThanThereMayBe) {
  Sweep sweep = test_sweep(1, 64);
  sweep.samples[1].assign(kMaxSamples + 100, 1);
  Bytes bytes;
  append_record(bytes, 1, sweep);
  const auto decoded = decode_record(bytes);
  ASSERT_TRUE(decoded.ok()) << decoded.error().text;
  EXPECT_EQ(std::get<Sweep>(decoded->record).samples[1].size(), kMaxSamples);
}

TEST(EdgesRecord, ComesBackWithAnyNumberOfEdges) {
  for (const std::size_t count : {0, 1, 3, 4, 5, 100, 4095, 4096}) {
    expect_round_trip(test_edges(static_cast<std::uint32_t>(count), count), count);
  }
}

TEST(EventRecord, ComesBackForEveryEvent) {
  for (std::uint32_t seed = 0; seed < 50; ++seed) expect_round_trip(test_event(seed), seed);
}

TEST(Records, FollowOneAnotherAndAreFoundByTheirSizes) {
  Bytes bytes;
  append_record(bytes, 10, test_sweep(1, 100, 50));
  append_record(bytes, 11, test_edges(2, 9));
  append_record(bytes, 12, test_event(3));
  std::size_t at = 0;
  for (std::uint64_t sequence = 10; sequence < 13; ++sequence) {
    const auto rest = std::span(bytes).subspan(at);
    const auto prefix = record_prefix(rest);
    const auto decoded = decode_record(rest);
    ASSERT_TRUE(prefix.has_value() && decoded.ok());
    EXPECT_EQ(decoded->sequence, sequence);
    EXPECT_EQ(prefix->sequence, sequence);
    EXPECT_EQ(prefix->size, decoded->size);
    EXPECT_EQ(prefix->kind, decoded->record.index() + 1);
    at += decoded->size;
  }
  EXPECT_EQ(at, bytes.size());
}

// The bytes of BOARD.md's tables, written here a second time by hand.
TEST(SweepRecord, HasTheBytesThatTheTablesSay) {
  Sweep sweep;
  sweep.meta = {.radar = 0x01020304,
                .trigger_count = 0x1112131415161718,
                .trigger_tick = 0x2122232425262728,
                .sample_clock_hz = 0x01312D00,
                .acp_count = 0x00000A0B,
                .ticks_since_acp = 0x00001112,
                .acp_period = 0x00002FAF,
                .acp_per_turn = 0x00001000,
                .turn_ticks = 0x02FAF080,
                .arp_ticks = 0x00000C0D,
                .arp_count = 0x41424344,
                .utc_ns = 0x3132333435363738,
                .delay_ticks = 0x00005152,
                .pulse_ns = 0x000000FA,
                .prf_millihertz = 0x001B7740,
                .faults = 0x00000042,
                .pulses = 5,
                .spoke = 0x000007FE,
                .spokes_per_turn = 0x00000800,
                .channels = {}};
  sweep.meta.channels[0] = {3, 0x0105, 14, DecimationMode::mean, Detector::log, true};
  sweep.meta.channels[1] = {1, 1, 8, DecimationMode::sum, Detector::linear, false};
  sweep.samples = {{{0x1234, 0x3FFF, 0x0001}, {0xABCD}}};

  Bytes expected(320, 0);
  const auto put = [&](std::size_t at, std::initializer_list<int> bytes) {
    for (const int byte : bytes) expected[at++] = static_cast<std::uint8_t>(byte);
  };
  put(0, {0x40, 0x01, 0x00, 0x00, 1, 1, 0xC0, 0x00});
  put(8, {0x88, 0x77, 0x66, 0x55, 0x44, 0x33, 0x22, 0x11});
  put(16, {0x04, 0x03, 0x02, 0x01, 0x42, 0, 0, 0});
  put(24, {0x18, 0x17, 0x16, 0x15, 0x14, 0x13, 0x12, 0x11});
  put(32, {0x28, 0x27, 0x26, 0x25, 0x24, 0x23, 0x22, 0x21});
  put(40, {0x38, 0x37, 0x36, 0x35, 0x34, 0x33, 0x32, 0x31});
  put(48, {0x00, 0x2D, 0x31, 0x01, 0x0B, 0x0A, 0, 0, 0x12, 0x11, 0, 0, 0xAF, 0x2F, 0, 0});
  put(64, {0x00, 0x10, 0, 0, 0x0D, 0x0C, 0, 0, 0x44, 0x43, 0x42, 0x41, 0x52, 0x51, 0, 0});
  put(80, {0xFA, 0, 0, 0, 0x40, 0x77, 0x1B, 0x00, 5, 0, 0, 0, 0xFE, 0x07, 0, 0});
  put(96, {0x00, 0x08, 0, 0, 0x80, 0xF0, 0xFA, 0x02});
  put(128, {3, 0, 0, 0, 0x05, 0x01, 0, 0, 192, 0, 0, 0, 14, 1, 0, 1});
  put(160, {1, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 8, 2, 1, 0});
  put(192, {0x34, 0x12, 0xFF, 0x3F, 0x01, 0x00});
  put(256, {0xCD, 0xAB});

  Bytes bytes;
  append_record(bytes, 0x1122334455667788, sweep);
  EXPECT_EQ(bytes, expected);
}

TEST(EdgesRecord, HasTheBytesThatTheTablesSay) {
  const Edges edges = {.radar = 2,
                       .sample_clock_hz = 0x01312D00,
                       .from_tick = 0x0100,
                       .to_tick = 0x0200,
                       .edges = {{0x0101, Line::trigger}, {0x0102, Line::heading}}};
  Bytes expected(128, 0);
  const auto put = [&](std::size_t at, std::initializer_list<int> bytes) {
    for (const int byte : bytes) expected[at++] = static_cast<std::uint8_t>(byte);
  };
  put(0, {128, 0, 0, 0, 2, 1, 64, 0, 7});
  put(16, {2});
  put(24, {0x00, 0x01, 0, 0, 0, 0, 0, 0, 0x00, 0x02});
  put(40, {0x00, 0x2D, 0x31, 0x01, 2, 0, 0, 0});
  put(64, {0x01, 0x01, 0, 0, 0, 0, 0, 0, 0});
  put(80, {0x02, 0x01, 0, 0, 0, 0, 0, 0, 3});
  Bytes bytes;
  append_record(bytes, 7, edges);
  EXPECT_EQ(bytes, expected);
}

TEST(EventRecord, HasTheBytesThatTheTablesSay) {
  Bytes expected(64, 0);
  const auto put = [&](std::size_t at, std::initializer_list<int> bytes) {
    for (const int byte : bytes) expected[at++] = static_cast<std::uint8_t>(byte);
  };
  put(0, {64, 0, 0, 0, 3, 1, 64, 0, 9});
  put(16, {1, 0, 0, 0, 2, 0, 0, 0, 0x08, 0x07, 0x06, 0x05, 0x04, 0x03, 0x02, 0x01});
  put(32, {4, 0, 0, 0, 0x21, 0x43, 0, 0});
  Bytes bytes;
  append_record(bytes, 9,
                Event{.radar = 1,
                      .tick = 0x0102030405060708,
                      .event = event::fault_raised,
                      .faults = fault::acp_missing,
                      .value = 0x4321});
  EXPECT_EQ(bytes, expected);
}

}  // namespace
}  // namespace skerry::board
