// E-120 and its analogue scanner: the recording is read.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>

#include "protocol/raymarine/rd_packets.hpp"
#include "protocol/wire/byte_order.hpp"
#include "tests/unit/pcap/radar_captures.hpp"

namespace skerry::raymarine {
namespace {

constexpr const char* kRdCapture = "raymarine-e120-analog-tx-stdby.pcap.gz";
constexpr Ipv4Endpoint kRdData{ipv4(224, 29, 69, 231), 2566};

class RdCapture : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!have_radar_captures()) GTEST_SKIP() << kNoRadarCaptures;
    datagrams_ = read_radar_capture(kRdCapture);
  }
  std::vector<Bytes> of_type(std::uint32_t type) const {
    std::vector<Bytes> found;
    for (const auto& datagram : datagrams_) {
      if (datagram.to == kRdData &&
          ByteReader(datagram.payload).little_endian<std::uint32_t>() == type) {
        found.push_back(datagram.payload);
      }
    }
    return found;
  }
  std::vector<CapturedDatagram> datagrams_;
};

TEST_F(RdCapture, SpokesAreDecodedAsAnIndependentDecoderDoes) {
  const ExpectedDecode expected = expected_decode(kRdCapture);
  DecodedCells cells;
  const auto packets = of_type(kRdSpokesType);
  std::uint64_t wraps = 0;
  std::uint32_t last = 0;
  for (const Bytes& packet : packets) {
    const auto spokes = decode_rd_spokes(packet);
    ASSERT_TRUE(spokes.ok()) << spokes.error().text;
    for (const RdSpoke& spoke : *spokes) {
      cells.add(spoke.cells);
      wraps += last > spoke.azimuth + kRdSpokes / 2;
      last = spoke.azimuth;
    }
  }
  EXPECT_EQ(packets.size(), expected.spoke_packets);
  expect_cells(cells, expected);
  EXPECT_EQ(wraps, expected.azimuth_wraps);
}

TEST_F(RdCapture, TheStatusTellsTransmissionAndRange) {
  const auto packets = of_type(kRdStatusType);
  ASSERT_EQ(packets.size(), 34u);
  std::set<int> states;
  for (const Bytes& packet : packets) {
    const auto status = decode_rd_status(packet);
    ASSERT_TRUE(status.ok()) << status.error().text;
    states.insert(status->state);
    EXPECT_EQ(status->range_index, 1);
    EXPECT_EQ(std::lround(status->range_m()), 463);
  }
  EXPECT_EQ(states, (std::set<int>{0, 1}));
}

TEST_F(RdCapture, EveryCutOfAFrameIsRefused) {
  const auto packets = of_type(kRdSpokesType);
  ASSERT_FALSE(packets.empty());
  const Bytes& whole = packets.front();
  for (std::size_t length = 0; length < whole.size(); ++length) {
    EXPECT_FALSE(decode_rd_spokes(std::span(whole).first(length)).ok()) << length;
  }
}

}  // namespace
}  // namespace skerry::raymarine
