// Lists of targets as text, as rows, and as lines of what has changed.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "clients/cli/targets/target_words.hpp"
#include "protocol/wire/schema.hpp"
#include "tests/unit/clients/made_targets.hpp"

namespace skerry::client {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

// The line that begins with that word; empty if none does.
std::string line_of(const std::string& text, const std::string& word) {
  for (std::size_t from = 0, to; from < text.size(); from = to + 1) {
    to = std::min(text.find('\n', from), text.size());
    const std::string line = text.substr(from, to - from);
    const std::size_t begin = line.find_first_not_of(' ');
    if (begin != std::string::npos && line.compare(begin, word.size() + 1, word + " ") == 0) {
      return line;
    }
  }
  return "";
}

// Whether the words stand in this order, each once at least.
void expect_order(const std::string& text, const std::vector<std::string>& words) {
  std::size_t from = 0;
  for (const std::string& word : words) {
    const std::size_t at = text.find("\n" + word, from);
    ASSERT_NE(at, std::string::npos) << word << " in\n" << text;
    from = at + 1;
  }
}

TEST(TargetWords, ATableHasWhatIsKnownAndADashForWhatIsNot) {
  const std::string text = targets_text(made_list(), TargetSort::cpa);
  EXPECT_THAT(text, HasSubstr("TARGETS  3 of 100, radar 0 view 0, 11:06:40 UTC; courses and speeds "
                              "are over ground, by GNSS\n"
                              "OWN      course 335.0 at 12.0 kn\n"));
  EXPECT_EQ(line_of(text, "3"),
            "        3  tracked       9.00   045.0   180.0     12.0    0.25      8.0      1");
  EXPECT_EQ(line_of(text, "4"),
            "        4  acquiring     1.00   000.0       -        -       -        -      1");
  EXPECT_THAT(line_of(text, "002570100"), HasSubstr("activated"));
  EXPECT_THAT(line_of(text, "002570100"), HasSubstr("FERRY, \"BLUE\""));
  EXPECT_THAT(line_of(text, "257000002"), HasSubstr("sleeping"));
  for (const char* absent : {"PROBLEM", "ALERT", "TEST", "zone", "trial", "left out"}) {
    EXPECT_THAT(text, Not(HasSubstr(absent)));
  }
}

TEST(TargetWords, TheOrderIsByCpaRangeOrNumber) {
  wire::TargetList list = made_list();
  *list.add_targets() = made_mover(1, 2.0, 0.1, -3.0);
  const auto expect = [&](TargetSort sort, const std::vector<std::string>& numbers) {
    std::vector<std::string> words;
    for (const std::string& number : numbers) words.push_back("        " + number + "  ");
    expect_order(targets_text(list, sort), words);
  };
  expect(TargetSort::cpa, {"3", "2", "1", "4"});  // 1 is past, 4 has none
  expect(TargetSort::range, {"4", "1", "2", "3"});
  expect(TargetSort::number, {"1", "2", "3", "4"});
}

TEST(TargetWords, WhatIsTrueOfATargetStandsBesideIt) {
  wire::TargetList list = made_list();
  wire::Target& target = *list.mutable_targets(1);
  target.set_is_dangerous(true);
  target.set_is_new(true);
  target.set_is_reference(true);
  target.set_by_hand(true);
  target.set_mmsi(257000002);
  target.set_name("TANKER");
  list.mutable_targets(0)->set_state(wire::TARGET_FROZEN);
  list.mutable_targets(2)->set_is_test(true);
  list.mutable_ais(1)->set_target(3);
  list.set_test_targets(true);
  const std::string text = targets_text(list, TargetSort::cpa);
  EXPECT_THAT(line_of(text, "3"), HasSubstr("257000002 TANKER"));
  EXPECT_THAT(line_of(text, "3"), HasSubstr("DANGEROUS, new, reference, by hand"));
  EXPECT_THAT(line_of(text, "2"), HasSubstr("frozen"));
  EXPECT_THAT(line_of(text, "2"), HasSubstr("where it was"));
  EXPECT_THAT(line_of(text, "4"), HasSubstr("TEST TARGET"));
  EXPECT_THAT(line_of(text, "257000002"), HasSubstr("target 3"));
}

TEST(TargetWords, WhatHoldsForAllStandsAroundTheTable) {
  wire::TargetList list = made_list();
  list.clear_stabilised_by();
  list.clear_own_course_deg();
  list.set_problem("heading is lost: targets are frozen");
  list.set_ais_left_out(7);
  auto* zone = list.add_zones();
  zone->set_number(2);
  zone->set_kind(wire::TargetZone::EXCLUDES);
  zone->set_inner_nm(1.0);
  zone->set_outer_nm(3.5);
  zone->set_from_deg(315.0);
  zone->set_to_deg(45.0);
  zone->set_relative(true);
  list.add_zones()->set_outer_nm(6.0);
  *list.add_alerts() = made_alert(2, wire::ALERT_ACKNOWLEDGED);
  const std::string text = targets_text(list, TargetSort::cpa);
  for (const char* part :
       {"courses and speeds are not known", "OWN      her motion and heading are not known",
        "PROBLEM  heading is lost: targets are frozen\n",
        "zone 2: excludes, 1.00 to 3.50 NM, 315.0 to 045.0 from the bow\n",
        "zone 0: acquires, 0.00 to 6.00 NM, all round\n", "7 AIS targets farther off",
        "3044.2     alarm    acknowledged  11:06:40  CPA/TCPA: Target 3: CPA 0.2 NM in 8 min\n"}) {
    EXPECT_THAT(text, HasSubstr(part));
  }
}

TEST(TargetWords, ATrialHasTheClosestFirstAndWhatWouldBeWithoutIt) {
  wire::TargetList list = made_list();
  auto& order = *list.mutable_trial()->mutable_order();
  order.set_course_deg(90.0);
  order.set_speed_kn(12.0);
  order.set_delay_min(5.0);
  order.set_turn_rate_deg_min(60.0);
  list.mutable_trial()->set_begins_s(299.6);
  const auto add = [&](std::uint32_t target, std::uint32_t mmsi, double cpa_nm) {
    auto* outcome = list.mutable_trial()->add_outcomes();
    outcome->set_target(target);
    outcome->set_mmsi(mmsi);
    outcome->set_cpa_nm(cpa_nm);
    outcome->set_tcpa_min(14.0);
    outcome->set_is_dangerous(cpa_nm < 1.0);
  };
  add(3, 0, 2.5);
  add(2, 0, 0.75);
  add(0, 2570100, 3.0);
  const std::string text = targets_text(list, TargetSort::cpa);
  const std::string trial = text.substr(text.find("trial: "));
  EXPECT_THAT(
      trial, HasSubstr("trial: course 090.0 at 12.0 kn in 5.0 min, 60 deg/min; begins in 300 s\n"));
  EXPECT_EQ(trial, trial_text(list));
  expect_order(trial,
               {"        2    0.75     14.0       1.50  ", "        3    2.50     14.0       0.25",
                "002570100    3.00     14.0          -  FERRY"});
  EXPECT_THAT(line_of(trial, "2"), HasSubstr("DANGEROUS"));
  EXPECT_THAT(line_of(trial, "3"), Not(HasSubstr("DANGEROUS")));
}

TEST(TargetWords, RowsAreForSpreadsheets) {
  wire::TargetList list = made_list();
  list.mutable_targets(1)->set_is_dangerous(true);
  EXPECT_EQ(targets_csv(list, TargetSort::number),
            "kind,number,mmsi,state,range_nm,bearing_deg,course_deg,speed_kn,cpa_nm,tcpa_min,age_s,"
            "lat_deg,lon_deg,name,dangerous,new,reference,test,by_hand\n"
            "tracked,2,,tracked,5.0000,45.00,180.00,12.04,1.5000,20.00,1.2,60.500000,-5.250000,"
            "\"\",0,0,0,0,0\n"
            "tracked,3,,tracked,9.0000,45.00,180.00,12.04,0.2500,8.00,1.2,60.500000,-5.250000,"
            "\"\",1,0,0,0,0\n"
            "tracked,4,,acquiring,1.0000,359.96,,,,,1.2,60.500000,-5.250000,\"\",0,0,0,0,0\n"
            "ais,,2570100,activated,2.0000,0.00,,,,,0.0,0.000000,0.000000,"
            "\"FERRY, \"\"BLUE\"\"\",0,0,0,0,0\n"
            "ais,,257000002,sleeping,0.0000,0.00,,,,,0.0,0.000000,0.000000,\"\",0,0,0,0,0\n");
}

TEST(TargetWords, WhateverAServerSendsIsOneLineEachAndFitsTheTable) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  wire::TargetList list = made_list();
  for (int k = 0; k < 4; ++k) {
    wire::Target& bad = *list.add_targets();
    bad = made_mover(9, kNan, kNan, 1e300);
    bad.set_bearing_deg(-1e300);
    bad.set_course_deg(kNan);
    bad.set_speed_kn(std::numeric_limits<double>::infinity());
    bad.set_name("\x1b[31m\nRED");
    bad.set_mmsi(4294967295u);
    bad.set_state(static_cast<wire::TargetState>(77));
  }
  list.set_utc_ns(UINT64_MAX);
  list.set_problem("\x1b[2J");
  list.add_alerts()->set_text("\a");
  for (const TargetSort sort : {TargetSort::cpa, TargetSort::range, TargetSort::number}) {
    const std::string text = targets_text(list, sort);
    EXPECT_THAT(text, Not(HasSubstr("\x1b")));
    EXPECT_THAT(text, Not(HasSubstr("\a")));
    EXPECT_THAT(line_of(text, "9"), HasSubstr("4294967295 ?[31m?RED"));
    EXPECT_LT(line_of(text, "9").size(), 160u);
    EXPECT_THAT(targets_csv(list, sort), Not(HasSubstr("nan")));
  }
}

