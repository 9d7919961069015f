// A Quantum display's session against our radar.  The recording has no commands (they were unicast
// past the recorder), but the radar's statuses tell what they were: each change of one is asked for
// here as a display asks, and the statuses and all else have to come out byte by byte.
#include <gtest/gtest.h>

#include <map>

#include "protocol/raymarine/quantum_command.hpp"
#include "protocol/raymarine/quantum_report.hpp"
#include "protocol/wire/byte_order.hpp"
#include "server/displays/raymarine/quantum.hpp"
#include "tests/unit/displays/fake_display_port.hpp"
#include "tests/unit/pcap/radar_captures.hpp"

namespace skerry::server {
namespace {

using namespace raymarine;
using std::chrono::milliseconds;

constexpr const char* kCapture = "quantum2-solent-03-gain-sea-rain.pcap.gz";
constexpr std::uint32_t kRadar = ipv4(198, 18, 4, 117);
constexpr Ipv4Endpoint kData{ipv4(232, 1, 215, 1), 2574};

using Wishes = std::vector<std::pair<QuantumControl, std::int32_t>>;

Wishes wishes_for(const QuantumStatus& before, const QuantumStatus& after) {
  Wishes wishes;
  const auto wish = [&](QuantumControl control, std::int32_t was, std::int32_t is) {
    if (was != is) wishes.emplace_back(control, is);
  };
  const auto& was = before.controls[static_cast<std::size_t>(after.mode)];
  const auto& is = after.controls[static_cast<std::size_t>(after.mode)];
  wish(QuantumControl::transmit, before.transmits, after.transmits);
  wish(QuantumControl::range_index, before.range_index, after.range_index);
  wish(QuantumControl::gain_auto, was.gain_auto, is.gain_auto);
  wish(QuantumControl::gain, was.gain, is.gain);
  wish(QuantumControl::colour_auto, was.colour_auto, is.colour_auto);
  wish(QuantumControl::colour, was.colour, is.colour);
  wish(QuantumControl::sea_auto, was.sea_auto, is.sea_auto);
  wish(QuantumControl::sea, was.sea, is.sea);
  wish(QuantumControl::rain_on, was.rain_on, is.rain_on);
  wish(QuantumControl::rain, was.rain, is.rain);
  wish(QuantumControl::expansion, before.expansion, after.expansion);
  wish(QuantumControl::rejection, before.rejection, after.rejection);
  wish(QuantumControl::bearing_offset, before.bearing_offset, after.bearing_offset);
  return wishes;
}

struct Told {
  double seconds = 0.0;
  Bytes bytes;
};

// Kinds of datagrams: where they went, and their first four bytes.
using Kind = std::pair<Ipv4Endpoint, std::uint32_t>;
Kind kind_of(const Ipv4Endpoint& to, const Bytes& payload) {
  return {to, ByteReader(payload).little_endian<std::uint32_t>()};
}

class QuantumSession : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    if (!have_radar_captures()) return;
    for (auto& datagram : read_radar_capture(kCapture)) {
      const bool spoke =
          datagram.payload.size() >= 4 && datagram.payload[0] == 3 && datagram.to == kData;
      if (datagram.from.address != kRadar || spoke) continue;
      if (start_ == UtcTime{}) start_ = datagram.time - milliseconds(370);
      if (datagram.to != kData && datagram.from.port != kLocatorAddress.port) continue;
      theirs_[kind_of(datagram.to, datagram.payload)].push_back(
          {in_seconds(datagram.time - start_), datagram.payload});
    }
    replay();
  }
  static void TearDownTestSuite() {
    theirs_.clear();
    ours_.clear();
  }
  void SetUp() override {
    if (theirs_.empty()) GTEST_SKIP() << kNoRadarCaptures;
  }

