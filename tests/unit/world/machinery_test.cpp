// Faults of an own ship's machinery.
#include "server/world/handling/machinery.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "server/world/environment.hpp"
#include "server/world/own_ship.hpp"
#include "server/world/scenario.hpp"
#include "server/world/world.hpp"
#include "tests/unit/world/random_faults.hpp"

namespace skerry::server {
namespace {

// One own ship, by herself, in a calm.
class Faulty {
 public:
  explicit Faulty(const std::string& keys)
      : scenario_(
            parse_scenario("name: s\nown_ships:\n  - name: F\n    position: {lat: 60, lon: 5}\n"
                           "    radars: [{}]\n" +
                               keys,
                           "f")),
        environment_(environment_of(scenario_)),
        ship_(scenario_.own_ships(0), environment_, World::kTick, 1) {}

  OwnShip& ship() { return ship_; }
  const ConState& con() const { return *state_.con; }
  const ShipState& after(double seconds) {
    const auto ticks = static_cast<int>(std::lround(seconds / in_seconds(World::kTick)));
    for (int i = 0; i < ticks; ++i) ship_.step(environment_);
    state_ = ship_.state();
    return state_;
  }
  void set(const std::function<void(wire::Faults&)>& change) {
    wire::Faults faults;
    change(faults);
    ship_.set_faults(faults);
  }
  void hand(double rudder_deg) {
    wire::ConOrder order;
    order.set_rudder_deg(rudder_deg);
    ship_.order(order);
  }
  void lever(double percent) {
    wire::ConOrder order;
    order.set_engine_percent(percent);
    ship_.order(order);
  }