TEST(TargetWords, EveryRuleIsShownWithWhatIsAllowedAndWhatItIsFor) {
  wire::TargetRules rules;
  rules.set_acquire(wire::AUTO_ACQUIRE_MOVING);
  rules.set_cpa_nm(0.5);
  const std::string text = rules_text(rules);
  for (const auto* field : wire::fields_of(*wire::TargetRules::descriptor())) {
    EXPECT_THAT(text, HasSubstr(wire::control_of(*field).help()));
    EXPECT_THAT(text, HasSubstr("--" + wire::option_name(*field) + " "));
    EXPECT_THAT(text, HasSubstr(wire::allowed_by(wire::rule_of(*field))));
  }
  EXPECT_THAT(text, HasSubstr("CPA limit            0.5 NM     --cpa "));
  EXPECT_THAT(text, HasSubstr("none or moving or all"));
  EXPECT_EQ(rules_in_words(rules), "acquire moving, CPA limit 0.5 NM");
  EXPECT_EQ(rules_in_words({}), "");
}

// --- changes

TEST(TargetChanges, ThatTargetsMoveIsNone) {
  wire::TargetList after = made_list();
  for (auto& target : *after.mutable_targets()) {
    target.set_range_m(target.range_m() - 10.0);
    target.set_bearing_deg(12.0);
    if (target.has_cpa_nm()) target.set_cpa_nm(target.cpa_nm() + 0.1);
    target.set_age_s(3.0);
  }
  after.set_own_course_deg(12.0);
  after.set_plots(99);
  after.add_ais()->set_mmsi(257000003);  // it sleeps
  EXPECT_THAT(target_changes(made_list(), after), IsEmpty());
}

