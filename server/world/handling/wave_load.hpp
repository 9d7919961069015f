// What the waves do to a ship's way: they slow her and make her yaw.
#pragma once

#include <cstdint>

#include "server/world/handling/hull.hpp"

namespace skerry::server {

struct WaveShape {
  double length_m, beam_m, draught_m, block;  // block coefficient
};

// h: the less of H and L / 10, for higher waves lift all of her.
// Added resistance in head seas is 0.64 h^2 rho g CB B^2 / L (Kreitner; recalled, unverified), and
// falls with the cosine to nothing in following seas.  The yaw moment is our own assumption: 0.1
// rho g h/2 L^2 d sin(2 mu) / (1 + (L / wavelength)^2), as a sum of four sines around the mean
// period 3.6 sqrt(H); a ship of 100 m yaws some 1 to 2 deg in seas of 4 m on her bow.
// `height_m`: H, significant.  `from_rad`: whence, off the bow.  `time_s`: since the scenario
// began.  Waves meet her as often as they
// pass a fixed point, whatever her way.  Nothing in a calm.  The same seed and time give the same
// loads.
Loads wave_load(const WaveShape& shape, double height_m, double from_rad, double time_s,
                std::uint64_t seed);

}  // namespace skerry::server
