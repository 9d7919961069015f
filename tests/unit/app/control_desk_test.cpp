// Controls are decided in one place: all or nothing, locks, followers, the log.
#include "server/app/control/control_desk.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "server/app/options/radar_config.hpp"
#include "server/world/scenario.hpp"
#include "tests/unit/net/kept_audit.hpp"
#include "tests/unit/radar/open_sea.hpp"

namespace skerry::server {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

// Radars 0 and 1 on one ship, radar 2 on another.
class Desk : public testing::Test {
 protected:
  explicit Desk(const std::string& first_ship = "")
      : scenario_(parse_scenario(
            "name: s\nown_ships:\n"
            "  - {name: F, position: {lat: 60, lon: 5}, course_deg: 10, speed_kn: 8, " +
                first_ship +
                "\n"
                "     radars: [{range_nm: 6, locked: [pulse]}, {range_nm: 12}]}\n"
                "  - {name: Y, position: {lat: 61, lon: 5}, radars: [{range_nm: 3}]}\n",
            "f")),
        timeline_(World(scenario_)),
        coast_(std::make_unique<OpenSea>(), 3, {}),
        airwaves_(3) {
    std::uint32_t index = 0;
    for (int ship = 0; ship < scenario_.own_ships_size(); ++ship) {
      for (const scenario::Radar& radar : scenario_.own_ships(ship).radars()) {
        units_.push_back(std::make_unique<RadarUnit>(
            radar_config(radar, index++, static_cast<std::size_t>(ship), 1), timeline_, coast_,
            airwaves_, 0));
      }
    }
    std::vector<RadarUnit*> units;
    for (const auto& unit : units_) units.push_back(unit.get());
    desk_ = std::make_unique<ControlDesk>(
        timeline_, units, initial_locks(scenario_),
        ChangeLog([this](const std::string& line) { lines_.push_back(line); }));
  }

  static wire::Set of(std::uint32_t radar, std::uint32_t view = 0) {
    wire::Set set;
    set.set_radar(radar);
    set.set_view(view);
    return set;
  }
  wire::Reply apply(const wire::Set& set) { return desk_->apply(set, "console 192.0.2.1:9"); }
  void expect_ok(const wire::Set& set) {
    const wire::Reply reply = apply(set);
    EXPECT_EQ(reply.code(), wire::Reply::OK) << reply.text();
  }
  void lock(std::uint32_t radar, const std::string& control) {
    wire::Set set = of(radar);
    set.set_instructor(true);
    set.add_lock(control);
    expect_ok(set);
  }
  std::uint32_t open_view(std::uint32_t radar, bool follows) {
    return units_[radar]->views().open(0, follows, [](VideoChannel&) {})->number;
  }
  // All changes of a radar's view that are not of its own making.
  std::string settings_text(std::uint32_t radar, std::uint32_t view = 0) const {
    return desk_->settings(radar, view).DebugString();
  }

