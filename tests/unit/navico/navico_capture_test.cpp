// The recordings of real Navico radars: every spoke decoded as an independent decoder does, and
// every field of every packet as we would send it.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "protocol/navico/command.hpp"
#include "protocol/navico/frame.hpp"
#include "protocol/navico/locator.hpp"
#include "protocol/navico/report.hpp"
#include "tests/unit/pcap/radar_captures.hpp"

namespace skerry::navico {
namespace {

struct Recording {
  const char* file;
  Model model;
  std::vector<Ipv4Endpoint> data;
};

const std::vector<Recording>& recordings() {
  static const std::vector<Recording> all = {
      {"br24-ranges-nm.pcap.gz", Model::br24, {kAddressesA.data}},
      {"3g-trueheading.pcap.gz", Model::g3, {kAddressesA.data}},
      {"4g-ranges-nm.pcap.gz", Model::g4, {kAddressesA.data}},
      {"halo20-ranges.pcap.gz", Model::halo20, {kAddressesA.data}},
      {"halo-velocitytrack-notarget.pcap.gz", Model::halo, {{ipv4(236, 6, 8, 35), 6515}}},
      {"halo3-5-connect-transmit.pcap.gz", Model::halo, {{ipv4(236, 6, 7, 100), 6132}}},
  };
  return all;
}

bool is_data(const Recording& recording, const CapturedDatagram& datagram) {
  return std::find(recording.data.begin(), recording.data.end(), datagram.to) !=
         recording.data.end();
}

class NavicoCapture : public testing::TestWithParam<Recording> {
 protected:
  void SetUp() override {
    if (!have_radar_captures()) GTEST_SKIP() << kNoRadarCaptures;
    datagrams_ = read_radar_capture(GetParam().file);
  }
  std::vector<CapturedDatagram> datagrams_;
};

// "1633.4", "98": as expected_decode.csv prints ranges, to the digits it has.
std::string nearest_of(const std::map<std::string, std::uint64_t>& ranges, double range_m) {
  const auto nearest =
      std::min_element(ranges.begin(), ranges.end(), [&](const auto& a, const auto& b) {
        return std::abs(std::stod(a.first) - range_m) < std::abs(std::stod(b.first) - range_m);
      });
  return std::abs(std::stod(nearest->first) - range_m) < 0.06 ? nearest->first
                                                              : fmt::format("{}", range_m);
}

TEST_P(NavicoCapture, EverySpokeIsReadAsTheIndependentDecoderReadsIt) {
  const ExpectedDecode expected = expected_decode(GetParam().file);
  DecodedCells cells;
  std::uint64_t packets = 0, wraps = 0;
  std::map<std::string, std::uint64_t> ranges;
  int last_angle = -1;
  for (const CapturedDatagram& each : datagrams_) {
    if (!is_data(GetParam(), each)) continue;
    const auto spokes = decode_frame(GetParam().model, each.payload);
    ASSERT_TRUE(spokes.ok()) << spokes.error().text;
    ++packets;
    for (const FrameSpoke& spoke : *spokes) {
      cells.add(spoke.cells);
      ++ranges[nearest_of(expected.spokes_at_range_m, spoke.fields.reach.in_metres())];
      wraps += last_angle - spoke.fields.angle > static_cast<int>(kTurnUnits) / 2;
      last_angle = spoke.fields.angle;
    }
  }
  EXPECT_EQ(packets, expected.spoke_packets);
  expect_cells(cells, expected);
  EXPECT_EQ(ranges, expected.spokes_at_range_m);
  EXPECT_EQ(wraps, expected.azimuth_wraps);
}

// Octets of a spoke header whose meaning nobody knows (README.md); the rest is compared.
std::set<std::size_t> unknown_of_spoke(Model model) {
  if (is_first_generation(model)) return {18, 19, 22, 23};
  return {16, 17, 18, 19, 20, 21, 22, 23};
}

// Four octets of the 4G's and HALO's headers are of the range, and two of BR24's are constants: a
// spoke of the same fields and range has the same octets.
TEST_P(NavicoCapture, OurSpokesOfTheSameFieldsHaveTheSameOctets) {
  const std::set<std::size_t> unknown = unknown_of_spoke(GetParam().model);
  std::uint32_t range_dm = 0;
  std::size_t compared = 0, others = 0;
  for (const CapturedDatagram& each : datagrams_) {
    if (const auto report = decode_report(each.payload); report.ok()) {
      const auto* controls = std::get_if<ControlReport>(&*report);
      if (controls != nullptr && each.to == kAddressesA.report) range_dm = controls->range_dm;
    }
    if (!is_data(GetParam(), each) || range_dm < kMinRangeDm ||
        range_dm > max_range_dm(GetParam().model)) {
      continue;
    }
    const auto spokes = decode_frame(GetParam().model, each.payload);
    ASSERT_TRUE(spokes.ok());
    const SpokeRange range = spoke_range(GetParam().model, range_dm);
    for (std::size_t i = 0; i < spokes->size(); ++i) {
      const FrameSpoke& spoke = (*spokes)[i];
      // The antenna still turns at the range before for some spokes after a command.
      if (spoke.fields.reach != range.reach) {
        ++others;
        continue;
      }
      std::array<std::uint8_t, kSpokeCells / 2> nibbles;
      pack_nibbles(spoke.cells, nibbles);
      Bytes ours;
      append_frame_header(ours, spokes->size());
      ASSERT_TRUE(std::equal(ours.begin(), ours.end(), each.payload.begin()));
      append_spoke(ours, spoke.fields, range, GetParam().model, nibbles);
      const std::size_t theirs = kFrameHeader + i * kSpokeOctets;
      for (std::size_t k = 0; k < kSpokeOctets; ++k) {
        if (k < kSpokeHeader && unknown.contains(k)) continue;
        ASSERT_EQ(ours[kFrameHeader + k], each.payload[theirs + k]) << "octet " << k;
      }
      ++compared;
    }
  }
  RecordProperty("compared", static_cast<int>(compared));
  if (GetParam().data.front() != kAddressesA.data) return;  // its report group is another
  EXPECT_GT(compared, 9 * others) << compared << " of " << compared + others;
}

// Octets of reports that nobody knows; README.md has the same table.
using Places = std::vector<std::pair<std::size_t, std::size_t>>;  // first and last
Places unknown_of_report(std::uint8_t kind, std::size_t size) {
  switch (kind) {
    case 0x02:
      return {{28, 28}, {46, 97}};
    case 0x03:
      return {{3, 31}, {38, 57}, {127, 128}};
    case 0x04:
      return {{14, 18}, {26, 31}};
    case 0x06:
      return {{12, 13}, {30, 30}, {33, 35}, {56, size - 1}};
    case 0x08:
      return {{10, 11}};
    default:
      return {};
  }
}

TEST_P(NavicoCapture, OurReportsOfTheSameFieldsHaveTheSameOctets) {
  std::map<unsigned, std::size_t> compared;
  for (const CapturedDatagram& each : datagrams_) {
    const auto report = decode_report(each.payload);
    if (!report.ok()) continue;
    const Model model = GetParam().model == Model::halo20 || each.payload.size() != 22
                            ? GetParam().model
                            : Model::halo20;
    const Bytes ours =
        std::visit([&](const auto& fields) { return encode(model, fields); }, *report);
    ASSERT_EQ(ours.size(), each.payload.size()) << fmt::format("{:02X}", each.payload[0]);
    for (std::size_t i = 0; i < ours.size(); ++i) {
      const Places unknown = unknown_of_report(each.payload[0], ours.size());
      if (std::any_of(unknown.begin(), unknown.end(),
                      [&](const auto& place) { return i >= place.first && i <= place.second; })) {
        continue;
      }
      ASSERT_EQ(ours[i], each.payload[i]) << fmt::format("{:02X}C4 octet {}", each.payload[0], i);
    }
    ++compared[each.payload[0]];
  }
  for (const unsigned kind : {1u, 2u, 3u, 4u, 8u}) EXPECT_GT(compared[kind], 0u) << kind;
}

TEST_P(NavicoCapture, EveryCommandOfItsDisplaysIsReadAndWrittenTheSame) {
  std::size_t commands = 0;
  for (const CapturedDatagram& each : datagrams_) {
    const bool is_command = each.payload.size() >= 2 &&
                            (each.payload[1] == 0xC1 || each.payload[1] == 0xC2) &&
                            each.to.address >> 16 == (236u << 8 | 6);
    if (!is_command) continue;
    const auto command = decode_command(each.payload);
    ASSERT_TRUE(command.ok()) << command.error().text;
    EXPECT_EQ(encode_command(*command), each.payload);
    ++commands;
  }
  // In one recording there is no display.
  const bool has_display = GetParam().data.front() != recordings()[4].data.front();
  EXPECT_EQ(commands > 5, has_display) << commands;
}

TEST_P(NavicoCapture, EveryLocatorIsReadAndWrittenTheSame) {
  std::size_t locators = 0;
  for (const CapturedDatagram& each : datagrams_) {
    if (each.to != kLocatorGroup || is_locator_question(each.payload)) continue;
    const auto locator = decode_locator(each.payload);
    ASSERT_TRUE(locator.ok()) << locator.error().text;
    EXPECT_EQ(encode_locator(*locator), each.payload);
    const auto a = locator->find_picture(1), b = locator->find_picture(2);
    ASSERT_TRUE(a.has_value());
    EXPECT_EQ(a->data, GetParam().data.front());
    EXPECT_EQ(b.has_value(), each.payload.size() == 222);
    // The one we make differs in nothing but groups.
    EXPECT_EQ(encode_locator(make_locator(locator->serial, locator->radar, *a, b)).size(),
              each.payload.size());
    if (!b) {
      EXPECT_EQ(encode_locator(make_locator(locator->serial, locator->radar, *a, b)), each.payload);
    }
    ++locators;
  }
  const bool asked = is_halo(GetParam().model) && datagrams_.size() > 401;
  EXPECT_EQ(locators > 1, asked) << locators;
}

INSTANTIATE_TEST_SUITE_P(Recordings, NavicoCapture, testing::ValuesIn(recordings()),
                         [](const auto& each) { return test_name_of(each.param.file); });

}  // namespace
}  // namespace skerry::navico
