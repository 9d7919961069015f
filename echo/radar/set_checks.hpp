// What a radar set may be.
#pragma once

#include <string>
#include <vector>

#include "echo/radar/radar_set.hpp"

namespace skerry::echo {

// Why this set cannot be: one sentence for each parameter out of its range, naming it as RadarSet
// does, with its value and the allowed range; empty for a sound set.  Not a number is out of range.
//
// Ranges: frequency 2.9 to 3.1 or 9.2 to 9.5 GHz (the bands of marine radar, ITU-R M.824;
// SOURCES.md "Beacons"), each with 0.05 GHz beyond for sets off the shelf; the rest as wide as sets
// that were ever sold.  A set's duty is at most 1 %, and each pulse's unambiguous range reaches its
// range scale. A gain that lies more than 3 dB from 26000 / (beam widths) in deg^2 (SOURCES.md
// "Sets") is a fault: such an antenna cannot be built, and every level of the picture would be
// wrong by twice as much.
std::vector<std::string> faults_of(const RadarSet& set);

// 10 log10(26000 / (horizontal * vertical)), dB.
double gain_of_beams_db(double beam_width_deg, double vertical_beam_deg);

}  // namespace skerry::echo
