#include "protocol/asterix/cat240.hpp"

#include <gmock/gmock.h>

#include <chrono>
#include <cmath>

#include "tests/unit/wire/test_spoke.hpp"

namespace skerry {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAreArray;

constexpr Cat240Source kSource{25, 7};
constexpr UtcTime kMidnight{std::chrono::hours(24 * 20'000)};

Cat240Record only_record(const Bytes& bytes) {
  auto records = decode_cat240(bytes);
  EXPECT_TRUE(records.ok()) << records.error().text;
  if (!records.ok() || records->size() != 1) {
    ADD_FAILURE() << "expected one record";
    return {};
  }
  return std::move(records->front());
}

TEST(Cat240, VideoIsTheGoldenBytes) {
  Spoke spoke;
  spoke.header.geometry = {256, 257, 4};
  spoke.header.range_scale = *RangeScale::find(6);
  spoke.header.heading = TrueBearing::from(degrees(90));
  spoke.header.index = 255;  // 358.59 deg off the bow: 88.59 deg true
  spoke.header.utc = kMidnight + 1h + 2s + 500ms;
  spoke.cells.assign(257, 0);
  spoke.cells[0] = 0x1;
  spoke.cells[1] = 0x2;
  spoke.cells[256] = 0xF;
  Bytes golden = {
      0xF0,                    // category 240
      0x00, 0xA7,              // 167 octets
      0xE7, 0xC8,              // FSPEC: 010 000 020 041 048 | 049 050 140
      0x19, 0x07,              // 010: SAC 25, SIC 7
      0x02,                    // 000: video
      0x01, 0x02, 0x03, 0x04,  // 020
      0x3F, 0x00,              // 041: 63/256 of a turn
      0x40, 0x00,              //      to 90 deg
      0x00, 0x00, 0x00, 0x00,  //      first cell at the antenna
      0x11, 0x31, 0x60, 0x42,  //      2 * 11112 m / 257 / c = 288,448,578 fs
      0x00, 0x03,              // 048: not compressed, 4 bits
      0x00, 0x81,              // 049: 129 octets
      0x00, 0x01, 0x01,        //      257 cells
      0x21,                    // 050: 33 blocks of 4 octets
      0x12,                    //      cells 0 and 1, the first in the high nibble
  };
  golden.resize(golden.size() + 127);
  golden.push_back(0xF0);                           // cell 256
  golden.insert(golden.end(), {0x00, 0x00, 0x00});  // padding to 132 octets
  golden.insert(golden.end(), {0x07, 0x09, 0x40});  // 140: 3602.5 s * 128
  EXPECT_THAT(encode_cat240_video(spoke, kSource, 0x01020304), ElementsAreArray(golden));
}

TEST(Cat240, SummaryIsTheGoldenBytes) {
  const Bytes golden = {0xF0, 0x00, 0x0F, 0xD1, 0x08, 0x19, 0x07, 0x01,
                        0x03, 'a',  'b',  '?',  0x00, 0x00, 0x80};
  EXPECT_THAT(encode_cat240_summary("ab\n", kSource, kMidnight + 1s), ElementsAreArray(golden));
}

TEST(Cat240, SummaryComesBack) {
  const Cat240Record record =
      only_record(encode_cat240_summary("skerryd radar 0", kSource, kMidnight));
  EXPECT_EQ(record.kind, Cat240Kind::summary);
  EXPECT_EQ(record.source, kSource);
  EXPECT_EQ(record.summary, "skerryd radar 0");
  EXPECT_FALSE(record.video);
  EXPECT_EQ(record.time_of_day, 0u);
}

TEST(Cat240, SummaryIsCutAt255Characters) {
  EXPECT_EQ(only_record(encode_cat240_summary(std::string(300, 'x'), kSource, kMidnight)).summary,
            std::string(255, 'x'));
}

TEST(Cat240, VideoComesBackAtEveryCellCountRangeScaleAndWidth) {
  double worst = 0;
  for (const std::uint32_t bits : {4u, 8u}) {
    for (const std::uint32_t cells :
         {256u, 257u, 300u, 512u, 1020u, 1021u, 1024u, 2040u, 2041u, 2048u, 4095u, 4096u}) {
      for (std::size_t scale = 0; scale < RangeScale::kCount; ++scale) {
        const Spoke spoke = test_spoke({4096, cells, bits}, scale, 100, cells);
        const Cat240Record record = only_record(encode_cat240_video(spoke, kSource, cells));
        ASSERT_TRUE(record.video);
        EXPECT_EQ(record.video->message_index, cells);
        EXPECT_EQ(record.video->bits_per_cell, bits);
        EXPECT_EQ(record.video->cell_count, cells);
        EXPECT_EQ(record.video->start_range, 0u);
        EXPECT_FALSE(record.video->compressed);
        ASSERT_EQ(record.video->cells, spoke.cells);
        const double cell_size = spoke.header.cell_size().in_metres();
        const double off = std::abs(record.video->cell_size().in_metres() / cell_size - 1);
        EXPECT_EQ(record.video->in_nanoseconds, cell_size > 643.8) << cell_size;
        ASSERT_LT(off, record.video->in_nanoseconds ? 1.2e-4 : 2e-6);
        worst = std::max(worst, off);
      }
    }
  }
  RecordProperty("worst_relative_cell_size_error", std::to_string(worst));
}

TEST(Cat240, OneTurnTilesTheCircleWithoutGapOrOverlap) {
  for (const std::uint32_t spokes : {256u, 360u, 2048u, 4095u, 4096u, 8192u}) {
    Spoke spoke = test_spoke({spokes, 256, 4}, 7, 0);
    const TrueBearing heading = spoke.header.heading;
    std::uint32_t turned = 0;
    std::optional<std::uint16_t> previous_end;
    for (std::uint32_t i = 0; i < spokes; ++i) {
      spoke.header.index = i;
      const auto video = only_record(encode_cat240_video(spoke, kSource, i)).video;
      ASSERT_TRUE(video);
      const double bearing = heading.in_degrees() + i * 360.0 / spokes;
      ASSERT_LE(std::abs(std::remainder(video->start_azimuth * (360.0 / 65536) - bearing, 360.0)),
                180.0 / 65536 + 1e-6);
      if (previous_end) {
        ASSERT_EQ(video->start_azimuth, *previous_end);
      }
      previous_end = video->end_azimuth;
      turned += static_cast<std::uint16_t>(video->end_azimuth - video->start_azimuth);
    }
    EXPECT_EQ(turned, 65536u);
  }
}

TEST(Cat240, AzimuthJustBelowNorthRoundsToNorth) {
  Spoke spoke = test_spoke({256, 256, 8}, 7, 0);
  spoke.header.heading = TrueBearing::from_units(0xFFFF8000);
  EXPECT_EQ(only_record(encode_cat240_video(spoke, kSource, 0)).video->start_azimuth, 0);
  spoke.header.heading = TrueBearing::from_units(0xFFFF7FFF);
  EXPECT_EQ(only_record(encode_cat240_video(spoke, kSource, 0)).video->start_azimuth, 65535);
}

TEST(Cat240, TimeOfDayStaysWithinItsDay) {
  const auto time_of_day = [](UtcTime utc) {
    return only_record(encode_cat240_summary("", kSource, utc)).time_of_day;
  };
  EXPECT_EQ(time_of_day(kMidnight), 0u);
  EXPECT_EQ(time_of_day(kMidnight - 1ns), 86'400u * 128 - 1);
  EXPECT_EQ(time_of_day(kMidnight + 7812499ns), 0u);
  EXPECT_EQ(time_of_day(kMidnight + 7812500ns), 1u);
  EXPECT_EQ(time_of_day(UtcTime(-1s)), 86'399u * 128);
}

TEST(Cat240, SmallestVideoBlockThatFitsIsUsed) {
  const auto second_fspec = [](std::uint32_t cells, std::uint32_t bits) {
    return encode_cat240_video(test_spoke({256, cells, bits}, 0, 0), kSource, 0)[4];
  };
  EXPECT_EQ(second_fspec(1020, 8), 0xC8);  // 050
  EXPECT_EQ(second_fspec(1021, 8), 0xA8);  // 051
  EXPECT_EQ(second_fspec(4096, 8), 0xA8);
  EXPECT_EQ(second_fspec(2040, 4), 0xC8);
  EXPECT_EQ(second_fspec(2041, 4), 0xA8);
}

TEST(Cat240, AppendsToWhatIsThere) {
  const Spoke spoke = test_spoke({4096, 1024, 8}, 7, 5);
  Bytes stream = encode_cat240_summary("a", kSource, kMidnight);
  append_cat240_video(stream, spoke, kSource, 1);
  append_cat240_video(stream, spoke, kSource, 2);
  const auto records = decode_cat240(stream);
  ASSERT_TRUE(records.ok()) << records.error().text;
  ASSERT_EQ(records->size(), 3u);
  EXPECT_EQ(records->at(0).kind, Cat240Kind::summary);
  EXPECT_EQ(records->at(1).video->message_index, 1u);
  EXPECT_EQ(records->at(2).video->message_index, 2u);
  EXPECT_EQ(records->at(2).video->cells, spoke.cells);
}

}  // namespace
}  // namespace skerry
