// Collisions and groundings of an exercise.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <random>
#include <string>

#include <fmt/format.h>

#include "server/config/config_error.hpp"
#include "server/world/dead_reckoning.hpp"
#include "server/world/scenario.hpp"
#include "server/world/short_way.hpp"
#include "server/world/world.hpp"
#include "tests/unit/world/slow_outline.hpp"

namespace skerry::server {
namespace {

// Alfa and Kilo meet head on: 1852 m apart, 20 kn together, 100 m of ships: 170.30 s.
constexpr const char* kHeadOn = R"(
name: Head on
seed: 3
sea: {depth_m: 60}
own_ships:
  - {name: Alfa, position: {lat: 0, lon: 2}, course_deg: 0, speed_kn: 10, length_m: 100, radars: [{}]}
  - {name: Bravo, position: {lat: 0.3, lon: 2.4}, course_deg: 0, radars: [{}]}
targets:
  - {name: Kilo, position: {lat: 0.016748, lon: 2}, course_deg: 180, speed_kn: 10, length_m: 100}
)";
World mishap_world(const std::string& yaml) { return World(parse_scenario(yaml, "mishaps.yaml")); }

void run_seconds(World& world, double seconds) {
  for (int i = 0; i < static_cast<int>(10.0 * seconds); ++i) world.step();
}

wire::ExerciseOrder at_rate(double rate) {
  wire::ExerciseOrder order;
  order.mutable_clock()->set_rate(rate);
  return order;
}
wire::ExerciseOrder aground(std::uint32_t ship) {
  wire::ExerciseOrder order;
  order.set_aground(ship);
  return order;
}
wire::ExerciseOrder put_north(std::uint32_t ship, double lat, double lon, double speed_kn) {
  wire::ExerciseOrder order;
  order.mutable_own_ship()->set_own_ship(ship);
  order.mutable_own_ship()->set_latitude_deg(lat);
  order.mutable_own_ship()->set_longitude_deg(lon);
  order.mutable_own_ship()->set_heading_deg(0.0);
  order.mutable_own_ship()->set_speed_kn(speed_kn);
  return order;
}

TEST(Collision, IsToldWhenAndWhereItWas) {
  World world = mishap_world(kHeadOn);
  run_seconds(world, 200.0);
  const auto log = world.state().log;
  ASSERT_EQ(log->contacts.size(), 1u);
  const Contact& contact = log->contacts[0];
  EXPECT_EQ(contact.kind, Contact::Kind::collision);
  EXPECT_EQ(contact.own_name, "Alfa");
  EXPECT_EQ(contact.other_name, "Kilo");
  EXPECT_FALSE(contact.other_own);
  const double apart_m = short_way_between({0.0, 2.0}, {0.016748, 2.0}).north_m;
  const double closing_mps = 20.0 * 1852.0 / 3600.0;
  EXPECT_NEAR(in_seconds(contact.when), (apart_m - 100.0) / closing_mps, 0.01);
  EXPECT_NEAR(contact.relative_mps, closing_mps, 1e-9);
  ASSERT_EQ(log->marks.size(), 1u);
  EXPECT_EQ(log->marks[0].kind(), "collision");
  EXPECT_NEAR(log->marks[0].exercise_s(), in_seconds(contact.when), 1e-9);
  EXPECT_EQ(log->marks[0].text().find("Alfa and Kilo at 0.0"), 0u) << log->marks[0].text();
  EXPECT_FALSE(world.state().frozen);
}

TEST(Collision, IsTheSameAtTwentyTimes) {
  World slow = mishap_world(kHeadOn), fast = mishap_world(kHeadOn);
  fast.order(at_rate(20.0), "instructor");
  run_seconds(slow, 200.0);
  run_seconds(fast, 10.0);
  ASSERT_EQ(fast.state().log->contacts.size(), 1u);
  EXPECT_EQ(fast.state().log->contacts[0].when, slow.state().log->contacts[0].when);
  EXPECT_EQ(fast.state().log->contacts[0].position, slow.state().log->contacts[0].position);
}

TEST(Collision, FreezesTheClockWhereItWasIfTheSheetSaysSo) {
  const std::string yaml =
      std::string(kHeadOn) + "exercise: {goal: Keep clear, freeze_on: [collision]}\n";
  World world = mishap_world(yaml);
  world.order(at_rate(20.0), "instructor");
  run_seconds(world, 30.0);
  const WorldState state = world.state();
  ASSERT_EQ(state.log->contacts.size(), 1u);
  EXPECT_TRUE(state.frozen);
  const Duration after = state.exercise - state.log->contacts[0].when;
  EXPECT_GE(after, Duration::zero());
  EXPECT_LE(after, World::kTick) << "not where the tick on the air ends";

  World other =
      mishap_world(std::string(kHeadOn) + "exercise: {goal: x, freeze_on: [grounding]}\n");
  run_seconds(other, 200.0);
  EXPECT_EQ(other.state().log->contacts.size(), 1u);
  EXPECT_FALSE(other.state().frozen);
}

TEST(Collision, IsToldOnceUntilTheyHaveParted) {
  World world = mishap_world(kHeadOn);
  run_seconds(world, 175.0);
  ASSERT_EQ(world.state().log->contacts.size(), 1u);
  // Turned round while they still lie in one another: no new contact, and she runs away from Kilo.
  wire::ExerciseOrder away = put_north(0, 0.0082, 2.0, 20.0);
  away.mutable_own_ship()->set_heading_deg(180.0);
  world.order(away, "instructor");
  run_seconds(world, 60.0);
  EXPECT_EQ(world.state().log->contacts.size(), 1u);
  world.order(0, {}, 0.0);
  run_seconds(world, 400.0);
  ASSERT_EQ(world.state().log->contacts.size(), 2u) << "Kilo has caught her up";
  run_seconds(world, 600.0);
  EXPECT_EQ(world.state().log->contacts.size(), 2u);
}

TEST(Collision, OfTwoOwnShipsIsToldOfThePair) {
  World world = mishap_world(kHeadOn);
  world.order(put_north(1, 0.0002, 2.0, 0.0), "instructor");
  run_seconds(world, 1.0);
  const auto log = world.state().log;
  ASSERT_EQ(log->contacts.size(), 1u) << "she was put upon her";
  EXPECT_TRUE(log->contacts[0].other_own);
  EXPECT_EQ(log->contacts[0].own_name, "Alfa");
  EXPECT_EQ(log->contacts[0].other_name, "Bravo");
}

TEST(Collision, OfAShipThatWasPutPastAnotherIsNone) {
  World world = mishap_world(kHeadOn);
  run_seconds(world, 160.0);
  world.order(put_north(0, 0.02, 2.0, 10.0), "instructor");
  run_seconds(world, 60.0);
  EXPECT_TRUE(world.state().log->contacts.empty());
}

// Whoever is near is looked for once in some seconds; an order in between shall not be missed.
TEST(Collision, OfAShipThatIsOrderedToLeapIsFound) {
  World world = mishap_world(R"(
name: Leap
own_ships:
  - {name: Alfa, position: {lat: 0, lon: 2}, course_deg: 0, speed_time_constant_s: 0.1, length_m: 10,
     beam_m: 3, radars: [{}]}
  - {name: Bravo, position: {lat: 0.000723, lon: 2}, course_deg: 0, length_m: 10, beam_m: 3, radars: [{}]}
)");
  run_seconds(world, 1.0);
  world.order(0, std::nullopt, 60.0);
  run_seconds(world, 5.0);
  ASSERT_EQ(world.state().log->contacts.size(), 1u);
  EXPECT_EQ(world.state().log->contacts[0].other_name, "Bravo");
}

TEST(Collision, BelongsToTheSnapshotThatIsRestored) {
  World world = mishap_world(kHeadOn);
  wire::ExerciseOrder order;
  order.set_snapshot("before");
  run_seconds(world, 160.0);
  world.order(order, "instructor");
  run_seconds(world, 20.0);
  ASSERT_EQ(world.state().log->contacts.size(), 1u);
  order.set_restore("before");
  world.order(order, "instructor");
  run_seconds(world, 20.0);
  const auto log = world.state().log;
  ASSERT_EQ(log->contacts.size(), 2u) << "sailed again, told again";
  EXPECT_EQ(log->contacts[0].when, log->contacts[1].when);
}

TEST(Mishaps, HaveEventsHappen) {
  World world = mishap_world(std::string(kHeadOn) + R"(
events:
  - {name: crash, collides: Kilo, mark: Kilo was hit}
  - {name: other crash, collides: Bravo, mark: Bravo was hit}
  - {name: ashore, grounds: Bravo, mark: Bravo is ashore}
)");
  run_seconds(world, 180.0);
  EXPECT_TRUE(world.happened("crash"));
  EXPECT_FALSE(world.happened("other crash"));
  EXPECT_FALSE(world.happened("ashore"));
  world.order(aground(1), "the chart");
  run_seconds(world, 2.0);
  EXPECT_TRUE(world.happened("ashore"));
  EXPECT_THROW(parse_scenario(std::string(kHeadOn) + "events: [{name: a, grounds: Kilo}]\n", "x"),
               ConfigError)
      << "targets do not run aground";
}

// Random encounters, each against outlines made of points, a hundredth of a second apart.
TEST(Collision, OfRandomEncountersAgreesWithAFineSweep) {
  std::mt19937 random(7);
  const auto between = [&](double least, double most) {
    return std::uniform_real_distribution<double>(least, most)(random);
  };
  int collisions = 0;
  double worst_s = 0.0;
  for (int i = 0; i < 60; ++i) {
    // Both are at the middle of things after 30 s, but for a miss of some of their lengths.
    const double course_a = between(0.0, 360.0), course_b = between(0.0, 360.0);
    const double speed_a = between(2.0, 50.0), speed_b = between(2.0, 60.0);
    const auto back = [](double course, double kn, PlanePoint miss) {
      const double way = 30.0 * kn * 1852.0 / 3600.0, angle = course * 3.14159265358979 / 180.0;
      return advanced({10.0, 20.0},
                      {miss.north_m - way * std::cos(angle), miss.east_m - way * std::sin(angle)});
    };
    const GeoPoint a = back(course_a, speed_a, {});
    const GeoPoint b = back(course_b, speed_b, {between(-90.0, 90.0), between(-90.0, 90.0)});
    World world = mishap_world(fmt::format(R"(
name: Encounter
own_ships:
  - {{name: Alfa, position: {{lat: {}, lon: {}}}, course_deg: {}, speed_kn: {},
     length_m: {}, beam_m: {}, radars: [{{}}]}}
targets:
  - {{name: Kilo, position: {{lat: {}, lon: {}}}, course_deg: {}, speed_kn: {}, length_m: {}, beam_m: {}}}
)",
                                           a.latitude_deg, a.longitude_deg, course_a, speed_a,
                                           between(15.0, 90.0), between(2.0, 15.0), b.latitude_deg,
                                           b.longitude_deg, course_b, speed_b, between(15.0, 90.0),
                                           between(2.0, 15.0)));
    std::optional<double> exact_s, larger_s;
    for (int tick = 0; tick < 600; ++tick) {
      const WorldState state = world.state();
      for (int k = 0; k < 10; ++k) {
        const Duration into = World::kTick / 10 * k;
        const auto hull = [&](const ShipState& ship, double more_m) {
          const ShipPlace place = position_at(ship, into);
          const ShortWay way = short_way_between({10.0, 20.0}, place.position);
          return slow::Hull{{way.east_m, way.north_m},
                            ship.length_m + more_m,
                            ship.beam_m + more_m,
                            place.heading_deg};
        };
        const double now_s = in_seconds(state.exercise + into);
        const auto touches = [&](double more_m) {
          return slow::touch(hull(state.own_ships[0], more_m), hull(state.targets[0], more_m), 0.3);
        };
        if (!larger_s && touches(1.5)) larger_s = now_s;
        if (larger_s && !exact_s && touches(0.0)) exact_s = now_s;
      }
      world.step();
    }
    const auto log = world.state().log;
    ASSERT_LE(log->contacts.size(), 1u) << "encounter " << i;
    if (exact_s) {
      ASSERT_EQ(log->contacts.size(), 1u) << "encounter " << i;
    }
    if (log->contacts.empty()) continue;
    ++collisions;
    ASSERT_TRUE(larger_s) << "encounter " << i;
    const double told_s = in_seconds(log->contacts[0].when);
    EXPECT_GE(told_s, *larger_s - 0.01) << "encounter " << i;
    if (exact_s) {
      EXPECT_LE(told_s, *exact_s + 0.001) << "encounter " << i;
      worst_s = std::max(worst_s, *exact_s - told_s);
    }
  }
  EXPECT_GT(collisions, 10);
  EXPECT_LT(collisions, 55);
  std::printf("%d of 60 collided; told at most %.3f s before the reference\n", collisions, worst_s);
}

