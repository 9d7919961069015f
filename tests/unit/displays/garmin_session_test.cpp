// A Garmin display's session against our radar, beside what a real radar made of it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "protocol/garmin/xhd_reports.hpp"
#include "server/displays/garmin/garmin_xhd.hpp"
#include "tests/unit/displays/fake_display_port.hpp"
#include "tests/unit/pcap/radar_captures.hpp"

namespace skerry::server {
namespace {

using garmin::Type;
using std::chrono::milliseconds;

constexpr const char* kCapture = "garminxhd_txon_txoff.pcap.gz";
constexpr std::uint32_t kRadar = ipv4(172, 16, 2, 0);

// Settings of the radar in the capture, as a display would have set them.
void set_like_the_capture(RadarEmulation& radar, FakeDisplayPort& port) {
  port.at(RangeChannel::a).set_range_nm(1.5);
  const std::pair<Type, std::int64_t> wishes[] = {{Type::range, 1852},
                                                  {Type::gain_auto, 0},
                                                  {Type::gain, 5600},
                                                  {Type::gain_auto_level, 1},
                                                  {Type::rain, 3200},
                                                  {Type::rain_on, 0},
                                                  {Type::sea, 8700},
                                                  {Type::sea_mode, 0},
                                                  {Type::sea_auto_level, 2},
                                                  {Type::alignment, 0},
                                                  {Type::rejection, 0},
                                                  {Type::crosstalk, 0},
                                                  {Type::speed, 0},
                                                  {Type::no_transmit_on, 1},
                                                  {Type::no_transmit_from, 5440},
                                                  {Type::no_transmit_to, -5440},
                                                  {Type::timed_on, 0},
                                                  {Type::timed_idle, 300},
                                                  {Type::timed_run, 60}};
  for (const auto& [type, value] : wishes) {
    radar.on_datagram(0, kGarminDisplay, garmin::encode_packet(type, 4, value), ScenarioTime{},
                      port);
  }
}

// Types that depend on the antenna's motion, and temperatures and voltages of that one radar.
bool is_measured(std::uint32_t type) {
  return type == 0x921 || (type >= 0x994 && type <= 0x996) || (type >= 0x9a3 && type <= 0x9a9);
}

struct Seen {
  double seconds = 0.0;
  std::uint32_t number = 0;
};
using History = std::map<std::uint32_t, std::vector<Seen>>;

void note(History& history, std::span<const std::uint8_t> datagram, double seconds) {
  const auto packet = garmin::decode_packet(datagram);
  ASSERT_TRUE(packet.ok());
  const auto number = packet->number();
  if (!number || is_measured(packet->type)) return;
  history[packet->type].push_back({seconds, *number});
}

// Runs of one value.
std::vector<Seen> changes(const std::vector<Seen>& seen) {
  std::vector<Seen> runs;
  for (const Seen& each : seen) {
    if (runs.empty() || runs.back().number != each.number) runs.push_back(each);
  }
  return runs;
}

class GarminSession : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!have_radar_captures()) GTEST_SKIP() << kNoRadarCaptures;
    const auto datagrams = read_radar_capture(kCapture);
    auto radar = make_garmin_xhd({});
    FakeDisplayPort port;
    port.on_change = [&](RangeChannel channel) { radar->on_settings(channel, now_, port); };
    radar->begin(kRadar, {}, now_, port);
    set_like_the_capture(*radar, port);
    radar->on_time(now_, port);
    port.sent.clear();

