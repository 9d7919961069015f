// The watch over tracks of made plots: states, motions, zones, alarms, trial and test targets.
#include <gtest/gtest.h>

#include <limits>

#include "server/tracking/watch/test_targets.hpp"
#include "tests/unit/tracking/watch/watched_sea.hpp"

namespace skerry::server {
namespace {

TEST(TargetWatch, ATargetIsAcquiredThenATrendThenTracked) {
  WatchedSea sea;
  sea.set_own_way(0.0, 10.0);
  sea.sea.targets = {{straight_way({0.0, 8.0 * kNm}, 90.0, 15.0)}};
  sea.go_on_for(30.0);
  ASSERT_EQ(sea.list().targets_size(), 1);
  EXPECT_EQ(sea.target(1)->state(), wire::TARGET_ACQUIRING);
  EXPECT_FALSE(sea.target(1)->has_course_deg());
  EXPECT_FALSE(sea.target(1)->has_relative_speed_kn());
  EXPECT_FALSE(sea.target(1)->has_cpa_nm());
  EXPECT_FALSE(sea.target(1)->has_tcpa_min());
  sea.go_on_for(60.0);
  EXPECT_EQ(sea.target(1)->state(), wire::TARGET_TREND);
  EXPECT_TRUE(sea.target(1)->has_course_deg());
  sea.go_on_for(110.0);
  EXPECT_EQ(sea.target(1)->state(), wire::TARGET_TRACKED);
  EXPECT_NEAR(sea.target(1)->course_deg(), 90.0, 2.0);
  EXPECT_NEAR(sea.target(1)->speed_kn(), 15.0, 0.5);
  EXPECT_NEAR(sea.target(1)->relative_speed_kn(), std::hypot(10.0, 15.0), 0.5);
  EXPECT_NEAR(sea.target(1)->relative_course_deg(),
              180.0 - std::atan2(15.0, 10.0) * kDegreesPerRadian, 2.0);
  EXPECT_NEAR(sea.target(1)->range_m(),
              length_of(PlanePoint{15.0, -10.0} * (kKnot * 200.0) + PlanePoint{0.0, 8.0 * kNm}),
              40.0);
  EXPECT_EQ(sea.list().stabilised_by(), "GNSS");
  EXPECT_NEAR(sea.list().own_speed_kn(), 10.0, 0.01);
  EXPECT_EQ(sea.list().problem(), "");
  EXPECT_LT(sea.target(1)->age_s(), 5.0);
  EXPECT_NEAR(sea.target(1)->tracked_s(), 199.0, 2.0);
  EXPECT_EQ(sea.target(1)->past_size(), 1);
}

// Scenario 2 of A.823(19) and after: it is past, and TCPA says so.
TEST(TargetWatch, TcpaIsNegativeOnceItIsPastAndAbsentWithoutRelativeMotion) {
  WatchedSea sea;
  sea.sea.targets = {{straight_way({-0.5 * kNm, 2.0 * kNm}, 90.0, 20.0)}};
  sea.go_on_for(150.0);
  EXPECT_LT(sea.target(1)->tcpa_min(), 0.0);
  EXPECT_NEAR(sea.target(1)->cpa_nm(), 2.0, 0.1);
}

TEST(TargetWatch, StabilisationByWaterHasTheCurrentInIt) {
  WatchedSea sea;
  sea.set_own_way(0.0, 10.0);
  sea.current_mps = vector_of(90.0, 3.0 * kKnot);
  sea.sea.targets = {{straight_way({4.0 * kNm, 4.0 * kNm}, 90.0, 3.0)}};  // adrift
  wire::TargetOrder water;
  water.mutable_rules()->set_stabilisation(wire::STABILISATION_WATER);
  sea.order(water);
  sea.go_on_for(200.0);
  EXPECT_EQ(sea.list().stabilisation(), wire::STABILISATION_WATER);
  EXPECT_EQ(sea.list().stabilised_by(), "gyro and log");
  EXPECT_LT(sea.target(1)->speed_kn(), 0.5);
  EXPECT_NEAR(sea.list().own_speed_kn(), std::hypot(10.0, 3.0), 0.01);

  sea.has_log = false;
  sea.go_on_for(5.0);
  EXPECT_FALSE(sea.target(1)->has_course_deg());
  EXPECT_TRUE(sea.target(1)->has_relative_course_deg());
  EXPECT_TRUE(sea.target(1)->has_cpa_nm());
  EXPECT_FALSE(sea.list().has_own_speed_kn());
  EXPECT_EQ(sea.list().stabilised_by(), "");
  EXPECT_NE(sea.list().problem().find("speed through water is not known"), std::string::npos);
  EXPECT_EQ(sea.alert_numbers(), "3015");
  sea.has_log = true;
  sea.go_on_for(5.0);
  EXPECT_EQ(sea.alert(3015).state(), wire::ALERT_RECTIFIED);
  EXPECT_TRUE(sea.target(1)->has_course_deg());
}

TEST(TargetWatch, AReferenceTargetTakesTheErrorOfPositionsOut) {
  WatchedSea sea;
  sea.set_own_way(0.0, 10.0);
  sea.sea.targets = {{[](double) {
                       return PlanePoint{3.0 * kNm, 4.0 * kNm};
                     }},
                     {straight_way({-4.0 * kNm, 6.0 * kNm}, 90.0, 12.0)}};
  sea.go_on_for(200.0);
  sea.own_mps = vector_of(10.0, 14.0 * kKnot);  // a receiver that errs
  sea.go_on_for(2.5);
  const std::uint32_t still = sea.list().targets(0).bearing_deg() < 180.0 ? 1 : 2;
  EXPECT_GT(sea.target(still)->speed_kn(), 3.0);
  wire::TargetOrder reference;
  reference.set_reference(still);
  EXPECT_EQ(sea.order(reference).code(), wire::Reply::OK);
  sea.go_on_for(2.5);
  EXPECT_EQ(sea.list().stabilised_by(), "target " + std::to_string(still));
  EXPECT_TRUE(sea.target(still)->is_reference());
  EXPECT_NEAR(sea.target(still)->speed_kn(), 0.0, 1e-9);
  EXPECT_NEAR(sea.target(3 - still)->speed_kn(), 12.0, 0.6);
  EXPECT_NEAR(sea.list().own_speed_kn(), 10.0, 0.5);
  EXPECT_NEAR(std::remainder(sea.list().own_course_deg(), 360.0), 0.0, 3.0);
  // It is lost: by positions again, and the mariner is told.
  sea.sea.targets[0].seen = 0.0;
  sea.go_on_for(60.0);
  EXPECT_EQ(sea.list().stabilised_by(), "GNSS");
  EXPECT_NE(sea.list().problem().find("reference target"), std::string::npos);
  EXPECT_EQ(sea.alerts(3015).size(), 1u);
  reference.set_reference(0);
  sea.order(reference);
  sea.go_on_for(2.5);
  EXPECT_EQ(sea.list().problem(), "");
}

TEST(TargetWatch, ACollisionCourseIsAnAlarmUntilItIsPast) {
  WatchedSea sea;
  sea.sea.targets = {{straight_way({0.0, 3.0 * kNm}, 180.0, 20.0)}};
  sea.go_on_for(50.0);
  EXPECT_EQ(sea.alert_numbers(), "");  // its motion is not known yet
  sea.go_on_for(50.0);
  ASSERT_EQ(sea.alert_numbers(), "3044");
  const wire::Alert alarm = sea.alert(3044);
  EXPECT_EQ(alarm.target(), 1u);
  EXPECT_EQ(alarm.state(), wire::ALERT_ACTIVE);
  EXPECT_EQ(alarm.text().substr(0, 11), "Target 1: C");
  EXPECT_TRUE(sea.target(1)->is_dangerous());
  wire::TargetOrder silence;
  silence.set_silence(true);
  sea.order(silence);
  sea.update();
  EXPECT_EQ(sea.alert(3044).state(), wire::ALERT_SILENCED);
  EXPECT_EQ(sea.acknowledge(3044, alarm.instance()).code(), wire::Reply::OK);
  sea.go_on_for(60.0);
  EXPECT_EQ(sea.alert(3044).state(), wire::ALERT_ACKNOWLEDGED);
  EXPECT_TRUE(sea.target(1)->is_dangerous());
}

TEST(TargetWatch, ALimitOfNoneIsNoAlarm) {
  WatchedSea sea;
  wire::TargetOrder none;
  none.mutable_rules()->set_cpa_nm(0.0);
  sea.order(none);
  sea.sea.targets = {{straight_way({0.0, 3.0 * kNm}, 180.0, 20.0)}};
  sea.go_on_for(100.0);
  EXPECT_NEAR(sea.target(1)->cpa_nm(), 0.0, 0.5);
  EXPECT_EQ(sea.alert_numbers(), "");
  EXPECT_FALSE(sea.target(1)->is_dangerous());
}

wire::TargetOrder zone_order(double inner_nm, double outer_nm, double from_deg, double to_deg,
                             wire::TargetZone::Kind kind = wire::TargetZone::ACQUIRES,
                             std::uint32_t number = 1) {
  wire::TargetOrder order;
  wire::TargetZone& zone = *order.add_zones();
  zone.set_number(number);
  zone.set_kind(kind);
  zone.set_inner_nm(inner_nm);
  zone.set_outer_nm(outer_nm);
  zone.set_from_deg(from_deg);
  zone.set_to_deg(to_deg);
  return order;
}

TEST(TargetWatch, AZoneAcquiresAndWarnsOfWhatIsNewInItOnce) {
  WatchedSea sea;
  wire::TargetOrder order = zone_order(3.0, 5.0, 0.0, 90.0);
  order.mutable_rules()->set_acquire(wire::AUTO_ACQUIRE_NONE);
  sea.order(order);
  sea.sea.targets = {{straight_way({0.7 * 4.0 * kNm, 0.7 * 4.0 * kNm}, 0.0, 5.0)},
                     {straight_way({-4.0 * kNm, 0.0}, 0.0, 5.0)}};  // in none
  sea.go_on_for(30.0);
  ASSERT_EQ(sea.list().targets_size(), 1);
  ASSERT_EQ(sea.alert_numbers(), "3048");
  EXPECT_TRUE(sea.list().targets(0).is_new());
  EXPECT_EQ(sea.alert(3048).target(), sea.list().targets(0).number());
  sea.acknowledge(3048);
  sea.go_on_for(120.0);
  EXPECT_EQ(sea.alert_numbers(), "");
  EXPECT_FALSE(sea.list().targets(0).is_new());
}

TEST(TargetWatch, ATrackedTargetThatEntersAZoneIsWarnedOfToo) {
  WatchedSea sea;
  sea.sea.targets = {{straight_way({-2.0 * kNm, 4.0 * kNm}, 90.0, 30.0)},
                     {straight_way({3.0 * kNm, 4.0 * kNm}, 90.0, 1.0)}};
  sea.go_on_for(60.0);
  sea.order(zone_order(1.0, 8.0, 0.0, 90.0));
  sea.go_on_for(20.0);
  EXPECT_EQ(sea.alert_numbers(), "");  // the second was there when the zone was laid
  sea.go_on_for(180.0);
  ASSERT_EQ(sea.alert_numbers(), "3048");
  // It leaves the zone: the warning waits, and it is new when it comes again.
  EXPECT_EQ(sea.alert(3048).state(), wire::ALERT_ACTIVE);
  wire::TargetOrder smaller = zone_order(0.0, 1.0, 0.0, 90.0);
  sea.order(smaller);
  sea.go_on_for(5.0);
  EXPECT_EQ(sea.alert(3048).state(), wire::ALERT_RECTIFIED);
}

TEST(TargetWatch, WhatAMarinerAcquiresInAZoneIsNotNew) {
  WatchedSea sea;
  wire::TargetOrder order = zone_order(3.0, 5.0, 0.0, 0.0);
  sea.order(order);
  sea.sea.targets = {{straight_way({-4.0 * kNm, 0.0}, 0.0, 5.0)}};
  sea.go_on_for(7.5);
  EXPECT_EQ(sea.list().targets_size(), 0);
  wire::TargetOrder acquire;
  acquire.mutable_acquire()->set_range_nm(4.0);
  acquire.mutable_acquire()->set_bearing_deg(270.0);
  EXPECT_EQ(sea.order(acquire).code(), wire::Reply::OK);
  sea.go_on_for(10.0);
  EXPECT_EQ(sea.list().targets_size(), 1);
  EXPECT_EQ(sea.alert_numbers(), "");
}

// Its place wanders by 20 m and more, and it goes along the border.
TEST(TargetWatch, OnTheBorderOfAZoneItIsNewOnce) {
  WatchedSea sea;
  sea.sea.range_sigma_m = 25.0;
  sea.order(zone_order(2.0, 4.0, 0.0, 0.0));
  sea.sea.targets = {
      {[](double t) { return vector_of(45.0 + 0.02 * t, 4.0 * kNm + 30.0 * std::sin(t / 20.0)); }}};
  int warnings = 0;
  for (int k = 0; k < 240; ++k) {
    sea.go_on_for(2.5);
    for (const wire::Alert& alert : sea.alerts(3048)) {
      warnings += alert.state() == wire::ALERT_ACTIVE;
    }
    sea.acknowledge(3048);
  }
  EXPECT_EQ(warnings, 1);
}

TEST(TargetWatch, WhereAZoneExcludesNothingIsAcquiredByItselfAndTheRestWorks) {
  WatchedSea sea;
  wire::TargetOrder order = zone_order(0.0, 8.0, 0.0, 0.0);
  *order.add_zones() = zone_order(3.0, 5.0, 0.0, 90.0, wire::TargetZone::EXCLUDES, 2).zones(0);
  sea.order(order);
  sea.sea.targets = {{straight_way({0.7 * 4.0 * kNm, 0.7 * 4.0 * kNm}, 0.0, 5.0)},
                     {straight_way({-4.0 * kNm, 0.0}, 0.0, 5.0)}};
  sea.go_on_for(60.0);
  ASSERT_EQ(sea.list().targets_size(), 1);
  EXPECT_GT(sea.list().targets(0).bearing_deg(), 180.0);
  EXPECT_EQ(sea.alerts(3048).size(), 1u);
  wire::TargetOrder acquire;  // by hand it may be
  acquire.mutable_acquire()->set_range_nm(0.7 * 4.0 * std::sqrt(2.0));
  acquire.mutable_acquire()->set_bearing_deg(45.0);
  EXPECT_EQ(sea.order(acquire).code(), wire::Reply::OK);
  sea.go_on_for(5.0);
  EXPECT_EQ(sea.list().targets_size(), 2);
  EXPECT_EQ(sea.alerts(3048).size(), 1u);
}

TEST(TargetWatch, PastPositionsAreTrueAndRelative) {
  WatchedSea sea;
  sea.set_own_way(0.0, 12.0);
  sea.sea.targets = {{straight_way({2.0 * kNm, 4.0 * kNm}, 0.0, 12.0)}};  // keeps its place
  wire::TargetOrder often;
  often.mutable_rules()->set_past_interval_s(60.0);
  sea.order(often);
  sea.go_on_for(720.0);
  const wire::Target& target = sea.list().targets(0);
  ASSERT_EQ(target.past_size(), 10);
  for (int k = 0; k < 10; ++k) {
    EXPECT_NEAR(target.past(k).range_m(), std::hypot(2.0, 4.0) * kNm, 60.0);
    if (k == 0) continue;
    const double gone_m =
        (target.past(k - 1).latitude_deg() - target.past(k).latitude_deg()) * 111'229.0;
    EXPECT_NEAR(gone_m, 60.0 * 12.0 * kKnot, 40.0);
  }
  often.mutable_rules()->set_past_interval_s(120.0);
  sea.order(often);
  sea.go_on_for(2.5);
  EXPECT_EQ(sea.list().targets(0).past_size(), 6);  // at once
}

TEST(TargetWatch, ATrialTellsOfAllWhoseMotionIsKnownAndDisturbsNone) {
  WatchedSea sea;
  sea.set_own_way(0.0, 10.0);
  sea.sea.range_sigma_m = 2.0;
  sea.sea.bearing_sigma_deg = 0.02;
  // Scenario 1 of A.823(19), as it is after three minutes of tracking.
  const double before_m = 20.0 * kKnot * 200.0;
  sea.sea.targets = {{straight_way({0.0, 8.0 * kNm + before_m}, 180.0, 10.0)}};
  tell_by_ais(sea, 211'000'001, straight_way({5.0 * kNm, 0.0}, 0.0, 10.0), 0.0, 10.0);
  sea.go_on_for(200.0);
  wire::TargetOrder order;
  order.mutable_trial()->set_course_deg(90.0);
  order.mutable_trial()->set_speed_kn(10.0);
  EXPECT_EQ(sea.order(order).code(), wire::Reply::OK);
  sea.update();
  ASSERT_EQ(sea.list().trial().outcomes_size(), 2);
  const auto& outcome = sea.list().trial().outcomes(0);
  EXPECT_EQ(outcome.target(), 1u);
  EXPECT_NEAR(outcome.cpa_nm(), 5.657, 0.15);
  EXPECT_NEAR(outcome.tcpa_min(), 24.0, 0.5);
  EXPECT_FALSE(outcome.is_dangerous());
  EXPECT_EQ(sea.list().trial().outcomes(1).mmsi(), 211'000'001u);
  EXPECT_EQ(sea.target(1)->state(), wire::TARGET_TRACKED);
  EXPECT_NEAR(sea.target(1)->cpa_nm(), 0.0, 0.3);  // what there is, beside what might be

  order.mutable_trial()->set_delay_min(5.0);
  sea.order(order);
  sea.update();
  EXPECT_NEAR(sea.list().trial().begins_s(), 300.0, 1e-9);
  sea.go_on_for(30.0);
  EXPECT_NEAR(sea.list().trial().begins_s(), 270.0, 1e-9);
  wire::TargetOrder end;
  end.set_end_trial(true);
  sea.order(end);
  sea.update();
  EXPECT_FALSE(sea.list().has_trial());
  EXPECT_EQ(sea.target(1)->state(), wire::TARGET_TRACKED);
}

TEST(TargetWatch, TestTargetsMoveAsTheirTableHasThemAndAlarmNobody) {
  WatchedSea sea;
  sea.set_own_way(30.0, 15.0);
  wire::TargetOrder order;
  order.set_test_targets(true);
  sea.order(order);
  sea.go_on_for(2.5);
  sea.go_on_for(720.0);
  ASSERT_EQ(sea.list().targets_size(), 8);
  EXPECT_TRUE(sea.list().test_targets());
  EXPECT_EQ(sea.alert_numbers(), "");
  const wire::Target& first = *sea.target(kFirstTestTarget);
  EXPECT_TRUE(first.is_test());
  EXPECT_EQ(first.state(), wire::TARGET_TRACKED);
  EXPECT_NEAR(first.cpa_nm(), 0.0, 1e-6);
  EXPECT_NEAR(first.tcpa_min(), 12.0, 1e-6);  // of 24
  EXPECT_TRUE(first.is_dangerous());
  EXPECT_NEAR(first.relative_speed_kn(), 20.0, 1e-6);
  const wire::Target& still = *sea.target(kFirstTestTarget + 6);
  EXPECT_FALSE(still.has_tcpa_min());
  EXPECT_NEAR(still.course_deg(), 30.0, 1e-6);
  EXPECT_NEAR(still.speed_kn(), 15.0, 1e-6);
  wire::TargetOrder cancel;
  cancel.add_cancel(kFirstTestTarget);
  EXPECT_EQ(sea.order(cancel).code(), wire::Reply::UNKNOWN);
  order.set_test_targets(false);
  sea.order(order);
  sea.go_on_for(2.5);
  EXPECT_EQ(sea.list().targets_size(), 0);
}

TEST(TargetWatch, ALeapOfTimeEndsWhatHangsOnIt) {
  for (const double leap_s : {-3600.0, 181.0}) {
    WatchedSea sea;
    sea.sea.targets = {{straight_way({0.0, 3.0 * kNm}, 180.0, 20.0)}};
    sea.go_on_for(150.0);
    EXPECT_EQ(sea.alert_numbers(), "3044");
    EXPECT_GT(sea.target(1)->past_size(), 0);
    OwnSensors own = sea.sensors();
    own.utc += seconds_as_duration(leap_s);
    sea.watch.update(own, {}, sea.plotter);
    ASSERT_EQ(sea.list().targets_size(), 1) << leap_s;  // it is still tracked
    EXPECT_EQ(sea.alerts(3044).size(), 1u);             // and still dangerous: a new alarm
    EXPECT_EQ(sea.alert(3044).revision(), 1u);
    EXPECT_LE(sea.target(1)->past_size(), 1);
    EXPECT_GE(sea.target(1)->age_s(), 0.0);
  }
}

TEST(TargetWatch, NumbersThatAreNoneAreSensorsThatAreLost) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  WatchedSea sea;
  sea.sea.targets = {{straight_way({0.0, 3.0 * kNm}, 180.0, 20.0)}};
  sea.go_on_for(100.0);
  for (const double odd : {kNan, 1e300, -1e300}) {
    OwnSensors own = sea.sensors();
    own.place = GeoPoint{odd, odd};
    own.heading_deg = odd;
    own.over_ground_mps = own.through_water_mps = PlanePoint{odd, 0.0};
    sea.watch.update(own, {}, sea.plotter);
    EXPECT_EQ(sea.target(1)->state(), wire::TARGET_FROZEN);
    EXPECT_FALSE(sea.list().has_own_speed_kn());
    EXPECT_FALSE(sea.list().has_own_heading_deg());
    EXPECT_TRUE(std::isfinite(sea.list().own_latitude_deg()));
  }
}

}  // namespace
}  // namespace skerry::server
