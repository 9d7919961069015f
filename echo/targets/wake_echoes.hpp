// Wakes and overhead cables.
#pragma once

#include <optional>
#include <vector>

#include "echo/targets/turbine_echoes.hpp"

namespace skerry::echo {

inline constexpr std::size_t kWakeParts = 64;

// The rough water a ship leaves astern while she makes more than 1 m/s: a trail as wide as her
// beam along the way she came (a circle if she turns), as long as she sails in a minute and at most
// 800 m, in kWakeParts scatterers.  Its reflectivity is -33 dB beside the stern and falls by 1/e
// in 20 s.  Source: none that gives a level; weak against any ship, shown over a calm sea close in.
void wake_parts(const Hull& hull, double dt, std::uint64_t pass_key, std::vector<EchoPart>& out);

// Where a cable echoes: at the foot of the perpendicular from the own ship, if that lies on the
// cable, as three steady wires of 15 mm radius (reflectors.hpp); it moves along as the own ship
// does, always at right angles to the cable.  Source: SOURCES.md "Artefacts".
std::optional<EchoPart> cable_part(const OverheadCable& cable, PlanePoint own_ship);

}  // namespace skerry::echo
