// An exercise: its clock, what an instructor orders, snapshots, undo and events.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <string>

#include "echo/kernel/hash.hpp"
#include "server/world/dead_reckoning.hpp"
#include "server/world/scenario.hpp"
#include "server/world/short_way.hpp"
#include "server/world/world.hpp"

namespace skerry::server {
namespace {

constexpr const char* kScenario = R"(
name: Exercise
seed: 7
sea: {state: 3, wind_from_deg: 200, depth_m: 60, current_kn: 1, current_set_deg: 40}
artefacts: {interference: false}
rain:
  - {position: {lat: 60.1, lon: 2.1}, drift_kn: 20, drift_deg: 45}
areas:
  - {name: Box, corners: [{lat: 59.99, lon: 2.02}, {lat: 60.05, lon: 2.02}, {lat: 60.05, lon: 2.2}, {lat: 59.99, lon: 2.2}]}
own_ships:
  - {name: Alfa, position: {lat: 60, lon: 2}, course_deg: 90, speed_kn: 12, ship_class: coaster, radars: [{}]}
  - {name: Bravo, position: {lat: 60.05, lon: 2}, course_deg: 180, speed_kn: 10}
targets:
  - {name: Kilo, position: {lat: 60, lon: 2.2}, course_deg: 270, speed_kn: 15}
  - {name: Buoy, kind: buoy, position: {lat: 60.01, lon: 2.05}}
)";

World world_of(const std::string& more = "") {
  return World(parse_scenario(kScenario + more, "exercise.yaml"));
}

// All numbers of the ships as bits.
std::string ship_bits(const WorldState& state) {
  std::string bits;
  for (const auto* ships : {&state.own_ships, &state.targets}) {
    for (const ShipState& ship : *ships) {
      for (const double value : {ship.position.latitude_deg, ship.position.longitude_deg,
                                 ship.heading_deg, ship.course_over_ground_deg, ship.speed_mps,
                                 ship.rate_of_turn_deg_s, ship.ordered_course_deg}) {
        bits.append(reinterpret_cast<const char*>(&value), sizeof value);
      }
    }
  }
  return bits;
}

void run_ticks(World& world, int ticks) {
  for (int i = 0; i < ticks; ++i) world.step();
}

wire::ExerciseOrder clock(std::optional<bool> frozen, std::optional<double> rate) {
  wire::ExerciseOrder order;
  if (frozen) order.mutable_clock()->set_frozen(*frozen);
  if (rate) order.mutable_clock()->set_rate(*rate);
  return order;
}

wire::ExerciseOrder snapshot(const std::string& name) {
  wire::ExerciseOrder order;
  order.set_snapshot(name);
  return order;
}
wire::ExerciseOrder restore(const std::string& name) {
  wire::ExerciseOrder order;
  order.set_restore(name);
  return order;
}
wire::ExerciseOrder undo() {
  wire::ExerciseOrder order;
  order.set_undo(true);
  return order;
}

TEST(Exercise, TwentyTimesAsFastIsTheSameWayBitForBit) {
  World slow = world_of(), fast = world_of();
  fast.order(clock(std::nullopt, 20.0), "test");
  for (int i = 0; i < 300; ++i) {  // ten minutes
    run_ticks(slow, 20);
    run_ticks(fast, 1);
    ASSERT_EQ(slow.state().exercise, fast.state().exercise);
    ASSERT_TRUE(ship_bits(slow.state()) == ship_bits(fast.state())) << i;
  }
  EXPECT_EQ(fast.state().time.time_since_epoch(), std::chrono::seconds(30));
  EXPECT_EQ(fast.state().exercise, std::chrono::seconds(600));
}

TEST(Exercise, ATenthAsFastPassesThroughTheSamePlaces) {
  World real = world_of(), slow = world_of();
  slow.order(clock(std::nullopt, 0.1), "test");
  for (int i = 0; i < 50; ++i) {
    const std::string before = ship_bits(slow.state());
    EXPECT_TRUE(ship_bits(real.state()) == before);
    run_ticks(slow, 4);
    // In between too she moves, as far as she should.
    const ShipPlace there = position_at(real.state().own_ships[0], std::chrono::milliseconds(40));
    const ShortWay off = short_way_between(there.position, slow.state().own_ships[0].position);
    EXPECT_LT(std::hypot(off.north_m, off.east_m), 1e-6);
    run_ticks(slow, 6);
    run_ticks(real, 1);
  }
}

TEST(Exercise, StandsWhileItIsFrozen) {
  World world = world_of(), other = world_of();
  run_ticks(world, 200);
  run_ticks(other, 200);
  world.order(clock(true, std::nullopt), "test");
  const std::string before = ship_bits(world.state());
  run_ticks(world, 137);
  const WorldState frozen = world.state();
  EXPECT_TRUE(ship_bits(frozen) == before);
  EXPECT_EQ(frozen.time.time_since_epoch(), World::kTick * 337);
  EXPECT_EQ(frozen.exercise, World::kTick * 200);
  for (const ShipState& ship : {frozen.own_ships[0], frozen.targets[0]}) {
    const ShipPlace later = position_at(ship, std::chrono::seconds(5));
    EXPECT_EQ(later.position, ship.position);
    EXPECT_EQ(later.heading_deg, ship.heading_deg);
    EXPECT_GT(ship.speed_mps, 1.0) << "her speed is told as it was";
  }
  EXPECT_EQ(frozen.rain[0].centre, other.state().rain[0].centre);
  world.order(clock(false, std::nullopt), "test");
  run_ticks(world, 500);
  run_ticks(other, 500);
  EXPECT_TRUE(ship_bits(world.state()) == ship_bits(other.state()));
  EXPECT_EQ(world.state().rain[0].centre, other.state().rain[0].centre);
}

TEST(Exercise, ARestoredSnapshotHasTheSameFuture) {
  World world = world_of();
  run_ticks(world, 333);
  world.order(0, 30.0, std::nullopt);
  world.order(snapshot("before the turn"), "test");
  run_ticks(world, 600);
  const std::string first = ship_bits(world.state());
  const Duration then = world.state().exercise;

  Environment storm = *world.environment();
  storm.wind_kn = 60.0;
  storm.visibility_nm = 0.1;
  world.set_environment(storm);
  world.order(0, 300.0, 3.0);
  run_ticks(world, 400);
  world.order(restore("before the turn"), "test");
  EXPECT_EQ(world.tick(), 1333u) << "radars go on";
  run_ticks(world, 600);
  EXPECT_EQ(world.state().exercise, then);
  EXPECT_EQ(world.environment()->visibility_nm, kClearVisibility_nm);
  EXPECT_TRUE(ship_bits(world.state()) == first);
  ASSERT_EQ(world.state().log->snapshots.size(), 1u);
  EXPECT_EQ(world.state().log->marks.back().text(), "restored \"before the turn\"");
}

TEST(Exercise, SaysWhatIsWrongWithAnOrder) {
  World world = world_of();
  const auto fault = [&](const wire::ExerciseOrder& order) {
    const auto text = world.fault_of(order);
    return text ? *text : std::string("none");
  };
  EXPECT_EQ(fault(restore("Fred")),
            "restore: there is no snapshot \"Fred\"; allowed: none was taken");
  EXPECT_EQ(fault(undo()), "undo: there is nothing to take back");
  EXPECT_EQ(fault(snapshot("")), "snapshot: 0 characters; allowed: 1 to 64");
  EXPECT_NE(fault(wire::ExerciseOrder()).find("says nothing"), std::string::npos);
  wire::ExerciseOrder put;
  put.mutable_own_ship()->set_own_ship(2);
  EXPECT_EQ(fault(put), "own ship 2: there are 2, counted from 0");
  put.mutable_own_ship()->set_own_ship(1);
  put.mutable_own_ship()->set_latitude_deg(60.0);
  EXPECT_NE(fault(put).find("one of them is missing"), std::string::npos);
  wire::ExerciseOrder broken;
  broken.mutable_fault()->add_change("gyro");
  EXPECT_NE(fault(broken).find("there is no fault \"gyro\""), std::string::npos);
  wire::ExerciseOrder target;
  target.mutable_target()->set_target(1);
  EXPECT_NE(fault(target), "none") << "a buoy takes no orders";
  target.mutable_target()->set_target(77);
  EXPECT_NE(fault(target), "none");
  wire::ExerciseOrder text;
  text.mutable_text()->set_text(std::string(501, 'x'));
  EXPECT_EQ(fault(text), "text: 501 characters; allowed: 1 to 500");
  for (int i = 0; i < 16; ++i) world.order(snapshot(std::to_string(i)), "test");
  EXPECT_NE(fault(snapshot("one more")), "none");
  EXPECT_EQ(fault(snapshot("3")), "none") << "a name may be used again";
}

TEST(Exercise, UndoTakesBackTheLastChange) {
  World world = world_of();
  run_ticks(world, 50);
  const double wind = world.environment()->sea.wind_from_deg;

  wire::ExerciseOrder fault;
  fault.mutable_fault()->set_own_ship(0);
  fault.mutable_fault()->mutable_faults()->set_gyro_bias_deg(5.0);
  world.order(fault, "first");
  Environment other = *world.environment();
  other.sea.wind_from_deg = 10.0;
  other.visibility_nm = 0.5;
  world.set_environment(other);
  wire::ExerciseOrder put;
  put.mutable_own_ship()->set_own_ship(1);
  put.mutable_own_ship()->set_latitude_deg(61.0);
  put.mutable_own_ship()->set_longitude_deg(3.0);
  world.order(put, "second");
  wire::ExerciseOrder fresh;
  fresh.mutable_new_target()->set_latitude_deg(60.2);
  fresh.mutable_new_target()->set_longitude_deg(2.2);
  fresh.mutable_new_target()->set_course_deg(180.0);
  fresh.mutable_new_target()->set_speed_kn(8.0);
  world.order(fresh, "second");

  EXPECT_EQ(world.state().targets.size(), 2u);
  EXPECT_EQ(world.state().targets[1].number, 2u);
  EXPECT_NE(world.state().targets[1].mmsi, 0u);
  EXPECT_EQ(world.state().log->last_by, "second");
  EXPECT_EQ(world.state().log->can_undo, "the new target Target 3");
  world.order(undo(), "test");
  run_ticks(world, 1);
  EXPECT_EQ(world.state().targets.size(), 1u);
  EXPECT_NEAR(world.state().own_ships[1].position.latitude_deg, 61.0, 1e-3);
  world.order(undo(), "test");
  EXPECT_NEAR(world.state().own_ships[1].position.latitude_deg, 60.05, 1e-2);
  EXPECT_EQ(world.state().own_ships[0].faults->faults.gyro_bias_deg(), 5.0);
  world.order(undo(), "test");
  EXPECT_EQ(world.environment()->sea.wind_from_deg, wind);
  EXPECT_EQ(world.environment()->visibility_nm, kClearVisibility_nm);
  world.order(undo(), "test");
  EXPECT_EQ(world.state().own_ships[0].faults, nullptr);
  EXPECT_EQ(world.state().log->can_undo, "");
  EXPECT_TRUE(world.fault_of(undo()).has_value());
}

TEST(Exercise, AFaultAloneLeavesTheOthers) {
  World world = world_of();
  wire::ExerciseOrder order;
  order.mutable_fault()->mutable_faults()->set_gyro_bias_deg(5.0);
  order.mutable_fault()->mutable_faults()->set_log_lost(true);
  world.order(order, "test");
  order.mutable_fault()->mutable_faults()->Clear();
  order.mutable_fault()->add_change("log_lost");
  order.mutable_fault()->add_change("gnss_lost");
  order.mutable_fault()->mutable_faults()->set_gnss_lost(true);
  world.order(order, "test");
  const wire::Faults faults = world.state().own_ships[0].faults->faults;
  EXPECT_EQ(faults.gyro_bias_deg(), 5.0);
  EXPECT_FALSE(faults.log_lost());
  EXPECT_TRUE(faults.gnss_lost());
}

TEST(Exercise, ADriftingGyroTurnsAShipWhoseAutopilotKeepsAHeading) {
  World world = world_of();
  run_ticks(world, 600);
  const double before = world.state().own_ships[0].heading_deg;
  wire::ExerciseOrder order;
  order.mutable_fault()->mutable_faults()->set_gyro_drift_deg_min(2.0);
  world.order(order, "test");
  run_ticks(world, 6000);  // ten minutes: the gyro says 20 degrees more than is so
  EXPECT_NEAR(world.state().own_ships[0].heading_deg, before - 20.0, 2.0);
  wire::ExerciseOrder well;
  well.mutable_fault();
  world.order(well, "test");
  run_ticks(world, 3000);
  EXPECT_NEAR(world.state().own_ships[0].heading_deg, before, 2.0);
}

TEST(Exercise, EventsHappenByTimeOrderAndPlace) {
  World world = world_of(R"(
events:
  - {name: Squall, at_min: 1, text: A squall comes,
     weather: {sea_state: 5, wind_kn: 40, visibility_nm: 0.5, rain: [{latitude_deg: 60.02, longitude_deg: 2.0}]}}
  - {name: Later, after: Squall, after_min: 0.5, own_ships: [{own_ship: Alfa, faults: {gyro_lost: true}, text: Your gyro is gone}]}
  - {name: Near, ship: Alfa, within_of: Kilo, within_nm: 4, own_ships: [{own_ship: Bravo, course_deg: 200}]}
  - {name: Inside, ship: Alfa, enters: Box, mark: in the box}
  - {name: Never, ship: Bravo, faster_than_kn: 30}
  - {name: Slow, ship: Bravo, slower_than_kn: 11, freeze: true, at_min: 9}
)");
  const auto at = [&](const char* event) {
    const auto when = world.happened(event);
    return when ? in_seconds(*when) : -1.0;
  };
  run_ticks(world, 599);
  EXPECT_EQ(at("Squall"), -1.0);
  run_ticks(world, 1);
  EXPECT_EQ(world.happened("Squall"), std::chrono::seconds(60));
  EXPECT_EQ(world.environment()->sea.state, 5.0);
  EXPECT_EQ(world.environment()->visibility_nm, 0.5);
  EXPECT_EQ(world.environment()->rain.size(), 2u);
  EXPECT_EQ(world.state().log->texts[1].text, "A squall comes");
  EXPECT_FALSE(world.environment()->artefacts.interference) << "it stays as the scenario has it";
  run_ticks(world, 400);
  EXPECT_EQ(world.happened("Later"), std::chrono::seconds(90));
  EXPECT_TRUE(world.state().own_ships[0].faults->faults.gyro_lost());
  EXPECT_EQ(world.state().log->texts[0].text, "Your gyro is gone");
  EXPECT_EQ(world.state().log->texts[0].count, 2u);
  EXPECT_EQ(world.state().log->texts[1].count, 1u);

  // 0.02 deg of longitude are 0.6 NM, at some 12.7 kn over ground.
  while (!world.happened("Inside") && world.tick() < 4000) run_ticks(world, 1);
  EXPECT_NEAR(world.state().own_ships[0].position.longitude_deg, 2.02, 0.0005);
  while (!world.happened("Near") && world.tick() < 6000) run_ticks(world, 1);
  const ShortWay apart =
      short_way_between(world.state().own_ships[0].position, world.state().targets[0].position);
  EXPECT_NEAR(std::hypot(apart.north_m, apart.east_m) / 1852.0, 4.0, 0.02);
  run_ticks(world, 2);
  EXPECT_EQ(world.state().own_ships[1].ordered_course_deg, 200.0);
  while (!world.state().frozen && world.tick() < 9000) run_ticks(world, 1);
  EXPECT_EQ(world.happened("Slow"), std::chrono::seconds(540));
  EXPECT_EQ(at("Never"), -1.0);
  std::string events;
  for (const wire::ExerciseMark& mark : world.state().log->marks) {
    if (mark.kind() == "event") events += mark.text() + " ";
  }
  EXPECT_EQ(events, "Squall Later Inside Near Slow ");
}

TEST(Exercise, WrongEventsAreRefusedAllAtOnce) {
  const std::string wrong = std::string(kScenario) + R"(
events:
  - {name: A}
  - {name: A, at_min: 1}
  - {name: C, after: Z}
  - {name: D, ship: Nobody, enters: Nowhere}
  - {name: E, enters: Box}
  - {name: F, ship: Alfa}
  - {name: G, at_min: 1, targets: [{target_name: Buoy, removed: true}]}
  - {name: H, at_min: 1, own_ships: [{own_ship: Kilo}]}
  - {name: I, at_min: 1, weather: {sea_state: 9}}
)";
  try {
    parse_scenario(wrong, "wrong.yaml");
    FAIL() << "it was accepted";
  } catch (const ConfigError& error) {
    const std::string text = error.what();
    for (const char* each :
         {"says not when", "is there already", "no event before this one called \"Z\"",
          "no ship \"Nobody\"", "no area \"Nowhere\"", "a condition without the ship",
          "given without a condition", "no ship among the targets called \"Buoy\"",
          "no own ship \"Kilo\"", "9 is out of range"}) {
      EXPECT_NE(text.find(each), std::string::npos) << each << "\n" << text;
    }
  }
}

