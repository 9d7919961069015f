// Ships, marks, structures and cables around the own ship, in the plane.
#pragma once

#include <cstdint>

#include "protocol/quantity/geo_point.hpp"

namespace skerry::echo {

// A ship's hull.  It moves on straight, turning about its middle, from the scene's time.
struct Hull {
  PlanePoint centre;
  PlanePoint velocity;       // m/s
  double heading_deg = 0.0;  // clockwise from the plane's north
  double turn_rate_deg_s = 0.0;
  double length_m = 0.0, beam_m = 0.0, height_m = 0.0;
  std::uint64_t identity = 0;     // which ship, for its scatterers
  double cross_section_m2 = 0.0;  // median at X band, bow aspect; 0: from its size
  bool wake = false;              // draws a wake while she makes way
};

// How an echo changes from scan to scan.  steady: Swerling 0; rayleigh: Swerling 1 (exponential
// power); one_dominant: Swerling 3 (chi-square of four degrees of freedom).
enum class Fluctuation : std::uint8_t { steady, rayleigh, one_dominant };

// Something smaller than the radar can resolve: a buoy, a boat, a reflector.
struct PointTarget {
  PlanePoint place;
  PlanePoint velocity;     // m/s
  double height_m = 3.5;   // of the echoing part over the water
  double x_band_m2 = 5.0;  // cross-section
  double s_band_m2 = 0.5;
  Fluctuation fluctuation = Fluctuation::rayleigh;
  std::uint64_t identity = 0;
};

struct WindTurbine {
  PlanePoint place;
  double hub_height_m = 90.0;
  double rotor_diameter_m = 120.0;
  double rotor_rpm = 10.0;    // 0: stands still
  double facing_deg = 270.0;  // clockwise from the plane's north
  std::uint64_t identity = 0;
};

// A power line over the water: echoes where the line of sight meets it square.
struct OverheadCable {
  PlanePoint from, to;
  double height_m = 30.0;
  std::uint64_t identity = 0;
};

}  // namespace skerry::echo
