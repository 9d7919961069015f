// As many targets and AIS targets as there may be, with everything on.
#include <gtest/gtest.h>

#include <chrono>
#include <cstdio>
#include <set>

#include "tests/unit/tracking/watch/watched_sea.hpp"

namespace skerry::server {
namespace {

// Rings of targets on their ways inward; each has AIS, and there are a hundred AIS targets more.
struct FullSea : WatchedSea {
  static constexpr std::uint32_t kShips = 200, kMore = 100;

  FullSea() {
    set_own_way(5.0, 12.0);
    sea.reach_m = 30'000.0;
    wire::TargetOrder full;
    full.mutable_rules()->set_capacity(kShips);
    for (std::uint32_t k = 1; k <= 8; ++k) {
      wire::TargetZone& zone = *full.add_zones();
      zone.set_number(k);
      zone.set_inner_nm(0.5 * k);
      zone.set_outer_nm(6.0 + k);
      zone.set_from_deg(40.0 * k);
      zone.set_to_deg(40.0 * k + 60.0 < 360.0 ? 40.0 * k + 60.0 : 30.0);
      zone.set_relative(k % 2 == 0);
    }
    full.set_test_targets(true);
    order(full);
    for (std::uint32_t k = 0; k < kShips; ++k) {
      const double bearing = 1.0 + 18.0 * (k % 20) + (k / 20 % 2 == 0 ? 9.0 : 0.0);
      const Way way = straight_way(vector_of(bearing, (3.0 + k / 20) * kNm), bearing + 180.0, 8.0);
      sea.targets.push_back({way});
      tell_by_ais(*this, 1000 + k, way, wrapped_degrees(bearing + 180.0), 8.0);
    }
    for (std::uint32_t k = 0; k < kMore; ++k) {
      const Way way = straight_way(vector_of(3.6 * k, 16.0 * kNm), 90.0, 12.0);
      tell_by_ais(*this, 9000 + k, way, 90.0, 12.0);
    }
  }
};

TEST(FullLoad, IsToldWithinItsBounds) {
  FullSea sea;
  sea.go_on_for(100.0);
  wire::TargetOrder trial;
  trial.mutable_trial()->set_course_deg(180.0);
  trial.mutable_trial()->set_speed_kn(20.0);
  trial.mutable_trial()->set_turn_rate_deg_min(2.0);
  trial.mutable_trial()->set_acceleration_kn_min(0.5);
  ASSERT_EQ(sea.order(trial).code(), wire::Reply::OK);
  sea.go_on_for(20.0);
  const wire::TargetList& list = sea.list();
  EXPECT_GE(list.tracked(), 190u);
  EXPECT_LE(list.targets_size(), 200 + 50 + 8);
  EXPECT_EQ(list.ais_size(), 240);
  EXPECT_EQ(list.ais_left_out(), 60u);
  EXPECT_LE(list.alerts_size(), 200);
  EXPECT_LE(list.trial().outcomes_size(), 200 + 240);
  // Each once.
  std::set<std::uint32_t> partners;
  int paired = 0;
  for (const wire::Target& target : list.targets()) {
    if (target.mmsi() == 0) continue;
    ++paired;
    EXPECT_TRUE(partners.insert(target.mmsi()).second);
    ASSERT_NE(sea.ais_target(target.mmsi()), nullptr);
    EXPECT_EQ(sea.ais_target(target.mmsi())->target(), target.number());
  }
  EXPECT_GE(paired, 180);

  constexpr int kUpdates = 50;
  const auto begin = std::chrono::steady_clock::now();
  OwnSensors own = sea.sensors();
  for (int k = 0; k < kUpdates; ++k) {
    own.utc += std::chrono::milliseconds(10);
    sea.watch.update(own, sea.ais, sea.plotter);
  }
  const std::chrono::duration<double, std::milli> spent = std::chrono::steady_clock::now() - begin;
  std::printf("an update: %.2f ms; the list: %zu bytes, %d alerts, %d paired\n",
              spent.count() / kUpdates, list.ByteSizeLong(), list.alerts_size(), paired);
}

// The same calls make the same lists.
TEST(FullLoad, IsTheSameTwice) {
  const auto list_after = [] {
    FullSea sea;
    sea.go_on_for(50.0);
    return sea.list().SerializeAsString();
  };
  EXPECT_EQ(list_after(), list_after());
}

}  // namespace
}  // namespace skerry::server