  scenario::Scenario scenario_;
  Timeline timeline_;
  CoastService coast_;
  Airwaves airwaves_;
  std::vector<std::unique_ptr<RadarUnit>> units_;
  std::vector<std::string> lines_;
  std::unique_ptr<ControlDesk> desk_;
};

TEST_F(Desk, EveryControlOfASetComesBackInTheSettings) {
  wire::Set set = of(1);
  set.set_range_nm(24);
  set.set_gain(61.5);
  set.set_sea(31);
  set.set_rain(12);
  set.set_sea_auto(true);
  set.set_interference_rejection(33);
  set.set_echo_stretch(44);
  set.set_integration(55);
  set.set_stretch_bearing(true);
  set.set_decimation(wire::MEAN);
  set.set_transmit(false);
  set.set_pulse(wire::PULSE_MEDIUM);
  set.set_tune_auto(false);
  set.set_tune(49);
  set.set_gain_auto(true);
  set.set_side_lobe_suppression(21);
  set.set_side_lobe_auto(true);
  set.set_noise_rejection(22);
  set.set_target_separation(23);
  set.set_target_boost(24);
  set.set_doppler(wire::DOPPLER_APPROACHING);
  set.set_doppler_threshold_mps(3.5);
  set.set_mode(wire::BIRD);
  set.set_instrumented_range_m(50'000);
  set.set_rotation_rpm(48);
  set.set_bearing_alignment_deg(-12.5);
  set.set_antenna_height_m(33);
  auto& sector = *set.mutable_blanked_sectors()->add_sectors();
  sector.set_from_deg(350);
  sector.set_to_deg(10);
  const std::uint64_t version = desk_->settings_version();
  expect_ok(set);
  EXPECT_GT(desk_->settings_version(), version);

  const wire::Settings settings = desk_->settings(1, 0);
  const google::protobuf::Reflection& said = *set.GetReflection();
  std::vector<const google::protobuf::FieldDescriptor*> fields;
  said.ListFields(set, &fields);
  int compared = 0;
  for (const auto* field : fields) {
    const auto* same = settings.GetDescriptor()->FindFieldByName(field->name());
    if (same == nullptr || same->cpp_type() != field->cpp_type()) continue;
    const std::string name = field->name();
    ++compared;
    switch (field->cpp_type()) {
      case google::protobuf::FieldDescriptor::CPPTYPE_DOUBLE:
        EXPECT_EQ(said.GetDouble(set, field), settings.GetReflection()->GetDouble(settings, same))
            << name;
        break;
      case google::protobuf::FieldDescriptor::CPPTYPE_BOOL:
        EXPECT_EQ(said.GetBool(set, field), settings.GetReflection()->GetBool(settings, same))
            << name;
        break;
      case google::protobuf::FieldDescriptor::CPPTYPE_ENUM:
        EXPECT_EQ(said.GetEnumValue(set, field),
                  settings.GetReflection()->GetEnumValue(settings, same))
            << name;
        break;
      default:
        break;
    }
  }
  EXPECT_EQ(compared, 28) << "radar and blanked_sectors among them";
  EXPECT_TRUE(settings.standby());
  ASSERT_EQ(settings.blanked_sectors().sectors_size(), 1);
  EXPECT_EQ(settings.blanked_sectors().sectors(0).from_deg(), 350);
}

TEST_F(Desk, WithoutControlsTheSettingsAreThoseOfTheSet) {
  const wire::Settings settings = desk_->settings(0, 0);
  EXPECT_EQ(settings.rotation_rpm(), units_[0]->config().set.rpm);
  EXPECT_EQ(settings.antenna_height_m(), units_[0]->config().set.antenna_height_m);
  EXPECT_EQ(settings.instrumented_range_m(), 0.0);
  EXPECT_EQ(settings.doppler_threshold_mps(), 2.0);
}

TEST_F(Desk, TheLogNamesWhoWhereWhatAndBothValues) {
  wire::Set set = of(1);
  set.set_gain(60);
  set.set_transmit(false);
  set.set_mode(wire::HARBOUR);
  set.set_speed_kn(5);
  set.mutable_world()->set_sea_state(4);
  set.mutable_blanked_sectors()->add_sectors()->set_to_deg(20);
  expect_ok(set);
  const std::string who = "console 192.0.2.1:9: radar 1 view 0: ";
  EXPECT_THAT(lines_,
              ElementsAre(who + "gain 50 -> 60", who + "transmit on -> off",
                          who + "mode custom -> harbour", who + "blanked_sectors none -> 0 to 20",
                          who + "speed_kn 8 -> 5", who + "world.sea_state 0 -> 4"));
  lines_.clear();
  expect_ok(set);  // once more: nothing changes
  EXPECT_TRUE(lines_.empty()) << lines_.front();

  wire::Set weather = of(1);
  weather.mutable_world()->set_wind_kn(24.999999999999996);
  weather.mutable_world()->set_visibility_nm(0.5);
  expect_ok(weather);
  EXPECT_THAT(lines_, ElementsAre(who + "world.wind_kn not given -> 25",
                                  who + "world.visibility_nm clear -> 0.5"));
  lines_.clear();
  weather.Clear();
  weather.set_radar(1);
  weather.mutable_world()->set_visibility_nm(30.0);
  expect_ok(weather);
  desk_.reset();  // tells what it holds back
  EXPECT_THAT(lines_, testing::Contains(who + "world.visibility_nm 0.5 -> clear"));
}

TEST_F(Desk, ALockedControlRefusesTheWholeSetAndNamesItself) {
  lock(0, "gain");
  wire::Set set = of(0);
  set.set_sea(77);
  set.set_gain(80);
  const std::string before = settings_text(0);
  const wire::Reply reply = apply(set);
  EXPECT_EQ(reply.code(), wire::Reply::REFUSED);
  EXPECT_EQ(reply.text(), "gain: locked by the instructor; it stays 50");
  EXPECT_EQ(settings_text(0), before);
  EXPECT_THAT(desk_->settings(0, 0).locked(), ElementsAre("gain", "pulse"));

  set.set_gain(50);  // as it is
  expect_ok(set);
  set.set_gain(80);
  set.set_instructor(true);
  expect_ok(set);
  EXPECT_EQ(desk_->settings(0, 0).gain(), 80);

  wire::Set unlock = of(0);
  unlock.set_instructor(true);
  unlock.add_unlock("gain");
  unlock.add_unlock("pulse");
  expect_ok(unlock);
  EXPECT_THAT(desk_->settings(0, 0).locked(), ElementsAre());
  set.clear_instructor();
  set.set_gain(20);
  expect_ok(set);
  desk_.reset();  // tells what it holds back
  EXPECT_THAT(lines_, testing::Contains(HasSubstr("lock gain, pulse -> none")));
}

TEST_F(Desk, AScenarioMayLockFromTheStart) {
  wire::Set set = of(0);
  set.set_pulse(wire::PULSE_LONG);
  EXPECT_EQ(apply(set).code(), wire::Reply::REFUSED);
  set.set_radar(1);
  expect_ok(set);
  scenario_.mutable_own_ships(0)->mutable_radars(0)->add_locked("volume");
  EXPECT_THROW(initial_locks(scenario_), std::runtime_error);
}

TEST_F(Desk, ALockHoldsForAllViewsOfItsRadarAndForWhatRadarsShare) {
  lock(0, "gain");
  lock(0, "speed_kn");
  lock(2, "world");
  const std::uint32_t view = open_view(0, false);
  wire::Set gain = of(0, view);
  gain.set_gain(1);
  EXPECT_EQ(apply(gain).code(), wire::Reply::REFUSED);
  gain = of(1);
  gain.set_gain(1);
  expect_ok(gain);

  wire::Set speed = of(1);
  speed.set_speed_kn(3);
  EXPECT_EQ(apply(speed).text(), "speed_kn: locked by the instructor; it stays 8");
  speed.set_radar(2);
  expect_ok(speed);

  for (const std::uint32_t radar : {0u, 1u, 2u}) {
    wire::Set world = of(radar);
    world.mutable_world()->set_sea_state(5);
    EXPECT_EQ(apply(world).text(), "world.sea_state: locked by the instructor; it stays 0");
  }
}

TEST_F(Desk, WhatIsSetInAViewThatFollowsIsSetInTheOneItFollows) {
  const std::uint32_t view = open_view(0, true);
  wire::Set set = of(0, view);
  set.set_range_nm(12);  // more than the radar has now: it is the radar's own range
  set.set_gain(70);
  set.set_instrumented_range_m(30'000);
  expect_ok(set);
  EXPECT_EQ(desk_->settings(0, 0).range_nm(), 12);
  EXPECT_EQ(desk_->settings(0, 0).gain(), 70);
  EXPECT_EQ(desk_->settings(0, 0).instrumented_range_m(), 0);
  EXPECT_EQ(desk_->settings(0, view).instrumented_range_m(), 30'000);

  // The other way round, its own range goes with the range scale.
  wire::Set half = of(0);
  half.set_range_nm(6);
  half.set_sea(9);
  expect_ok(half);
  EXPECT_EQ(desk_->settings(0, view).range_nm(), 6);
  EXPECT_EQ(desk_->settings(0, view).sea(), 9);
  EXPECT_DOUBLE_EQ(desk_->settings(0, view).instrumented_range_m(), 15'000);

  lock(0, "instrumented_range_m");
  wire::Set reach = of(0, view);
  reach.set_instrumented_range_m(20'000);
  expect_ok(reach);
  reach.set_view(0);
  EXPECT_EQ(apply(reach).code(), wire::Reply::REFUSED);
}

TEST_F(Desk, AnInstrumentedRangeIsASixteenthOfTheRangeScaleToTwiceIt) {
  const double scale_m = 6 * 1852.0;
  for (const auto& [share, code] : {std::pair{1.0 / 16.0, wire::Reply::OK},
                                    {2.0, wire::Reply::OK},
                                    {0.0, wire::Reply::OK},
                                    {0.0624, wire::Reply::OUT_OF_RANGE},
                                    {2.0001, wire::Reply::OUT_OF_RANGE}}) {
    wire::Set set = of(0);
    set.set_instrumented_range_m(share * scale_m);
    EXPECT_EQ(apply(set).code(), code) << share;
  }
  wire::Set set = of(0);
  set.set_instrumented_range_m(3 * scale_m);
  EXPECT_EQ(apply(set).text(),
            "instrumented range: 33336 m is out of range; allowed: 694.5 to 22224 m, or 0 for the "
            "range scale");
}

TEST_F(Desk, ADrivenShipTakesNoOrders) {
  timeline_.drive(0, {.heading_deg = 45.0}, ScenarioTime{});
  timeline_.at(ScenarioTime(World::kTick));
  wire::Set set = of(1);
  set.set_course_deg(100);
  EXPECT_THAT(apply(set).text(), HasSubstr("a simulator outside drives this own ship"));
  set.set_radar(2);
  expect_ok(set);
}

TEST_F(Desk, SetsFromManyThreadsLoseNothing) {
  std::vector<std::thread> threads;
  const auto turn = [&](void (*change)(wire::Set&, double)) {
    threads.emplace_back([this, change] {
      for (int i = 1; i <= 300; ++i) {
        wire::Set set = of(2);
        change(set, i / 4.0);
        desk_->apply(set, "a thread");
        (void)desk_->settings(2, 0);
      }
    });
  };
  turn([](wire::Set& set, double value) { set.set_gain(value); });
  turn([](wire::Set& set, double value) { set.set_sea(value); });
  turn([](wire::Set& set, double value) { set.set_rain(value); });
  for (auto& thread : threads) thread.join();
  const wire::Settings settings = desk_->settings(2, 0);
  EXPECT_EQ(settings.gain(), 75.0);
  EXPECT_EQ(settings.sea(), 75.0);
  EXPECT_EQ(settings.rain(), 75.0);
  EXPECT_LE(lines_.size(), 30u) << "nine hundred changes, three of them told at once";
}

// The first ship has a class.
class ConDesk : public Desk {
 protected:
  ConDesk() : Desk("ship_class: coaster,") {}

  static wire::Set con_of(std::uint32_t radar, const wire::ConOrder& order) {
    wire::Set set = of(radar);
    *set.mutable_con() = order;
    return set;
  }
  wire::Reply apply_as(const std::string& origin, const wire::Set& set) {
    return desk_->apply(set, origin);
  }
};

wire::ConOrder taken() {
  wire::ConOrder order;
  order.set_take(true);
  return order;
}
wire::ConOrder rudder(double deg) {
  wire::ConOrder order;
  order.set_rudder_deg(deg);
  return order;
}
wire::ConOrder engine(double percent) {
  wire::ConOrder order;
  order.set_engine_percent(percent);
  return order;
}

TEST_F(ConDesk, OneConsoleHasTheConOfAShipOnAllHerRadars) {
  EXPECT_EQ(apply_as("console a", con_of(0, rudder(5))).code(), wire::Reply::OK) << "nobody's";
  EXPECT_EQ(apply_as("console a", con_of(0, taken())).code(), wire::Reply::OK);
  EXPECT_EQ(desk_->con_of(0), "console a");
  EXPECT_EQ(desk_->con_of(1), "console a");
  EXPECT_EQ(desk_->con_of(2), "");
  const wire::Reply reply = apply_as("console b", con_of(1, rudder(10)));
  EXPECT_EQ(reply.code(), wire::Reply::REFUSED);
  EXPECT_EQ(reply.text(),
            "console a has the con of F; ask for it to be given away, or take it as instructor");
  wire::Set speed = of(0);
  speed.set_speed_kn(5);
  EXPECT_EQ(apply_as("console b", speed).code(), wire::Reply::REFUSED);
  wire::ConOrder release;
  release.set_release(true);
  EXPECT_EQ(apply_as("console b", con_of(0, release)).code(), wire::Reply::REFUSED);
  EXPECT_EQ(apply_as("console a", con_of(0, rudder(10))).code(), wire::Reply::OK);

  wire::Set instructor = con_of(0, taken());
  instructor.set_instructor(true);
  EXPECT_EQ(apply_as("console b", instructor).code(), wire::Reply::OK);
  EXPECT_EQ(desk_->con_of(0), "console b");
  EXPECT_EQ(apply_as("console a", con_of(0, engine(10))).code(), wire::Reply::REFUSED);
  EXPECT_EQ(apply_as("console b", con_of(0, release)).code(), wire::Reply::OK);
  EXPECT_EQ(desk_->con_of(0), "");
  EXPECT_EQ(apply_as("console a", con_of(0, taken())).code(), wire::Reply::OK);
  KeptAudit audit;
  desk_->set_audit(&audit);
  desk_->leave("console b");
  EXPECT_EQ(desk_->con_of(0), "console a");
  {
    const AuditedRequest leaving(&audit, "console a", "Anna, trainee");
    desk_->leave("console a");
  }
  EXPECT_EQ(desk_->con_of(0), "") << "its connection has ended";
  ASSERT_EQ(audit.entries().size(), 1u);
  const AuditEntry freed = audit.entries().front();
  EXPECT_EQ(freed.who + "|" + freed.what + "|" + freed.before + "|" + freed.after,
            "Anna, trainee|" + timeline_.latest()->own_ships[0].name +
                ": con|console a|nobody: its console has left");
  desk_->set_audit(nullptr);
}

TEST_F(ConDesk, ALockOfCourseOrSpeedHoldsForWheelAndEngine) {
  timeline_.at(ScenarioTime(std::chrono::seconds(1)));
  lock(0, "course_deg");
  for (const std::uint32_t radar : {0u, 1u}) {
    EXPECT_EQ(apply(con_of(radar, rudder(5))).text(),
              "con.rudder_deg: locked by the instructor; it stays 0");
  }
  wire::ConOrder heading, hand, bow;
  heading.set_heading_deg(90);
  hand.set_steering(wire::STEERING_HAND);
  for (const wire::ConOrder& order : {heading, hand}) {
    EXPECT_EQ(apply(con_of(0, order)).code(), wire::Reply::REFUSED);
  }
  expect_ok(con_of(0, engine(40)));
  expect_ok(con_of(0, taken()));
  lock(1, "speed_kn");
  EXPECT_EQ(apply(con_of(0, engine(50))).code(), wire::Reply::REFUSED);
  wire::Set instructor = con_of(0, engine(50));
  instructor.set_instructor(true);
  expect_ok(instructor);
}

TEST_F(ConDesk, ALockOfTheConHoldsForAllItsOrders) {
  timeline_.at(ScenarioTime(std::chrono::seconds(1)));
  lock(1, "con");
  EXPECT_THAT(desk_->settings(0, 0).locked(), ElementsAre("con", "pulse"));
  EXPECT_EQ(apply(con_of(0, rudder(5))).code(), wire::Reply::REFUSED);
  EXPECT_EQ(apply(con_of(0, engine(5))).code(), wire::Reply::REFUSED);
  expect_ok(con_of(0, taken()));
}

}  // namespace
}  // namespace skerry::server