// An order by chance, of the kinds that an instructor gives.
void give_by_chance(World& world, std::uint64_t n) {
  const auto share = [&](std::uint64_t salt) {
    return static_cast<double>(echo::mixed(n, salt) >> 11) * 0x1p-53;
  };
  wire::ExerciseOrder order;
  switch (echo::mixed(n, 1) % 11) {
    case 0:
      order = clock(share(2) < 0.3, 0.1 + 19.9 * share(3));
      break;
    case 1:
      order.mutable_new_target()->set_latitude_deg(60.0 + 0.2 * share(2));
      order.mutable_new_target()->set_longitude_deg(2.0 + 0.2 * share(3));
      order.mutable_new_target()->set_course_deg(360.0 * share(4));
      order.mutable_new_target()->set_speed_kn(12.0 * share(5));
      break;
    case 2:
      order.mutable_target()->set_target(echo::mixed(n, 2) % 4);
      order.mutable_target()->set_course_deg(360.0 * share(3));
      break;
    case 3:
      order.mutable_target()->set_target(echo::mixed(n, 2) % 4);
      order.mutable_target()->set_latitude_deg(60.0 + 0.2 * share(3));
      order.mutable_target()->set_longitude_deg(2.0 + 0.2 * share(4));
      break;
    case 4:
      order.mutable_own_ship()->set_own_ship(echo::mixed(n, 2) % 2);
      order.mutable_own_ship()->set_heading_deg(360.0 * share(3));
      break;
    case 5:
      order.mutable_fault()->set_own_ship(echo::mixed(n, 2) % 2);
      order.mutable_fault()->mutable_faults()->set_gyro_drift_deg_min(share(3));
      break;
    case 6:
      order = snapshot(std::to_string(echo::mixed(n, 2) % 3));
      break;
    case 7:
      order = restore(std::to_string(echo::mixed(n, 2) % 3));
      break;
    case 8:
      order = undo();
      break;
    case 9:
      world.order(echo::mixed(n, 2) % 2, 360.0 * share(3), 12.0 * share(4));
      return;
    default: {
      Environment environment = *world.environment();
      environment.wind_kn = 50.0 * share(2);
      environment.visibility_nm = 0.02 + 5.0 * share(3);
      world.set_environment(std::move(environment));
      return;
    }
  }
  if (!world.fault_of(order)) world.order(order, "test");
}