    std::size_t next = 0;
    for (int tick = 0; tick <= 1204; ++tick) {
      const Duration passed = milliseconds(10) * tick;
      for (; next < datagrams.size() && datagrams[next].time - datagrams[0].time <= passed;
           ++next) {
        const auto& datagram = datagrams[next];
        const double seconds = in_seconds(datagram.time - datagrams[0].time);
        if (datagram.to == garmin::kReportAddress) note(theirs_, datagram.payload, seconds);
        if (datagram.to.port != garmin::kCommandPort) continue;
        now_ = ScenarioTime{} + (datagram.time - datagrams[0].time);
        radar->on_datagram(0, datagram.from, datagram.payload, now_, port);
      }
      now_ = ScenarioTime{} + passed;
      radar->on_time(now_, port);
      for (const Bytes& report : port.take(garmin::kReportAddress)) {
        note(ours_, report, in_seconds(passed));
      }
      port.take(garmin::kHeartbeatAddress);
      if (port.changes.size() > told_) transmits_.push_back({in_seconds(passed), last_of(port)});
      told_ = port.changes.size();
    }
    EXPECT_TRUE(port.sent.empty());
    unknown_ = port.counts["garmin unknown kind command"];
  }
  static std::uint32_t last_of(const FakeDisplayPort& port) {
    return port.changes.back().transmit() ? 1 : 0;
  }

  ScenarioTime now_{};
  std::size_t told_ = 0;
  std::uint64_t unknown_ = 0;
  std::vector<Seen> transmits_;
  History theirs_, ours_;
};

TEST_F(GarminSession, TheRadarGoesThroughTheSameStatesAtTheSameTimes) {
  const auto state = static_cast<std::uint32_t>(Type::scanner_state);
  const auto theirs = changes(theirs_[state]), ours = changes(ours_[state]);
  ASSERT_EQ(ours.size(), theirs.size());
  for (std::size_t i = 0; i < ours.size(); ++i) {
    EXPECT_EQ(ours[i].number, theirs[i].number);
    EXPECT_NEAR(ours[i].seconds, theirs[i].seconds, 0.03) << "state " << ours[i].number;
  }
  // On the air when it tells so, and off at once.
  ASSERT_GE(transmits_.size(), 3u);  // the first has set the radar up
  EXPECT_EQ(transmits_[1].number, 1u);
  EXPECT_NEAR(transmits_[1].seconds, 6.172, 0.03);
  EXPECT_EQ(transmits_[2].number, 0u);
  EXPECT_NEAR(transmits_[2].seconds, 10.032, 0.03);
}

TEST_F(GarminSession, EveryReportTellsTheSame) {
  for (const auto& [type, seen] : theirs_) {
    const auto theirs = changes(seen), ours = changes(ours_[type]);
    if (type == static_cast<std::uint32_t>(Type::until_change)) continue;  // below
    ASSERT_EQ(ours.size(), theirs.size()) << std::hex << type;
    for (std::size_t i = 0; i < ours.size(); ++i) {
      EXPECT_EQ(ours[i].number, theirs[i].number) << std::hex << type;
      if (i == 0) continue;
      EXPECT_NEAR(ours[i].seconds, theirs[i].seconds, 0.05) << std::hex << type;
    }
  }
  for (const auto& [type, seen] : ours_) EXPECT_TRUE(theirs_.contains(type)) << std::hex << type;
}

TEST_F(GarminSession, EveryReportComesAsOften) {
  for (const auto& [type, seen] : theirs_) {
    const auto theirs = static_cast<double>(seen.size());
    EXPECT_NEAR(static_cast<double>(ours_[type].size()), theirs, 1.0) << std::hex << type;
  }
}

TEST_F(GarminSession, TheTimeToTheNextStateIsCountedDownAlike) {
  const auto type = static_cast<std::uint32_t>(Type::until_change);
  const auto& theirs = theirs_[type];
  const auto& ours = ours_[type];
  ASSERT_NEAR(static_cast<double>(ours.size()), static_cast<double>(theirs.size()), 1.0);
  for (std::size_t i = 0; i < std::min(ours.size(), theirs.size()); ++i) {
    EXPECT_NEAR(ours[i].number, theirs[i].number, 30.0) << "at " << theirs[i].seconds << " s";
  }
}

TEST_F(GarminSession, TheOneCommandThatNobodyKnowsIsCounted) { EXPECT_EQ(unknown_, 2u); }

}  // namespace
}  // namespace skerry::server
