// Own ships that come upon the chart's land.
#include "server/app/shore_watch.hpp"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

#include "protocol/quantity/angle.hpp"
#include "server/world/short_way.hpp"

namespace skerry::server {
namespace {

constexpr double kMile = 1852.0;

// An island: a square of so many metres about a place, land on the left of its edges.
echo::CoastRing island(GeoPoint middle, double half_m) {
  echo::CoastRing ring;
  for (const auto& [north, east] : {std::pair{-1.0, -1.0}, {-1.0, 1.0}, {1.0, 1.0}, {1.0, -1.0}}) {
    ring.vertices.push_back(advanced(middle, {north * half_m, east * half_m}));
    ring.edges.push_back(echo::EdgeKind::shoreline);
    ring.vertex_ids.push_back(ring.vertices.size());
  }
  return ring;
}

class ShoreWatchTest : public testing::Test {
 protected:
  ShoreWatchTest()
      : watch_(
            [this](GeoPoint centre, Length radius, ShoreWatch::SurveyDone done) {
              ++surveys_;
              asked_.push_back(std::move(done));
              EXPECT_GT(radius.in_metres(), kMile);
              centre_ = centre;
              if (answers_) answer();
            },
            [this](std::size_t ship, GeoPoint) { aground_.push_back(ship); }) {
    ShipState ship;
    ship.length_m = 100.0;
    ship.beam_m = 16.0;
    ship.position = {60.0, 5.0};
    state_.own_ships.push_back(ship);
    chart_.rings.push_back(island(advanced({60.0, 5.0}, {500.0, 0.0}), 100.0));
  }

  void answer() {
    for (ShoreWatch::SurveyDone& done : std::exchange(asked_, {})) done(chart_);
  }
  ShipState& ship() { return state_.own_ships[0]; }
  // She goes north, looked at every `step_m`, ten times a second.
  void sail(double way_m, double step_m) {
    ship().speed_mps = 10.0 * step_m;
    for (double gone = 0.0; gone < way_m; gone += step_m) {
      ship().position = advanced(ship().position, {step_m, 0.0});
      watch_.look(state_);
      if (!aground_.empty()) return;
    }
  }
  double north_m() const {
    return short_way_between({60.0, 5.0}, state_.own_ships[0].position).north_m;
  }

  bool answers_ = true;
  int surveys_ = 0;
  GeoPoint centre_;
  std::vector<ShoreWatch::SurveyDone> asked_;
  std::vector<std::size_t> aground_;
  echo::CoastChart chart_;
  WorldState state_;
  ShoreWatch watch_;
};

TEST_F(ShoreWatchTest, FindsAShipWhereHerBowComesUponLand) {
  watch_.look(state_);
  sail(800.0, 1.0);
  ASSERT_EQ(aground_, std::vector<std::size_t>{0});
  EXPECT_NEAR(north_m(), 500.0 - 100.0 - 50.0, ShoreWatch::kSpacing_m + 1.0);
  EXPECT_EQ(surveys_, 1);
}

// At twenty times as fast, a look is some hundred metres from the next.
TEST_F(ShoreWatchTest, JumpsOverNothing) {
  chart_.rings[0] = island(advanced({60.0, 5.0}, {500.0, 0.0}), 6.0);
  watch_.look(state_);
  sail(1200.0, 250.0);
  EXPECT_EQ(aground_, std::vector<std::size_t>{0});
}

TEST_F(ShoreWatchTest, FindsASideThatSwingsUponLand) {
  ship().position = advanced({60.0, 5.0}, {500.0 - 100.0 - 20.0, 0.0});
  ship().heading_deg = 90.0;
  watch_.look(state_);
  for (; ship().heading_deg > 0.0 && aground_.empty(); ship().heading_deg -= 1.0) {
    watch_.look(state_);
  }
  EXPECT_EQ(aground_, std::vector<std::size_t>{0});
  EXPECT_GT(ship().heading_deg, 50.0) << "her bow is 20 m north of her at 66 degrees";
}

TEST_F(ShoreWatchTest, LeavesAShipAtHerBerth) {
  ship().position = advanced({60.0, 5.0}, {360.0, 0.0});  // her bow 10 m upon land
  watch_.look(state_);
  for (int i = 0; i < 10; ++i) {
    ship().position = advanced(ship().position, {2.0, 0.0});
    watch_.look(state_);
  }
  EXPECT_TRUE(aground_.empty());
  for (int i = 0; i < 60; ++i) {  // astern, clear of it
    ship().position = advanced(ship().position, {-2.0, 0.0});
    watch_.look(state_);
  }
  EXPECT_TRUE(aground_.empty());
  sail(300.0, 1.0);
  EXPECT_EQ(aground_.size(), 1u) << "and now she comes from the sea";
}

TEST_F(ShoreWatchTest, TellsAGroundedShipOnceAndAgainWhenSheWasPutElsewhere) {
  watch_.look(state_);
  sail(800.0, 1.0);
  ASSERT_EQ(aground_.size(), 1u);
  ship().aground = true;
  for (int i = 0; i < 10; ++i) watch_.look(state_);
  EXPECT_EQ(aground_.size(), 1u);
  aground_.clear();
  ship().aground = false;
  ship().position = {60.0, 5.0};
  watch_.look(state_);
  sail(800.0, 1.0);
  EXPECT_EQ(aground_.size(), 1u);
}

TEST_F(ShoreWatchTest, DoesNotSailTheWayOfAShipThatIsPut) {
  watch_.look(state_);
  ship().position = advanced({60.0, 5.0}, {1000.0, 0.0});  // beyond the island
  watch_.look(state_);
  sail(500.0, 5.0);
  EXPECT_TRUE(aground_.empty());
}

// An instructor moors her, or takes her over a mole.
TEST_F(ShoreWatchTest, DoesNotSailAShortWayOfAShipThatIsPut) {
  ship().position = advanced({60.0, 5.0}, {200.0, 0.0});
  watch_.look(state_);
  sail(20.0, 1.0);
  ship().speed_mps = 0.0;
  ship().position = advanced({60.0, 5.0}, {380.0, 0.0});  // her bow 30 m upon land
  watch_.look(state_);
  watch_.look(state_);
  EXPECT_TRUE(aground_.empty());
}

TEST_F(ShoreWatchTest, AsksForANewWindowBeforeTheOldOneEnds) {
  chart_.rings[0] = island({60.5, 5.0}, 100.0);  // 30 NM north
  watch_.look(state_);
  sail(31.0 * kMile, 25.0);
  EXPECT_EQ(aground_.size(), 1u);
  EXPECT_GE(surveys_, 9);
  EXPECT_LE(surveys_, 11);
}

TEST_F(ShoreWatchTest, WaitsForTheChart) {
  answers_ = false;
  watch_.look(state_);
  sail(250.0, 1.0);
  EXPECT_EQ(surveys_, 1) << "one question at a time";
  answer();
  sail(500.0, 1.0);
  EXPECT_EQ(aground_.size(), 1u);
}

TEST_F(ShoreWatchTest, AsksSeldomForAChartThatCannotBeRead) {
  answers_ = false;
  watch_.look(state_);
  asked_.front()(std::nullopt);
  asked_.clear();
  for (int i = 0; i < ShoreWatch::kPatience - 1; ++i) watch_.look(state_);
  EXPECT_EQ(surveys_, 1);
  for (int i = 0; i < 3; ++i) watch_.look(state_);
  EXPECT_EQ(surveys_, 2);
}

}  // namespace
}  // namespace skerry::server