constexpr const char* kShallow = R"(
name: Shallow
sea: {depth_m: 60}
own_ships:
  - {name: Coaster, position: {lat: 60, lon: 2}, course_deg: 90, speed_kn: 10, ship_class: coaster, radars: [{}]}
  - {name: Plain, position: {lat: 60.1, lon: 2}, course_deg: 90, speed_kn: 10, radars: [{}]}
)";

void set_depth(World& world, double depth_m) {
  Environment environment = *world.environment();
  environment.depth_m = depth_m;
  world.set_environment(environment);
}

TEST(Grounding, IsWhereTheWaterIsNoDeeperThanHerDraught) {
  World world = mishap_world(kShallow);
  run_seconds(world, 20.0);
  EXPECT_TRUE(world.state().log->contacts.empty());
  const GeoPoint before = world.state().own_ships[0].position;
  set_depth(world, 3.0);
  run_seconds(world, 1.0);
  const WorldState state = world.state();
  ASSERT_EQ(state.log->contacts.size(), 1u) << "who has no class has no draught";
  EXPECT_EQ(state.log->contacts[0].kind, Contact::Kind::grounding);
  EXPECT_EQ(state.log->contacts[0].own_name, "Coaster");
  EXPECT_EQ(state.log->contacts[0].why.find("3.0 m of water, draught "), 0u);
  EXPECT_EQ(state.log->marks.back().kind(), "grounding");
  EXPECT_TRUE(state.own_ships[0].aground);
  EXPECT_FALSE(state.own_ships[1].aground);
  const ShortWay way = short_way_between(before, state.own_ships[0].position);
  EXPECT_LT(std::hypot(way.north_m, way.east_m), 5.2 * 0.3);
}

