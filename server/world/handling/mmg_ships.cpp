#include "server/world/handling/mmg_ships.hpp"

#include <numbers>

#include "server/world/handling/hull_math.hpp"

namespace skerry::server {

MmgParticulars kvlcc2() {
  return {.length_m = 320.0,
          .beam_m = 58.0,
          .draught_m = 20.8,
          .volume_m3 = 312600.0,
          .centre_m = 11.2,
          .added_x = 0.022,
          .added_y = 0.223,
          .added_inertia = 0.011,
          .resistance = 0.022,
          .y_v = -0.315,
          .y_r = 0.083,
          .n_v = -0.137,
          .n_r = -0.049,
          .cubic = MmgParticulars::Cubic{.y_vvv = -1.607,
                                         .y_vvr = 0.379,
                                         .y_vrr = -0.391,
                                         .y_rrr = 0.008,
                                         .n_vvv = -0.030,
                                         .n_vvr = -0.294,
                                         .n_vrr = 0.055,
                                         .n_rrr = -0.013},
          .propeller_m = 9.86,
          .thrust_0 = 0.2931,
          .thrust_1 = -0.2753,
          .thrust_2 = -0.1385,
          .thrust_deduction = 0.220,
          .wake = 0.35,
          .rudder_m2 = 112.5,
          .rudder_height_m = 15.8,
          .rudder_slope = 2.747,
          .rudder_deduction = 0.387,
          .rudder_on_hull = 0.312,
          .rudder_on_hull_x = -0.464,
          .straightening_port = 0.395,
          .straightening_starboard = 0.640,
          .wake_ratio = 1.09,
          .race = 0.50,
          .shaft_rate_rps2 = 0.02};
}

MmgParticulars from_sizes(const MainSizes& s) {
  const double volume = s.block * s.length_m * s.beam_m * s.draught_m;
  const double slender = 2.0 * s.draught_m / s.length_m;  // k
  const double fullness = s.block * s.beam_m / s.length_m;
  const double breadth = s.beam_m / s.draught_m, wide = s.beam_m / s.length_m;
  const double mass = 2.0 * volume / (squared(s.length_m) * s.draught_m);
  // Clarke's are in 1/2 rho L^3; per L^2 d there.
  const double clarke =
      std::numbers::pi * squared(s.draught_m / s.length_m) * s.length_m / s.draught_m;
  const double surface = 1.025 * s.length_m * (s.block * s.beam_m + 1.7 * s.draught_m);
  const double wake = 0.5 * s.block - 0.05;
  const double straightening = 2.06 * fullness + 0.14;
  constexpr double kAspect = 1.5;
  return {.length_m = s.length_m,
          .beam_m = s.beam_m,
          .draught_m = s.draught_m,
          .volume_m3 = volume,
          .added_x = 0.1 * mass,
          .added_y = clarke * (1.0 + 0.16 * s.block * breadth - 5.1 * squared(wide)),
          .added_inertia =
              clarke * std::max(1.0 / 12.0 + 0.017 * s.block * breadth - 0.33 * wide, 0.03),
          .resistance = s.total_resistance * surface / (s.length_m * s.draught_m),
          .x_vvvv = 0.0,  // it would drive a ship that drifts fast
          .y_v = -(0.5 * std::numbers::pi * slender + 1.4 * fullness),
          .y_r = 0.25 * std::numbers::pi * slender,
          .n_v = -slender,
          .n_r = -0.54 * slender + squared(slender),
          .propeller_m = s.propeller_m,
          .thrust_0 = 0.44,
          .thrust_1 = -0.29,
          .thrust_2 = -0.13,
          .thrust_deduction = 0.6 * wake,
          .wake = wake,
          .rudder_m2 = s.rudder_m2,
          .rudder_height_m = std::sqrt(kAspect * s.rudder_m2),
          .rudder_slope = 6.13 * kAspect / (kAspect + 2.25),
          .rudder_deduction = 1.0 - (0.28 * s.block + 0.55),
          .rudder_on_hull = std::max(0.627 * s.block - 0.153, 0.0),
          .rudder_on_hull_x = -0.45,
          .straightening_port = straightening,
          .straightening_starboard = straightening,
          .wake_ratio = std::clamp(-156.2 * squared(fullness) + 41.6 * fullness - 1.76, 0.9, 1.1),
          .race = 0.5,
          .shaft_rate_rps2 = s.shaft_rate_rps2};
}

}  // namespace skerry::server
