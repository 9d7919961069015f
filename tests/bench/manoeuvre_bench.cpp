// How ships of each class handle, and what that costs: circles, zig-zags, stopping; error by step.
#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <string>
#include <vector>

#include "server/world/class_ship.hpp"
#include "server/world/dead_reckoning.hpp"
#include "server/world/handling/manoeuvres.hpp"
#include "server/world/rhumb_step.hpp"
#include "server/world/short_way.hpp"

namespace skerry::server {
namespace {

void print_table() {
  fmt::print(
      "At full service speed, deep calm water; L: the ship's length.  IMO MSC.137(76): advance "
      "4.5 L,\ntactical diameter 5 L, stopping 15 L; ! exceeds it.\n\n");
  fmt::print(
      "| class | source | L m | kn | advance | transfer | tactical | steady kn | deg/min | "
      "10/10 1st, 2nd | 20/20 1st | stopping "
      "|\n|---|---|---|---|---|---|---|---|---|---|---|---|\n");
  for (const ShipClass& ship : ship_classes()) {
    const double length = ship.hull->length_m();
    const Trial trial = trial_at_service(ship);
    const TurningCircle c = turning_circle(ship, trial, ship.gear.limit_deg);
    const ZigZag ten = zig_zag(ship, trial, 10.0, 10.0), twenty = zig_zag(ship, trial, 20.0, 20.0);
    const Stopping stop = stopping(ship, trial);
    const auto over = [&](double metres, double lengths) {
      return fmt::format("{:.2f}{}", metres / length, metres > lengths * length ? " !" : "");
    };
    fmt::print(
        "| {} | {} | {:.0f} | {:.1f} | {} | {:.2f} | {} | {:.1f} | {:.0f} | {:.1f}, {:.1f} | "
        "{:.1f} | {} |\n",
        ship.key, ship.source, length, ship.service_speed_mps * 3.6 / 1.852, over(c.advance_m, 4.5),
        c.transfer_m / length, over(c.tactical_diameter_m, 5.0), c.speed_mps * 3.6 / 1.852,
        std::fabs(c.rate_deg_s) * 60.0, ten.overshoot_deg[0], ten.overshoot_deg[1],
        twenty.overshoot_deg[0], over(stop.track_reach_m, 15.0));
  }
}

// An hour of rudder orders that change every minute; the place at its end.
ShortWay wandered(const ShipClass& ship, double step_s) {
  DynamicState state = under_way(ship, 0.0, 0.8 * ship.service_speed_mps);
  ActuatorOrders orders{.shaft_rps = state.shaft_rps};
  ShortWay at;
  std::uint64_t chance = 7;
  const auto steps = static_cast<int>(std::lround(60.0 / step_s));
  for (int minute = 0; minute < 60; ++minute) {
    chance = chance * 6364136223846793005ull + 1442695040888963407ull;
    orders.rudder_deg = static_cast<double>(chance >> 40 & 0x3f) - 32.0;
    for (int i = 0; i < steps; ++i) {
      const WayMade way = advance(ship, orders, {}, step_s, state);
      at.north_m += way.north_m;
      at.east_m += way.east_m;
    }
  }
  return at;
}

void print_steps() {
  fmt::print(
      "\nOff after an hour of wild rudder orders, m, against steps of 0.0025 s; the server's step "
      "is "
      "0.05 s\n\n| class | 0.2 s | 0.1 s | 0.05 s | 0.025 s | ns a step "
      "|\n|---|---|---|---|---|---|\n");
  for (const ShipClass& ship : ship_classes()) {
    const ShortWay fine = wandered(ship, 0.0025);
    fmt::print("| {} |", ship.key);
    for (const double step : {0.2, 0.1, 0.05, 0.025}) {
      const ShortWay at = wandered(ship, step);
      fmt::print(" {:.1e} |", std::hypot(at.north_m - fine.north_m, at.east_m - fine.east_m));
    }
    const auto begin = std::chrono::steady_clock::now();
    wandered(ship, 0.05);
    const std::chrono::duration<double, std::nano> took = std::chrono::steady_clock::now() - begin;
    fmt::print(" {:.0f} |\n", took.count() / 72000.0);
  }
}

// A day under the autopilot: new course and speed every ten minutes, wind, waves and current.
// `more_kn`: on top of her first speed.
GeoPoint day(const ShipClass& ship, double sea_state, int steps_per_tick, double more_kn) {
  scenario::OwnShip model;
  model.mutable_position()->set_lat(60.0);
  model.set_speed_kn(0.7 * ship.service_speed_mps * 3.6 / 1.852 + more_kn);
  ClassShip sailing(ship, model, 3, steps_per_tick);
  Environment environment;
  environment.sea.state = sea_state;
  environment.wind_kn = 18.6;
  environment.sea.wind_from_deg = 290.0;
  environment.current_set_deg = 40.0;
  environment.current_kn = 1.6;
  ShipState state;
  state.position = {60.0, 4.0};
  constexpr Duration kTick = std::chrono::milliseconds(100);
  for (int tick = 0; tick < 864'000; ++tick) {
    if (tick % 6000 == 0) {
      sailing.order_course(137.0 * (tick / 6000));
      sailing.order_speed((0.5 + 0.1 * (tick / 6000 % 5)) * ship.service_speed_mps);
    }
    sailing.begin_tick(environment, kTick * tick, kTick, state);
    const ShipPlace place = position_at(state, kTick);
    state.position = place.position;
    state.heading_deg = place.heading_deg;
    state.course_over_ground_deg = place.course_over_ground_deg;
  }
  return state.position;
}

// Where a nudge of her first speed moves her as far as another step does, waves rule a small ship's
// autopilot, and no step can foretell her.
void print_day() {
  fmt::print(
      "\nOff after a day under the autopilot in 18.6 kn of wind, m: two steps a tick against "
      "twenty, "
      "and after a nudge of 1e-9 kn\n\n"
      "| class | sea state 2 | nudged | sea state 4 | nudged |\n|---|---|---|---|---|\n");
  for (const ShipClass& ship : ship_classes()) {
    fmt::print("| {} |", ship.key);
    for (const double sea_state : {2.0, 4.0}) {
      const GeoPoint as_is = day(ship, sea_state, 2, 0.0);
      for (const GeoPoint other : {day(ship, sea_state, 20, 0.0), day(ship, sea_state, 2, 1e-9)}) {
        const ShortWay off = short_way_between(as_is, other);
        fmt::print(" {:.1e} |", std::hypot(off.north_m, off.east_m));
      }
      std::fflush(stdout);
    }
    fmt::print("\n");
  }
}

}  // namespace
}  // namespace skerry::server

int main(int argc, char** argv) {
  bool quick = false, with_day = false;
  for (int i = 1; i < argc; ++i) {
    const std::string option = argv[i];
    if (option.starts_with("--benchmark_min_time")) {
      quick = true;  // as the tests run all benches
    } else if (option == "--day") {
      with_day = true;
    } else {
      fmt::print(
          "usage: manoeuvre_bench [--day]\n  circles, zig-zags and stopping of every class, and "
          "the "
          "error of the step\n  --day: after a day, too (8 min)\n");
      return option == "--help" ? 0 : 2;
    }
  }
  skerry::server::print_table();
  if (!quick) skerry::server::print_steps();
  if (with_day) skerry::server::print_day();
  return 0;
}
