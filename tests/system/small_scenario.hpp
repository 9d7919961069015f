// Scenarios small enough for a server with a sanitizer to keep pace on one core.
#pragma once

#include <string>

#include "tests/system/child_process.hpp"

namespace skerry::system_test {

inline constexpr unsigned kSmallSpokes = 512;
inline constexpr unsigned kSmallCells = 512;

// An own ship in Hjeltefjorden near Bergen with land on both sides, a second one at sea, three
// targets.  Radar 0: 8 bits, 60 turns a minute, 6 NM.  Radar 1, on the same ship: the same with
// 4 bits.  Radar 2, on the second ship: 12 NM.
inline std::string small_scenario(unsigned seed = 7) {
  return "name: Small\nseed: " + std::to_string(seed) + R"(
own_ships:
  - name: Tern
    position: {lat: 60.425, lon: 5.040}
    course_deg: 335
    speed_kn: 12
    speed_time_constant_s: 1
    turn_time_constant_s: 1
    max_rate_of_turn_deg_min: 720
    radars:
      - {name: Eight bits, spokes: 512, cells: 512, bits: 8, rpm: 60, range_nm: 6}
      - {name: Four bits, spokes: 512, cells: 512, bits: 4, rpm: 60, range_nm: 6}
  - name: Gannet
    position: {lat: 60.36, lon: 4.81}
    course_deg: 5
    speed_kn: 14
    radars:
      - {name: Far, spokes: 512, cells: 512, bits: 8, rpm: 60, range_nm: 12}
targets:
  - {name: Tanker, position: {lat: 60.445, lon: 5.020}, course_deg: 160, speed_kn: 10,
     length_m: 182, beam_m: 32, height_m: 22}
  - {name: Coaster, position: {lat: 60.452, lon: 5.024}, course_deg: 335, speed_kn: 9}
  - {name: Ferry, position: {lat: 60.42, lon: 5.03}, course_deg: 80, speed_kn: 11}
)";
}

}  // namespace skerry::system_test
