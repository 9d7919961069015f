// StripShadow: how much of the antenna's field a mast or funnel before it leaves.
#pragma once

#include <vector>

#include "echo/scene/own_rig.hpp"

namespace skerry::echo {

// A real and an imaginary part.
struct Voltage {
  double in_phase = 0.0;
  double quadrature = 0.0;
};

// Field behind a half plane that hides a plane wave by the Fresnel parameter v (negative: clears
// it), 1 without it: (1+j)/2 integral from v to infinity of exp(-j pi t^2 / 2).  Its power is what
// ITU-R P.526's knife-edge loss J(v) approximates (SOURCES.md "Propagation").
// Error: 2e-3 in voltage, and 1e-4 of it beyond v = 5 (Abramowitz and Stegun 7.3.32 and 7.3.33;
// beyond, the asymptotic series).  Held by StripShadow.AHalfPlaneIsTheKnifeEdge.
Voltage past_half_plane(double v);

// A strip of the obstruction's width across the line of sight, at its distance.  Past both its
// edges comes what Fresnel says, added as voltages; the antenna gathers it over its own width,
// weighted by its cosine taper.  So a mast narrower than the antenna dims and a funnel wider than
// it blinds.
// Error: plane waves from far off, edges as thin as knives (round ones lose some decibels more);
// the antenna's pattern keeps its shape, only the axis loses.  Held against brute force over the
// Fresnel integral by StripShadow.IsTheIntegralOverTheAntenna (0.01 in voltage).
class StripShadow {
 public:
  // `antenna_m`: width of the antenna, 0 for a point.
  StripShadow(const Obstruction& obstruction, double wavelength_m, double antenna_m);

  // One-way power factor toward a bearing whose line passes the strip's middle at `lateral_m`, in
  // [kLeastGain, 1.9): fringes beside the shadow are brighter than the open.
  double one_way(double lateral_m) const;

  // Farther off than this the factor is 1.
  double reach_m() const { return step_m_ * static_cast<double>(power_.size()); }

 private:
  double step_m_;
  std::vector<float> power_;  // by lateral distance
};

// Whatever is in the way, this much comes through, one way (steel leaks round).
inline constexpr double kLeastGain = 1e-4;

// Width of the antenna with that beam: the cosine taper's 68.8 deg lambda / width (SOURCES.md
// "Sets").
double antenna_width_m(double beam_width_deg, double wavelength_m);

}  // namespace skerry::echo