TEST(TargetChanges, TargetsComeAndGo) {
  wire::TargetList after = made_list();
  after.mutable_targets()->DeleteSubrange(0, 1);
  after.mutable_targets(1)->set_state(wire::TARGET_TREND);
  *after.add_targets() = made_mover(5, 2.0, 0.3, 5.0);
  after.mutable_targets(2)->set_by_hand(true);
  after.mutable_targets(2)->set_is_dangerous(true);
  after.mutable_targets(0)->set_mmsi(257000002);
  after.mutable_targets(0)->set_name("TANKER");
  after.mutable_targets(0)->set_is_reference(true);
  EXPECT_THAT(
      target_changes(made_list(), after),
      ElementsAre("11:06:40  target 3: is AIS 257000002 TANKER",
                  "11:06:40  target 3: the reference", "11:06:40  target 4: trend, 1.00 NM, 000.0",
                  "11:06:40  target 5: acquired, 2.00 NM, 045.0, by hand, course 180.0 at "
                  "12.0 kn",
                  "11:06:40  target 5: dangerous, CPA 0.30 NM in 5.0 min",
                  "11:06:40  target 2: no longer listed"));
  EXPECT_THAT(target_changes(after, made_list()),
              testing::Contains("11:06:40  target 3: no AIS target"));
}

