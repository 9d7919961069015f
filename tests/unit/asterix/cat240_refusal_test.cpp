// decode_cat240() reads records of other makers, and false ones.
#include <gmock/gmock.h>

#include "protocol/asterix/cat240.hpp"
#include "protocol/wire/byte_order.hpp"
#include "tests/unit/wire/test_spoke.hpp"

namespace skerry {
namespace {

using testing::ElementsAre;

constexpr Cat240Source kOtherSource{1, 2};

// A data block around `record`.
Bytes block(const Bytes& record, std::uint8_t category = 240) {
  Bytes out;
  append_big_endian(out, category, 1);
  append_big_endian(out, record.size() + 3, 2);
  for (const std::uint8_t each : record) out.push_back(each);
  return out;
}

Bytes operator+(Bytes a, const Bytes& b) {
  for (const std::uint8_t each : b) a.push_back(each);
  return a;
}

// Pieces of a record by hand: 010, 000 of a video, 020, 041.
const Bytes kVideoStart = {1, 2, 2,        // 010, 000
                           0, 0, 0, 9,     // 020
                           0, 0, 0, 16,    // azimuths
                           0, 0, 0, 5,     // first cell
                           0, 0, 0, 100};  // duration
const Bytes kFemtoLow = {0xE7, 0xC0};      // FSPEC: 010 000 020 041 048 | 049 050

Bytes video(std::uint8_t resolution, const Bytes& counters_and_block) {
  return kFemtoLow + kVideoStart + Bytes{0, resolution} + counters_and_block;
}

WireErrorKind kind_of_refusal(const Bytes& datagram) {
  const auto records = decode_cat240(datagram);
  EXPECT_FALSE(records.ok());
  return records.ok() ? WireErrorKind{} : records.error().kind;
}

TEST(Cat240Reading, SkipsReservedAndSpecialItems) {
  const Bytes record = Bytes{0xE7, 0xC6} + kVideoStart + Bytes{0, 4, 0, 2, 0, 0, 2, 1, 8, 9, 0, 0} +
                       Bytes{4, 0xAA, 0xBB, 0xCC} + Bytes{1};
  const auto records = decode_cat240(block(record + record));
  ASSERT_TRUE(records.ok()) << records.error().text;
  ASSERT_EQ(records->size(), 2u);
  EXPECT_THAT(records->at(1).video->cells, ElementsAre(8, 9));
  EXPECT_EQ(records->at(1).video->start_range, 5u);
  EXPECT_FALSE(records->at(1).time_of_day);
}

TEST(Cat240Reading, SkipsOtherCategories) {
  const auto records = decode_cat240(
      block({1, 2, 3}, 48) + encode_cat240_summary("x", kOtherSource, UtcTime{}) + block({}, 34));
  ASSERT_TRUE(records.ok()) << records.error().text;
  EXPECT_EQ(records->size(), 1u);
}

TEST(Cat240Reading, UnpacksSmallCellsFromTheHighBits) {
  const auto cells = [](std::uint8_t resolution, std::uint8_t count) {
    const auto records =
        decode_cat240(block(video(resolution, {0, 2, 0, 0, count, 1, 0xB4, 0x80, 0, 0})));
    EXPECT_TRUE(records.ok()) << records.error().text;
    return records.ok() ? records->front().video->cells : Bytes{};
  };
  EXPECT_THAT(cells(1, 9), ElementsAre(1, 0, 1, 1, 0, 1, 0, 0, 1));
  EXPECT_THAT(cells(2, 5), ElementsAre(2, 3, 1, 0, 2));
  EXPECT_THAT(cells(3, 3), ElementsAre(0xB, 4, 8));
  EXPECT_THAT(cells(4, 2), ElementsAre(0xB4, 0x80));
}

TEST(Cat240Reading, ReadsWideCellsFromTheHighOctet) {
  const auto records = decode_cat240(block(video(5, {0, 4, 0, 0, 2, 1, 0xB4, 0x80, 1, 2})));
  ASSERT_TRUE(records.ok()) << records.error().text;
  EXPECT_THAT(records->front().video->wide_cells, ElementsAre(0xB480u, 0x0102u));
  EXPECT_TRUE(records->front().video->cells.empty());
}

TEST(Cat240Reading, LeavesOctetsCompressedInAnotherWayAsTheyAre) {
  const Bytes record =
      kFemtoLow + kVideoStart + Bytes{0x80, 4, 0, 3, 0, 4, 0, 1, 0x78, 0x9C, 0x01, 0};
  const auto records = decode_cat240(block(record));
  ASSERT_TRUE(records.ok()) << records.error().text;
  EXPECT_TRUE(records->front().video->compressed);
  EXPECT_EQ(records->front().video->cell_count, 1024u);
  EXPECT_THAT(records->front().video->foreign, ElementsAre(0x78, 0x9C, 0x01));
  EXPECT_TRUE(records->front().video->cells.empty());
}

TEST(Cat240Reading, RefusesCompressedCellsInNoOctets) {
  const auto of_cells = [](std::uint8_t count) {
    return block(kFemtoLow + kVideoStart + Bytes{0x80, 4, 0, 0, 0, 0, count, 1, 1, 2, 3, 4});
  };
  EXPECT_EQ(kind_of_refusal(of_cells(4)), WireErrorKind::malformed);
  EXPECT_TRUE(decode_cat240(of_cells(0)).ok());
}

TEST(Cat240Reading, AcceptsFspecOctetsThatAddNothing) {
  const Bytes record = Bytes{0xD1, 0x01, 0x00} + Bytes{1, 2, 1, 1, 'x'};
  const auto records = decode_cat240(block(record));
  ASSERT_TRUE(records.ok()) << records.error().text;
  EXPECT_EQ(records->front().summary, "x");
}

TEST(Cat240Reading, EveryCutIsRefused) {
  const Bytes whole = encode_cat240_video(test_spoke({256, 300, 4}, 3, 9), kOtherSource, 1);
  for (std::size_t size = 1; size < whole.size(); ++size) {
    Bytes cut(whole.begin(), whole.begin() + size);
    ASSERT_EQ(kind_of_refusal(cut), WireErrorKind::truncated) << size;
    if (size <= 3) continue;
    cut[1] = static_cast<std::uint8_t>(size >> 8);
    cut[2] = static_cast<std::uint8_t>(size);
    ASSERT_EQ(kind_of_refusal(cut), WireErrorKind::truncated) << "block of " << size;
  }
}

TEST(Cat240Reading, NothingIsNoRecord) {
  EXPECT_TRUE(decode_cat240({})->empty());
  EXPECT_TRUE(decode_cat240(block({}))->empty());
}

TEST(Cat240Reading, LiesAboutLengthsAreRefused) {
  const auto kMalformed = WireErrorKind::malformed;
  EXPECT_EQ(kind_of_refusal({240, 0, 2}), kMalformed);
  EXPECT_EQ(kind_of_refusal({240, 0, 0}), kMalformed);
  EXPECT_EQ(kind_of_refusal(Bytes(65536)), WireErrorKind::oversized);
  // More valid octets than octets; more cells than valid octets hold.
  EXPECT_EQ(kind_of_refusal(block(video(4, {0, 5, 0, 0, 4, 1, 1, 2, 3, 4}))), kMalformed);
  EXPECT_EQ(kind_of_refusal(block(video(4, {0, 4, 0, 0, 5, 1, 1, 2, 3, 4}))), kMalformed);
  EXPECT_EQ(kind_of_refusal(block(video(6, {0, 4, 0xFF, 0xFF, 0xFF, 1, 1, 2, 3, 4}))), kMalformed);
  // RE of length 0, and longer than its block.
  const Bytes start = Bytes{0xD1, 0x04, 1, 2, 1, 0};
  EXPECT_EQ(kind_of_refusal(block(start + Bytes{0})), kMalformed);
  EXPECT_EQ(kind_of_refusal(block(start + Bytes{3, 1})), WireErrorKind::truncated);
}

TEST(Cat240Reading, RecordsThatMissOrMixItemsAreRefused) {
  const auto kMalformed = WireErrorKind::malformed;
  EXPECT_EQ(kind_of_refusal(block({0x00})), kMalformed);           // nothing
  EXPECT_EQ(kind_of_refusal(block({0x80, 1, 2})), kMalformed);     // no 000
  EXPECT_EQ(kind_of_refusal(block({0xC0, 1, 2, 1})), kMalformed);  // summary without 030
  EXPECT_EQ(kind_of_refusal(block({0xF0, 1, 2, 1, 0, 0, 0, 1, 0})), kMalformed);  // with 020
  EXPECT_EQ(kind_of_refusal(block({0xC0, 1, 2, 2})), kMalformed);  // video without anything
  EXPECT_EQ(kind_of_refusal(block({0xD0, 1, 2, 3, 0})), WireErrorKind::unknown_kind);
  EXPECT_EQ(kind_of_refusal(block(Bytes{0xEF, 0xC0} + kVideoStart)), kMalformed);  // 040 and 041
  EXPECT_EQ(kind_of_refusal(block(Bytes{0xE7, 0xE0} + kVideoStart)), kMalformed);  // 050 and 051
  EXPECT_EQ(kind_of_refusal(block({0xD1, 0x01, 0x80, 1, 2, 1, 0})), WireErrorKind::unknown_kind);
}

TEST(Cat240Reading, ValuesTheFormatDoesNotAllowAreRefused) {
  EXPECT_EQ(kind_of_refusal(block(video(0, {0, 0, 0, 0, 0, 0}))), WireErrorKind::out_of_range);
  EXPECT_EQ(kind_of_refusal(block(video(7, {0, 0, 0, 0, 0, 0}))), WireErrorKind::out_of_range);
  const Bytes midnight = {0xD1, 0x08, 1, 2, 1, 0, 0xA8, 0xC0, 0x00};  // 86,400 s
  EXPECT_EQ(kind_of_refusal(block(midnight)), WireErrorKind::out_of_range);
}

TEST(Cat240Reading, ErrorsSayWhereInTheDatagram) {
  const Bytes good = encode_cat240_summary("abc", kOtherSource, UtcTime{});
  const auto records = decode_cat240(good + block({0xC0, 1, 2, 9}));
  ASSERT_FALSE(records.ok());
  EXPECT_EQ(records.error().offset, good.size() + 3 + 4);
}

}  // namespace
}  // namespace skerry
