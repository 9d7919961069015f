// Orders to a watch: all of one or nothing, and what a refusal says.
#include <gtest/gtest.h>

#include <limits>

#include "tests/unit/tracking/watch/watched_sea.hpp"

namespace skerry::server {
namespace {

// A target 4 NM to the east, on course 000 at 10 kn, tracked as number 1.
struct OneTarget : WatchedSea {
  OneTarget() {
    sea.targets = {{straight_way({4.0 * kNm, 0.0}, 0.0, 10.0)}};
    go_on_for(30.0);
  }
};

wire::TargetZone zone(std::uint32_t number, double inner_nm, double outer_nm) {
  wire::TargetZone zone;
  zone.set_number(number);
  zone.set_inner_nm(inner_nm);
  zone.set_outer_nm(outer_nm);
  return zone;
}

TEST(TargetOrders, RulesBeginAsTheProtocolHasThem) {
  const TargetWatch watch(1, 2);
  const wire::TargetRules& rules = watch.list().rules();
  EXPECT_EQ(watch.list().radar(), 1u);
  EXPECT_EQ(watch.list().view(), 2u);
  EXPECT_EQ(rules.acquire(), wire::AUTO_ACQUIRE_MOVING);
  EXPECT_EQ(rules.capacity(), 100u);
  EXPECT_EQ(rules.cpa_nm(), 1.0);
  EXPECT_EQ(rules.tcpa_min(), 12.0);
  EXPECT_EQ(rules.stabilisation(), wire::STABILISATION_GROUND);
  EXPECT_TRUE(rules.associate());
  EXPECT_TRUE(rules.lost_warnings());
  EXPECT_TRUE(rules.has_stabilisation());
  const Tracker::Rule tracks = watch.plotter_rule().tracks;
  EXPECT_EQ(tracks.most_tracks, 100u);
  EXPECT_EQ(tracks.acquire, Tracker::Acquire::moving);
  EXPECT_EQ(tracks.furthest_nm, 24.0);
}

TEST(TargetOrders, WhatIsPresentChangesAndTheRestStays) {
  WatchedSea sea;
  wire::TargetOrder order;
  order.mutable_rules()->set_cpa_nm(2.0);
  order.mutable_rules()->set_capacity(20);
  EXPECT_EQ(sea.order(order).code(), wire::Reply::OK);
  sea.update();
  EXPECT_EQ(sea.list().rules().cpa_nm(), 2.0);
  EXPECT_EQ(sea.list().rules().tcpa_min(), 12.0);
  EXPECT_EQ(sea.watch.plotter_rule().tracks.most_tracks, 20u);
  wire::TargetOrder back;
  back.set_default_rules(true);
  back.mutable_rules()->set_tcpa_min(6.0);
  EXPECT_EQ(sea.order(back).code(), wire::Reply::OK);
  sea.update();
  EXPECT_EQ(sea.list().rules().cpa_nm(), 1.0);
  EXPECT_EQ(sea.list().rules().tcpa_min(), 6.0);
}

TEST(TargetOrders, AValueOutOfItsRangeChangesNothingAndIsNamed) {
  WatchedSea sea;
  wire::TargetOrder order;
  order.mutable_rules()->set_tcpa_min(6.0);
  order.mutable_rules()->set_cpa_nm(11.0);
  const wire::Reply reply = sea.order(order);
  EXPECT_EQ(reply.code(), wire::Reply::OUT_OF_RANGE);
  EXPECT_EQ(reply.text(), "CPA limit 11 is out of range; allowed: 0 to 10 NM");
  sea.update();
  EXPECT_EQ(sea.list().rules().tcpa_min(), 12.0);

  wire::TargetOrder odd;
  odd.mutable_rules()->set_acquire(static_cast<wire::AutoAcquire>(7));
  EXPECT_EQ(sea.order(odd).text(), "acquire 7 is none of these: none, moving, all");
  wire::TargetOrder nan;
  nan.mutable_rules()->set_furthest_nm(std::numeric_limits<double>::quiet_NaN());
  EXPECT_EQ(sea.order(nan).code(), wire::Reply::OUT_OF_RANGE);
  wire::TargetOrder trial;
  trial.mutable_trial()->set_speed_kn(61.0);
  EXPECT_EQ(sea.order(trial).text(), "trial speed 61 is out of range; allowed: 0 to 60 kn");
}

TEST(TargetOrders, AZoneOfNoSizeIsRefusedWithItsReason) {
  WatchedSea sea;
  wire::TargetOrder order;
  *order.add_zones() = zone(1, 1.0, 3.0);
  *order.add_zones() = zone(2, 3.0, 3.0);
  const wire::Reply reply = sea.order(order);
  EXPECT_EQ(reply.code(), wire::Reply::OUT_OF_RANGE);
  EXPECT_EQ(reply.text(),
            "zone 2: it begins at 3 NM and ends at 3 NM, so nothing is in it; the inner distance "
            "must be below the outer one");
  sea.update();
  EXPECT_EQ(sea.list().zones_size(), 0);
  wire::TargetOrder ninth;
  *ninth.add_zones() = zone(9, 1.0, 3.0);
  EXPECT_EQ(sea.order(ninth).text(), "number 9 is out of range; allowed: 1 to 8");
}

TEST(TargetOrders, ZonesAreReplacedAndRemovedByNumber) {
  WatchedSea sea;
  wire::TargetOrder order;
  *order.add_zones() = zone(1, 1.0, 3.0);
  *order.add_zones() = zone(4, 1.0, 3.0);
  EXPECT_EQ(sea.order(order).code(), wire::Reply::OK);
  wire::TargetOrder change;
  *change.add_zones() = zone(4, 2.0, 5.0);
  change.add_remove_zones(1);
  EXPECT_EQ(sea.order(change).code(), wire::Reply::OK);
  sea.update();
  ASSERT_EQ(sea.list().zones_size(), 1);
  EXPECT_EQ(sea.list().zones(0).outer_nm(), 5.0);
  EXPECT_EQ(sea.order(change).text(), "there is no zone 1");
}

TEST(TargetOrders, AnEchoIsAcquiredByRangeAndBearingOrByPlace) {
  WatchedSea sea;
  wire::TargetOrder none;
  none.mutable_rules()->set_acquire(wire::AUTO_ACQUIRE_NONE);
  sea.order(none);
  sea.sea.targets = {{straight_way({4.0 * kNm, 0.0}, 0.0, 10.0)},
                     {straight_way({0.0, -2.0 * kNm}, 0.0, 10.0)}};
  sea.go_on_for(30.0);
  EXPECT_EQ(sea.list().targets_size(), 0);

  wire::TargetOrder acquire;
  acquire.mutable_acquire()->set_range_nm(4.0);
  acquire.mutable_acquire()->set_bearing_deg(89.0);  // 130 m off, and it has gone 150 m
  const wire::Reply first = sea.order(acquire);
  EXPECT_EQ(first.code(), wire::Reply::OK) << first.text();
  EXPECT_EQ(first.text(), "1");
  wire::TargetOrder place;
  const GeoPoint there = sea.sea.geo({50.0, -2.0 * kNm + 150.0});
  place.mutable_acquire()->set_latitude_deg(there.latitude_deg);
  place.mutable_acquire()->set_longitude_deg(there.longitude_deg);
  EXPECT_EQ(sea.order(place).text(), "2");
  sea.go_on_for(5.0);
  ASSERT_EQ(sea.list().targets_size(), 2);
  EXPECT_TRUE(sea.list().targets(0).by_hand());

  wire::TargetOrder nothing;
  nothing.mutable_acquire()->set_range_nm(6.0);
  nothing.mutable_acquire()->set_bearing_deg(90.0);
  nothing.mutable_rules()->set_cpa_nm(3.0);
  const wire::Reply no = sea.order(nothing);
  EXPECT_EQ(no.code(), wire::Reply::UNKNOWN);
  EXPECT_EQ(no.text(), "no echo there");
  sea.update();
  EXPECT_EQ(sea.list().rules().cpa_nm(), 1.0);  // nothing of it was done
}

TEST(TargetOrders, AnAcquisitionSaysOneWayWhereTheEchoIs) {
  OneTarget sea;
  const auto wrong = [&](auto&& fill) {
    wire::TargetOrder order;
    fill(*order.mutable_acquire());
    EXPECT_EQ(sea.order(order).code(), wire::Reply::OUT_OF_RANGE);
  };
  wrong([](auto&) {});
  wrong([](auto& a) { a.set_range_nm(4.0); });
  wrong([](auto& a) { a.set_range_nm(4.0), a.set_latitude_deg(50.0); });
  wrong([](auto& a) {
    a.set_range_nm(4.0), a.set_bearing_deg(90.0), a.set_latitude_deg(50.0),
        a.set_longitude_deg(3.0);
  });
  wrong([](auto& a) { a.set_range_nm(std::nan("")), a.set_bearing_deg(90.0); });
}

TEST(TargetOrders, NothingIsAcquiredBeforeOwnShipsPlaceIsKnown) {
  WatchedSea sea;
  wire::TargetOrder order;
  order.mutable_acquire()->set_range_nm(4.0);
  order.mutable_acquire()->set_bearing_deg(90.0);
  EXPECT_EQ(sea.order(order).code(), wire::Reply::REFUSED);
  EXPECT_EQ(sea.order(order).text(), "nothing can be acquired: no position yet");
  sea.has_heading = false;
  sea.update();
  EXPECT_NE(sea.order(order).text().find("heading is lost"), std::string::npos);
}

TEST(TargetOrders, WhatIsCancelledIsGoneAndNotAcquiredAnew) {
  OneTarget sea;
  ASSERT_EQ(sea.list().targets_size(), 1);
  wire::TargetOrder wrong;
  wrong.add_cancel(1);
  wrong.add_cancel(2);
  const wire::Reply reply = sea.order(wrong);
  EXPECT_EQ(reply.code(), wire::Reply::UNKNOWN);
  EXPECT_EQ(reply.text(), "target 2 is not tracked");
  sea.update();
  EXPECT_EQ(sea.list().targets_size(), 1);

  wire::TargetOrder cancel;
  cancel.add_cancel(1);
  cancel.add_cancel(1);
  EXPECT_EQ(sea.order(cancel).code(), wire::Reply::OK);
  sea.go_on_for(60.0);
  EXPECT_EQ(sea.list().targets_size(), 0);
  EXPECT_EQ(sea.alert_numbers(), "");
}

TEST(TargetOrders, AllAreCancelledAtOnce) {
  OneTarget sea;
  wire::TargetOrder cancel;
  cancel.set_cancel_all(true);
  EXPECT_EQ(sea.order(cancel).code(), wire::Reply::OK);
  sea.go_on_for(10.0);
  EXPECT_EQ(sea.list().targets_size(), 0);
}

TEST(TargetOrders, BeyondItsCapacityAnAcquisitionIsRefusedWithTheNumber) {
  WatchedSea sea;
  for (int k = 0; k < 12; ++k) {
    const PlanePoint at = vector_of(30.0 * k, 3.0 * kNm);
    sea.sea.targets.push_back({straight_way(at, 0.0, 5.0)});
  }
  wire::TargetOrder few;
  few.mutable_rules()->set_capacity(10);
  sea.order(few);
  sea.go_on_for(40.0);
  EXPECT_EQ(sea.list().tracked(), 10u);
  EXPECT_EQ(sea.alert_numbers(), "3042");
  bool refused = false;
  for (int k = 0; k < 12; ++k) {
    wire::TargetOrder acquire;
    acquire.mutable_acquire()->set_range_nm(3.0);
    acquire.mutable_acquire()->set_bearing_deg(30.0 * k);
    const wire::Reply reply = sea.order(acquire);
    if (reply.code() != wire::Reply::REFUSED) continue;
    refused = true;
    EXPECT_EQ(reply.text(), "10 targets are tracked, which is the capacity; cancel one first");
  }
  EXPECT_TRUE(refused);
  // Nine of ten: a caution, which ends below 85 %.
  wire::TargetOrder none;
  none.mutable_rules()->set_acquire(wire::AUTO_ACQUIRE_NONE);
  none.add_cancel(sea.list().targets(0).number());
  sea.order(none);
  sea.go_on_for(15.0);
  EXPECT_EQ(sea.alerts(3043).size(), 1u);
  EXPECT_EQ(sea.alert(3043).priority(), wire::ALERT_CAUTION);
  EXPECT_EQ(sea.acknowledge(3043).code(), wire::Reply::REFUSED);
  wire::TargetOrder one;
  one.add_cancel(sea.list().targets(0).number());
  sea.order(one);
  sea.go_on_for(5.0);
  EXPECT_TRUE(sea.alerts(3043).empty());
}

TEST(TargetOrders, AnAlertThatIsNoneIsNotAcknowledged) {
  WatchedSea sea;
  sea.update();
  EXPECT_EQ(sea.acknowledge(9999).text(), "there are no alerts 9999");
  EXPECT_EQ(sea.acknowledge(3044, 3).text(), "there is no alert 3044.3");
  EXPECT_EQ(sea.acknowledge(3044).code(), wire::Reply::OK);  // all of none
}

TEST(TargetOrders, AisTargetsAreActivatedAndLetSleep) {
  WatchedSea sea;
  tell_by_ais(sea, 211'000'001, straight_way({0.0, 8.0 * kNm}, 90.0, 10.0), 90.0, 10.0);
  sea.update();
  ASSERT_NE(sea.ais_target(211'000'001), nullptr);
  EXPECT_FALSE(sea.ais_target(211'000'001)->is_activated());
  wire::TargetOrder wake;
  wake.add_activate(211'000'001);
  EXPECT_EQ(sea.order(wake).code(), wire::Reply::OK);
  sea.update();
  EXPECT_TRUE(sea.ais_target(211'000'001)->is_activated());
  wire::TargetOrder sleep;
  sleep.add_let_sleep(211'000'001);
  EXPECT_EQ(sea.order(sleep).code(), wire::Reply::OK);
  sea.update();
  EXPECT_FALSE(sea.ais_target(211'000'001)->is_activated());
  wire::TargetOrder unknown;
  unknown.add_activate(5);
  EXPECT_EQ(sea.order(unknown).text(), "there is no AIS target 5");
}

TEST(TargetOrders, AReferenceTargetIsTrackedAndItsMotionKnown) {
  OneTarget sea;
  wire::TargetOrder reference;
  reference.set_reference(9);
  EXPECT_EQ(sea.order(reference).text(), "target 9 is not tracked");
  reference.set_reference(1);
  EXPECT_EQ(sea.order(reference).code(), wire::Reply::REFUSED);  // for thirty seconds
  sea.go_on_for(60.0);
  EXPECT_EQ(sea.order(reference).code(), wire::Reply::OK);
}

TEST(TargetOrders, WhatIsSaidOfALostReferenceEndsWithTheReference) {
  OneTarget sea;
  sea.go_on_for(60.0);
  wire::TargetOrder reference;
  reference.set_reference(1);
  ASSERT_EQ(sea.order(reference).code(), wire::Reply::OK);
  sea.update();
  sea.sea.targets.clear();
  sea.go_on_for(120.0);
  ASSERT_EQ(sea.alerts(3015).size(), 1u);
  EXPECT_NE(sea.alert(3015).text().find("Reference target 1 is lost"), std::string::npos);
  reference.set_reference(0);
  ASSERT_EQ(sea.order(reference).code(), wire::Reply::OK);
  sea.update();
  EXPECT_EQ(sea.alerts(3015).size(), 0u);
}

}  // namespace
}  // namespace skerry::server
