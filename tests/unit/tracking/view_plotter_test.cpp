// A view's plotter: from its ring to a list of targets.
#include "server/tracking/view_plotter.hpp"

#include <gtest/gtest.h>

#include "server/tracking/own_sensors.hpp"
#include "tests/unit/tracking/plotted_host.hpp"

namespace skerry::server {
namespace {

class Plotting : public testing::Test {
 protected:
  Plotting() : plotter_(0, 0, host_.find_channel(0, 0), kNativeFormat, 1.2, [] {}) {}
  OwnSensors own() { return sensors_of(host_.own_ship(0)); }
  // So many turns, each with its list.
  void turn(int times) {
    for (int i = 0; i < times; ++i) {
      host_.turn();
      while (plotter_.take(own())) continue;
      plotter_.tell(own(), {});
    }
  }
  const wire::Target& only() { return plotter_.list()->targets(0); }
  PlottedHost host_;
  ViewPlotter plotter_;
};

TEST_F(Plotting, AShipThatComesNearerIsListedWhereSheIs) {
  turn(40);
  const TargetListPtr young = plotter_.list();
  ASSERT_EQ(young->targets_size(), 1);
  EXPECT_EQ(only().state(), wire::TARGET_ACQUIRING);
  EXPECT_FALSE(only().has_course_deg());
  turn(160);
  ASSERT_EQ(plotter_.list()->targets_size(), 1);
  const wire::Target& target = only();
  EXPECT_EQ(target.state(), wire::TARGET_TRACKED);
  EXPECT_NEAR(target.bearing_deg(), 90.0, 0.3);
  EXPECT_NEAR(target.range_m(), host_.range_m(), 40.0);
  EXPECT_NEAR(target.relative_course_deg(), 270.0, 3.0);
  EXPECT_NEAR(target.relative_speed_kn(), 10.0 * 3600 / 1852, 0.8);
  EXPECT_LT(target.cpa_nm(), 0.1);
  EXPECT_EQ(plotter_.list()->spokes_lost(), 0u);
}

TEST_F(Plotting, PlotsAreThoseSinceTheListBefore) {
  turn(5);
  const TargetPlotsPtr first = plotter_.plots();
  ASSERT_GE(first->plots_size(), 1);
  EXPECT_NEAR(first->plots(0).range_m(), host_.range_m(), 60.0);
  EXPECT_NEAR(first->plots(0).bearing_deg(), 90.0, 0.5);
  EXPECT_NEAR(first->plots(0).longitude_deg(), 3.0 + 2950 / (111'320 * 0.6428), 0.002);
  turn(1);
  const TargetPlotsPtr second = plotter_.plots();
  EXPECT_EQ(second->first(), first->first() + static_cast<unsigned>(first->plots_size()));
}

TEST_F(Plotting, WithoutAHeadingSpokesAreGivenToNobody) {
  turn(80);
  ASSERT_EQ(plotter_.list()->targets_size(), 1);
  const std::uint64_t plots = plotter_.list()->plots();
  host_.gyro_lost = true;
  turn(10);
  EXPECT_EQ(plotter_.list()->plots(), plots);
  ASSERT_EQ(plotter_.list()->targets_size(), 1);
  EXPECT_EQ(only().state(), wire::TARGET_FROZEN);
  EXPECT_FALSE(plotter_.list()->problem().empty());
  host_.gyro_lost = false;
  turn(20);
  ASSERT_EQ(plotter_.list()->targets_size(), 1) << "taken up again";
  EXPECT_NE(only().state(), wire::TARGET_FROZEN);
}

// As a playback that stands still does for who joins.
TEST_F(Plotting, ATurnThatIsSentAgainChangesNothing) {
  turn(80);
  ASSERT_EQ(plotter_.list()->targets_size(), 1);
  const std::uint64_t plots = plotter_.list()->plots();
  const int alerts = plotter_.list()->alerts_size();
  host_.go_back(1);
  turn(1);
  EXPECT_EQ(plotter_.list()->plots(), plots);
  ASSERT_EQ(plotter_.list()->targets_size(), 1);
  EXPECT_EQ(only().number(), 1u);
  EXPECT_EQ(plotter_.list()->alerts_size(), alerts) << "nothing leapt";
}

TEST_F(Plotting, OrdersAreAnsweredAtOnce) {
  turn(10);
  wire::TargetOrder order;
  order.mutable_acquire()->set_range_nm(1.0);
  order.mutable_acquire()->set_bearing_deg(200.0);
  EXPECT_EQ(plotter_.order(order).code(), wire::Reply::UNKNOWN);
  order.mutable_acquire()->set_range_nm(host_.range_m() / 1852.0);
  order.mutable_acquire()->set_bearing_deg(90.0);
  const wire::Reply acquired = plotter_.order(order);
  EXPECT_EQ(acquired.code(), wire::Reply::OK) << acquired.text();
  EXPECT_EQ(acquired.text(), "1");
  turn(1);
  EXPECT_TRUE(only().by_hand());
}

}  // namespace
}  // namespace skerry::server