TEST(Grounding, HoldsHerWhateverIsOrderedUntilSheIsPutElsewhere) {
  World world = mishap_world(kShallow);
  run_seconds(world, 5.0);
  world.order(aground(0), "the chart");
  world.order(aground(1), "the chart");
  world.step();
  const WorldState there = world.state();
  for (std::size_t ship = 0; ship < 2; ++ship) world.order(ship, 180.0, 12.0);
  run_seconds(world, 60.0);
  const WorldState later = world.state();
  for (std::size_t ship = 0; ship < 2; ++ship) {
    const ShipState& now = later.own_ships[ship];
    EXPECT_TRUE(now.aground);
    EXPECT_EQ(now.position, there.own_ships[ship].position);
    EXPECT_EQ(now.heading_deg, there.own_ships[ship].heading_deg);
    EXPECT_EQ(now.speed_mps, 0.0);
    EXPECT_EQ(now.rate_of_turn_deg_s, 0.0);
    EXPECT_EQ(now.ordered_course_deg, 180.0);
  }
  EXPECT_EQ(later.log->contacts.size(), 2u) << "told once each";
  EXPECT_GT(later.own_ships[0].con->shaft_rps, 0.0) << "her engine runs";

  for (std::uint32_t ship = 0; ship < 2; ++ship) {
    world.order(put_north(ship, 60.2 + ship, 2.5, 8.0), "instructor");
  }
  run_seconds(world, 10.0);
  for (const ShipState& ship : world.state().own_ships) {
    EXPECT_FALSE(ship.aground);
    EXPECT_GT(ship.speed_mps, 3.5) << ship.name;
  }
  // Taken back: she lies where she lay.
  wire::ExerciseOrder undo;
  undo.set_undo(true);
  world.order(undo, "instructor");
  run_seconds(world, 10.0);
  EXPECT_TRUE(world.state().own_ships[1].aground);
  EXPECT_EQ(world.state().own_ships[1].position, there.own_ships[1].position);
}

