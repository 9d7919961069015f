// The emulated Garmin xHD: controls, arbitration, bad input, spokes.
#include "server/displays/garmin/garmin_xhd.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "protocol/garmin/xhd_reports.hpp"
#include "protocol/garmin/xhd_spoke.hpp"
#include "tests/unit/displays/fake_display_port.hpp"

namespace skerry::server {
namespace {

using garmin::Type;
using std::chrono::milliseconds;

class GarminXhdTest : public ::testing::Test {
 protected:
  GarminXhdTest() {
    port_.at(RangeChannel::a).set_standby(false);
    port_.on_change = [this](RangeChannel channel) { radar_->on_settings(channel, now_, port_); };
    radar_->begin(ipv4(127, 0, 0, 1), {}, now_, port_);
    pass(milliseconds(10));
  }
  void pass(Duration time) {
    for (Duration passed{}; passed < time; passed += milliseconds(10)) {
      now_ += milliseconds(10);
      radar_->on_time(now_, port_);
    }
  }
  void wish(Type type, std::int64_t value) {
    radar_->on_datagram(0, kGarminDisplay, garmin::encode_packet(type, 4, value), now_, port_);
  }
  // The radar's next report of that type, at most a round later.
  std::optional<std::int32_t> told(Type type, Duration within = milliseconds(2000)) {
    port_.sent.clear();
    for (Duration passed{}; passed < within; passed += milliseconds(10)) {
      pass(milliseconds(10));
      for (const Bytes& report : port_.take(garmin::kReportAddress)) {
        const auto packet = garmin::decode_packet(report);
        if (packet->is(type)) return packet->signed_number();
      }
    }
    return std::nullopt;
  }
  const wire::Settings& settings() { return port_.at(RangeChannel::a); }

