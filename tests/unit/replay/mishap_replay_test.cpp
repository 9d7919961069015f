// A recorded exercise with a collision and a grounding is made again bit for bit, without a chart.
#include <gtest/gtest.h>

#include <cstring>
#include <string>
#include <vector>

#include "server/replay/replayed_world.hpp"
#include "server/world/scenario.hpp"

namespace skerry::server {
namespace {

constexpr const char* kScenario = R"(
name: Mishaps
seed: 5
sea: {depth_m: 40, state: 3}
exercise: {goal: Keep clear, freeze_on: [grounding]}
own_ships:
  - {name: Alfa, position: {lat: 60, lon: 2}, course_deg: 0, speed_kn: 12, ship_class: coaster, radars: [{}]}
  - {name: Bravo, position: {lat: 60.02, lon: 2}, course_deg: 90, speed_kn: 9, radars: [{}]}
targets:
  - {name: Kilo, position: {lat: 60.01, lon: 2}, course_deg: 180, speed_kn: 8, length_m: 90}
)";

std::string bits_of(const WorldState& state) {
  std::string bits;
  for (const auto* ships : {&state.own_ships, &state.targets}) {
    for (const ShipState& ship : *ships) {
      for (const double value :
           {ship.position.latitude_deg, ship.position.longitude_deg, ship.heading_deg,
            ship.speed_mps, ship.rate_of_turn_deg_s, ship.con ? ship.con->rudder_deg : 0.0}) {
        bits.append(reinterpret_cast<const char*>(&value), sizeof value);
      }
      bits += ship.aground ? 'a' : '-';
    }
  }
  for (const Contact& contact : state.log->contacts) {
    bits.append(reinterpret_cast<const char*>(&contact.when), sizeof contact.when);
    bits.append(reinterpret_cast<const char*>(&contact.position), sizeof contact.position);
    bits += contact.own_name + contact.other_name + contact.why;
  }
  for (const wire::ExerciseMark& mark : state.log->marks) bits += mark.SerializeAsString();
  return bits + (state.frozen ? 'f' : '-') + std::to_string(state.exercise.count());
}

ScenarioTime tick_time(std::uint64_t tick) {
  return ScenarioTime(World::kTick * static_cast<std::int64_t>(tick));
}

TEST(MishapReplay, OfACollisionAndAGroundingIsBitExact) {
  const scenario::Scenario scenario = parse_scenario(kScenario, "mishaps.yaml");
  Timeline live{World(scenario)};
  std::vector<WorldInput> inputs;
  const auto give = [&](const wire::ExerciseOrder& order, const char* by) {
    const auto ordered = live.order(order, by);
    ASSERT_FALSE(ordered.fault) << *ordered.fault;
    WorldInput& given = inputs.emplace_back();
    given.tick = ordered.tick;
    given.input.mutable_exercise()->set_tick(ordered.tick);
    *given.input.mutable_exercise()->mutable_order() = order;
    given.input.mutable_exercise()->set_by(by);
  };
  wire::ExerciseOrder rate, aground, go;
  rate.mutable_clock()->set_rate(7.3);  // so that ticks end within steps
  aground.set_aground(1);
  go.mutable_clock()->set_frozen(false);
  std::vector<std::string> states;
  for (std::uint64_t tick = 0; tick <= 1200; ++tick) {
    if (tick == 100) give(rate, "instructor");
    if (tick == 300) give(aground, "the chart");
    if (tick == 320) give(go, "instructor");
    states.push_back(bits_of(*live.at(tick_time(tick))));
  }
  const WorldStatePtr end = live.at(tick_time(1200));
  ASSERT_EQ(end->log->contacts.size(), 2u);
  EXPECT_EQ(end->log->contacts[0].kind, Contact::Kind::collision);
  EXPECT_EQ(end->log->contacts[1].kind, Contact::Kind::grounding);
  EXPECT_TRUE(live.at(tick_time(1200))->own_ships[1].aground);
  EXPECT_FALSE(end->frozen);

  ReplayedWorld again(scenario, inputs, [](const wire::Set&) { return true; });
  for (std::uint64_t tick = 0; tick <= 1200; ++tick) {
    ASSERT_EQ(bits_of(*again.at(tick_time(tick))), states[tick]) << "tick " << tick;
  }
  EXPECT_FALSE(again.fault());

  // Without the shore's order she sails on: the test can tell.
  inputs.erase(inputs.begin() + 1);
  ReplayedWorld afloat(scenario, inputs, [](const wire::Set&) { return true; });
  EXPECT_NE(bits_of(*afloat.at(tick_time(1200))), states[1200]);
}

}  // namespace
}  // namespace skerry::server
