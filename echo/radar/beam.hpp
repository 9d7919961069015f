// The antenna's horizontal beam.
#pragma once

#include <cstdint>
#include <vector>

namespace skerry::echo {

// One-way voltage pattern of a cosine-tapered aperture, 1 on the axis:
// g(mu) = cos(mu) / (1 - (2 mu / pi)^2), mu = 68.8 pi sin(angle) / beam width in degrees.
// First null at about 1.25 beam widths, first side lobe -23 dB.  Source: physics.md B1.
double cosine_taper_voltage(double angle_deg, double beam_width_deg);

// How a beam is laid over rays.  Rays are `per_spoke` times as dense as spokes, so that a beam is
// always at least kRaysPerBeam rays wide however coarse the spokes.
struct Beam {
  static constexpr double kRaysPerBeam = 5.0;
  std::uint32_t per_spoke = 1;
  // Two-way power weights of rays -half .. +half about the spoke's own; weights[half] = 1.
  std::uint32_t half = 0;
  std::vector<float> weights;
};

// The main lobe down to kBeamFloorDb two-way.  Bound: what is left out is below -40 dB of the axis,
// and 3e-4 of the beam's two-way power; side lobes (-46 dB two-way at most) are not modelled here.
// Held by Beam.LeavesOutLessThanItsBound.
inline constexpr double kBeamFloorDb = -40.0;
Beam beam_over_rays(double beam_width_deg, std::uint32_t spokes_per_turn);

}  // namespace skerry::echo
