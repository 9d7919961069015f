// A scenario with ten errors of all kinds, and what is said of each.
#pragma once

#include <array>

namespace skerry::scenes {

// Unknown key, wrong type, out of range, name given twice, bad reference, unphysical set, missing
// key, unknown set, broader than long, key given twice.
inline constexpr const char* kTenErrors = R"(name: Ten errors
sead: 5
own_ships:
  - name: Tern
    position: {lat: 60, lon: 5}
    speed_kn: fast
    radars:
      - {name: X, rpm: 75}
      - {name: X}
      - {name: S, board: {channel_a: {source: Y}}}
      - {name: T, pulses: [{length_us: 1, bandwidth_mhz: 3, prf_hz: 5000, up_to_nm: 96}]}
targets:
  - {position: {lat: 60, lon: 5.1}}
  - {name: B, position: {lat: 60, lon: 5.2}, radar: 25 kW Y}
  - {name: C, position: {lat: 60, lon: 5.3}, length_m: 5, beam_m: 6}
  - {name: D, position: {lat: 60, lon: 5.4}, name: E}
)";

// After the file's name, the beginning of each line.
inline constexpr std::array<const char*, 10> kTenErrorsFound = {
    ":2:1: sead: unknown key; did you mean \"seed\"?; known keys: name, seed, own_ships,",
    ":6:15: own_ships[0].speed_kn: expected a number, given fast; allowed: -10 to 60 kn",
    ":8:24: own_ships[0].radars[0].rpm: 75 is out of range; allowed: 10 to 60 turns/min",
    ":9:16: own_ships[0].radars[1].name: \"X\" is the name of own_ships[0].radars[0] too (line 8)",
    ":10:47: own_ships[0].radars[2].board.channel_a.source: \"Y\" is no radar of Tern; allowed: X,",
    ":11:69: own_ships[0].radars[3].pulses[0].prf_hz: 5000 is outside",
    ":13:5: targets[0].name: missing; expected text",
    ":14:53: targets[1].radar: \"25 kW Y\" is no shipped set; allowed: 25 kW X,",
    ":15:67: targets[2].beam_m: beam 6 m is more than length 5 m; allowed: at most the length",
    ":16:46: targets[3].name: given twice; first in line 16"};

}  // namespace skerry::scenes
