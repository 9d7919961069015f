// Spokes as displays take them, read by protobuf's own reader of the wire format.
#include <gmock/gmock.h>
#include <google/protobuf/io/coded_stream.h>
#include <google/protobuf/wire_format_lite.h>
#include <gtest/gtest.h>

#include <bit>
#include <map>
#include <string>
#include <vector>

#include "protocol/signalk/radar_message.hpp"

namespace skerry::signalk {
namespace {

using google::protobuf::internal::WireFormatLite;
using google::protobuf::io::CodedInputStream;

struct ReadSpoke {
  std::map<int, std::uint64_t> numbers;
  std::map<int, double> reals;
  std::string data;
};

ReadSpoke read_spoke(const std::string& bytes) {
  ReadSpoke spoke;
  CodedInputStream in(reinterpret_cast<const std::uint8_t*>(bytes.data()),
                      static_cast<int>(bytes.size()));
  while (const std::uint32_t tag = in.ReadTag()) {
    const int field = WireFormatLite::GetTagFieldNumber(tag);
    std::uint64_t number = 0;
    std::uint32_t length = 0;
    switch (WireFormatLite::GetTagWireType(tag)) {
      case WireFormatLite::WIRETYPE_VARINT:
        EXPECT_TRUE(in.ReadVarint64(&number));
        spoke.numbers[field] = number;
        break;
      case WireFormatLite::WIRETYPE_FIXED64:
        EXPECT_TRUE(in.ReadLittleEndian64(&number));
        spoke.reals[field] = std::bit_cast<double>(number);
        break;
      case WireFormatLite::WIRETYPE_LENGTH_DELIMITED:
        EXPECT_EQ(field, 5);
        EXPECT_TRUE(in.ReadVarint32(&length));
        EXPECT_TRUE(in.ReadString(&spoke.data, static_cast<int>(length)));
        break;
      default:
        ADD_FAILURE() << "a wire type that RadarMessage does not have";
        return spoke;
    }
  }
  EXPECT_TRUE(in.ConsumedEntireMessage());
  return spoke;
}

std::vector<ReadSpoke> read_message(const Bytes& bytes) {
  std::vector<ReadSpoke> spokes;
  CodedInputStream in(bytes.data(), static_cast<int>(bytes.size()));
  while (const std::uint32_t tag = in.ReadTag()) {
    EXPECT_EQ(WireFormatLite::GetTagFieldNumber(tag), 2) << "only spokes: field 1 is old";
    std::uint32_t length = 0;
    std::string spoke;
    EXPECT_TRUE(in.ReadVarint32(&length));
    EXPECT_TRUE(in.ReadString(&spoke, static_cast<int>(length)));
    spokes.push_back(read_spoke(spoke));
  }
  return spokes;
}

SpokeHeader header(std::uint32_t index, double heading_deg) {
  SpokeHeader header;
  header.index = index;
  header.geometry = {.spokes_per_turn = 2048, .cells = 1024, .bits = 8};
  header.range_scale = *RangeScale::find(6.0);
  header.heading = TrueBearing::from(degrees(heading_deg));
  header.own_ship = {60.5143, 4.9672};
  header.utc = UtcTime(std::chrono::milliseconds(1'795'000'000'123) + Duration(456'789));
  return header;
}

TEST(RadarMessage, SaysEverythingOfASpoke) {
  std::vector<std::uint8_t> cells(1024, 0);
  cells[0] = 255;
  RadarSpoke spoke = radar_spoke(header(5, 90.0));
  spoke.cells = cells;
  Bytes bytes;
  append_radar_spoke(bytes, spoke);
  const auto read = read_message(bytes);
  ASSERT_EQ(read.size(), 1u);
  EXPECT_EQ(read[0].numbers.at(1), 5u);
  EXPECT_EQ(read[0].numbers.at(2), 512u + 5u) << "from true north: a quarter turn more";
  EXPECT_EQ(read[0].numbers.at(3), 11112u);
  EXPECT_EQ(read[0].numbers.at(4), 1'795'000'000'123u);
  EXPECT_EQ(read[0].reals.at(6), 60.5143);
  EXPECT_EQ(read[0].reals.at(7), 4.9672);
  EXPECT_EQ(read[0].numbers.size(), 4u);
  EXPECT_EQ(read[0].data.size(), 1024u);
}

TEST(RadarMessage, BearingsAndAnglesStayWithinATurn) {
  for (const std::uint32_t index : {0u, 1u, 1024u, 2047u}) {
    for (const double heading : {0.0, 0.05, 179.9, 359.99}) {
      const RadarSpoke spoke = radar_spoke(header(index, heading));
      EXPECT_EQ(spoke.angle, index);
      ASSERT_LT(spoke.bearing, 2048u);
      const double deg = spoke.bearing * 360.0 / 2048.0;
      const double want = index * 360.0 / 2048.0 + heading;
      EXPECT_NEAR(std::remainder(deg - want, 360.0), 0.0, 0.09) << index << " at " << heading;
    }
  }
}

TEST(RadarMessage, ASpokeThatReachesBeyondTheScaleSaysHowFar) {
  SpokeHeader far = header(0, 0.0);
  far.instrumented_range = metres(19'531.25);
  EXPECT_EQ(radar_spoke(far).range_m, 19'531u);
}

TEST(RadarMessage, MessagesCanBePutTogetherBetweenSpokes) {
  const std::vector<std::uint8_t> cells(300, 7);
  Bytes bytes;
  for (std::uint32_t i = 0; i < 32; ++i) {
    RadarSpoke spoke = radar_spoke(header(i, 0.0));
    spoke.cells = cells;
    append_radar_spoke(bytes, spoke);
  }
  const auto read = read_message(bytes);
  ASSERT_EQ(read.size(), 32u);
  EXPECT_EQ(read[31].numbers.at(1), 31u);
}

TEST(RadarMessage, NoEchoIsLostAndEveryCellIsInTheLegend) {
  std::vector<std::uint8_t> cells(256);
  for (std::size_t i = 0; i < cells.size(); ++i) cells[i] = static_cast<std::uint8_t>(i);
  for (const std::uint32_t bits : {4u, 8u}) {
    RadarSpoke spoke = radar_spoke(header(0, 0.0));
    spoke.legend = legend_of(bits);
    spoke.cells = std::span(cells).first(bits == 4 ? 16 : 256);
    Bytes bytes;
    append_radar_spoke(bytes, spoke);
    const std::string data = read_message(bytes).at(0).data;
    std::uint8_t last = 0;
    for (std::size_t i = 0; i < data.size(); ++i) {
      const auto level = static_cast<std::uint8_t>(data[i]);
      EXPECT_EQ(level == 0, i == 0) << "cell " << i;
      EXPECT_GE(level, last) << "stronger cells have no lower level";
      EXPECT_LT(level, spoke.legend.levels);
      last = level;
    }
    EXPECT_EQ(last, spoke.legend.levels - 1) << "the strongest is the strongest";
  }
}

TEST(RadarMessage, MovingEchoesHaveTheirColoursAndNothingElseHas) {
  const std::vector<std::uint8_t> cells = {200, 200, 200, 0, 1};
  const std::vector<DopplerClass> doppler = {DopplerClass::none, DopplerClass::approaching,
                                             DopplerClass::receding, DopplerClass::approaching,
                                             DopplerClass::receding};
  RadarSpoke spoke = radar_spoke(header(0, 0.0));
  spoke.cells = cells;
  spoke.doppler = doppler;
  Bytes bytes;
  append_radar_spoke(bytes, spoke);
  const Legend legend = spoke.legend;
  const std::string data = read_message(bytes).at(0).data;
  const std::vector<std::uint8_t> levels(data.begin(), data.end());
  EXPECT_THAT(levels,
              testing::ElementsAre(100, legend.doppler_approaching(), legend.doppler_receding(), 0,
                                   legend.doppler_receding()));
}

TEST(Legend, EveryValueHasAColourThatIsAText) {
  for (const std::uint32_t bits : {4u, 8u}) {
    const Legend legend = legend_of(bits);
    ASSERT_LE(legend.size(), 256u);
    const Json document = legend_document(legend);
    const Json& pixels = document["pixels"];
    ASSERT_EQ(pixels.size(), legend.size());
    for (const Json& pixel : pixels) {
      ASSERT_TRUE(pixel["color"].is_string());
      EXPECT_THAT(pixel["color"].get<std::string>(), testing::MatchesRegex("#[0-9a-f]{8}"));
    }
    EXPECT_EQ(pixels[0]["color"], "#00000000") << "where there is nothing the chart shows";
    EXPECT_EQ(pixels[document["dopplerApproaching"].get<int>()]["type"], "dopplerApproaching");
    EXPECT_EQ(pixels[document["dopplerReceding"].get<int>()]["type"], "dopplerReceding");
    EXPECT_EQ(pixels[document["targetBorder"].get<int>()]["type"], "targetBorder");
    EXPECT_EQ(pixels[document["historyStart"].get<int>()]["type"], "history");
    EXPECT_EQ(pixels[document["pixelColors"].get<int>() - 1]["type"], "normal");
    EXPECT_LT(document["lowReturn"], document["mediumReturn"]);
    EXPECT_LT(document["mediumReturn"], document["strongReturn"]);
    EXPECT_LT(document["strongReturn"], document["pixelColors"]);
  }
}

}  // namespace
}  // namespace skerry::signalk
