// Wind turbines: tower, nacelle and turning blades.
#pragma once

#include <cstdint>
#include <vector>

#include "echo/scene/targets.hpp"

namespace skerry::echo {

// A part of something that stands out of the water, before anything lies between it and the radar.
struct EchoPart {
  PlanePoint place;
  double height_m = 0.0;
  double cross_section_m2 = 0.0;
  bool from_the_water = false;  // reaches from the water up to that height
  float phase = 0.0f;           // turns
};

inline constexpr std::size_t kTurbineParts = 17;
inline constexpr double kTowerSection = 2000.0;  // m2

// Tower and nacelle are steady; each of three blades is five scatterers out to the tip.  A blade
// flashes when it comes square to the line of sight: its cross-section grows by 13 dB in a lobe
// 12 deg wide.  Facing the radar all blades are square all the time; edge on, a blade flashes as
// it passes the tower and the zenith.  The rotor's place is that at `seconds` of scenario time.
// Source: none that gives cross-sections: 2000, 500 and 150 m2 (each blade) at X band are
// plausible, not measured.
void turbine_parts(const WindTurbine& turbine, PlanePoint own_ship, double seconds,
                   std::uint64_t pass_key, std::vector<EchoPart>& out);

}  // namespace skerry::echo
