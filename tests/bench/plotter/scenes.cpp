#include "tests/bench/plotter/scenes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace skerry::bench {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kLat = 56.3, kLon = 4.2;  // the open North Sea

// A place so many nautical miles off the own ship's begin.
std::string at(double bearing_deg, double nm) {
  const double a = bearing_deg * kPi / 180.0;
  const double lat = kLat + nm * std::cos(a) / 60.0;
  const double lon = kLon + nm * std::sin(a) / 60.0 / std::cos(kLat * kPi / 180.0);
  return fmt::format("position: {{lat: {:.6f}, lon: {:.6f}}}", lat, lon);
}

std::string ship(const std::string& name, const std::string& kind, double bearing_deg, double nm,
                 double course_deg, double speed_kn) {
  return fmt::format("  - {{name: {}, ship_class: {}, {}, course_deg: {:.1f}, speed_kn: {:.1f}}}\n",
                     name, kind, at(bearing_deg, nm), course_deg, speed_kn);
}

std::string sea_of(int state, const std::string& more = "") {
  return fmt::format(
      "name: scene\nseed: 7\nsea: {{state: {}, wind_from_deg: 250, depth_m: 60}}\n{}", state, more);
}

std::string own(double course_deg, double speed_kn, double range_nm, const std::string& more = "") {
  return fmt::format(
      "own_ships:\n  - {{name: Own, {}, course_deg: {:.1f}, speed_kn: {:.1f}, radars: "
      "[{{range_nm: {:g}}}]{}}}\n",
      at(0, 0), course_deg, speed_kn, range_nm, more);
}

// `count` ships in rings, of changing kinds, courses and speeds.
std::string crowd(int count, double nearest_nm, double furthest_nm, double slowest_kn,
                  double fastest_kn) {
  const char* const kinds[] = {"coaster",        "container", "bulker",
                               "product_tanker", "ferry",     "fishing"};
  const double most_kn[] = {14, 20, 15, 15, 20, 12};
  std::string text = "targets:\n";
  for (int i = 0; i < count; ++i) {
    // The golden angle spreads them evenly.
    const double share = (i + 0.5) / count;
    const double nm = std::sqrt(nearest_nm * nearest_nm +
                                share * (furthest_nm * furthest_nm - nearest_nm * nearest_nm));
    text += ship(fmt::format("T{}", i), kinds[i % 6], i * 137.508, nm, std::fmod(i * 77.0, 360.0),
                 std::min(slowest_kn + (fastest_kn - slowest_kn) * std::fmod(i * 0.618, 1.0),
                          most_kn[i % 6]));
  }
  return text;
}

std::string anchorage(int count) {
  std::string text = "targets:\n";
  for (int i = 0; i < count; ++i) {
    const double nm = 1.0 + 3.0 * std::sqrt((i + 0.5) / count);
    text +=
        fmt::format("  - {{name: A{}, ship_class: bulker, {}, course_deg: 250, anchored: true}}\n",
                    i, at(i * 137.508, nm));
  }
  return text;
}

constexpr double kCoastLat = 60.42, kCoastLon = 4.95;  // a sound west of Bergen

std::string coast() {
  return fmt::format(
      "name: scene\nseed: 7\nsea: {{state: 2, wind_from_deg: 250}}\nown_ships:\n  - {{name: Own, "
      "position: {{lat: {:.2f}, lon: {:.2f}}}, course_deg: 350, speed_kn: 10, radars: [{{range_nm: "
      "6}}]}}\n",
      kCoastLat, kCoastLon);
}

}  // namespace

