#include "tests/system/nmea_day/voyages.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "server/world/scenario.hpp"

namespace skerry::system_test {
namespace {

using namespace std::chrono;
using server::Environment;
using server::World;

double uniform(std::mt19937& random, double from, double to) {
  return from + (to - from) * (static_cast<double>(random()) / 4294967296.0);
}

void order(World& world, const std::function<void(wire::ConOrder&)>& fill) {
  wire::ConOrder order;
  fill(order);
  world.order(0, order);
}

void weather(World& world, double wind_from_deg, double wind_kn, double set_deg, double drift_kn,
             double depth_m) {
  Environment environment = *world.environment();
  environment.sea.wind_from_deg = wind_from_deg;
  environment.wind_kn = wind_kn;
  environment.current_set_deg = set_deg;
  environment.current_kn = drift_kn;
  environment.depth_m = depth_m;
  world.set_environment(environment);
}

void chance_weather(World& world, std::mt19937& random, double most_wind_kn, double least_depth_m,
                    double most_depth_m) {
  weather(world, uniform(random, 0.0, 360.0), uniform(random, 0.0, most_wind_kn),
          uniform(random, 0.0, 360.0), uniform(random, 0.0, 4.0),
          uniform(random, least_depth_m, most_depth_m));
}

// Three ships about her: one crosses to and fro, one meets her, one lies still.
std::string scenario_text(const std::string& name, const std::string& own, const std::string& sea,
                          double latitude, double longitude) {
  const auto near = [&](double north, double east) {
    return fmt::format("{{lat: {:.6f}, lon: {:.6f}}}", latitude + north,
                       std::remainder(longitude + east, 360.0));
  };
  const auto to_and_fro = [&](double north, double east, double back_north, double back_east) {
    return fmt::format("position: {0}, waypoints: [{1}, {0}], route_end: back", near(north, east),
                       near(back_north, back_east));
  };
  return fmt::format(
      "name: {0}\nseed: 3\nsea: {{{1}}}\nown_ships:\n  - name: {0}\n    position: {2}\n"
      "    mmsi: 257123450\n    radars: [{{range_nm: 6}}]\n{3}\ntargets:\n"
      "  - {{name: Crosser, {4}, speed_kn: 15.3, length_m: 180, beam_m: 28, mmsi: 257123451}}\n"
      "  - {{name: Meeter, {5}, speed_kn: 5.5, length_m: 90, beam_m: 14, mmsi: 257123452}}\n"
      "  - {{name: Anchored, position: {6}, length_m: 12, beam_m: 4, mmsi: 257123453}}\n",
      name, sea, near(0.0, 0.0), own, to_and_fro(0.02, 0.03, 0.018, -0.06),
      to_and_fro(-0.03, -0.004, 0.05, -0.0035), near(0.004, -0.006));
}

scenario::Scenario read(const std::string& text) { return server::parse_scenario(text, "voyage"); }

// To and fro over the equator and the 180th meridian, for more than a day at 12 kn.
Voyage dateline() {
  std::string route;
  for (int round = 0; round < 30; ++round) {
    route +=
        "{lat: 0.06, lon: -179.95}, {lat: -0.05, lon: -179.93}, {lat: -0.07, lon: 179.94}, "
        "{lat: 0.05, lon: 179.96}, ";
  }
  return {"Dateline",
          read(scenario_text("Dateline",
                             "    ship_class: coaster\n    speed_kn: 12\n    course_deg: 45\n"
                             "    route: [" +
                                 route + "]",
                             "wind_from_deg: 120, wind_kn: 18, depth_m: 3000, state: 4", -0.004,
                             179.996)),
          2028y / January / 1, [](World& world, int, std::mt19937& random) {
            chance_weather(world, random, 25.0, 2000.0, 11000.0);
          }};
}

// Rudder, lever and thrusters by chance, ahead and astern; west of Greenwich and south.
Voyage wild() {
  return {
      "Wild",
      read(scenario_text("Wild", "    ship_class: tug\n    speed_kn: -4\n    course_deg: 200",
                         "wind_from_deg: 300, wind_kn: 25, depth_m: 40, state: 3", -47.5, -62.3)),
      2028y / February / 29, [](World& world, int scene, std::mt19937& random) {
        order(world, [&](wire::ConOrder& con) {
          con.set_rudder_deg(uniform(random, -35.0, 35.0));
          con.set_engine_percent(scene % 3 == 0 ? -80.0 : uniform(random, -100.0, 100.0));
        });
        chance_weather(world, random, 40.0, 6.0, 60.0);
      }};
}

// Courses on both sides of north, in waves.
Voyage north() {
  return {
      "North",
      read(scenario_text("North", "    ship_class: mariner\n    speed_kn: 14\n    course_deg: 0",
                         "wind_from_deg: 290, wind_kn: 22, depth_m: 300, state: 5", 60.1, 4.0)),
      2028y / March / 1, [](World& world, int scene, std::mt19937& random) {
        constexpr std::array kCourses = {0.0, 3.0, 357.0, 359.97, 0.03, 350.0, 12.0, 181.0};
        order(world, [&](wire::ConOrder& con) {
          con.set_heading_deg(kCourses[static_cast<std::size_t>(scene) % kCourses.size()]);
        });
        weather(world, 290.0, uniform(random, 10.0, 40.0), 350.0, uniform(random, 0.0, 1.0), 300.0);
      }};
}

// At 0 N 0 E without way, wind or current for the first third; then what there is takes her.
Voyage still() {
  return {"Still",
          read(scenario_text("Still", "    ship_class: pilot\n    course_deg: 0",
                             "wind_kn: 0, depth_m: 12, state: 0", 0.0, 0.0)),
          2027y / January / 1, [](World& world, int scene, std::mt19937& random) {
            if (scene < 4) return;
            chance_weather(world, random, scene % 3 == 0 ? 0.0 : 12.0, 2.5, 15.0);
            if (scene % 5 == 0) {
              order(world, [&](wire::ConOrder& con) {
                con.set_rudder_deg(0.0);
                con.set_engine_percent(uniform(random, -30.0, 30.0));
              });
            }
          }};
}

// Deep in shallow water, in a storm; so far north that longitude runs.
Voyage storm() {
  return {
      "Storm",
      read(scenario_text("Storm", "    ship_class: tanker\n    speed_kn: 13\n    course_deg: 270",
                         "wind_from_deg: 20, wind_kn: 60, depth_m: 25, state: 6", 81.0, -179.99)),
      2027y / December / 1, [](World& world, int scene, std::mt19937& random) {
        order(world, [&](wire::ConOrder& con) {
          con.set_heading_deg(uniform(random, 0.0, 359.9));
          con.set_engine_percent(scene % 7 == 6 ? -60.0 : uniform(random, 40.0, 100.0));
        });
        chance_weather(world, random, 80.0, 20.0, 60.0);
      }};
}

}  // namespace

std::vector<Voyage> voyages() { return {dateline(), wild(), north(), still(), storm()}; }

}  // namespace skerry::system_test