TEST(Grounding, IsTakenBackByARestoredSnapshot) {
  World world = mishap_world(kShallow);
  wire::ExerciseOrder order;
  order.set_snapshot("afloat");
  world.order(order, "instructor");
  run_seconds(world, 5.0);
  world.order(aground(0), "the chart");
  run_seconds(world, 5.0);
  order.set_restore("afloat");
  world.order(order, "instructor");
  run_seconds(world, 5.0);
  EXPECT_FALSE(world.state().own_ships[0].aground);
  EXPECT_GT(world.state().own_ships[0].speed_mps, 4.0);
}

TEST(Grounding, IsRefusedOfNobody) {
  World world = mishap_world(kShallow);
  ASSERT_TRUE(world.fault_of(aground(2)));
  EXPECT_EQ(*world.fault_of(aground(2)), "own ship 2: there are 2, counted from 0");
}

TEST(Grounding, IsOverForAShipThatIsDrivenFromOutside) {
  World world = mishap_world(kHeadOn);
  run_seconds(world, 10.0);
  world.order(aground(0), "shore");
  run_seconds(world, 1.0);
  ASSERT_TRUE(world.state().own_ships[0].aground);
  const ScenarioTime now = world.state().time;
  world.drive(0, {.position = GeoPoint{0.01, 2.0}, .speed_mps = 5.0}, now);
  run_seconds(world, 1.0);
  EXPECT_FALSE(world.state().own_ships[0].aground);
}

}  // namespace
}  // namespace skerry::server
