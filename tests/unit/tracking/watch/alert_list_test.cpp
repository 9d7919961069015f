#include "server/tracking/watch/alert_list.hpp"

#include <gtest/gtest.h>

#include <set>

#include "tests/unit/tracking/watch/watch_times.hpp"

namespace skerry::server {
namespace {

AlertSubject target(std::uint32_t number) { return {number, 0, {}}; }

struct Alerts : AlertList {
  Alerts() { go_on(kBegin); }
  wire::Alert only() const {
    const auto all = told();
    EXPECT_EQ(all.size(), 1u);
    return all.empty() ? wire::Alert{} : all.front();
  }
};

TEST(AlertList, TellsTheNumbersOfTheirTable) {
  Alerts alerts;
  alerts.raise(AlertKind::approach, target(1), "close");
  const wire::Alert alert = alerts.only();
  EXPECT_EQ(alert.number(), 3044u);
  EXPECT_EQ(alert.instance(), 1u);
  EXPECT_EQ(alert.revision(), 1u);
  EXPECT_EQ(alert.priority(), wire::ALERT_ALARM);
  EXPECT_EQ(alert.category(), "A");
  EXPECT_EQ(alert.state(), wire::ALERT_ACTIVE);
  EXPECT_EQ(alert.title(), "CPA/TCPA");
  EXPECT_EQ(alert.text(), "close");
  EXPECT_EQ(alert.target(), 1u);
  EXPECT_EQ(alert.utc_ns(), 1'790'000'040'000'000'000u);
  std::set<std::uint32_t> numbers;
  for (int kind = 0; kind <= static_cast<int>(AlertKind::capacity_near); ++kind) {
    const AlertRow& row = row_of(static_cast<AlertKind>(kind));
    EXPECT_EQ(find_alert_row(row.number), &row);
    numbers.insert(row.number);
  }
  EXPECT_EQ(numbers, (std::set<std::uint32_t>{3015, 3042, 3043, 3044, 3048, 3052}));
  EXPECT_EQ(find_alert_row(3002), nullptr);
}

TEST(AlertList, AnAlarmThatIsOverIsGoneAlsoUnacknowledged) {
  Alerts alerts;
  alerts.raise(AlertKind::approach, target(1), "");
  alerts.end(AlertKind::approach, target(1));
  EXPECT_TRUE(alerts.told().empty());
}

TEST(AlertList, AWarningThatIsOverWaitsForItsAcknowledgement) {
  Alerts alerts;
  alerts.raise(AlertKind::lost_input, {0, 0, "log"}, "once");
  alerts.end(AlertKind::lost_input, {0, 0, "log"});
  EXPECT_EQ(alerts.only().state(), wire::ALERT_RECTIFIED);
  EXPECT_EQ(alerts.only().revision(), 2u);
  alerts.end(AlertKind::lost_input, {0, 0, "log"});
  EXPECT_EQ(alerts.only().revision(), 2u);
  // The cause is there again: the same instance, to be acknowledged anew.
  alerts.go_on(utc_at(5));
  alerts.raise(AlertKind::lost_input, {0, 0, "log"}, "again");
  EXPECT_EQ(alerts.only().state(), wire::ALERT_ACTIVE);
  EXPECT_EQ(alerts.only().instance(), 1u);
  EXPECT_EQ(alerts.only().revision(), 3u);
  EXPECT_EQ(alerts.only().text(), "again");
  alerts.end(AlertKind::lost_input, {0, 0, "log"});
  alerts.acknowledge(3015, 1);
  EXPECT_TRUE(alerts.told().empty());
}

TEST(AlertList, AnAcknowledgedOneStaysAsLongAsItsCause) {
  Alerts alerts;
  alerts.raise(AlertKind::approach, target(1), "");
  alerts.acknowledge(3044, 0);
  EXPECT_EQ(alerts.only().state(), wire::ALERT_ACKNOWLEDGED);
  alerts.raise(AlertKind::approach, target(1), "");  // the cause goes on
  EXPECT_EQ(alerts.only().state(), wire::ALERT_ACKNOWLEDGED);
  EXPECT_EQ(alerts.only().revision(), 2u);
  alerts.acknowledge(3044, 1);  // twice
  EXPECT_EQ(alerts.only().revision(), 2u);
  alerts.end(AlertKind::approach, target(1));
  EXPECT_TRUE(alerts.told().empty());
}

TEST(AlertList, WhatTellsOfAnEventIsDoneWithOnceAcknowledged) {
  Alerts alerts;
  alerts.raise(AlertKind::new_target, target(1), "");
  alerts.raise(AlertKind::lost_target, target(2), "");
  EXPECT_TRUE(alerts.is_unacknowledged(AlertKind::new_target, target(1)));
  alerts.acknowledge(3048, 1);
  alerts.acknowledge(3052, 1);
  EXPECT_TRUE(alerts.told().empty());
}

TEST(AlertList, SilenceLastsThirtySeconds) {
  Alerts alerts;
  alerts.raise(AlertKind::approach, target(1), "");
  alerts.silence();
  EXPECT_EQ(alerts.only().state(), wire::ALERT_SILENCED);
  alerts.go_on(utc_at(29));
  EXPECT_EQ(alerts.only().state(), wire::ALERT_SILENCED);
  alerts.go_on(utc_at(30));
  EXPECT_EQ(alerts.only().state(), wire::ALERT_ACTIVE);
  alerts.silence();
  alerts.acknowledge(3044, 1);
  alerts.silence();
  EXPECT_EQ(alerts.only().state(), wire::ALERT_ACKNOWLEDGED);
}

TEST(AlertList, WhatNobodyAcknowledgesEscalatesEveryMinute) {
  Alerts alerts;
  alerts.raise(AlertKind::new_target, target(1), "");
  alerts.go_on(utc_at(59));
  EXPECT_EQ(alerts.only().escalations(), 0u);
  alerts.go_on(utc_at(60));
  EXPECT_EQ(alerts.only().escalations(), 1u);
  EXPECT_EQ(alerts.only().revision(), 2u);
  alerts.go_on(utc_at(61));
  EXPECT_EQ(alerts.only().revision(), 2u);
  alerts.go_on(utc_at(185));
  EXPECT_EQ(alerts.only().escalations(), 3u);
  alerts.end(AlertKind::new_target, target(1));  // rectified: no longer
  alerts.go_on(utc_at(400));
  EXPECT_EQ(alerts.only().escalations(), 3u);

  Alerts caution;
  caution.raise(AlertKind::capacity_near, {0, 0, "targets"}, "");
  caution.go_on(utc_at(400));
  EXPECT_EQ(caution.only().escalations(), 0u);
}

TEST(AlertList, ACautionIsNeitherAcknowledgedNorSilenced) {
  Alerts alerts;
  alerts.raise(AlertKind::capacity_near, {0, 0, "targets"}, "");
  alerts.acknowledge(3043, 0);
  alerts.silence();
  EXPECT_EQ(alerts.only().state(), wire::ALERT_ACTIVE);
  EXPECT_EQ(alerts.only().revision(), 1u);
  alerts.end(AlertKind::capacity_near, {0, 0, "targets"});
  EXPECT_TRUE(alerts.told().empty());
}

TEST(AlertList, TwoTargetsHaveTwoInstances) {
  Alerts alerts;
  alerts.raise(AlertKind::approach, target(5), "");
  alerts.raise(AlertKind::approach, {0, 211'000'000, {}}, "");
  alerts.raise(AlertKind::new_target, target(5), "");
  EXPECT_TRUE(alerts.has(3044, 1));
  EXPECT_TRUE(alerts.has(3044, 2));
  EXPECT_FALSE(alerts.has(3044, 3));
  EXPECT_TRUE(alerts.has(3048, 1));
  alerts.acknowledge(3044, 2);
  EXPECT_TRUE(alerts.is_unacknowledged(AlertKind::approach, target(5)));
  EXPECT_FALSE(alerts.is_unacknowledged(AlertKind::approach, {0, 211'000'000, {}}));
  alerts.remove(target(5));
  EXPECT_EQ(alerts.told().size(), 1u);
}

TEST(AlertList, RevisionsGoRound) {
  Alerts alerts;
  for (int change = 1; change <= 200; ++change) {
    alerts.raise(AlertKind::lost_input, {0, 0, "log"}, "");
    alerts.end(AlertKind::lost_input, {0, 0, "log"});
    EXPECT_GE(alerts.only().revision(), 1u);
    EXPECT_LE(alerts.only().revision(), 99u);
  }
  EXPECT_EQ(alerts.only().revision(), 400u % 99u);
}

TEST(AlertList, AlarmsComeFirstThenTheNewest) {
  Alerts alerts;
  alerts.raise(AlertKind::approach, target(1), "");
  alerts.raise(AlertKind::capacity_near, {0, 0, "targets"}, "");
  alerts.go_on(utc_at(1));
  alerts.raise(AlertKind::new_target, target(2), "");
  alerts.go_on(utc_at(2));
  alerts.raise(AlertKind::new_target, target(3), "");
  std::vector<std::uint32_t> targets;
  for (const wire::Alert& alert : alerts.told()) targets.push_back(alert.target());
  EXPECT_EQ(targets, (std::vector<std::uint32_t>{1, 3, 2, 0}));
}

TEST(AlertList, IsBoundedAndTheOldestUnimportantOneGoes) {
  Alerts alerts;
  alerts.raise(AlertKind::approach, target(1), "");
  for (std::uint32_t k = 2; k < 1000; ++k) {
    alerts.go_on(utc_at(0.01 * k));
    alerts.raise(AlertKind::new_target, target(k), "");
  }
  EXPECT_EQ(alerts.told().size(), AlertList::kMost);
  EXPECT_TRUE(alerts.has(AlertKind::approach, target(1)));
  EXPECT_FALSE(alerts.has(AlertKind::new_target, target(2)));
  EXPECT_TRUE(alerts.has(AlertKind::new_target, target(999)));
}

TEST(AlertList, WhatBecomesAnotherTakesItsAlertAlong) {
  Alerts alerts;
  alerts.raise(AlertKind::approach, {0, 7, {}}, "");
  alerts.acknowledge(3044, 1);
  alerts.move(AlertKind::approach, {0, 7, {}}, target(3));
  EXPECT_EQ(alerts.only().target(), 3u);
  EXPECT_EQ(alerts.only().state(), wire::ALERT_ACKNOWLEDGED);
  alerts.copy(AlertKind::approach, target(3), {0, 7, {}});
  ASSERT_EQ(alerts.told().size(), 2u);
  for (const wire::Alert& alert : alerts.told()) {
    EXPECT_EQ(alert.state(), wire::ALERT_ACKNOWLEDGED);
  }
  EXPECT_TRUE(alerts.has(3044, 2));
  // Each has one by now: they become one.
  alerts.move(AlertKind::approach, {0, 7, {}}, target(3));
  EXPECT_EQ(alerts.only().instance(), 1u);
}

}  // namespace
}  // namespace skerry::server
