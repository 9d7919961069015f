// Which of our sets stands for the radar of a known capture.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "echo/radar/radar_set.hpp"

namespace skerry::echo {

// Captures by how their file's name begins, and the reaches at which they have whole turns. Source:
// SOURCES.md "Pictures".
struct CapturedRadar {
  std::string_view capture;
  std::string_view set;           // of shipped_sets.hpp
  double reach_m = 0.0;           // 0: the one with most turns
  double reach_over_scale = 1.0;  // what the radar sends, over what it is set to
  bool velocity_track = false;    // its highest levels tell Doppler
};
std::span<const CapturedRadar> captured_radars();

// The row of a file, by its name and to 2 % of the reach; of an unknown reach the first of its
// name.
std::optional<CapturedRadar> captured_radar_of(const std::string& file, double reach_m);

// The set of that name; the HALO20 and a note where there is none.
RadarSet stand_in_set(std::string_view name, std::vector<std::string>& notes);

}  // namespace skerry::echo