  ScenarioTime now_{};
  FakeDisplayPort port_;
  std::unique_ptr<RadarEmulation> radar_ = make_garmin_xhd({});
};

TEST_F(GarminXhdTest, WhatADisplaySetsComesBackExactlyAndAtOnce) {
  const std::pair<Type, std::int64_t> wishes[] = {{Type::gain_auto, 2},
                                                  {Type::gain_auto, 0},
                                                  {Type::gain, 4733},
                                                  {Type::rain_on, 1},
                                                  {Type::rain, 101},
                                                  {Type::sea_mode, 1},
                                                  {Type::sea, 9999},
                                                  {Type::sea_mode, 2},
                                                  {Type::sea_auto_level, 0},
                                                  {Type::alignment, -31},
                                                  {Type::rejection, 2},
                                                  {Type::crosstalk, 1},
                                                  {Type::speed, 1},
                                                  {Type::speed, 2},
                                                  {Type::no_transmit_on, 1},
                                                  {Type::no_transmit_to, 33},
                                                  {Type::no_transmit_from, -99},
                                                  {Type::no_transmit_from, 6111},
                                                  {Type::timed_on, 1},
                                                  {Type::timed_idle, 17},
                                                  {Type::timed_run, 90},
                                                  {Type::range, 1389},
                                                  {Type::range, 463},
                                                  {Type::range, 88896},
                                                  {Type::range, 232},
                                                  {Type::gain_auto_level, 0}};
  for (const auto& [type, value] : wishes) {
    wish(type, value);
    EXPECT_EQ(told(type, milliseconds(20)), value) << std::hex << static_cast<std::uint32_t>(type);
  }
  EXPECT_TRUE(port_.counts.empty());
}

TEST_F(GarminXhdTest, EveryCommandReachesTheControlItIsFor) {
  wish(Type::gain, 4700);
  EXPECT_EQ(settings().gain(), 47.0);
  wish(Type::gain_auto, 2);
  EXPECT_TRUE(settings().gain_auto());
  wish(Type::rain_on, 1);
  wish(Type::rain, 2100);
  EXPECT_EQ(settings().rain(), 21.0);
  wish(Type::rain_on, 0);
  EXPECT_EQ(settings().rain(), 0.0);
  EXPECT_EQ(told(Type::rain), 2100) << "the level is kept while it is off";
  wish(Type::rain_on, 1);
  EXPECT_EQ(settings().rain(), 21.0);
  wish(Type::sea_mode, 1);
  wish(Type::sea, 3000);
  EXPECT_EQ(settings().sea(), 30.0);
  wish(Type::sea_mode, 2);
  EXPECT_TRUE(settings().sea_auto());
  wish(Type::sea_mode, 0);
  EXPECT_FALSE(settings().sea_auto());
  EXPECT_EQ(settings().sea(), 0.0);
  wish(Type::alignment, -64);
  EXPECT_EQ(settings().bearing_alignment_deg(), -2.0);
  wish(Type::rejection, 1);
  EXPECT_GT(settings().interference_rejection(), 0.0);
  wish(Type::speed, 1);
  EXPECT_EQ(settings().rotation_rpm(), 48.0);
  wish(Type::no_transmit_from, -32);
  wish(Type::no_transmit_to, 64);
  EXPECT_EQ(settings().blanked_sectors().sectors_size(), 0);
  wish(Type::no_transmit_on, 1);
  ASSERT_EQ(settings().blanked_sectors().sectors_size(), 1);
  EXPECT_EQ(settings().blanked_sectors().sectors(0).from_deg(), 359.0);
  EXPECT_EQ(settings().blanked_sectors().sectors(0).to_deg(), 2.0);
  wish(Type::no_transmit_on, 0);
  EXPECT_EQ(settings().blanked_sectors().sectors_size(), 0);
}

TEST_F(GarminXhdTest, ChangesByOthersAreToldAtOnce) {
  auto& mine = port_.at(RangeChannel::a);
  mine.set_gain(33.0);
  mine.set_range_nm(3.0);
  mine.set_sea_auto(true);
  radar_->on_settings(RangeChannel::a, now_, port_);
  port_.sent.clear();
  pass(milliseconds(10));
  std::map<std::uint32_t, std::uint32_t> told;
  for (const Bytes& report : port_.take(garmin::kReportAddress)) {
    const auto packet = garmin::decode_packet(report);
    told[packet->type] = packet->number().value_or(0);
  }
  EXPECT_EQ(told[0x925], 3300u);
  EXPECT_EQ(told[0x91e], 5556u);
  EXPECT_EQ(told[0x939], 2u);
}

TEST_F(GarminXhdTest, ARangeOfTheDisplaysTableIsKeptUntilTheScaleIsChangedByOthers) {
  wish(Type::range, 1852);
  EXPECT_EQ(settings().range_nm(), 1.5);
  EXPECT_EQ(told(Type::range), 1852);
  port_.at(RangeChannel::a).set_range_nm(0.75);
  radar_->on_settings(RangeChannel::a, now_, port_);
  EXPECT_EQ(told(Type::range), 1389);
  wish(Type::range, 1700);
  EXPECT_EQ(told(Type::range), 1852) << "the nearest of the table";
}

TEST_F(GarminXhdTest, APictureModeEndsWhereADisplayTurnsAKnob) {
  port_.at(RangeChannel::a).set_mode(wire::HARBOUR);
  wish(Type::gain, 4000);
  EXPECT_EQ(settings().mode(), wire::CUSTOM);
  EXPECT_EQ(settings().gain(), 40.0);
}

TEST_F(GarminXhdTest, WhatIsRefusedIsCountedAndNotReportedAsSet) {
  port_.refusal = "gain is locked by the instructor";
  wish(Type::gain, 1000);
  EXPECT_EQ(port_.counts["garmin refused command"], 1u);
  EXPECT_EQ(port_.last_detail, port_.refusal);
  EXPECT_EQ(told(Type::gain), 5000);
  wish(Type::range, 463);
  EXPECT_EQ(told(Type::range), 11112);
  wish(Type::transmit, 0);
  EXPECT_EQ(told(Type::scanner_state), 5);
}

TEST_F(GarminXhdTest, TransmissionThatIsLockedIsNotBegun) {
  wish(Type::transmit, 0);
  pass(std::chrono::seconds(6));
  EXPECT_EQ(told(Type::scanner_state), 3);
  port_.at(RangeChannel::a).add_locked("transmit");
  wish(Type::transmit, 1);
  EXPECT_EQ(told(Type::scanner_state), 3);
  EXPECT_EQ(port_.counts["garmin refused command"], 1u);
}

TEST_F(GarminXhdTest, ARadarSwitchedOnFromElsewhereTransmitsAtOnce) {
  wish(Type::transmit, 0);
  pass(milliseconds(500));
  EXPECT_TRUE(settings().standby());
  port_.at(RangeChannel::a).set_standby(false);
  radar_->on_settings(RangeChannel::a, now_, port_);
  EXPECT_EQ(told(Type::scanner_state, milliseconds(20)), 5);
}

TEST_F(GarminXhdTest, MalformedCommandsAreCountedByKindAndChangeNothing) {
  const Bytes good = garmin::encode_packet(Type::gain, 2, 100);
  for (std::size_t length = 0; length < good.size(); ++length) {
    radar_->on_datagram(0, kGarminDisplay, std::span(good).first(length), now_, port_);
  }
  EXPECT_EQ(port_.counts["garmin truncated command"], good.size());
  Bytes more = good;
  more.push_back(0);
  radar_->on_datagram(0, kGarminDisplay, more, now_, port_);
  EXPECT_EQ(port_.counts["garmin oversized command"], 1u);
  radar_->on_datagram(0, kGarminDisplay, garmin::encode_packet(Type::rotation, 4, 1), now_, port_);
  EXPECT_EQ(port_.counts["garmin unknown kind command"], 1u);
  wish(Type::gain, 99'999);
  EXPECT_EQ(port_.counts["garmin value out of range"], 1u);
  EXPECT_EQ(settings().gain(), 100.0);
  EXPECT_EQ(port_.changes.size(), 1u);
}

TEST_F(GarminXhdTest, TenThousandCommandsAreAnsweredByOneReport) {
  for (int i = 0; i < 10'000; ++i) wish(Type::gain, i);
  port_.sent.clear();
  pass(milliseconds(10));
  EXPECT_LE(port_.sent.size(), 4u);
  EXPECT_EQ(settings().gain(), 99.99);
}

TEST_F(GarminXhdTest, AfterALongPauseOnlyTheLastTicksAreMadeUpFor) {
  port_.sent.clear();
  now_ += std::chrono::hours(24);
  radar_->on_time(now_, port_);
  EXPECT_LE(port_.sent.size(), 25u);
}

SpokePtr spoke(std::uint64_t sequence, std::uint32_t index, RangeScale scale, double reach_m,
               const std::vector<std::uint32_t>& bright, std::uint32_t bits = 8) {
  auto made = std::make_shared<Spoke>();
  made->header.sequence = sequence;
  made->header.index = index;
  made->header.geometry = {1440, 1024, bits};
  made->header.range_scale = scale;
  made->header.instrumented_range = metres(reach_m);
  made->cells.assign(1024, 0);
  for (const std::uint32_t cell : bright) made->cells[cell] = bits == 8 ? 200 : 15;
  return made;
}

TEST_F(GarminXhdTest, SpokesHaveTheDisplaysRangeAndEchoesWhereTheyAre) {
  for (const std::uint32_t range_m : garmin::kRanges) {
    wish(Type::range, range_m);
    const auto scale = *RangeScale::find(settings().range_nm());
    const double reach_m = radar_->instrumented_range_m(RangeChannel::a, settings());
    EXPECT_GE(reach_m, scale.length().in_metres() * (1 - 1e-9)) << range_m;
    EXPECT_LE(reach_m, 2.0 * scale.length().in_metres() * (1 + 1e-9)) << range_m;
    const std::uint32_t bright =
        static_cast<std::uint32_t>(range_m / reach_m * 1024.0);  // an echo on the display's range
    auto encoder = radar_->spoke_encoder(RangeChannel::a);
    const auto sector =
        encoder({{spoke(0, 0, scale, reach_m, {bright}), spoke(1, 1, scale, reach_m, {bright})}});
    ASSERT_EQ(sector->spoke_count(), 2u);
    const auto sent = garmin::decode_spoke(std::span(sector->bytes).first(sector->spoke_ends[0]));
    ASSERT_TRUE(sent.ok());
    EXPECT_EQ(sent->angle, 0);
    EXPECT_EQ(sent->range_m, range_m);
    EXPECT_EQ(sent->cells.size(), garmin::kCells);
    double middle = 0.0, count = 0.0;
    for (std::size_t i = 0; i < sent->cells.size(); ++i) {
      if (sent->cells[i] == 0) continue;
      middle += static_cast<double>(i) + 0.5;
      ++count;
    }
    ASSERT_GT(count, 0.0) << range_m;
    const double at_m = middle / count / garmin::kCells * sent->span_m;
    EXPECT_NEAR(at_m, range_m, 0.004 * range_m);
  }
}

TEST_F(GarminXhdTest, RowsOfAnyOtherLengthAreOneSpoke) {
  auto encoder = radar_->spoke_encoder(RangeChannel::a);
  const auto sector = encoder({{spoke(0, 7, *RangeScale::find(6.0), 11112.0, {1023}, 4)}});
  ASSERT_EQ(sector->spoke_count(), 1u);
  const auto sent = garmin::decode_spoke(sector->bytes);
  EXPECT_EQ(sent->angle, 56);
  EXPECT_EQ(sent->span_m, 11112u);
  EXPECT_EQ(sent->cells.back(), 255) << "four bits fill eight";
}

TEST_F(GarminXhdTest, TheAntennaIsReportedWhereItsLastSpokeWas) {
  auto encoder = radar_->spoke_encoder(RangeChannel::a);
  encoder({{spoke(0, 100, *RangeScale::find(6.0), 12558.0, {})}});
  EXPECT_EQ(told(Type::last_spoke, milliseconds(110)), 800);
  EXPECT_EQ(told(Type::antenna, milliseconds(110)), 800);
  EXPECT_EQ(told(Type::rotation, milliseconds(110)), 2400);
}

}  // namespace
}  // namespace skerry::server
