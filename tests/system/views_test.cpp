// Views of one radar, standby, and an instructor's hand on the running server.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numeric>
#include <string>
#include <vector>

#include "tests/system/receive.hpp"
#include "tests/system/small_scenario.hpp"

namespace skerry::system_test {
namespace {

using testing::HasSubstr;

class Views : public testing::Test {
 protected:
  void set(const std::vector<std::string>& arguments) const {
    const Ending ending = server_.skerry("set", arguments);
    EXPECT_EQ(ending.code, 0) << ending.err;
  }
  std::string refusal(const std::vector<std::string>& arguments) const {
    const Ending ending = server_.skerry("set", arguments);
    EXPECT_NE(ending.code, 0);
    return ending.err;
  }
  static std::uint32_t open_view(client::SpokeClient& client) {
    const auto view = client.subscribe_new_view(0, 0, kAnswerTime);
    if (!view) throw std::runtime_error(view.error().text);
    return *view;
  }
  static double mean_level(const Scan& scan) {
    double sum = 0.0;
    for (const auto& spoke : scan.spokes) {
      sum += std::accumulate(spoke->cells.begin(), spoke->cells.end(), 0.0);
    }
    return sum / (static_cast<double>(kSmallSpokes) * kSmallCells);
  }

  TempFolder folder_;
  RunningServer server_{{"--scenario", folder_.write("small.yaml", small_scenario())}};
};

TEST_F(Views, TwoViewsOfOneRadarHaveTheSameEchoesAtTheirOwnGainAndRange) {
  client::SpokeClient shared = subscribed(server_, 0);
  client::SpokeClient own = connected(server_);
  const std::uint32_t view = open_view(own);
  ASSERT_GT(view, 0u);
  const std::string number = std::to_string(view);
  // With the same controls, spoke by spoke the same video: the returns and the noise are shared.
  const Spoke of_own = next_spoke(own);
  EXPECT_EQ(of_own.header.view, view);
  const Spoke of_shared = await<Spoke>(shared, [&](const Spoke& spoke) {
    return spoke.header.scan == of_own.header.scan && spoke.header.index == of_own.header.index;
  });
  EXPECT_EQ(of_shared.cells, of_own.cells);

  set({"--view", number, "--gain", "85", "--range", "3"});
  const auto told =
      await<wire::Settings>(own, [](const wire::Settings& s) { return s.gain() == 85.0; });
  EXPECT_EQ(told.view(), view);
  EXPECT_EQ(told.range_nm(), 3.0);
  EXPECT_EQ(told.radar_range_nm(), 6.0);
  await<Spoke>(own, [](const Spoke& s) { return s.header.range_scale == *RangeScale::find(3.0); });
  EXPECT_GT(mean_level(next_scan(own)), mean_level(next_scan(shared)) + 10.0);
  EXPECT_EQ(next_spoke(shared).header.range_scale, *RangeScale::find(6.0));

  EXPECT_THAT(refusal({"--view", number, "--range", "12"}), HasSubstr("up to 6 NM"));
  EXPECT_THAT(server_.skerry("status").out, HasSubstr("0     " + number + "    Eight bits"));
}

TEST_F(Views, AViewIsAtMostAsLongAsTheRadarAndGrowsAgainWithIt) {
  client::SpokeClient own = connected(server_);
  open_view(own);
  set({"--range", "3"});
  await<Spoke>(own, [](const Spoke& s) { return s.header.range_scale == *RangeScale::find(3.0); });
  set({"--range", "12"});
  await<Spoke>(own, [](const Spoke& s) { return s.header.range_scale == *RangeScale::find(6.0); });
}

TEST_F(Views, AViewEndsWithItsLastConsole) {
  {
    client::SpokeClient own = connected(server_);
    open_view(own);
    next_spoke(own);
  }
  client::SpokeClient observer = connected(server_);
  await_status(observer, [](const wire::Status& s) { return s.radars(0).views_size() == 0; });
}

TEST_F(Views, InStandbyNoSpokesComeAndTheShipSailsOn) {
  client::SpokeClient console = subscribed(server_, 0);
  const std::uint64_t before = next_spoke(console).header.sequence;
  set({"--transmit", "off"});
  await<wire::Settings>(console, [](const wire::Settings& s) { return s.standby(); });
  client::SpokeClient observer = connected(server_);
  const auto spokes_of = [&] {
    return await_status(observer, [](const wire::Status&) { return true; }).radars(0).spokes();
  };
  // Spokes under way at the switching off are published by the time of the second message.
  await<wire::OwnShip>(console, [](const wire::OwnShip&) { return true; });
  const std::uint64_t spokes = spokes_of();
  const auto ship = await<wire::OwnShip>(console, [](const wire::OwnShip&) { return true; });
  const auto later = await<wire::OwnShip>(
      console, [&](const wire::OwnShip& s) { return s.latitude_deg() != ship.latitude_deg(); });
  EXPECT_GT(later.latitude_deg(), ship.latitude_deg());
  EXPECT_EQ(spokes_of(), spokes);
  set({"--transmit", "on"});
  await<wire::Settings>(console, [](const wire::Settings& s) { return !s.standby(); });
  const Scan scan = next_scan(console);
  EXPECT_GT(mean_level(scan), 1.0);
  EXPECT_GT(scan.spokes.front()->header.sequence, before);
  EXPECT_EQ(console.losses().lost(), 0u) << "standby is no loss";
}

TEST_F(Views, AnInstructorsSeaAndRainReachEveryConsole) {
  client::SpokeClient console = subscribed(server_, 2);
  client::SpokeClient other = subscribed(server_, 0);
  set({"--sea-state", "4.5", "--wind-from", "225", "--add-rain", "60.40", "4.81", "--rain-rate",
       "16", "--rain-kind", "squall_line", "--artefact", "interference=off"});
  const auto at_sea = [](const wire::World& w) { return w.sea_state() == 4.5; };
  for (client::SpokeClient* client : {&console, &other}) {
    const auto world = await<wire::World>(*client, at_sea);
    EXPECT_EQ(world.wind_from_deg(), 225.0);
    ASSERT_EQ(world.rain_size(), 1);
    EXPECT_EQ(world.rain(0).rate_mm_h(), 16.0);
    EXPECT_EQ(world.rain(0).kind(), wire::RAIN_SQUALL_LINE);
    EXPECT_FALSE(world.interference());
    EXPECT_TRUE(world.side_lobes());
  }
  EXPECT_THAT(refusal({"--sea-state", "7"}),
              HasSubstr("sea state: 7 is out of range; allowed: 0 to 6"));
  EXPECT_THAT(refusal({"--gain", "60", "--remove-rain", "9"}), HasSubstr("no rain cell 9"));
  EXPECT_EQ(
      await_status(console, [](const wire::Status&) { return true; }).radars(0).settings().gain(),
      50.0)
      << "all or nothing";
  set({"--remove-all-rain"});
  await<wire::World>(console, [](const wire::World& w) { return w.rain_size() == 0; });
}

TEST_F(Views, WhatIsMistypedIsNamedWithWhatThereIs) {
  EXPECT_THAT(refusal({"--artefact", "lobes=off"}), HasSubstr("'lobes' is none of side_lobes"));
  EXPECT_THAT(refusal({"--artefact", "side_lobes=no"}), HasSubstr("neither on nor off"));
  EXPECT_THAT(refusal({"--pulse", "longer"}), HasSubstr("longer"));
  EXPECT_THAT(refusal({"--brilliance", "3"}), HasSubstr("--brilliance"));
  EXPECT_THAT(refusal({"--rain-rate", "3"}), HasSubstr("which rain cell?"));
}

}  // namespace
}  // namespace skerry::system_test
