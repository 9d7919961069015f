// Ships as extended bodies.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "echo/scene/scene.hpp"

namespace skerry::echo {

// Median radar cross-section of a ship, m2: 52 sqrt(f MHz) D^1.5 with D in kilotonnes
// (Skolnik 1974; physics.md B6), D from length, beam and a draught of 0.4 beam at block coefficient
// 0.7.  Error: Skolnik's ships were of 2 to 17 kt; below that it is an extrapolation.
double ship_cross_section(double length_m, double beam_m, double frequency_hz);

// Factor on the cross-section for the aspect (0 = bow on): 1 ahead and astern, 10 (10 dB) abeam
// with a lobe 25 deg wide; a broadside is 10 to 20 dB over bow and quarter (physics.md B6).
double aspect_factor(double aspect_degrees);

// A point that echoes, seen from the own ship at one instant.
struct Scatterer {
  double range_m;
  double bearing_radians;  // clockwise from the plane's north
  double cross_section_m2;
};

// What a hull looks like from `own_ship` at `dt` seconds after the scene's time: scatterers along
// both rails and the centre line, closer together than the radar can tell apart (`resolution_m`),
// (at most 80 along, so 400 m at 5 m), the strongest at the house; each dimmed by what the horizon
// hides of the height.
void scatterers_of(const Hull& hull, PlanePoint own_ship, double dt, double antenna_height_m,
                   double frequency_hz, double resolution_m, std::vector<Scatterer>& out);

}  // namespace skerry::echo