 private:
  scenario::Scenario scenario_;
  Environment environment_;
  OwnShip ship_;
  ShipState state_;
};

constexpr const char* kContainer = "    ship_class: container\n    speed_kn: 16\n";

// Of a zig-zag 20/20: how long the rudder takes from 20 to 0, where the lag is
// not felt yet, and her first overshoot.
struct Swing {
  double rudder_s = 0.0, overshoot_deg = 0.0;
};
Swing zig_zag(bool one_pump) {
  Faulty ship(kContainer);
  ship.after(60);
  if (one_pump) ship.set([](wire::Faults& faults) { faults.set_steering_one_pump(true); });
  ship.hand(20.0);
  while (ship.after(0.1).heading_deg < 20.0 || ship.after(0.0).heading_deg > 180.0) {
  }
  ship.hand(-20.0);
  Swing swing;
  double most = 0.0;
  for (double heading = 20.0; heading >= most;) {
    heading = ship.after(0.1).heading_deg;
    most = std::max(most, heading);
    if (ship.con().rudder_deg > 0.0) swing.rudder_s += 0.1;
  }
  swing.overshoot_deg = most - 20.0;
  return swing;
}

TEST(Machinery, WithOnePumpTheRudderNeedsTwiceAsLongAndSheOvershootsMore) {
  const Swing both = zig_zag(false), one = zig_zag(true);
  std::printf("two pumps: %.1f s, %.2f deg; one: %.1f s, %.2f deg\n", both.rudder_s,
              both.overshoot_deg, one.rudder_s, one.overshoot_deg);
  EXPECT_NEAR(one.rudder_s / both.rudder_s, 2.0, 0.1);
  EXPECT_GT(one.overshoot_deg, both.overshoot_deg * 1.1);
}

TEST(Machinery, WithoutSteeringTheRudderStaysWhereItIs) {
  Faulty ship(kContainer);
  ship.hand(15.0);
  ship.after(30);
  ship.set([](wire::Faults& faults) { faults.set_steering_lost(true); });
  ship.after(0.2);  // a con shows the rudder of a tick ago
  const double held = ship.con().rudder_deg;
  EXPECT_NEAR(held, 15.0, 1e-6);
  ship.hand(-20.0);
  ship.after(60);
  EXPECT_EQ(ship.con().rudder_deg, held);
  EXPECT_EQ(ship.con().rudder_order_deg, -20.0) << "the wheel";
  ship.ship().order_course(270.0);
  ship.after(60);
  EXPECT_EQ(ship.con().rudder_deg, held);
  ship.hand(-20.0);
  ship.ship().set_faults({});
  ship.after(30);
  EXPECT_NEAR(ship.con().rudder_deg, -20.0, 1e-6) << "the order that stood";
}

TEST(Machinery, ATrippedEngineSlowsHerAsAStoppedShaftDoes) {
  Faulty tripped(kContainer), stopped(kContainer);
  tripped.lever(80.0);
  stopped.lever(80.0);
  const double before = tripped.after(60).speed_mps;
  stopped.after(60);
  tripped.set([](wire::Faults& faults) { faults.set_engine_tripped(true); });
  stopped.lever(0.0);
  for (int minute = 1; minute <= 10; ++minute) {
    const double speed = tripped.after(60).speed_mps;
    EXPECT_EQ(speed, stopped.after(60).speed_mps);
    if (minute % 5 == 0) std::printf("%d min: %.2f m/s of %.2f\n", minute, speed, before);
  }
  EXPECT_EQ(tripped.con().engine_percent, 80.0) << "as ordered";
  EXPECT_LT(tripped.con().shaft_rps, 0.05);
  EXPECT_LT(tripped.after(0).speed_mps, 0.6 * before);
  tripped.ship().set_faults({});
  EXPECT_GT(tripped.after(1800).speed_mps, 0.85 * before);
}

TEST(Machinery, WithoutThrustersTheyGiveNothing) {
  const auto turned = [](bool lost) {
    Faulty ship("    ship_class: ferry\n    speed_kn: 0\n");
    ship.lever(0.0);
    wire::ConOrder order;
    order.set_bow_thruster_percent(100.0);
    order.set_rudder_deg(0.0);
    ship.ship().order(order);
    if (lost) ship.set([](wire::Faults& faults) { faults.set_thrusters_lost(true); });
    return std::fabs(std::remainder(ship.after(120).heading_deg, 360.0));
  };
  EXPECT_GT(turned(false), 5.0);
  EXPECT_LT(turned(true), 1e-6);
}

TEST(Machinery, ABlackoutLosesAllOfIt) {
  Faulty ship(kContainer);
  ship.hand(10.0);
  ship.after(60);
  const double before = ship.after(0).speed_mps, held = ship.con().rudder_deg;
  ship.set([](wire::Faults& faults) { faults.set_blackout(true); });
  ship.hand(0.0);
  EXPECT_LT(ship.after(600).speed_mps, 0.7 * before);
  EXPECT_EQ(ship.con().rudder_deg, held);
  EXPECT_NEAR(held, 10.0, 1e-6);
}

TEST(Machinery, AShipWithoutAClassStopsAndGoesOnInHerTurn) {
  Faulty ship("    course_deg: 0\n    speed_kn: 20\n");
  ship.set([](wire::Faults& faults) { faults.set_engine_tripped(true); });
  const double fast = ship.after(0.1).speed_mps;
  EXPECT_LT(ship.after(1200).speed_mps, 0.01 * fast);
  EXPECT_NEAR(ship.after(0).ordered_speed_mps * 3600 / 1852, 20.0, 1e-9);
  ship.ship().set_faults({});
  EXPECT_GT(ship.after(1200).speed_mps, 0.99 * fast);

  ship.ship().order_course(170.0);
  const double rate = ship.after(20).rate_of_turn_deg_s;
  ASSERT_GT(rate, 0.1);
  ship.set([](wire::Faults& faults) { faults.set_steering_lost(true); });
  ship.ship().order_course(0.0);
  EXPECT_NEAR(ship.after(600).rate_of_turn_deg_s, rate, 0.2 * rate);
  ship.ship().set_faults({});
  EXPECT_NEAR(std::remainder(ship.after(600).heading_deg, 360.0), 0.0, 0.01);
}

TEST(Machinery, NoFaultsMakeHerMotionWild) {
  std::mt19937_64 random(5);
  for (const char* keys : {kContainer, "    ship_class: pilot\n    speed_kn: 14\n",
                           "    course_deg: 80\n    speed_kn: 12\n"}) {
    Faulty ship(keys);
    for (int i = 0; i < 200; ++i) {
      ship.ship().set_faults(random_faults(random));
      if (i % 3 == 0) ship.ship().order_course(static_cast<double>(random() % 360));
      if (i % 5 == 0) ship.ship().order_speed(static_cast<double>(random() % 10));
      const ShipState& now = ship.after(5);
      ASSERT_TRUE(std::isfinite(now.heading_deg) && std::isfinite(now.position.latitude_deg));
      ASSERT_LT(std::fabs(now.speed_mps), 20.0);
      ASSERT_LT(std::fabs(now.rate_of_turn_deg_s), 20.0);
    }
  }
}

}  // namespace
}  // namespace skerry::server
