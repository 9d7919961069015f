// The emulated Raymarine Quantum: controls, modes, arbitration, bad input, spokes.
#include "server/displays/raymarine/quantum.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "protocol/raymarine/quantum_command.hpp"
#include "protocol/raymarine/quantum_report.hpp"
#include "protocol/raymarine/quantum_spoke.hpp"
#include "tests/unit/displays/fake_display_port.hpp"

namespace skerry::server {
namespace {

using namespace raymarine;
using std::chrono::milliseconds;

class QuantumTest : public ::testing::Test {
 protected:
  QuantumTest() { start({}); }
  void start(const QuantumOptions& options) {
    options_ = options;
    radar_ = make_quantum(options);
    port_.at(RangeChannel::a).set_standby(false);
    port_.on_change = [this](RangeChannel channel) { radar_->on_settings(channel, now_, port_); };
    const std::uint16_t ports[] = {40'123};
    radar_->begin(ipv4(127, 0, 0, 1), ports, now_, port_);
  }
  void pass(Duration time) {
    for (Duration passed{}; passed < time; passed += milliseconds(10)) {
      now_ += milliseconds(10);
      radar_->on_time(now_, port_);
    }
  }
  void wish(QuantumControl control, std::int32_t value) {
    radar_->on_datagram(0, kQuantumDisplay, encode_quantum_command(control, value), now_, port_);
  }
  // The last status since the last told(); after a change it comes at once.
  std::optional<QuantumStatus> told(Duration within = milliseconds(10)) {
    pass(within);
    std::optional<QuantumStatus> last;
    for (const Bytes& report : port_.take(options_.data)) {
      if (const auto status = decode_quantum_status(report)) last = *status;
    }
    return last;
  }
  const wire::Settings& settings() { return port_.at(RangeChannel::a); }

  ScenarioTime now_{};
  FakeDisplayPort port_;
  QuantumOptions options_;
  std::unique_ptr<RadarEmulation> radar_;
};

TEST_F(QuantumTest, TheLocatorTellsThePortItReallyTakesCommandsAt) {
  pass(std::chrono::seconds(1));
  bool found = false;
  for (const Bytes& packet : port_.take(kLocatorAddress)) {
    const auto addresses = decode_locator_addresses(packet);
    if (!addresses) continue;
    found = true;
    EXPECT_EQ(addresses->radar, (Ipv4Endpoint{ipv4(127, 0, 0, 1), 40'123}));
    EXPECT_EQ(addresses->data, options_.data);
  }
  EXPECT_TRUE(found);
}

TEST_F(QuantumTest, EveryValueOfEveryControlComesBackExactlyAndAtOnce) {
  for (int value = 0; value <= 100; ++value) {
    wish(QuantumControl::gain, value);
    wish(QuantumControl::sea, value);
    wish(QuantumControl::rain_on, 1);
    wish(QuantumControl::rain, value);
    wish(QuantumControl::colour, value);
    wish(QuantumControl::rejection, value % 6);
    wish(QuantumControl::bearing_offset, value * 36 - 1800);
    wish(QuantumControl::range_index, value % 20);
    wish(QuantumControl::expansion, value % 2);
    wish(QuantumControl::gain_auto, value % 2);
    wish(QuantumControl::sea_auto, value % 2);
    wish(QuantumControl::colour_auto, value % 2);
    const auto status = told();
    ASSERT_TRUE(status.has_value());
    const QuantumModeControls& mine = status->controls[0];
    EXPECT_EQ(mine.gain, value);
    EXPECT_EQ(mine.sea, value);
    EXPECT_EQ(mine.rain, value);
    EXPECT_TRUE(mine.rain_on);
    EXPECT_EQ(mine.colour, value);
    EXPECT_EQ(status->rejection, value % 6);
    EXPECT_EQ(status->bearing_offset, value * 36 - 1800);
    EXPECT_EQ(status->range_index, value % 20);
    EXPECT_EQ(status->expansion, value % 2);
    EXPECT_EQ(mine.gain_auto, value % 2 == 1);
    EXPECT_EQ(mine.sea_auto, value % 2 == 1);
    EXPECT_EQ(mine.colour_auto, value % 2 == 1);
  }
  EXPECT_TRUE(port_.counts.empty());
}

TEST_F(QuantumTest, EveryCommandReachesTheControlItIsFor) {
  wish(QuantumControl::transmit, 0);
  EXPECT_TRUE(settings().standby());
  wish(QuantumControl::transmit, 1);
  EXPECT_FALSE(settings().standby());
  wish(QuantumControl::range_index, 9);
  EXPECT_EQ(settings().range_nm(), 3.0);
  wish(QuantumControl::gain, 47);
  EXPECT_EQ(settings().gain(), 47.0);
  wish(QuantumControl::sea, 12);
  EXPECT_EQ(settings().sea(), 12.0);
  wish(QuantumControl::sea_auto, 1);
  EXPECT_TRUE(settings().sea_auto());
  wish(QuantumControl::rain_on, 1);
  wish(QuantumControl::rain, 30);
  EXPECT_EQ(settings().rain(), 30.0);
  wish(QuantumControl::rain_on, 0);
  EXPECT_EQ(settings().rain(), 0.0);
  wish(QuantumControl::rejection, 5);
  EXPECT_EQ(settings().interference_rejection(), 100.0);
  wish(QuantumControl::expansion, 1);
  EXPECT_GT(settings().echo_stretch(), 0.0);
  wish(QuantumControl::bearing_offset, -15);
  EXPECT_EQ(settings().bearing_alignment_deg(), -1.5);
}

TEST_F(QuantumTest, EveryModeHasControlsOfItsOwn) {
  wish(QuantumControl::gain, 33);
  wish(QuantumControl::mode, static_cast<int>(QuantumMode::offshore));
  EXPECT_EQ(settings().gain(), 85.0);
  EXPECT_TRUE(settings().sea_auto());
  wish(QuantumControl::gain, 77);
  auto status = told();
  ASSERT_TRUE(status.has_value());
  EXPECT_EQ(status->mode, QuantumMode::offshore);
  EXPECT_EQ(status->controls[0].gain, 33);
  EXPECT_EQ(status->controls[2].gain, 77);
  wish(QuantumControl::mode, static_cast<int>(QuantumMode::harbour));
  EXPECT_EQ(settings().gain(), 33.0);
  EXPECT_FALSE(settings().sea_auto());
}

TEST_F(QuantumTest, ChangesByOthersAreToldAtOnce) {
  auto& mine = port_.at(RangeChannel::a);
  mine.set_gain(12.4);
  mine.set_range_nm(0.25);
  mine.set_mode(wire::WEATHER);
  radar_->on_settings(RangeChannel::a, now_, port_);
  const auto status = told();
  ASSERT_TRUE(status.has_value());
  EXPECT_EQ(status->mode, QuantumMode::weather);
  EXPECT_EQ(status->controls[3].gain, 12);
  EXPECT_EQ(status->ranges[status->range_index], 250u);
  wish(QuantumControl::gain, 50);
  EXPECT_EQ(settings().mode(), wire::CUSTOM) << "a picture mode ends where a knob is turned";
}

TEST_F(QuantumTest, AScaleThatIsNotInTheTableIsToldAsItsLastRange) {
  port_.at(RangeChannel::a).set_range_nm(96.0);
  radar_->on_settings(RangeChannel::a, now_, port_);
  const auto status = told();
  ASSERT_TRUE(status.has_value());
  EXPECT_EQ(status->range_index, 19);
  EXPECT_EQ(status->ranges[19], 96'000u);
}

TEST_F(QuantumTest, NothingNewIsToldOnlyOnceASecond) {
  pass(std::chrono::seconds(1));
  port_.sent.clear();
  radar_->on_settings(RangeChannel::a, now_, port_);
  wish(QuantumControl::stay_alive, 0);
  EXPECT_FALSE(told().has_value());
}

TEST_F(QuantumTest, WhatIsRefusedIsCountedAndNotReportedAsSet) {
  port_.refusal = "gain is locked by the instructor";
  wish(QuantumControl::gain, 10);
  wish(QuantumControl::range_index, 3);
  EXPECT_EQ(port_.counts["quantum refused command"], 2u);
  const auto status = told(std::chrono::seconds(1));
  ASSERT_TRUE(status.has_value());
  EXPECT_EQ(status->controls[0].gain, 50);
  EXPECT_EQ(status->ranges[status->range_index], 6000u);
}

TEST_F(QuantumTest, MalformedCommandsAreCountedByKindAndChangeNothing) {
  const Bytes good = encode_quantum_command(QuantumControl::gain, 10);
  for (std::size_t length = 0; length < 6; ++length) {
    radar_->on_datagram(0, kQuantumDisplay, std::span(good).first(length), now_, port_);
  }
  EXPECT_EQ(port_.counts["quantum truncated command"], 6u);
  radar_->on_datagram(0, kQuantumDisplay, Bytes(600, 0xAA), now_, port_);
  EXPECT_EQ(port_.counts["quantum unknown kind command"], 1u);
  EXPECT_TRUE(port_.changes.empty());
  wish(QuantumControl::gain, 250);
  EXPECT_EQ(port_.counts["quantum value out of range"], 1u);
  EXPECT_EQ(settings().gain(), 100.0);
}

TEST_F(QuantumTest, TenThousandCommandsAreAnsweredByOneStatus) {
  for (int i = 0; i < 10'000; ++i) wish(QuantumControl::gain, i % 101);
  port_.sent.clear();
  pass(milliseconds(10));
  EXPECT_LE(port_.sent.size(), 2u);
}

TEST_F(QuantumTest, ARadarThatNobodyKeepsAwakeGoesToStandby) {
  QuantumOptions options;
  options.standby_after = std::chrono::seconds(10);
  start(options);
  pass(std::chrono::seconds(9));
  wish(QuantumControl::stay_alive, 0);
  pass(std::chrono::seconds(9));
  EXPECT_FALSE(settings().standby());
  pass(std::chrono::seconds(2));
  EXPECT_TRUE(settings().standby());
}

SpokePtr spoke(std::uint64_t sequence, std::uint32_t index, RangeScale scale, double reach_m,
               std::uint32_t bright) {
  auto made = std::make_shared<Spoke>();
  made->header.sequence = sequence;
  made->header.index = index;
  made->header.geometry = {2000, 2048, 8};
  made->header.range_scale = scale;
  made->header.instrumented_range = metres(reach_m);
  made->cells.assign(2048, 0);
  made->cells[bright] = 255;
  return made;
}

TEST_F(QuantumTest, SpokesSpanTheDisplaysRangeAndEchoesAreWhereTheyWere) {
  for (std::size_t index = 0; index < kQuantumRanges.size(); ++index) {
    const double range_m = kQuantumRanges[index] * 1.852;
    wish(QuantumControl::range_index, static_cast<int>(index));
    const auto scale = *RangeScale::find(settings().range_nm());
    const double reach_m = radar_->instrumented_range_m(RangeChannel::a, settings());
    EXPECT_GE(reach_m, scale.length().in_metres() * (1 - 1e-9)) << range_m;
    EXPECT_LE(reach_m, 2.0 * scale.length().in_metres() * (1 + 1e-9)) << range_m;
    auto encoder = radar_->spoke_encoder(RangeChannel::a);
    Sector sector;
    for (std::uint32_t i = 0; i < 8; ++i) {
      sector.spokes.push_back(
          spoke(i, i, scale, reach_m, static_cast<std::uint32_t>(range_m / reach_m * 2048.0)));
    }
    const auto encoded = encoder(sector);
    ASSERT_EQ(encoded->spoke_count(), 1u) << range_m;
    const auto sent = decode_quantum_spoke(encoded->bytes);
    ASSERT_TRUE(sent.ok());
    EXPECT_EQ(sent->azimuth, 125) << "the bow; 0 is the stern";
    EXPECT_EQ(sent->cells_per_range, kQuantumCellsPerRange);
    // The display puts cell 103 at the range.
    EXPECT_GT(std::max(sent->cells[102], sent->cells[103]), 0) << range_m;
    EXPECT_EQ(std::count(sent->cells.begin(), sent->cells.end(), kQuantumStrongest), 1);
  }
}

TEST_F(QuantumTest, MovingEchoesHaveTheColoursOfTheirMotion) {
  auto moving = std::make_shared<Spoke>();
  moving->header.geometry = {250, 231, 8};
  moving->header.range_scale = *RangeScale::find(3.0);
  moving->header.instrumented_range =
      metres(radar_->instrumented_range_m(RangeChannel::a, settings()));
  moving->cells.assign(231, 0);
  moving->doppler.assign(231, DopplerClass::none);
  moving->cells[10] = moving->cells[20] = moving->cells[30] = 255;
  moving->doppler[10] = DopplerClass::approaching;
  moving->doppler[20] = DopplerClass::receding;
  moving->doppler[40] = DopplerClass::receding;
  auto encoder = radar_->spoke_encoder(RangeChannel::a);
  const auto sent = decode_quantum_spoke(encoder({{moving}})->bytes);
  ASSERT_TRUE(sent.ok());
  std::vector<int> seen;
  for (const std::uint8_t cell : sent->cells) {
    if (cell != 0 && (seen.empty() || seen.back() != cell)) seen.push_back(cell);
  }
  EXPECT_EQ(seen, (std::vector<int>{255, 254, 253}));
}

}  // namespace
}  // namespace skerry::server