TEST(TargetChanges, AlertsAreRaisedAcknowledgedAndOver) {
  wire::TargetList none = made_list(), raised = made_list(), acknowledged = made_list();
  *raised.add_alerts() = made_alert(1, wire::ALERT_ACTIVE);
  *acknowledged.add_alerts() = made_alert(1, wire::ALERT_ACKNOWLEDGED);
  wire::TargetList again = raised;
  again.mutable_alerts(0)->set_escalations(1);
  EXPECT_THAT(target_changes(none, raised),
              ElementsAre("11:06:40  alarm 3044.1 CPA/TCPA: Target 3: CPA 0.2 NM in 8 min"));
  EXPECT_THAT(target_changes(raised, again),
              ElementsAre("11:06:40  alarm 3044.1 CPA/TCPA: still not acknowledged"));
  EXPECT_THAT(target_changes(raised, acknowledged),
              ElementsAre("11:06:40  alarm 3044.1 CPA/TCPA: acknowledged"));
  EXPECT_THAT(target_changes(acknowledged, none),
              ElementsAre("11:06:40  alarm 3044.1 CPA/TCPA: over"));
}

TEST(TargetChanges, OrdersOfOtherDisplaysAreTold) {
  wire::TargetList after = made_list();
  after.mutable_rules()->set_cpa_nm(2.0);
  after.add_zones()->set_number(1);
  after.mutable_trial()->mutable_order()->set_course_deg(90.0);
  after.set_test_targets(true);
  after.set_problem("position is lost");
  after.clear_stabilised_by();
  after.mutable_ais(0)->set_is_activated(false);
  after.mutable_ais(1)->set_is_lost(true);
  EXPECT_THAT(
      target_changes(made_list(), after),
      ElementsAre("11:06:40  problem: position is lost",
                  "11:06:40  courses and speeds are not known", "11:06:40  rules: CPA limit 2 NM",
                  "11:06:40  zone 1: acquires, 0.00 to 0.00 NM, all round",
                  "11:06:40  trial: course 090.0 at 0.0 kn in 0.0 min", "11:06:40  test targets on",
                  "11:06:40  AIS 002570100 FERRY, \"BLUE\": sleeping",
                  "11:06:40  AIS 257000002: lost"));
  EXPECT_THAT(
      target_changes(after, made_list()),
      ElementsAre("11:06:40  no problem any more", "11:06:40  courses and speeds: ground, by GNSS",
                  "11:06:40  rules: CPA limit 1 NM", "11:06:40  zone 1: removed",
                  "11:06:40  trial: ended", "11:06:40  test targets off",
                  "11:06:40  AIS 002570100 FERRY, \"BLUE\": activated, 2.00 NM, 000.0",
                  "11:06:40  AIS 257000002: heard again"));
}

}  // namespace
}  // namespace skerry::client
