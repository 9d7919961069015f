// RainForm: what a kind of rain area looks like and how long its parts live.
#pragma once

#include <cstdint>

#include "echo/scene/weather.hpp"

namespace skerry::echo {

// Lengths are shares of the area's radius, along the form's axis and to the right of it.  All
// numbers are chosen by us for pictures like those of rain on a ship's radar; README.md "Kinds".
struct RainForm {
  // The coarsest grains over the whole area, and half the area's length and width.
  std::uint32_t columns = 4, rows = 4;
  double half_along = 1.0, half_across = 1.0;
  // The axis lies along the drift, or across it to port; the field's identity turns it by up to
  // that much to either side.
  bool across_drift = false;
  double turn_deg = 25.0;
  double shear = 0.0;  // how far a place is moved along per length to the right
  // Roughness of the field.  The contours of a surface of the Hurst exponent H have the dimension
  // (3 - H) / 2 (Kondev and Henley, "Geometrical exponents of contour loops on random Gaussian
  // surfaces"), those of rain areas 1.35 +- 0.05 (Lovejoy 1982, "Area-perimeter relation for rain
  // and cloud areas").  That asks for 0.3; the kinds have what gives 1.35 +- 0.1 as it is measured
  // on their finite areas, with holes and without: RainShape.AreasAndPerimetersAreRainsOwn.
  double hurst = 0.4;
  // Standard deviation of the rate, octaves (log-normal); what is below `least` of the outline's
  // middle is dry, in octaves.
  double spread = 1.3, least = -2.0;
  // Octaves lost towards the edge of the ellipse: edge * q / (1 - q), q the squared distance.
  double edge = 1.0;
  // Of a band: octaves lost per squared half width ahead of its middle and behind it, and how far
  // the middle is ahead of the ends.  0: no band.
  double front = 0.0, back = 0.0, bow = 0.0;
  // For how long the largest grains of an area of kLifeRadius grow and decay, seconds.
  double life_s = 1800.0;
};
inline constexpr double kLifeRadius = 4000.0;  // m

// Requires a kind other than even.
const RainForm& rain_form(RainKind kind);

// Octaves under the middle at a place of the area, both in -1 to 1; -200 from the edge on.
double rain_outline(const RainForm& form, double along, double across);

}  // namespace skerry::echo
