// The ray by way of the sea: where it strikes a round Earth and what the sea leaves of it.
#pragma once

namespace skerry::echo {

// The two rays between an antenna and a point over a smooth round Earth, in line of sight.
struct ReflectionPath {
  double to_mirror_m = 0.0;      // from the antenna to where the sea reflects, along the sea
  double antenna_m = 0.0;        // heights over the plane that touches the Earth there
  double target_m = 0.0;         //
  double difference_m = 0.0;     // by which the reflected ray is longer
  double sine_of_grazing = 0.0;  // of the angle at which it strikes
  double divergence = 1.0;       // factor on its voltage by the Earth's roundness, (0, 1]
};

// Requires range_m > 0, heights > 0 and the target within the horizon of both,
// sqrt(2 ae) (sqrt h1 + sqrt h2).  Source: SOURCES.md "Propagation"; the mirror is the root of
// Fermat's cubic 2 x^3 - 3 d x^2 + (d^2 - 2 ae (h1 + h2)) x + 2 ae h1 d = 0, the divergence (1 + 2
// d1 d2 / (ae d sin psi))^-1/2 (Kerr 1951, unverified). Error: the Earth as a parabola: heights of
// 1e-6 of themselves within 400 km.
ReflectionPath reflection_path(double range_m, double antenna_height_m, double target_height_m,
                               double effective_earth_m);

// What a rough sea leaves of the reflected voltage.  g = 2 pi sigma_h sin(psi) / lambda, sigma_h
// the standard deviation of the surface (a quarter of the significant wave height). Ament: exp(-2
// g^2).  Miller, Brown, Vegh: exp(-2 g^2) I0(2 g^2), nearer to what is measured where the sea is
// rough; it is the one in use.  Source: SOURCES.md "Propagation".  Error of I0: 5e-7 relative.
double ament_roughness(double g);
double miller_brown_roughness(double g);

// Power one way of direct and reflected ray against the direct one alone: |1 - rho exp(-i
// phase)|^2. The sea turns the phase by half a turn: Gamma = -1, good for HH at all grazing angles
// of a ship's radar and for VV below half a degree (15 % low in voltage there).
double two_ray_power(double rho, double difference_m, double wavelength_m);

}  // namespace skerry::echo
