// The effects of the own ship on her own radar.
#pragma once

#include <cstddef>

namespace skerry::echo {

// A mast, funnel or crane beside the antenna, as high as it and round: it shadows what is behind it
// and reflects.
struct Obstruction {
  double bearing_deg = 180.0;  // of its middle, clockwise from the bow
  double width_m = 0.6;        // across the line of sight, 0.05 to 30
  double distance_m = 8.0;     // from the antenna, 0.5 to 200
  double reflectivity = 0.3;   // share of the voltage it throws elsewhere, 0 to 1
  friend bool operator==(const Obstruction&, const Obstruction&) = default;
};

// So many blanked sectors count.
inline constexpr std::size_t kMostBlanked = 32;

// A sector in which the transmitter is off, clockwise from the bow, from one side to the other.
struct BlankedSector {
  double from_deg = 0.0, to_deg = 0.0;
  friend bool operator==(const BlankedSector&, const BlankedSector&) = default;
};

// Motion of the antenna with the ship: a sine of each.
struct AntennaMotion {
  double roll_deg = 0.0, roll_period_s = 10.0;  // amplitude 0 to 30; period 2 to 40
  double pitch_deg = 0.0, pitch_period_s = 7.0;
};

// The own hull, which echoes back what ships close by reflect onto it.
struct OwnHull {
  double length_m = 120.0;  // 0: throws nothing back; to 500
  double beam_m = 18.0;     // to 80
};

}  // namespace skerry::echo