  static void replay() {
    QuantumOptions options;
    options.link_id = 0xd680d988;
    options.serial_number = "0880217";
    auto radar = make_quantum(options);
    FakeDisplayPort port;
    ScenarioTime now{};
    port.on_change = [&](RangeChannel channel) { radar->on_settings(channel, now, port); };
    const std::uint16_t ports[] = {2575};
    radar->begin(kRadar, ports, now, port);
    const auto ask = [&](const Wishes& wishes) {
      for (const auto& [control, value] : wishes) {
        radar->on_datagram(0, kQuantumDisplay, encode_quantum_command(control, value), now, port);
      }
    };
    const auto& statuses = theirs_.at({kData, kQuantumStatusType});
    QuantumStatus last = *decode_quantum_status(statuses.front().bytes);
    QuantumStatus blank;
    blank.expansion = 9;
    ask(wishes_for(blank, last));
    radar->on_time(now, port);
    port.sent.clear();

    std::size_t next = 1;
    for (int tick = 0; tick < 27'640; ++tick) {
      now = ScenarioTime{} + milliseconds(10) * tick;
      const double seconds = in_seconds(now - ScenarioTime{});
      for (; next < statuses.size() && statuses[next].seconds <= seconds; ++next) {
        const QuantumStatus wanted = *decode_quantum_status(statuses[next].bytes);
        ask(wishes_for(last, wanted));
        last = wanted;
      }
      radar->on_time(now, port);
      for (SentDatagram& each : port.sent) {
        ours_[kind_of(each.to, each.payload)].push_back({seconds, std::move(each.payload)});
      }
      port.sent.clear();
    }
    EXPECT_TRUE(port.counts.empty());
    settings_ = port.settings(RangeChannel::a);
  }

  static inline UtcTime start_{};
  static inline std::map<Kind, std::vector<Told>> theirs_, ours_;
  static inline wire::Settings settings_;
};

std::vector<Told> changes(const std::vector<Told>& all) {
  std::vector<Told> runs;
  for (const Told& each : all) {
    if (runs.empty() || runs.back().bytes != each.bytes) runs.push_back(each);
  }
  return runs;
}

TEST_F(QuantumSession, TheStatusesComeOutByteByByteAndWhenTheirsDid) {
  const Kind kind{kData, kQuantumStatusType};
  const auto theirs = changes(theirs_[kind]), ours = changes(ours_[kind]);
  ASSERT_EQ(theirs.size(), 13u);
  ASSERT_EQ(ours.size(), theirs.size());
  for (std::size_t i = 0; i < theirs.size(); ++i) {
    EXPECT_EQ(ours[i].bytes, theirs[i].bytes) << "at " << theirs[i].seconds << " s";
    if (i == 0) continue;
    EXPECT_NEAR(ours[i].seconds, theirs[i].seconds, 0.03);
  }
  // At once when it changes, besides once a second.
  EXPECT_NEAR(static_cast<double>(ours_[kind].size()), static_cast<double>(theirs_[kind].size()),
              5.0);
}

TEST_F(QuantumSession, TheRadarEndsWithTheSameSettings) {
  EXPECT_FALSE(settings_.standby());
  EXPECT_EQ(settings_.range_nm(), 3.0);
  EXPECT_TRUE(settings_.gain_auto());
  EXPECT_EQ(settings_.gain(), 65.0);
  EXPECT_EQ(settings_.sea(), 11.0);
  EXPECT_EQ(settings_.rain(), 0.0);
  EXPECT_EQ(settings_.interference_rejection(), 60.0);
}

TEST_F(QuantumSession, EveryKindOfReportComesAsOftenAndAtTheSameTimes) {
  for (const auto& [kind, theirs] : theirs_) {
    const auto& ours = ours_[kind];
    const std::string name = text_of(kind.first) + " " + std::to_string(kind.second);
    // Counts of a kind that was lost to the recording here and there.
    EXPECT_NEAR(static_cast<double>(ours.size()), static_cast<double>(theirs.size()),
                5.0 + 0.002 * static_cast<double>(theirs.size()))
        << name;
    ASSERT_FALSE(ours.empty()) << name;
    EXPECT_NEAR(ours.front().seconds, theirs.front().seconds, 0.03) << name;
  }
  for (const auto& [kind, ours] : ours_) {
    EXPECT_TRUE(theirs_.contains(kind)) << text_of(kind.first) << " " << kind.second;
  }
}

TEST_F(QuantumSession, TheLocatorIsTheSameByteByByte) {
  for (const std::uint32_t type : {0u, 1u, 2u}) {
    const Kind kind{kLocatorAddress, type};
    ASSERT_FALSE(theirs_[kind].empty());
    ASSERT_FALSE(ours_[kind].empty());
    EXPECT_EQ(ours_[kind].front().bytes, theirs_[kind].front().bytes) << type;
  }
}

}  // namespace
}  // namespace skerry::server
