// A scenario's traffic, stepped.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "server/world/scenario.hpp"
#include "server/world/ship_units.hpp"
#include "server/world/short_way.hpp"
#include "server/world/traffic/traffic.hpp"

namespace skerry::server {

inline constexpr double kMile = 1852.0;
inline constexpr Duration kTrafficTick = std::chrono::milliseconds(100);

// A scenario of which only what follows the own ship matters.
inline scenario::Scenario traffic_scene(const std::string& rest) {
  return parse_scenario(
      "name: traffic\nseed: 7\nown_ships:\n  - name: Frida\n    position: {lat: 58, lon: 1}\n"
      "    radars: [{}]\n" +
          rest,
      "test.yaml");
}

class TrafficRun {
 public:
  explicit TrafficRun(const std::string& rest) : TrafficRun(traffic_scene(rest)) {}
  explicit TrafficRun(const scenario::Scenario& scene)
      : traffic(scene), environment(environment_of(scene)) {}

  void step() {
    traffic.step(now, kTrafficTick, own_ships, environment);
    now += kTrafficTick;
  }
  void step_to(double seconds) {
    while (in_seconds(now) < seconds - 1e-6) step();
  }
  ShipState ship(std::size_t number) const {
    for (const ShipState& ship : traffic.states(now)) {
      if (ship.number == number) return ship;
    }
    return {};
  }
  wire::ExerciseShip told(std::size_t number) const {
    wire::ExerciseShip ship;
    traffic.tell(number, now, ship);
    return ship;
  }

  Traffic traffic;
  Environment environment;
  std::vector<ShipState> own_ships;
  Duration now{};
};

inline double metres_apart(GeoPoint a, GeoPoint b) {
  const ShortWay way = short_way_between(a, b);
  return std::hypot(way.north_m, way.east_m);
}

inline double off_deg(double a, double b) { return std::fabs(std::remainder(a - b, 360.0)); }

// A target so far from 60 N 5 E, as a line of a scenario.
inline std::string ship_line(const std::string& name, double north_nm, double east_nm,
                             double course, double speed,
                             const std::string& rest = "gives_way: early",
                             const std::string& ship_class = "coaster") {
  const GeoPoint at = advanced({60.0, 5.0}, ShortWay{north_nm * kMile, east_nm * kMile});
  return "  - {name: " + name + ", ship_class: " + ship_class +
         ", position: {lat: " + std::to_string(at.latitude_deg) +
         ", lon: " + std::to_string(at.longitude_deg) + "}, course_deg: " + std::to_string(course) +
         ", speed_kn: " + std::to_string(speed) + ", " + rest + "}\n";
}

}  // namespace skerry::server
