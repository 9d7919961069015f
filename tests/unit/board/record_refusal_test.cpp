// Bytes that are no record, or one that lies about itself.
#include <gtest/gtest.h>

#include <string>

#include "protocol/board/sweep_record.hpp"
#include "tests/unit/board/test_records.hpp"

namespace skerry::board {
namespace {

template <typename T>
Bytes encoded(const T& value) {
  Bytes bytes;
  append_record(bytes, 5, value);
  return bytes;
}

struct Lie {
  std::string what;
  std::size_t offset;
  Bytes bytes;  // in place of what is there
  WireErrorKind kind;
  std::size_t at;  // where the error is said to be
};

void expect_refused(const Bytes& record, const Lie& lie) {
  SCOPED_TRACE(lie.what);
  Bytes bytes = record;
  std::copy(lie.bytes.begin(), lie.bytes.end(),
            bytes.begin() + static_cast<std::ptrdiff_t>(lie.offset));
  const auto decoded = decode_record(bytes);
  ASSERT_FALSE(decoded.ok());
  EXPECT_EQ(name_of(decoded.error().kind), name_of(lie.kind)) << decoded.error().text;
  EXPECT_EQ(decoded.error().offset, lie.at) << decoded.error().text;
  EXPECT_FALSE(decoded.error().text.empty());
}

TEST(SweepRecord, IsRefusedWhereItLies) {
  using enum WireErrorKind;
  const Bytes record = encoded(test_sweep(1, 40, 40));  // 192 + 128 + 128 bytes
  ASSERT_EQ(record.size(), 448u);
  const std::vector<Lie> lies = {
      {"longer than any record", 0, {0, 1, 1, 0}, oversized, 0},
      {"4 GB long", 0, {0xFF, 0xFF, 0xFF, 0xFF}, oversized, 0},
      {"no bytes long", 0, {0, 0, 0, 0}, malformed, 0},
      {"not a multiple of 64", 0, {0xBF, 1, 0, 0}, malformed, 0},
      {"longer than what came", 0, {0, 2, 0, 0}, truncated, 448},
      {"shorter than its samples", 0, {0x80, 1, 0, 0}, malformed, 0},
      {"shorter than its header", 0, {0x40, 0, 0, 0}, malformed, 6},
      {"of no kind", 4, {0}, unknown_kind, 4},
      {"of a kind to come", 4, {9}, unknown_kind, 4},
      {"a filler", 4, {255}, unknown_kind, 4},
      {"of a format to come", 5, {2}, out_of_range, 5},
      {"of another header", 6, {64, 0}, malformed, 6},
      {"without a clock", 48, {0, 0, 0, 0}, out_of_range, 48},
      {"with a clock too fast", 48, {0xFF, 0xFF, 0xFF, 0xFF}, out_of_range, 48},
      {"without ACPs", 64, {0, 0, 0, 0}, out_of_range, 64},
      {"without a pulse", 88, {0, 0, 0, 0}, out_of_range, 88},
      {"of a spoke beyond the turn", 92, {0, 8, 0, 0}, out_of_range, 92},
      {"of too many spokes", 96, {0, 0, 2, 0}, out_of_range, 96},
      {"with more samples than may be", 128, {1, 0x40, 0, 0}, out_of_range, 128},
      {"with 4 G samples", 160, {0xFF, 0xFF, 0xFF, 0xFF}, out_of_range, 160},
      {"with fewer samples than bytes", 128, {1, 0, 0, 0}, malformed, 168},
      {"without decimation", 132, {0, 0, 0, 0}, out_of_range, 132},
      {"with samples elsewhere", 136, {0, 1, 0, 0}, malformed, 136},
      {"with samples beyond the end", 168, {0xFF, 0xFF, 0, 0}, malformed, 168},
      {"of 7 bits", 140, {7}, out_of_range, 140},
      {"of 9 bits", 140, {9}, out_of_range, 140},
      {"of 16 bits", 140, {16}, out_of_range, 140},
      {"decimated somehow", 141, {3}, out_of_range, 141},
      {"detected somehow", 142, {2}, out_of_range, 142},
      {"upside down twice", 143, {2}, out_of_range, 143},
      {"with a sample of 13 bits", 193, {0x10}, out_of_range, 192},
  };
  for (const Lie& lie : lies) expect_refused(record, lie);
}

TEST(EdgesRecord, IsRefusedWhereItLies) {
  using enum WireErrorKind;
  Edges edges = {.radar = 1,
                 .sample_clock_hz = 20'000'000,
                 .from_tick = 100,
                 .to_tick = 200,
                 .edges = {{110, Line::acp}, {110, Line::trigger}, {150, Line::arp}}};
  const Bytes record = encoded(edges);
  ASSERT_EQ(record.size(), 128u);
  const std::vector<Lie> lies = {
      {"ends before it begins", 24, {201}, out_of_range, 32},
      {"without a clock", 40, {0, 0, 0, 0}, out_of_range, 40},
      {"with more edges than may be", 44, {1, 0x10, 0, 0}, out_of_range, 44},
      {"with more edges than bytes", 44, {5, 0, 0, 0}, malformed, 0},
      {"with fewer edges than bytes", 44, {0, 0, 0, 0}, malformed, 0},
      {"with an edge too early", 64, {99}, out_of_range, 64},
      {"with an edge too late", 96, {200}, out_of_range, 96},
      {"with an edge before the last", 80, {109}, out_of_range, 80},
      {"of a line that is not", 72, {4}, out_of_range, 72},
  };
  for (const Lie& lie : lies) expect_refused(record, lie);
}

TEST(EventRecord, IsRefusedWhereItLies) {
  using enum WireErrorKind;
  const Bytes record = encoded(test_event(1));
  expect_refused(record, {"nothing happened", 32, {0, 0, 0, 0}, out_of_range, 32});
  expect_refused(record, {"two things at once", 32, {3, 0, 0, 0}, out_of_range, 32});
  Bytes longer = record;
  longer.resize(128);
  expect_refused(longer, {"longer than an event", 0, {128}, malformed, 0});
}

TEST(Records, CutAnywhereAreRefusedAsCut) {
  using enum WireErrorKind;
  for (const Bytes& record :
       {encoded(test_sweep(3, 50, 10)), encoded(test_edges(1, 7)), encoded(test_event(1))}) {
    for (std::size_t length = 0; length < record.size(); ++length) {
      const auto decoded = decode_record(std::span(record).first(length));
      ASSERT_FALSE(decoded.ok()) << length;
      EXPECT_EQ(decoded.error().kind, truncated) << length;
      EXPECT_EQ(decoded.error().offset, length);
    }
  }
}

TEST(Records, WithBytesLaterVersionsMayUseAreReadAllTheSame) {
  const Sweep sweep = test_sweep(3, 50, 10);
  Bytes bytes = encoded(sweep);
  for (std::size_t at = 104; at < 128; ++at) bytes[at] = 0xEE;
  for (std::size_t at = 144; at < 160; ++at) bytes[at] = 0xEE;
  for (std::size_t at = 192 + 100; at < 192 + 128; ++at) bytes[at] = 0xEE;
  const auto decoded = decode_record(bytes);
  ASSERT_TRUE(decoded.ok()) << decoded.error().text;
  EXPECT_TRUE(std::get<Sweep>(decoded->record) == sweep);
}

TEST(Records, OfNoSenseHaveNoPrefix) {
  const Bytes record = encoded(test_event(1));
  EXPECT_TRUE(record_prefix(record).has_value());
  EXPECT_FALSE(record_prefix(std::span(record).first(63)).has_value());
  for (const std::uint32_t size : {0u, 1u, 63u, 65u, 65'792u, 0xFFFF'FFC0u}) {
    Bytes bytes = record;
    for (std::size_t i = 0; i < 4; ++i) bytes[i] = static_cast<std::uint8_t>(size >> 8 * i);
    EXPECT_FALSE(record_prefix(bytes).has_value()) << size;
  }
}

}  // namespace
}  // namespace skerry::board
