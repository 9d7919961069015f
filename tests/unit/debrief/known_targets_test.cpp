// What a set told of targets, as a debrief has it.
#include "server/debrief/known_targets.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "server/debrief/words.hpp"
#include "server/relayed/values_in_range.hpp"

namespace skerry::server {
namespace {

wire::Target& add_target(wire::TargetList& list, std::uint32_t number,
                         wire::TargetState state = wire::TARGET_TRACKED) {
  wire::Target& target = *list.add_targets();
  target.set_number(number);
  target.set_state(state);
  target.set_latitude_deg(60.0);
  target.set_longitude_deg(5.0);
  return target;
}

wire::Alert& add_alert(wire::TargetList& list, std::uint32_t number, wire::AlertState state,
                       std::uint32_t target = 0) {
  wire::Alert& alert = *list.add_alerts();
  alert.set_number(number);
  alert.set_instance(1);
  alert.set_state(state);
  alert.set_priority(number == 3044 ? wire::ALERT_ALARM : wire::ALERT_WARNING);
  alert.set_target(target);
  return alert;
}

class KnownTargetsTest : public testing::Test {
 protected:
  // A list a second later.
  void tell(const wire::TargetList& list) { known_.add({at_s_++, 0.0}, list); }

  double at_s_ = 0.0;
  KnownTargets known_;
};

TEST_F(KnownTargetsTest, ATargetIsToldFromFirstToLast) {
  for (int second = 0; second <= 30; ++second) {
    wire::TargetList list;
    if (second >= 2) {
      wire::Target& target = add_target(list, 4,
                                        second < 10   ? wire::TARGET_ACQUIRING
                                        : second < 20 ? wire::TARGET_TREND
                                                      : wire::TARGET_LOST);
      if (second == 15) target.set_name("Kilo");
    }
    if (second < 5) add_target(list, 3);
    if (second >= 25) add_target(list, 5);
    tell(list);
  }
  const KnownView view = known_.finish();
  ASSERT_EQ(view.targets.size(), 3u);
  EXPECT_EQ(view.targets[0].number, 3u);
  EXPECT_EQ(view.targets[0].last.at_s, 4.0);
  EXPECT_STREQ(ending_text(view.targets[0]), "let go");
  EXPECT_EQ(view.targets[1].name, "Kilo");
  EXPECT_EQ(view.targets[1].first.at_s, 2.0);
  EXPECT_EQ(view.targets[1].last.at_s, 20.0) << "it is told on until it is acknowledged";
  EXPECT_STREQ(ending_text(view.targets[1]), "lost");
  EXPECT_EQ(view.targets[1].way.size(), 3u) << "at 2, 12 and 20 s";
  EXPECT_STREQ(ending_text(view.targets[2]), "told to the end");
}

TEST_F(KnownTargetsTest, TheLeastCpaIsThatWhichLayAhead) {
  for (const auto& [cpa_nm, tcpa_min] :
       {std::pair{1.0, 9.0}, {0.5, 5.0}, {0.7, 2.0}, {0.1, -1.0}}) {
    wire::TargetList list;
    add_target(list, 1).set_cpa_nm(cpa_nm);
    list.mutable_targets(0)->set_tcpa_min(tcpa_min);
    tell(list);
  }
  const KnownView view = known_.finish();
  ASSERT_TRUE(view.targets.at(0).least_cpa_nm);
  EXPECT_EQ(*view.targets[0].least_cpa_nm, 0.5);
  EXPECT_EQ(*view.targets[0].tcpa_min, 5.0);
  EXPECT_EQ(view.targets[0].least_when.at_s, 1.0);
}

TEST_F(KnownTargetsTest, AnAlarmIsAcknowledgedOrEndsByItself) {
  // Raised at 1, acknowledged at 4, gone at 6, raised again at 8, gone at 10.
  for (int second = 0; second < 12; ++second) {
    wire::TargetList list;
    add_target(list, 7);
    if (second >= 1 && second < 6) {
      add_alert(list, 3044, second < 4 ? wire::ALERT_ACTIVE : wire::ALERT_ACKNOWLEDGED, 7)
          .set_text("Target 7: CPA 0.3 NM in 8 min");
    } else if (second >= 8 && second < 10) {
      add_alert(list, 3044, wire::ALERT_SILENCED, 7);
    }
    tell(list);
  }
  const KnownView view = known_.finish();
  ASSERT_EQ(view.alerts.size(), 2u);
  EXPECT_EQ(view.alerts[0].priority, "alarm");
  EXPECT_EQ(view.alerts[0].text, "Target 7: CPA 0.3 NM in 8 min");
  EXPECT_EQ(view.alerts[0].raised.at_s, 1.0);
  EXPECT_EQ(view.alerts[0].reaction_s(), 3.0);
  EXPECT_FALSE(view.alerts[0].ended);
  EXPECT_EQ(view.alerts[1].raised.at_s, 8.0);
  EXPECT_FALSE(view.alerts[1].reaction_s());
  ASSERT_TRUE(view.alerts[1].ended);
  EXPECT_EQ(view.alerts[1].ended->at_s, 10.0);
}

TEST_F(KnownTargetsTest, WhatIsOnlyOverOnceAcknowledgedWasAcknowledged) {
  wire::TargetList list;
  add_target(list, 7);
  add_alert(list, 3048, wire::ALERT_ACTIVE, 7);  // it stays: acknowledged
  add_alert(list, 3048, wire::ALERT_ACTIVE, 8);  // of the next one, which goes with its target
  list.mutable_alerts(1)->set_instance(2);
  add_target(list, 8);
  add_alert(list, 3052, wire::ALERT_ACTIVE, 9);  // the mark goes with it
  add_alert(list, 3015, wire::ALERT_RECTIFIED);  // over, it waited for that
  add_alert(list, 3042, wire::ALERT_ACTIVE);     // open at the end
  tell(list);
  wire::TargetList later;
  add_target(later, 7);
  add_alert(later, 3042, wire::ALERT_ACTIVE);
  tell(later);
  const KnownView view = known_.finish();
  ASSERT_EQ(view.alerts.size(), 5u);
  EXPECT_EQ(view.alerts[0].reaction_s(), 1.0);
  EXPECT_TRUE(!view.alerts[1].acknowledged && view.alerts[1].ended);
  EXPECT_EQ(view.alerts[2].reaction_s(), 1.0);
  EXPECT_EQ(view.alerts[3].reaction_s(), 1.0);
  EXPECT_TRUE(!view.alerts[4].acknowledged && !view.alerts[4].ended);
}

TEST_F(KnownTargetsTest, APlotterThatBeginsAnewHasOtherTargets) {
  for (const std::uint64_t plots : {50u, 60u, 3u}) {
    wire::TargetList list;
    list.set_plots(plots);
    add_target(list, 1);
    add_alert(list, 3044, wire::ALERT_ACTIVE, 1);
    tell(list);
  }
  const KnownView view = known_.finish();
  ASSERT_EQ(view.targets.size(), 2u);
  EXPECT_EQ(view.targets[1].first.at_s, 2.0);
  ASSERT_EQ(view.alerts.size(), 2u);
  EXPECT_TRUE(view.alerts[0].ended);
}

TEST_F(KnownTargetsTest, ListsWithoutEndAreBounded) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (std::uint32_t second = 0; second < 100; ++second) {
    // None but the first 2000 are kept: long texts in the others would take time only.
    const std::string text(second < 4 ? 5000 : 10, 'x');
    wire::TargetList list;
    for (std::uint32_t k = 0; k < 1000; ++k) {
      wire::Target& target = add_target(list, 1 + 1000 * second + k);
      target.set_cpa_nm(nan);
      target.set_latitude_deg(nan);
      add_alert(list, 1000 * second + k, wire::ALERT_ACTIVE).set_text(text);
    }
    list.add_targets()->CopyFrom(list.targets(0));  // twice the same
    bring_into_range(list);
    tell(list);
  }
  const KnownView view = known_.finish();
  EXPECT_EQ(view.targets.size(), KnownTargets::kMostTargets);
  EXPECT_EQ(view.alerts.size(), KnownTargets::kMostAlerts);
  EXPECT_EQ(view.left_out, 2 * 98'000u);
  EXPECT_LE(view.alerts[0].text.size(), kLongestText);
  EXPECT_GE(*view.targets[0].least_cpa_nm, 0.0);
}

TEST_F(KnownTargetsTest, WhatIsLeftOutIsCountedOnce) {
  for (int second = 0; second < 5; ++second) {
    wire::TargetList list;
    for (std::uint32_t k = 0; k <= KnownTargets::kMostTargets; ++k) {
      add_target(list, k + 1);
      add_alert(list, k + 1, wire::ALERT_ACTIVE);
    }
    tell(list);
  }
  EXPECT_EQ(known_.finish().left_out, 2u);
}

}  // namespace
}  // namespace skerry::server