TEST(Exercise, TwoHundredChangesInTenMinutesAreTheSameAgain) {
  const auto run = [](std::uint64_t seed) {
    World world = world_of();
    std::string bits;
    for (std::uint64_t n = 0; n < 200; ++n) {
      run_ticks(world, 30);
      give_by_chance(world, seed + n);
      bits += ship_bits(world.state());
    }
    return bits;
  };
  EXPECT_TRUE(run(0) == run(0));
  EXPECT_FALSE(run(0) == run(1000)) << "the test would see a difference";
}

TEST(Exercise, TellsEveryShipToItsInstructors) {
  World world = world_of();
  run_ticks(world, 100);
  wire::ExerciseOrder mark;
  mark.set_mark("look here");
  world.order(mark, "console 1");
  wire::ExerciseState told;
  world.tell(told);
  ASSERT_EQ(told.ships_size(), 3) << "two own ships and a target; a buoy is none";
  EXPECT_TRUE(told.ships(0).own());
  EXPECT_EQ(told.ships(0).ship_class(), "coaster");
  EXPECT_EQ(told.ships(2).name(), "Kilo");
  EXPECT_EQ(told.ships(2).number(), 0u);
  EXPECT_NEAR(told.ships(2).speed_kn(), 15.0, 1e-9);
  EXPECT_EQ(told.exercise_s(), 10.0);
  ASSERT_EQ(told.marks_size(), 1);
  EXPECT_EQ(told.marks(0).text(), "look here");
  EXPECT_EQ(told.last_by(), "console 1");
  EXPECT_EQ(told.orders(), 1u);
}

}  // namespace
}  // namespace skerry::server
