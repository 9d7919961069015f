// Wind turbines, wakes and overhead cables as the parts that echo.
#pragma once

#include <cstdint>
#include <optional>
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

inline constexpr std::size_t kWakeParts = 64;

// The rough water a ship leaves astern while she makes more than 1 m/s: a trail as wide as her
// beam along the way she came (a circle if she turns), as long as she sails in a minute and at most
// 800 m, in kWakeParts scatterers.  Its reflectivity is -33 dB beside the stern and falls by 1/e
// in 20 s.  Source: none that gives a level; weak against any ship, shown over a calm sea close in.
void wake_parts(const Hull& hull, double dt, std::uint64_t pass_key, std::vector<EchoPart>& out);

// A wire square to the line of sight, longer than the zone that echoes in phase (sqrt(l R / 2)):
// pi a R, m2, so that it falls as R^-3.  Physical optics of a smooth round wire; computed from the
// width pi a of a cylinder under a spherical wave.
double wire_cross_section(double radius_m, double range_m);

// The part of a cable that echoes: the foot of the perpendicular from the own ship, if that lies on
// the cable, as three steady wires of 15 mm radius; it moves along as the own ship does, always at
// right angles to the cable.  Source: SOURCES.md "Artefacts".
std::optional<EchoPart> cable_part(const OverheadCable& cable, PlanePoint own_ship);

}  // namespace skerry::echo