std::vector<PlotterScene> plotter_scenes() {
  const std::string calm = sea_of(2);
  std::vector<PlotterScene> scenes;
  scenes.push_back({"20 targets", calm + own(0, 10, 12) + crowd(20, 1, 10, 5, 20)});
  scenes.push_back({"40 targets", calm + own(0, 10, 12) + crowd(40, 1, 10, 5, 20)});
  scenes.push_back({"200 targets", calm + own(0, 10, 12) + crowd(200, 0.7, 11, 3, 20), 6.0});
  scenes.push_back({"two cross", calm + own(0, 0, 6) + "targets:\n" +
                                     ship("A", "coaster", 0, 3, 90, 10) +
                                     ship("B", "coaster", 20, 3.4, 180, 9) +
                                     ship("C", "container", 150, 3, 60, 15) +
                                     ship("D", "container", 120, 3.2, 235, 15)});
  // They cross at a small angle after five minutes, as one echo for two.
  scenes.push_back({"two merge and part", calm + own(0, 0, 6) + "targets:\n" +
                                              ship("A", "coaster", 344.17, 3.0425, 85, 10) +
                                              ship("B", "coaster", 344.89, 3.183, 95, 10)});
  scenes.push_back(
      {"rain 16 mm/h",
       sea_of(3, fmt::format("rain: [{{{}, radius_nm: 2.5, rate_mm_h: 16}}]\n", at(45, 4))) +
           own(0, 10, 12) + crowd(20, 1, 8, 5, 20)});
  scenes.push_back({"sea state 5", sea_of(5) + own(0, 10, 6) + crowd(20, 1, 5.5, 5, 20)});
  scenes.push_back({"anchorage of 60", calm + own(0, 0, 6) + anchorage(60), 10.0, true});
  scenes.push_back({"fast craft, 70 kn",
                    calm + own(0, 10, 6) + "targets:\n" +
                        fmt::format("  - {{name: F, {}, course_deg: 250, speed_kn: 70, length_m: "
                                    "35, beam_m: 9, height_m: 8}}\n",
                                    at(60, 5)) +
                        ship("G", "fast_craft", 300, 5.5, 130, 34) +
                        ship("A", "coaster", 0, 3, 90, 10),
                    5.0});
  scenes.push_back(
      {"own ship turns",
       calm + own(0, 12, 6, ", max_rate_of_turn_deg_min: 45") + crowd(20, 1, 5, 5, 20) +
           "events:\n  - {name: turn, at_min: 4, own_ships: [{own_ship: Own, course_deg: 45}]}\n"});
  scenes.push_back(
      {"racon and SART",
       calm + fmt::format("racons: [{{{}, code: K}}]\nsarts: [{{{}}}]\n", at(40, 3), at(300, 2.5)) +
           own(0, 5, 6),
       10.0, false, false});
  scenes.push_back({"sea state 5, nothing", sea_of(5) + own(0, 10, 6), 30.0, false, false});
  scenes.push_back({"a coast with no target", coast(), 60.0, false, false});
  // Astern in a sound, each behind headlands and skerries for some minutes.
  const auto in_sound = [](const std::string& name, const std::string& kind, double east_nm,
                           double north_nm, double course_deg, double speed_kn) {
    return fmt::format(
        "  - {{name: {}, ship_class: {}, position: {{lat: {:.6f}, lon: {:.6f}}}, course_deg: "
        "{:.1f}, "
        "speed_kn: {:.1f}}}\n",
        name, kind, kCoastLat + north_nm / 60.0,
        kCoastLon + east_nm / 60.0 / std::cos(kCoastLat * kPi / 180.0), course_deg, speed_kn);
  };
  scenes.push_back({"behind headlands", coast() + "targets:\n" +
                                            in_sound("A", "coaster", 0.12, -2.4, 352, 13) +
                                            in_sound("B", "ferry", 0.1, -0.8, 350, 15) +
                                            in_sound("C", "fishing", 0.05, -0.4, 352, 7) +
                                            in_sound("D", "bulker", 0.0, -1.1, 172, 12) +
                                            in_sound("E", "coaster", 0.0, -1.5, 170, 9)});
  return scenes;
}

}  // namespace skerry::bench
