// The scenario of a class: own ships with a radar each among traffic in the Dover Strait.
#pragma once

#include <fmt/format.h>

#include <array>
#include <string>

namespace skerry::system_test {

struct ClassSize {
  unsigned ships = 20;     // own ships, 1 .. 64: what a scenario may have
  unsigned targets = 500;  // 20 .. 500
  bool small = false;      // radars that a server with a sanitizer keeps up with
};

// Two lanes of north-east and south-west bound ships, ferries across, fishing between them; sea
// state 4, wind of 16 kn, three rains.  Own ships lie in the north-east bound lane, half a mile
// apart, each of another class than the one before.
inline std::string class_scenario(const ClassSize& size) {
  constexpr std::array kClasses = {"mariner", "container",  "tanker",  "vlcc", "ferry",
                                   "coaster", "fast_craft", "fishing", "tug",  "pilot"};
  std::string yaml = R"(name: A class in the Dover Strait
seed: 4
sea: {state: 4, wind_from_deg: 230, wind_kn: 16, depth_m: 40, current_set_deg: 35, current_kn: 1.2}
rain:
  - {position: {lat: 50.80, lon: 1.35}, radius_nm: 3, rate_mm_h: 10, drift_deg: 60, drift_kn: 10}
  - {position: {lat: 50.95, lon: 1.55}, radius_nm: 2, rate_mm_h: 25, drift_deg: 60, drift_kn: 10, kind: shower}
  - {position: {lat: 51.05, lon: 1.40}, radius_nm: 4, rate_mm_h: 4, drift_deg: 60, drift_kn: 10, kind: even}
own_ships:
)";
  for (unsigned i = 0; i < size.ships; ++i) {
    const double along = 0.005 * i, beside = 0.012 * (i % 3);
    yaml += fmt::format(
        "  - {{name: Station {}, ship_class: {}, course_deg: 38, speed_kn: {},\n"
        "     position: {{lat: {:.4f}, lon: {:.4f}}},\n"
        "     radars: [{{name: Radar {}, range_nm: {}{}}}]}}\n",
        i + 1, kClasses[i % kClasses.size()], 8 + i % 3, 50.72 + along,
        1.24 + 1.25 * along + beside, i + 1, i % 2 == 0 ? 6 : 12,
        size.small ? ", spokes: 512, cells: 512" : "");
  }
  const unsigned lane = size.targets * 2 / 5, fishing = size.targets / 10;
  yaml += fmt::format(R"(traffic:
  - {{name: North-east lane, kind: lane, count: {0}, from: {{lat: 50.62, lon: 1.13}}, via: [{{lat: 50.95, lon: 1.49}}],
     to: {{lat: 51.30, lon: 2.10}}, width_nm: 1.6, gives_way: early}}
  - {{name: South-west lane, kind: lane, count: {0}, from: {{lat: 51.33, lon: 1.82}}, via: [{{lat: 51.05, lon: 1.43}}],
     to: {{lat: 50.72, lon: 0.85}}, width_nm: 1.6, gives_way: early}}
  - {{name: Ferry, kind: crossing, count: {1}, from: {{lat: 51.09, lon: 1.39}}, to: {{lat: 50.995, lon: 1.80}},
     width_nm: 1, gives_way: early}}
  - {{name: Fishing, kind: fishing, count: {2}, from: {{lat: 51.02, lon: 1.53}}, radius_nm: 2.5}}
)",
                      lane, size.targets - 2 * lane - fishing, fishing);
  return yaml;
}

}  // namespace skerry::system_test
