// Raymarine Quantum: the packets of a real radar are read, and ours are the same byte by byte.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "protocol/raymarine/quantum_locator.hpp"
#include "protocol/raymarine/quantum_report.hpp"
#include "protocol/raymarine/quantum_spoke.hpp"
#include "protocol/wire/byte_order.hpp"
#include "tests/unit/pcap/radar_captures.hpp"

namespace skerry::raymarine {
namespace {

constexpr const char* kQuantumCapture = "quantum2-solent-03-gain-sea-rain.pcap.gz";
constexpr std::uint32_t kRadar = ipv4(198, 18, 4, 117);
constexpr Ipv4Endpoint kQuantumData{ipv4(232, 1, 215, 1), 2574};
constexpr std::uint32_t kLink = 0xd680d988;

class QuantumCapture : public ::testing::Test {
 protected:
  // It is large: read once.
  static void SetUpTestSuite() {
    if (have_radar_captures()) datagrams_ = read_radar_capture(kQuantumCapture);
  }
  static void TearDownTestSuite() { datagrams_ = {}; }
  void SetUp() override {
    if (datagrams_.empty()) GTEST_SKIP() << kNoRadarCaptures;
  }
  static std::uint32_t type_of(const CapturedDatagram& datagram) {
    return ByteReader(datagram.payload).little_endian<std::uint32_t>();
  }
  // Datagrams of one type that the radar sent to its data group.
  static std::vector<const CapturedDatagram*> of_type(std::uint32_t type) {
    std::vector<const CapturedDatagram*> found;
    for (const auto& datagram : datagrams_) {
      if (datagram.to == kQuantumData && type_of(datagram) == type) found.push_back(&datagram);
    }
    return found;
  }
  static inline std::vector<CapturedDatagram> datagrams_;
};

TEST_F(QuantumCapture, SpokesAreDecodedAsAnIndependentDecoderDoes) {
  const ExpectedDecode expected = expected_decode(kQuantumCapture);
  DecodedCells cells;
  std::map<std::string, std::uint64_t> ranges;
  std::uint64_t wraps = 0;
  std::uint16_t last = 0;
  long range_m = 0;  // told by the status alone
  for (const auto& datagram : datagrams_) {
    if (datagram.to != kQuantumData) continue;
    if (type_of(datagram) == kQuantumStatusType) {
      const auto status = decode_quantum_status(datagram.payload);
      ASSERT_TRUE(status.ok()) << status.error().text;
      range_m = std::lround(status->ranges[status->range_index] * 1.852);
    }
    if (type_of(datagram) != kQuantumSpokeType) continue;
    const auto spoke = decode_quantum_spoke(datagram.payload);
    ASSERT_TRUE(spoke.ok()) << spoke.error().text;
    ASSERT_EQ(spoke->cells.size(), kQuantumCells);
    cells.add(spoke->cells);
    ++ranges[std::to_string(range_m)];
    wraps += spoke->azimuth < last;
    last = spoke->azimuth;
  }
  expect_cells(cells, expected);
  EXPECT_EQ(ranges, expected.spokes_at_range_m);
  EXPECT_EQ(wraps, expected.azimuth_wraps);
}

TEST_F(QuantumCapture, EverySpokeIsEncodedByteByByte) {
  const auto spokes = of_type(kQuantumSpokeType);
  ASSERT_EQ(spokes.size(), 27656u);
  std::uint16_t next_sequence = decode_quantum_spoke(spokes.front()->payload)->sequence;
  for (const auto* datagram : spokes) {
    const auto spoke = decode_quantum_spoke(datagram->payload);
    Bytes bytes;
    append_quantum_spoke(bytes, *spoke);
    ASSERT_EQ(bytes, datagram->payload);
    EXPECT_EQ(spoke->cells_per_range, kQuantumCellsPerRange);
    ASSERT_EQ(spoke->sequence, next_sequence++);
  }
}

TEST_F(QuantumCapture, EveryStatusIsEncodedByteByByte) {
  const auto statuses = of_type(kQuantumStatusType);
  ASSERT_EQ(statuses.size(), 294u);
  for (const auto* datagram : statuses) {
    const auto status = decode_quantum_status(datagram->payload);
    ASSERT_TRUE(status.ok());
    EXPECT_EQ(encode_quantum_status(*status), datagram->payload);
    EXPECT_EQ(status->ranges, kQuantumRanges);
  }
  const auto first = decode_quantum_status(statuses.front()->payload);
  EXPECT_TRUE(first->transmits);
  EXPECT_EQ(first->ranges[first->range_index], 2000u);
  EXPECT_EQ(first->mode, QuantumMode::harbour);
  EXPECT_EQ(first->controls[0].gain, 54);
  EXPECT_EQ(first->rejection, 3);
}

TEST_F(QuantumCapture, TheOtherReportsAreEncodedByteByByte) {
  const auto info = of_type(kQuantumInfoType);
  ASSERT_EQ(info.size(), 277u);
  const auto read = decode_quantum_info(info.front()->payload);
  ASSERT_TRUE(read.ok());
  EXPECT_EQ(read->part_number, "E70498");
  Bytes ours = encode_quantum_info(*read);
  // Bytes 37 to 56 are measured (README.md).
  Bytes theirs = info.front()->payload;
  ASSERT_EQ(ours.size(), theirs.size());
  std::fill(ours.begin() + 37, ours.begin() + 57, std::uint8_t{0});
  std::fill(theirs.begin() + 37, theirs.begin() + 57, std::uint8_t{0});
  EXPECT_EQ(ours, theirs);

  for (const std::uint32_t type : kQuantumShortTypes) {
    EXPECT_EQ(encode_quantum_short(type), of_type(type).front()->payload) << std::hex << type;
  }
  EXPECT_EQ(encode_quantum_long(), of_type(0x280008).front()->payload);
  std::uint32_t count = 0;
  for (const auto* datagram : of_type(0x288942)) {
    count = ByteReader(std::span(datagram->payload).subspan(4)).little_endian<std::uint32_t>();
    ASSERT_LT(count, kQuantumCounts);
    ASSERT_EQ(encode_quantum_count(count), datagram->payload);
  }
}

TEST_F(QuantumCapture, TheLocatorIsEncodedByteByByte) {
  std::size_t addresses = 0, names = 0, long_names = 0;
  for (const auto& datagram : datagrams_) {
    if (datagram.to != kLocatorAddress || datagram.from.address != kRadar ||
        datagram.from.port != kLocatorAddress.port) {
      continue;
    }
    const LocatorName name{{kLink, kQuantumDevice}, "QuantumRadar"};
    const Ipv4Endpoint radar{kRadar, 2575};
    switch (datagram.payload.size()) {
      case 36: {
        const auto read = decode_locator_addresses(datagram.payload);
        ASSERT_TRUE(read.ok());
        EXPECT_EQ(read->data, kQuantumData);
        EXPECT_EQ(read->radar, radar);
        EXPECT_EQ(read->id.model, kQuantumModel);
        EXPECT_EQ(encode_locator_addresses(*read), datagram.payload);
        ++addresses;
        break;
      }
      case 56: {
        const auto read = decode_locator_name(datagram.payload);
        ASSERT_TRUE(read.ok());
        EXPECT_EQ(read->name, "QuantumRadar");
        EXPECT_EQ(read->id.link_id, kLink);
        EXPECT_EQ(encode_locator_name(*read), datagram.payload);
        ++names;
        break;
      }
      default:
        EXPECT_EQ(encode_locator_long_name(name, radar), datagram.payload);
        ++long_names;
    }
  }
  EXPECT_EQ(addresses, 277u);
  EXPECT_EQ(names, 277u);
  EXPECT_EQ(long_names, 277u);
}

}  // namespace
}  // namespace skerry::raymarine
