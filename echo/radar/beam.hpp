// The antenna's horizontal beam.
#pragma once

#include <cstdint>
#include <vector>

namespace skerry::echo {

// One-way voltage pattern of a cosine-tapered aperture, 1 on the axis:
// g(mu) = cos(mu) / (1 - (2 mu / pi)^2), mu = 68.8 pi sin(angle) / beam width in degrees.
// First null at about 1.25 beam widths, first side lobe -23 dB.  Source: SOURCES.md "Sets".
double cosine_taper_voltage(double angle_deg, double beam_width_deg);

// Two-way power weights of rays -reach .. +reach, `rays` to the turn, about an axis `part` of a ray
// to the right of the middle one: the main lobe down to kBeamFloorDb.  Bound: what is left out is
// below -40 dB of the axis, and 3e-4 of the beam's two-way power; side lobes (-46 dB two-way at
// most) are not modelled here.  Held by Beam.LeavesOutLessThanItsBound.
inline constexpr double kBeamFloorDb = -40.0;
std::vector<float> beam_weights(double beam_width_deg, std::uint32_t rays, double part,
                                std::uint32_t reach);

}  // namespace skerry::echo
