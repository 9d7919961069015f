// All that edition 1.3 leaves to the sender, there and back; and the stream to one receiver.
#include <gmock/gmock.h>

#include <algorithm>
#include <bit>
#include <cstring>

#include "protocol/asterix/cat240_stream.hpp"
#include "tests/unit/asterix/cat240_variants.hpp"
#include "tests/unit/asterix/tshark.hpp"
#include "tests/unit/wire/test_spoke.hpp"

namespace skerry {
namespace {

Bytes block_of(const Spoke& spoke, const Cat240Options& options, std::uint32_t index) {
  Bytes out;
  const std::size_t begun = begin_cat240_block(out);
  append_cat240_video_record(out, spoke.header, spoke.cells, options, index);
  end_cat240_block(out, begun);
  return out;
}

std::string text_of(const Cat240Options& o) {
  return testing::PrintToString(static_cast<int>(*o.bits)) + " bits, blocks " +
         testing::PrintToString(static_cast<int>(o.blocks)) + (o.nanoseconds ? ", nano" : "") +
         (o.compressed ? ", compressed" : "") + (o.time_of_day ? ", time" : "") +
         (o.start_range > 0 ? ", start range" : "");
}

TEST(Cat240Variants, EveryOneComesBackAsItWasSent) {
  const Spoke spoke = test_spoke({4096, 1024, 8}, 5, 77);
  for (const Cat240Options& options : every_cat240_variant()) {
    const auto records = decode_cat240(block_of(spoke, options, 9));
    ASSERT_TRUE(records.ok()) << text_of(options) << ": " << records.error().text;
    ASSERT_EQ(records->size(), 1u);
    const Cat240Video& video = *records->front().video;
    EXPECT_EQ(video.compressed, options.compressed);
    EXPECT_EQ(video.in_nanoseconds, options.nanoseconds);
    EXPECT_EQ(video.start_range, options.start_range);
    EXPECT_EQ(video.bits_per_cell, *options.bits);
    EXPECT_EQ(records->front().time_of_day.has_value(), options.time_of_day);
    EXPECT_EQ(video.cell_count, 1024 - options.start_range);
    EXPECT_TRUE(video.foreign.empty());
    const bool narrow = *options.bits <= 8;
    ASSERT_EQ(narrow ? video.cells.size() : video.wide_cells.size(), video.cell_count)
        << text_of(options);
    for (std::uint32_t i = 0; i < video.cell_count; ++i) {
      const std::uint32_t read = narrow ? video.cells[i] : video.wide_cells[i];
      ASSERT_EQ(read, cell_on(spoke.cells[i + options.start_range], *options.bits))
          << text_of(options) << ", cell " << i;
    }
    // Half a unit of the cell's duration.
    const double unit = options.nanoseconds ? 1e-9 : 1e-15;
    EXPECT_NEAR(video.cell_size().in_metres(), spoke.header.cell_size().in_metres(),
                0.5 * unit * 299'792'458.0 / 2 * 1.001);
  }
}

TEST(Cat240Variants, NanosecondsCostHalfAPercentOfRangeWhereTheFactsSaySo) {
  Spoke spoke = test_spoke({4096, 512, 8}, 5, 0);
  ASSERT_EQ(spoke.header.range_scale.in_nautical_miles(), 3.0);
  Cat240Options options;
  options.nanoseconds = true;
  const auto records = decode_cat240(block_of(spoke, options, 0));
  EXPECT_EQ(records->front().video->cell_duration, 72u);  // of 72.4
}

TEST(Cat240Variants, AFourBitSpokeKeepsItsStrongestAndItsWeakest) {
  Spoke spoke = test_spoke({4096, 256, 4}, 5, 0);
  for (std::size_t i = 0; i < 256; ++i) spoke.cells[i] = static_cast<std::uint8_t>(i % 16);
  for (const unsigned bits : {1u, 2u, 4u, 8u, 16u, 32u}) {
    Cat240Options options;
    options.bits = static_cast<std::uint8_t>(bits);
    const auto records = decode_cat240(block_of(spoke, options, 0));
    const Cat240Video& video = *records->front().video;
    for (std::uint32_t i = 0; i < 256; ++i) {
      const std::uint32_t read = bits <= 8 ? video.cells[i] : video.wide_cells[i];
      ASSERT_EQ(read, cell_on(static_cast<std::uint8_t>((i % 16) * 17), bits));
    }
  }
}

TEST(Cat240Variants, WhatIsNoZlibStreamIsHandedOnAsItStands) {
  const Spoke spoke = test_spoke({4096, 256, 8}, 5, 0);
  Cat240Options options;
  options.compressed = true;
  Bytes block = block_of(spoke, options, 0);
  // After CAT, LEN, FSPEC, 010, 000, 020, 041, 048, 049 and REP.
  const std::size_t first = 3 + 2 + 2 + 1 + 4 + 12 + 2 + 5 + 1;
  ASSERT_EQ(block[first], 0x78);  // zlib's method and window
  block[first] = 0x00;
  const auto records = decode_cat240(block);
  ASSERT_TRUE(records.ok()) << records.error().text;
  const Cat240Video& video = *records->front().video;
  EXPECT_TRUE(video.compressed);
  EXPECT_TRUE(video.cells.empty());
  EXPECT_FALSE(video.foreign.empty());
}

TEST(Cat240Variants, ManyCellsOutOfFewOctetsAreRefused) {
  // A record that says that its octets inflate to 16 million cells.
  const Spoke spoke = test_spoke({4096, 256, 8}, 5, 0);
  Cat240Options options;
  options.compressed = true;
  Bytes block = block_of(spoke, options, 0);
  const std::size_t count = 3 + 2 + 2 + 1 + 4 + 12 + 2 + 2;
  std::memset(block.data() + count, 0xFF, 3);
  const auto records = decode_cat240(block);
  ASSERT_FALSE(records.ok());
  EXPECT_EQ(records.error().kind, WireErrorKind::oversized);
}

struct Stream {
  std::vector<Bytes> datagrams;
  std::vector<Cat240Record> records;
};

Stream stream_of(const Cat240StreamShape& shape, std::uint32_t spokes, std::uint32_t cells) {
  Cat240Stream stream(shape);
  Stream out;
  for (std::uint32_t i = 0; i < 2 * spokes; ++i) {
    Spoke spoke = test_spoke({spokes, cells, 8}, 5, i % spokes, i);
    spoke.header.sequence = i;
    spoke.header.scan = i / spokes;
    stream.add(spoke, [&](std::span<const std::uint8_t> datagram) {
      out.datagrams.emplace_back(datagram.begin(), datagram.end());
      const auto records = decode_cat240(datagram);
      ASSERT_TRUE(records.ok()) << records.error().text;
      out.records.insert(out.records.end(), records->begin(), records->end());
    });
  }
  return out;
}

TEST(Cat240Stream, PutsAsManyRecordsIntoADatagramAsItShallHold) {
  Cat240StreamShape shape;
  shape.records = 8;
  const Stream stream = stream_of(shape, 512, 256);
  ASSERT_EQ(stream.datagrams.size(), 2 * (1 + 512 / 8));
  ASSERT_EQ(stream.records.size(), 2 * (1 + 512u));
  std::uint32_t index = 0;
  for (std::size_t i = 0; i < stream.records.size(); ++i) {
    if (i % 513 == 0) {
      EXPECT_EQ(stream.records[i].kind, Cat240Kind::summary);
    } else {
      ASSERT_TRUE(stream.records[i].video);
      EXPECT_EQ(stream.records[i].video->message_index, index++);
    }
  }
}

TEST(Cat240Stream, KeepsDatagramsWithinTheirSize) {
  Cat240StreamShape shape;
  shape.records = 64;
  shape.max_datagram = 1472;
  for (const Bytes& datagram : stream_of(shape, 512, 256).datagrams) {
    EXPECT_LE(datagram.size(), 1472u);
  }
}

TEST(Cat240Stream, IsOfTheShapeThatWasAskedFor) {
  Cat240StreamShape shape;
  shape.turn_spokes = 360;
  shape.cells = 512;
  shape.options.bits = 2;
  const Stream stream = stream_of(shape, 4096, 1024);
  ASSERT_EQ(stream.records.size(), 2 * 361u);
  for (std::size_t i = 0; i < stream.records.size(); ++i) {
    if (!stream.records[i].video) continue;
    const Cat240Video& video = *stream.records[i].video;
    EXPECT_EQ(video.cell_count, 512u);
    EXPECT_EQ(video.bits_per_cell, 2);
    // A degree each, to a unit of azimuth.
    const auto wide = static_cast<std::uint16_t>(video.end_azimuth - video.start_azimuth);
    EXPECT_NEAR(wide, 65536 / 360.0, 1.0);
  }
}

using Cat240VariantsTshark = Cat240Tshark;

std::string hex_of(const Bytes& bytes) {
  std::string text;
  for (const std::uint8_t byte : bytes) {
    std::array<char, 3> digits;
    std::snprintf(digits.data(), digits.size(), "%02x", byte);
    text += digits.data();
  }
  return text;
}

TEST_F(Cat240VariantsTshark, ReadsEveryOneWithoutAFaultAndTheSameCells) {
  const std::vector<Cat240Options> variants = every_cat240_variant();
  std::vector<Spoke> spokes;
  std::string expected;
  {
    Capture file(capture());
    std::uint32_t index = 0;
    for (const Cat240Options& options : variants) {
      const Spoke spoke = test_spoke({4096, 300, 8}, 5, index % 4096, index);
      file.add(block_of(spoke, options, index));
      expected += std::to_string(index) + "|" +
                  std::to_string(std::countr_zero(unsigned{*options.bits}) + 1) + "|" +
                  std::to_string(300 - options.start_range) + "\n";
      ++index;
      spokes.push_back(spoke);
    }
  }
  EXPECT_EQ(tshark("-Y '!asterix or _ws.malformed or _ws.expert.severity >= warning'"), "");
  EXPECT_EQ(tshark("-T fields -E separator='|' -e asterix.240_020_VALUE -e asterix.240_048_RES "
                   "-e asterix.240_049_NBCELLS"),
            expected);
  // The item with the cells, once for every packet.
  const std::string json = tshark("-T jsonraw");
  std::size_t at = 0;
  for (std::size_t i = 0; i < variants.size(); ++i) {
    if (variants[i].compressed) continue;
    const std::string cells = hex_of(octets_bit_by_bit(spokes[i], variants[i]));
    const std::size_t found = json.find(cells, at);
    ASSERT_NE(found, std::string::npos) << text_of(variants[i]);
    at = found;
  }
}

TEST_F(Cat240VariantsTshark, ReadsSeveralRecordsInABlock) {
  Cat240StreamShape shape;
  shape.records = 4;
  {
    Capture file(capture());
    for (const Bytes& datagram : stream_of(shape, 256, 256).datagrams) file.add(datagram);
  }
  EXPECT_EQ(tshark("-Y '!asterix or _ws.malformed or _ws.expert.severity >= warning'"), "");
  std::string indices = tshark("-T fields -e asterix.240_020_VALUE");
  std::replace(indices.begin(), indices.end(), ',', '\n');
  std::string expected;
  for (int i = 0; i < 512; ++i) {
    if (i % 256 == 0) expected += "\n";  // a summary
    expected += std::to_string(i) + "\n";
  }
  EXPECT_EQ(indices, expected);
}

}  // namespace
}  // namespace skerry
