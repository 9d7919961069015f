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
  bool open_sea = false;   // 20 deg farther west and 10 farther south, without any land
};

// Two lanes of north-east and south-west bound ships, ferries across, fishing between them; sea
// state 4, wind of 16 kn, three rains.  Own ships lie in the north-east bound lane, half a mile
// apart, each of another class than the one before.
inline std::string class_scenario(const ClassSize& size) {
  const auto at = [&](double lat, double lon) {
    return fmt::format("{{lat: {:.4f}, lon: {:.4f}}}", lat - (size.open_sea ? 10.0 : 0.0),
                       lon - (size.open_sea ? 20.0 : 0.0));
  };
  constexpr std::array kClasses = {"mariner", "container",  "tanker",  "vlcc", "ferry",
                                   "coaster", "fast_craft", "fishing", "tug",  "pilot"};
  std::string yaml = fmt::format(R"(name: A class in the Dover Strait
seed: 4
sea: {{state: 4, wind_from_deg: 230, wind_kn: 16, depth_m: 40, current_set_deg: 35, current_kn: 1.2}}
rain:
  - {{position: {}, radius_nm: 3, rate_mm_h: 10, drift_deg: 60, drift_kn: 10}}
  - {{position: {}, radius_nm: 2, rate_mm_h: 25, drift_deg: 60, drift_kn: 10, kind: shower}}
  - {{position: {}, radius_nm: 4, rate_mm_h: 4, drift_deg: 60, drift_kn: 10, kind: even}}
own_ships:
)",
                                 at(50.80, 1.35), at(50.95, 1.55), at(51.05, 1.40));
  for (unsigned i = 0; i < size.ships; ++i) {
    const double along = 0.005 * i, beside = 0.012 * (i % 3);
    yaml += fmt::format(
        "  - {{name: Station {}, ship_class: {}, course_deg: 38, speed_kn: {},\n"
        "     position: {},\n"
        "     radars: [{{name: Radar {}, range_nm: {}{}}}]}}\n",
        i + 1, kClasses[i % kClasses.size()], 8 + i % 3,
        at(50.72 + along, 1.24 + 1.25 * along + beside), i + 1, i % 2 == 0 ? 6 : 12,
        size.small ? ", spokes: 512, cells: 512" : "");
  }
  const unsigned lane = size.targets * 2 / 5, fishing = size.targets / 10;
  yaml += fmt::format(R"(traffic:
  - {{name: North-east lane, kind: lane, count: {0}, from: {3}, via: [{4}],
     to: {5}, width_nm: 1.6, gives_way: early}}
  - {{name: South-west lane, kind: lane, count: {0}, from: {6}, via: [{7}],
     to: {8}, width_nm: 1.6, gives_way: early}}
  - {{name: Ferry, kind: crossing, count: {1}, from: {9}, to: {10},
     width_nm: 1, gives_way: early}}
  - {{name: Fishing, kind: fishing, count: {2}, from: {11}, radius_nm: 2.5}}
)",
                      lane, size.targets - 2 * lane - fishing, fishing, at(50.62, 1.13),
                      at(50.95, 1.49), at(51.30, 2.10), at(51.33, 1.82), at(51.05, 1.43),
                      at(50.72, 0.85), at(51.09, 1.39), at(50.995, 1.80), at(51.02, 1.53));
  return yaml;
}

}  // namespace skerry::system_test
