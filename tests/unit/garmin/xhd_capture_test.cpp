// Garmin xHD: the packets of a real radar are read, and ours are the same byte by byte.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>

#include "protocol/garmin/xhd_packet.hpp"
#include "protocol/garmin/xhd_reports.hpp"
#include "protocol/garmin/xhd_spoke.hpp"
#include "tests/unit/pcap/radar_captures.hpp"

namespace skerry::garmin {
namespace {

constexpr const char* kCapture = "garminxhd_txon_txoff.pcap.gz";
constexpr std::uint32_t kRadar = ipv4(172, 16, 2, 0);

class XhdCapture : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!have_radar_captures()) GTEST_SKIP() << kNoRadarCaptures;
    datagrams_ = read_radar_capture(kCapture);
  }
  double seconds(const CapturedDatagram& datagram) const {
    return in_seconds(datagram.time - datagrams_.front().time);
  }
  std::vector<CapturedDatagram> datagrams_;
};

TEST_F(XhdCapture, SpokesAreDecodedAsAnIndependentDecoderDoes) {
  const ExpectedDecode expected = expected_decode(kCapture);
  DecodedCells cells;
  std::map<std::string, std::uint64_t> ranges;
  std::uint64_t wraps = 0;
  std::uint16_t last_angle = 0;
  for (const auto& datagram : datagrams_) {
    if (datagram.to.port != kSpokeAddress.port) continue;
    const auto spoke = decode_spoke(datagram.payload);
    ASSERT_TRUE(spoke.ok()) << spoke.error().text;
    cells.add(spoke->cells);
    ++ranges[std::to_string(spoke->range_m)];
    wraps += spoke->angle < last_angle;
    last_angle = spoke->angle;
  }
  expect_cells(cells, expected);
  EXPECT_EQ(ranges, expected.spokes_at_range_m);
  EXPECT_EQ(wraps, expected.azimuth_wraps);
}

TEST_F(XhdCapture, EverySpokeIsEncodedByteByByte) {
  std::size_t spokes = 0;
  for (const auto& datagram : datagrams_) {
    if (datagram.to.port != kSpokeAddress.port) continue;
    const auto spoke = decode_spoke(datagram.payload);
    ASSERT_TRUE(spoke.ok());
    Bytes bytes;
    append_spoke(bytes, *spoke);
    ASSERT_EQ(bytes, datagram.payload);
    EXPECT_EQ(spoke->cells.size(), kCells);
    EXPECT_EQ(std::lround(spoke->range_m * kSpanOfRange), spoke->span_m);
    EXPECT_EQ(spoke->angle % (kAnglesPerTurn / kSpokesPerTurn), 0u);
    ++spokes;
  }
  EXPECT_EQ(spokes, 2227u);
}

// Every report is one of the round, with the length that it has there; and the round has no other.
TEST_F(XhdCapture, TheRoundHasTheReportsOfARealRadarAndTheirLengths) {
  std::map<std::uint32_t, std::size_t> captured, ours;
  for (const auto& datagram : datagrams_) {
    if (datagram.to != kReportAddress) continue;
    const auto packet = decode_packet(datagram.payload);
    ASSERT_TRUE(packet.ok()) << packet.error().text;
    captured[packet->type] = packet->payload.size();
  }
  for (const ReportSlot& slot : report_slots()) ours[slot.type] = slot.octets;
  ours[kAbilitiesType] = encode_abilities().size() - 8;
  ours[kRangesType] = encode_ranges().size() - 8;
  EXPECT_EQ(captured, ours);
  EXPECT_EQ(ours.size(), 87u);
}

// Numbers that the table tells to be the capture's are: what it says before a display asked for
// anything, and all through for what never changes.
TEST_F(XhdCapture, NumbersOfUnknownMeaningAreTheCaptures) {
  std::map<std::uint32_t, Bytes> first;
  for (const auto& datagram : datagrams_) {
    if (datagram.to != kReportAddress) continue;
    const auto type = decode_packet(datagram.payload)->type;
    if (type == 0x919 && first.size() < 80) continue;  // an answer, before its turn
    first.emplace(type, datagram.payload);
  }
  for (const ReportSlot& slot : report_slots()) {
    EXPECT_EQ(encode_packet(static_cast<Type>(slot.type), slot.octets, slot.number),
              first[slot.type])
        << std::hex << slot.type;
  }
  EXPECT_EQ(encode_abilities(), first[kAbilitiesType]);
  EXPECT_EQ(encode_ranges(), first[kRangesType]);
}

// A report that leaves out of turn (an answer, a new state) takes the place of another, which comes
// one tick later or earlier from then on; the round does not drift.
TEST_F(XhdCapture, ReportsLeaveAtTheTicksOfARealRadar) {
  std::map<std::uint32_t, ReportSlot> slots;
  for (const ReportSlot& slot : report_slots()) slots[slot.type] = slot;
  std::size_t reports = 0, in_turn = 0;
  for (const auto& datagram : datagrams_) {
    if (datagram.to != kReportAddress) continue;
    const auto found = slots.find(decode_packet(datagram.payload)->type);
    if (found == slots.end()) continue;
    ++reports;
    const auto tick = std::lround(seconds(datagram) * 1000.0 / kTickMs);
    const long period = found->second.period;
    const long off = (tick - found->second.tick) % period;
    // Ticks 2..8 of ten are the turns of these reports: one tick, or the pause between.
    in_turn += off == 0 || off == period - 1 || off == period - 4;
  }
  EXPECT_GT(reports, 1000u);
  EXPECT_GE(static_cast<double>(in_turn), 0.98 * static_cast<double>(reports));
}

TEST_F(XhdCapture, HeartbeatsAreEncodedByteByByte) {
  std::vector<Bytes> heartbeats;
  for (const auto& datagram : datagrams_) {
    if (datagram.to == kHeartbeatAddress && datagram.from.address == kRadar) {
      heartbeats.push_back(datagram.payload);
    }
  }
  ASSERT_EQ(heartbeats.size(), 3u);
  for (std::size_t i = 0; i < heartbeats.size(); ++i) {
    EXPECT_EQ(encode_heartbeat(static_cast<std::uint16_t>(0x7e + i)), heartbeats[i]);
  }
}

TEST_F(XhdCapture, EveryCommandIsRead) {
  std::vector<std::int64_t> transmit;
  std::size_t unknown = 0;
  for (const auto& datagram : datagrams_) {
    if (datagram.to.port != kCommandPort || datagram.to.address != kRadar) continue;
    const auto command = decode_command(datagram.payload);
    if (!command) {
      EXPECT_EQ(command.error().kind, WireErrorKind::unknown_kind);
      EXPECT_EQ(decode_packet(datagram.payload)->type, 0x2b2u);
      ++unknown;
      continue;
    }
    EXPECT_EQ(command->type, Type::transmit);
    transmit.push_back(command->value);
  }
  EXPECT_EQ(transmit, (std::vector<std::int64_t>{1, 0}));
  EXPECT_EQ(unknown, 2u);
}

}  // namespace
}  // namespace skerry::garmin
