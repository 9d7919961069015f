// What a plotter has, as sentences tell it; and its alerts.
#include <gtest/gtest.h>

#include "protocol/nmea/alert_sentences.hpp"
#include "protocol/nmea/radar_sentences.hpp"
#include "protocol/nmea/tracked_target_data.hpp"
#include "server/navigation/alert_talker.hpp"
#include "server/navigation/target_sentences.hpp"
#include "server/navigation/told_targets.hpp"
#include "tests/unit/navigation/test_world.hpp"

namespace skerry::server {
namespace {

using namespace std::chrono_literals;

constexpr double kRange_m = 12 * 1852.0;  // within which targets are told

wire::Target& add(wire::TargetList& list, std::uint32_t number, double range_nm) {
  wire::Target& target = *list.add_targets();
  target.set_number(number);
  target.set_state(wire::TARGET_TRACKED);
  target.set_range_m(range_nm * 1852.0);
  target.set_bearing_deg(45.0);
  target.set_course_deg(200.0);
  target.set_speed_kn(9.0);
  target.set_cpa_nm(0.4);
  target.set_tcpa_min(-2.0);
  return target;
}

wire::Alert& alert(wire::TargetList& list, std::uint32_t instance, std::uint32_t target) {
  wire::Alert& one = *list.add_alerts();
  one.set_number(3044);
  one.set_instance(instance);
  one.set_revision(1);
  one.set_priority(wire::ALERT_ALARM);
  one.set_category("A");
  one.set_title("CPA/TCPA");
  one.set_text("Target 12: CPA .4 NM in 3 min");
  one.set_target(target);
  return one;
}

TEST(PlottedTargets, KeepTheirNumbersAndThoseBeyond99GetOneThatIsFree) {
  PlottedTargets told(kRange_m, 40, 4s);
  wire::TargetList list;
  add(list, 1, 3.0);
  add(list, 100, 4.0);
  add(list, 7, 13.0);
  auto targets = told.update(list, at_seconds(0));
  ASSERT_EQ(targets.size(), 2u) << "the third is too far";
  EXPECT_EQ(targets[0].number, 1u);
  EXPECT_EQ(targets[0].label, "");
  EXPECT_EQ(targets[1].number, 2u);
  EXPECT_EQ(targets[1].label, "100");
  add(list, 2, 1.0);
  targets = told.update(list, at_seconds(2));
  ASSERT_EQ(targets.size(), 3u);
  EXPECT_EQ(targets[1].label, "100") << "keeps the number that she has";
  EXPECT_EQ(targets[2].number, 3u);
  EXPECT_EQ(targets[2].label, "2");
}

TEST(PlottedTargets, TheDangerousAndTheNearestHaveTheRoom) {
  PlottedTargets told(kRange_m, 2, 4s);
  wire::TargetList list;
  add(list, 1, 3.0);
  add(list, 2, 2.0);
  add(list, 3, 11.0).set_is_dangerous(true);
  const auto targets = told.update(list, at_seconds(0));
  ASSERT_EQ(targets.size(), 2u);
  EXPECT_EQ(targets[0].number, 2u);
  EXPECT_EQ(targets[1].number, 3u);
  EXPECT_EQ(targets[1].status, ToldTarget::Status::alarm);
}

TEST(PlottedTargets, WhoIsCrowdedOutIsNotLostAndWhoIsToldKeepsHerPlace) {
  PlottedTargets told(kRange_m, 1, 4s);
  wire::TargetList list;
  add(list, 1, 3.0);
  told.update(list, at_seconds(0));
  add(list, 2, 2.9);
  auto targets = told.update(list, at_seconds(2));
  ASSERT_EQ(targets.size(), 1u);
  EXPECT_EQ(targets[0].number, 1u) << "the other is hardly nearer";
  list.mutable_targets(1)->set_range_m(1852.0);
  targets = told.update(list, at_seconds(4));
  ASSERT_EQ(targets.size(), 1u);
  EXPECT_EQ(targets[0].number, 2u);
  EXPECT_EQ(targets[0].status, ToldTarget::Status::tracking);
}

TEST(PlottedTargets, MotionThroughTheWaterIsNoTtdsWhichSaysOverGround) {
  PlottedTargets told(kRange_m, 40, 4s);
  wire::TargetList list;
  list.set_stabilisation(wire::STABILISATION_WATER);
  add(list, 1, 3.0);
  const auto targets = told.update(list, at_seconds(0));
  const auto lines = target_sentences(NavigationSentence::ttd, targets, UtcTime{}, 0);
  const auto ttd = nmea::decode_ttd(nmea::parse_sentence(lines.at(0)).value()).value();
  ASSERT_EQ(ttd.size(), 1u);
  EXPECT_FALSE(ttd[0].speed_kn || ttd[0].course_deg);
  EXPECT_TRUE(ttd[0].range_nm.has_value());
}

TEST(PlottedTargets, ALostOrCancelledOneIsToldAsLostForAWhile) {
  PlottedTargets told(kRange_m, 40, 4s);
  wire::TargetList list;
  add(list, 1, 3.0);
  add(list, 2, 3.0);
  told.update(list, at_seconds(0));
  list.mutable_targets(0)->set_state(wire::TARGET_LOST);
  list.mutable_targets()->RemoveLast();
  auto targets = told.update(list, at_seconds(2));
  ASSERT_EQ(targets.size(), 2u);
  for (const ToldTarget& target : targets) EXPECT_EQ(target.status, ToldTarget::Status::lost);
  EXPECT_EQ(told.update(list, at_seconds(5)).size(), 2u);
  EXPECT_EQ(told.update(list, at_seconds(6)).size(), 0u);
  EXPECT_EQ(told.update(list, at_seconds(8)).size(), 0u) << "still in the list, not acknowledged";
}

TEST(PlottedTargets, OneThatIsBeingAcquiredHasNoMotionInItsSentence) {
  PlottedTargets told(kRange_m, 40, 4s);
  wire::TargetList list;
  wire::Target& target = add(list, 5, 3.0);
  target.set_state(wire::TARGET_ACQUIRING);
  target.clear_course_deg();
  target.clear_speed_kn();
  target.clear_cpa_nm();
  target.clear_tcpa_min();
  target.set_by_hand(true);
  const auto targets = told.update(list, at_seconds(0));
  const auto lines = target_sentences(NavigationSentence::ttm, targets, UtcTime{}, 0);
  ASSERT_EQ(lines.size(), 1u);
  const auto ttm = nmea::decode_ttm(nmea::parse_sentence(lines[0]).value()).value();
  EXPECT_EQ(ttm.number, 5u);
  EXPECT_EQ(ttm.status, nmea::TargetStatus::acquiring);
  EXPECT_FALSE(ttm.speed_kn || ttm.course_deg || ttm.cpa_nm || ttm.tcpa_min) << lines[0];
  EXPECT_EQ(ttm.acquisition, nmea::TargetAcquisition::manual);
}

TEST(PlottedTargets, LabelsTellWhatTheOperatorCallsThem) {
  PlottedTargets told(kRange_m, 40, 4s);
  wire::TargetList list;
  add(list, 112, 3.0);
  add(list, 3, 4.0).set_name("Frida");
  add(list, 4, 4.0);
  const auto targets = told.update(list, at_seconds(0));
  const auto lines = target_sentences(NavigationSentence::tlb, targets, UtcTime{}, 0);
  ASSERT_EQ(lines.size(), 1u);
  const auto labels = nmea::decode_tlb(nmea::parse_sentence(lines[0]).value()).value();
  ASSERT_EQ(labels.size(), 2u);
  EXPECT_EQ(labels[0].number, 1u);
  EXPECT_EQ(labels[0].label, "112");
  EXPECT_EQ(labels[1].number, 3u);
  EXPECT_EQ(labels[1].label, "Frida");
}

TEST(NavigationTalker, TellsWhatThePlotterHasUnlessItIsToldToTellTheTruth) {
  TestWorld world;
  world.add(1, 2.0);
  auto list = std::make_shared<wire::TargetList>();
  add(*list, 31, 3.0);
  world.list = list;
  NavigationPlan plan;
  plan.periods = {{NavigationSentence::ttm, 1s}};
  NavigationTalker plotted{plan};
  const auto said = plotted.due(at_seconds(0), world);
  ASSERT_EQ(said.size(), 1u);
  EXPECT_TRUE(said[0].lines[0].starts_with("$RATTM,31,3.0")) << said[0].lines[0];
  EXPECT_EQ(world.traffic_asked, 0) << "no truth";
  plan.targets = TargetSource::truth;
  NavigationTalker truthful{plan};
  EXPECT_TRUE(truthful.due(at_seconds(0), world)[0].lines[0].starts_with("$RATTM,01,2.0"));
}

TEST(AlertTalker, TellsEachChangeOnceAndThatAnAlertHasGone) {
  AlertTalker talker;
  wire::TargetList list;
  alert(list, 1, 12);
  const auto alf_of = [](const std::string& line) {
    return nmea::decode_alf(nmea::parse_sentence(line).value()).value();
  };
  auto lines = talker.sentences(NavigationSentence::alf, list);
  ASSERT_EQ(lines.size(), 2u) << "title and description";
  EXPECT_EQ(alf_of(lines[0]).key.identifier, 3044u);
  EXPECT_EQ(alf_of(lines[0]).state, nmea::AlertState::unacknowledged);
  EXPECT_EQ(alf_of(lines[0]).priority, nmea::AlertPriority::alarm);
  EXPECT_EQ(alf_of(lines[0]).category, nmea::AlertCategory::a);
  EXPECT_TRUE(talker.sentences(NavigationSentence::alf, list).empty());
  list.mutable_alerts(0)->set_state(wire::ALERT_ACKNOWLEDGED);
  list.mutable_alerts(0)->set_revision(2);
  lines = talker.sentences(NavigationSentence::alf, list);
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_EQ(alf_of(lines[0]).state, nmea::AlertState::acknowledged);
  EXPECT_EQ(alf_of(lines[0]).revision, 2u);
  list.clear_alerts();
  lines = talker.sentences(NavigationSentence::alf, list);
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_EQ(alf_of(lines[0]).state, nmea::AlertState::normal);
  EXPECT_EQ(alf_of(lines[0]).revision, 3u);
  EXPECT_TRUE(talker.sentences(NavigationSentence::alf, list).empty());
}

TEST(AlertTalker, TheCyclicListHasThemAllAndMayBeEmpty) {
  AlertTalker talker;
  wire::TargetList list;
  const auto entries = [&] {
    const auto lines = talker.sentences(NavigationSentence::alc, list);
    return nmea::decode_alc(nmea::parse_sentence(lines.at(0)).value()).value().entries;
  };
  EXPECT_EQ(entries().size(), 0u);
  alert(list, 1, 12);
  alert(list, 2, 13);
  ASSERT_EQ(entries().size(), 2u);
  EXPECT_EQ(entries()[1].key.instance, 2u);
}

TEST(AlertTalker, CommandsAcknowledgeAndSilence) {
  nmea::Acn command{.key = {.manufacturer = {}, .identifier = 3044, .instance = 2}};
  auto order = server::order_of(command);
  ASSERT_TRUE(order.has_value());
  ASSERT_EQ(order->acknowledge_size(), 1);
  EXPECT_EQ(order->acknowledge(0).number(), 3044u);
  EXPECT_EQ(order->acknowledge(0).instance(), 2u);
  command.command = nmea::AlertCommand::silence;
  EXPECT_TRUE(server::order_of(command)->silence());
  command.key.manufacturer = "ABC";
  EXPECT_FALSE(server::order_of(command).has_value()) << "another maker's alert";
  command.key.manufacturer.clear();
  command.command = nmea::AlertCommand::transfer;
  EXPECT_FALSE(server::order_of(command).has_value());
  EXPECT_EQ(server::order_of(nmea::Ack{.number = 44})->acknowledge(0).number(), 3044u);
}

}  // namespace
}  // namespace skerry::server
