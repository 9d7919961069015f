// Limits of a radar set.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "echo/radar/radar_set.hpp"

namespace skerry::echo {

// The range of one number of a set.
struct SetLimit {
  std::string_view name;  // of the member
  double RadarSet::*member;
  double min, max;
  std::string_view unit;
};

// The limits of a set for every way in: scenario, C library, controls and checks.  As wide as sets
// that were ever sold.  Two ways in are narrower: the checks of a scenario's set want a frequency
// in a band of marine radar, and the server turns antennas at 10 to 60 a minute.
inline constexpr std::array kSetLimits = {
    SetLimit{"frequency_hz", &RadarSet::frequency_hz, 2.85e9, 9.9e9, "Hz"},
    SetLimit{"peak_power_w", &RadarSet::peak_power_w, 1.0, 100e3, "W"},
    SetLimit{"antenna_gain_db", &RadarSet::antenna_gain_db, 15.0, 45.0, "dB"},
    SetLimit{"beam_width_deg", &RadarSet::beam_width_deg, 0.3, 7.5, "deg"},
    SetLimit{"vertical_beam_deg", &RadarSet::vertical_beam_deg, 5.0, 40.0, "deg"},
    SetLimit{"near_side_lobe_db", &RadarSet::near_side_lobe_db, -60.0, -15.0, "dB"},
    SetLimit{"far_side_lobe_db", &RadarSet::far_side_lobe_db, -80.0, -15.0, "dB"},
    SetLimit{"rpm", &RadarSet::rpm, 1.0, 240.0, "rpm"},
    SetLimit{"antenna_height_m", &RadarSet::antenna_height_m, 1.0, 100.0, "m"},
    SetLimit{"noise_figure_db", &RadarSet::noise_figure_db, 0.0, 20.0, "dB"},
    SetLimit{"losses_db", &RadarSet::losses_db, 0.0, 20.0, "dB"},
    SetLimit{"video_range_db", &RadarSet::video_range_db, 3.0, 100.0, "dB"},
    SetLimit{"integration", &RadarSet::integration, 0.0, 100.0, "%"}};

// Why this set cannot be: one sentence for each parameter out of its range, naming it as RadarSet
// does, with its value and the allowed range; empty for a sound set.  Not a number is out of range.
//
// Besides kSetLimits: the frequency is 2.9 to 3.1 or 9.2 to 9.5 GHz (the bands of marine radar,
// ITU-R M.824; SOURCES.md "Beacons"), each with 0.05 GHz beyond for sets off the shelf.  A set's
// duty is at most 1 %, and each pulse's unambiguous range reaches its range scale.  A gain that
// lies more than 3 dB from 26000 / (beam widths) in deg^2 (SOURCES.md "Sets") is a fault: such an
// antenna cannot be built, and every level of the picture would be wrong by twice as much.
std::vector<std::string> faults_of(const RadarSet& set);

// 10 log10(26000 / (horizontal * vertical)), dB.
double gain_of_beams_db(double beam_width_deg, double vertical_beam_deg);

}  // namespace skerry::echo
