// An instructor's changes: all or nothing, and told to everybody.
#include "server/world/world_change.hpp"

#include <gtest/gtest.h>

#include "server/world/scenario.hpp"

namespace skerry::server {
namespace {

constexpr Duration kNow{std::chrono::minutes(10)};

Environment with_rain() {
  return environment_of(
      parse_scenario("name: s\nown_ships: [{name: F, position: {lat: 60, lon: 5}, radars: [{}]}]\n"
                     "rain: [{position: {lat: 60, lon: 5}, drift_deg: 90, drift_kn: 6}]\n",
                     "f"));
}

wire::Reply reply_to(const wire::WorldChange& change, Environment environment) {
  return change_environment(change, kNow, environment).value_or(wire::Reply());
}

TEST(WorldChange, ChangesWhatIsPresentAndLeavesTheRest) {
  Environment environment = with_rain();
  wire::WorldChange change;
  change.set_sea_state(4.5);
  change.set_swell_from_deg(360.0);
  change.set_ducting(0.5);
  change.set_interference(false);
  EXPECT_FALSE(change_environment(change, kNow, environment));
  const wire::World world = world_message(environment, kNow);
  EXPECT_EQ(world.sea_state(), 4.5);
  EXPECT_EQ(world.swell_from_deg(), 0.0);
  EXPECT_EQ(world.ducting(), 0.5);
  EXPECT_EQ(world.k_factor(), 4.0 / 3.0);
  EXPECT_FALSE(world.interference());
  EXPECT_TRUE(world.side_lobes());
  EXPECT_EQ(world.rain_size(), 1);
}

TEST(WorldChange, ACellThatChangesItsDriftGoesOnFromWhereItIs) {
  Environment environment = with_rain();
  const GeoPoint before = place_of(environment.rain[0], kNow);
  wire::WorldChange change;
  change.add_rain()->set_id(1);
  change.mutable_rain(0)->set_drift_kn(0.0);
  change.mutable_rain(0)->set_rate_mm_h(20.0);
  EXPECT_FALSE(change_environment(change, kNow, environment));
  const wire::World later = world_message(environment, kNow + std::chrono::hours(1));
  EXPECT_NEAR(later.rain(0).longitude_deg(), before.longitude_deg, 1e-9);
  EXPECT_GT(later.rain(0).longitude_deg(), 5.03);
  EXPECT_EQ(later.rain(0).rate_mm_h(), 20.0);
  EXPECT_EQ(later.rain(0).drift_deg(), 90.0);
}

TEST(WorldChange, CellsAreAddedAndRemovedByNumbersThatNeverComeAgain) {
  Environment environment = with_rain();
  wire::WorldChange change;
  change.add_remove_rain(1);
  wire::RainChange& fresh = *change.add_rain();
  fresh.set_latitude_deg(61.0);
  fresh.set_longitude_deg(180.0);
  EXPECT_FALSE(change_environment(change, kNow, environment));
  ASSERT_EQ(environment.rain.size(), 1u);
  EXPECT_EQ(environment.rain[0].id, 2u);
  EXPECT_EQ(environment.rain[0].from.longitude_deg, -180.0);
  EXPECT_EQ(environment.rain[0].radius_m, 2.0 * 1852.0);
  EXPECT_EQ(environment.rain[0].kind, echo::RainKind::cell);
  wire::WorldChange other;
  other.add_rain()->set_id(2);
  other.mutable_rain(0)->set_kind(wire::RAIN_SHOWER);
  EXPECT_FALSE(change_environment(other, kNow, environment));
  EXPECT_EQ(environment.rain[0].kind, echo::RainKind::shower);
  EXPECT_EQ(world_message(environment, kNow).rain(0).kind(), wire::RAIN_SHOWER);
  wire::WorldChange clear;
  clear.set_remove_all_rain(true);
  EXPECT_FALSE(change_environment(clear, kNow, environment));
  EXPECT_TRUE(environment.rain.empty());
}

TEST(WorldChange, RefusesWhatIsNotThereAndTooMuch) {
  wire::WorldChange change;
  change.add_remove_rain(5);
  EXPECT_EQ(reply_to(change, with_rain()).text(), "remove rain: there is no rain cell 5");
  EXPECT_EQ(reply_to(change, with_rain()).code(), wire::Reply::UNKNOWN);
  change.Clear();
  change.add_rain()->set_id(9);
  EXPECT_EQ(reply_to(change, with_rain()).text(), "rain: there is no rain cell 9");
  change.Clear();
  change.add_rain();
  EXPECT_EQ(reply_to(change, with_rain()).text(), "rain: a new rain cell needs a position");
  change.mutable_rain(0)->set_latitude_deg(60.0);
  EXPECT_EQ(reply_to(change, with_rain()).text(),
            "rain: a position is latitude and longitude; one of them is missing");
  change.Clear();
  for (int i = 0; i < kMaxRainCells; ++i) {
    wire::RainChange& rain = *change.add_rain();
    rain.set_latitude_deg(60.0);
    rain.set_longitude_deg(5.0);
  }
  EXPECT_EQ(reply_to(change, with_rain()).text(),
            "rain: there are 64 rain cells; allowed: at most 64");
}

}  // namespace
}  // namespace skerry::server
