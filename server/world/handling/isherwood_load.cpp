#include "server/world/handling/isherwood_load.hpp"

#include <array>

#include "server/world/handling/hull_math.hpp"
#include "server/world/handling/wind_load.hpp"

namespace skerry::server {
namespace {

constexpr std::size_t kAngles = 19;  // from ahead to astern, every 10 deg
template <std::size_t kFactors>
using Rows = std::array<std::array<double, kFactors>, kAngles>;

// Of 1, 2 AL / L^2, 2 AF / B^2, L / B, S / L, C / L and, in the first two, of the masts and of the
// superstructure's share.
constexpr Rows<7> kAlong = {{
    {2.152, -5.0, 0.243, -0.164, 0.0, 0.0, 0.0},
    {1.714, -3.33, 0.145, -0.121, 0.0, 0.0, 0.0},
    {1.818, -3.97, 0.211, -0.143, 0.0, 0.0, 0.033},
    {1.965, -4.81, 0.243, -0.154, 0.0, 0.0, 0.041},
    {2.333, -5.99, 0.247, -0.19, 0.0, 0.0, 0.042},
    {1.726, -6.54, 0.189, -0.173, 0.348, 0.0, 0.048},
    {0.913, -4.68, 0.0, -0.104, 0.482, 0.0, 0.052},
    {0.457, -2.88, 0.0, -0.068, 0.346, 0.0, 0.043},
    {0.341, -0.91, 0.0, -0.031, 0.0, 0.0, 0.032},
    {0.355, 0.0, 0.0, 0.0, -0.247, 0.0, 0.018},
    {0.601, 0.0, 0.0, 0.0, -0.372, 0.0, -0.02},
    {0.651, 1.29, 0.0, 0.0, -0.582, 0.0, -0.031},
    {0.564, 2.54, 0.0, 0.0, -0.748, 0.0, -0.024},
    {-0.142, 3.58, 0.0, 0.047, -0.7, 0.0, -0.028},
    {-0.677, 3.64, 0.0, 0.069, -0.529, 0.0, -0.032},
    {-0.723, 3.14, 0.0, 0.064, -0.475, 0.0, -0.032},
    {-2.148, 2.56, 0.0, 0.081, 0.0, 1.27, -0.027},
    {-2.707, 3.97, -0.175, 0.126, 0.0, 1.81, 0.0},
    {-2.529, 3.76, -0.174, 0.128, 0.0, 1.55, 0.0},
}};
constexpr Rows<7> kAcross = {{
    {0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0},           {0.096, 0.22, 0.0, 0.0, 0.0, 0.0, 0.0},
    {0.176, 0.71, 0.0, 0.0, 0.0, 0.0, 0.0},        {0.225, 1.38, 0.0, 0.023, 0.0, -0.29, 0.0},
    {0.329, 1.82, 0.0, 0.043, 0.0, -0.59, 0.0},    {1.164, 1.26, 0.121, 0.0, -0.242, -0.95, 0.0},
    {1.163, 0.96, 0.101, 0.0, -0.177, -0.88, 0.0}, {0.916, 0.53, 0.069, 0.0, 0.0, -0.65, 0.0},
    {0.844, 0.55, 0.082, 0.0, 0.0, -0.54, 0.0},    {0.889, 0.0, 0.138, 0.0, 0.0, -0.66, 0.0},
    {0.799, 0.0, 0.155, 0.0, 0.0, -0.55, 0.0},     {0.797, 0.0, 0.151, 0.0, 0.0, -0.55, 0.0},
    {0.996, 0.0, 0.184, 0.0, -0.212, -0.66, 0.34}, {1.014, 0.0, 0.191, 0.0, -0.28, -0.69, 0.44},
    {0.784, 0.0, 0.166, 0.0, -0.209, -0.53, 0.38}, {0.536, 0.0, 0.176, -0.029, -0.163, 0.0, 0.27},
    {0.251, 0.0, 0.106, -0.022, 0.0, 0.0, 0.0},    {0.125, 0.0, 0.046, -0.012, 0.0, 0.0, 0.0},
    {0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0},
}};
constexpr Rows<6> kTurning = {{
    {0.0, 0.0, 0.0, 0.0, 0.0, 0.0},
    {0.0596, 0.061, 0.0, 0.0, 0.0, -0.074},
    {0.1106, 0.204, 0.0, 0.0, 0.0, -0.17},
    {0.2258, 0.245, 0.0, 0.0, 0.0, -0.38},
    {0.2017, 0.457, 0.0, 0.0067, 0.0, -0.472},
    {0.1759, 0.573, 0.0, 0.0118, 0.0, -0.523},
    {0.1925, 0.48, 0.0, 0.0115, 0.0, -0.546},
    {0.2133, 0.315, 0.0, 0.0081, 0.0, -0.526},
    {0.1827, 0.254, 0.0, 0.0053, 0.0, -0.443},
    {0.2627, 0.0, 0.0, 0.0, 0.0, -0.508},
    {0.2102, 0.0, -0.0195, 0.0, 0.0335, -0.492},
    {0.1567, 0.0, -0.0258, 0.0, 0.0497, -0.457},
    {0.0801, 0.0, -0.0311, 0.0, 0.074, -0.396},
    {-0.0189, 0.0, -0.0488, 0.0101, 0.1128, -0.42},
    {0.0256, 0.0, -0.0422, 0.01, 0.0889, -0.463},
    {0.0552, 0.0, -0.0381, 0.0109, 0.0689, -0.476},
    {0.0881, 0.0, -0.0306, 0.0091, 0.0366, -0.415},
    {0.0851, 0.0, -0.0122, 0.0025, 0.0, -0.22},
    {0.0, 0.0, 0.0, 0.0, 0.0, 0.0},
}};

// A sum of factors, straight between the rows.
template <std::size_t kFactors>
double coefficient(const Rows<kFactors>& rows, double angle_deg,
                   const std::array<double, kFactors>& factors) {
  const double place = std::clamp(angle_deg / 10.0, 0.0, 18.0);
  const std::size_t below = std::min<std::size_t>(static_cast<std::size_t>(place), kAngles - 2);
  const double share = place - static_cast<double>(below);
  double sum = 0.0;
  for (std::size_t i = 0; i < kFactors; ++i) {
    sum += (rows[below][i] + share * (rows[below + 1][i] - rows[below][i])) * factors[i];
  }
  return sum;
}

}  // namespace

Loads isherwood_load(const IsherwoodShape& s, double wind_x, double wind_y) {
  const double flow = squared(wind_x) + squared(wind_y);
  if (flow <= 0.0 || s.lateral_m2 <= 0.0) return {};
  const double angle_deg = std::fabs(echo::exact_atan2(wind_y, -wind_x)) * kDegreesPerRadian;
  const double side = wind_y < 0.0 ? -1.0 : 1.0;  // from port it pushes to starboard
  const double length = s.length_m;
  const double lateral = 2.0 * s.lateral_m2 / squared(length);
  const double frontal = 2.0 * s.frontal_m2 / squared(s.beam_m);
  const double slender = length / s.beam_m, outline = s.perimeter_m / length;
  const double centre = s.centre_from_bow_m / length;

  const double cx = -coefficient<7>(
      kAlong, angle_deg,
      {1.0, lateral, frontal, slender, outline, centre, static_cast<double>(s.masts)});
  const double cy = coefficient<7>(
      kAcross, angle_deg,
      {1.0, lateral, frontal, slender, outline, centre, s.superstructure_m2 / s.lateral_m2});
  const double cn =
      coefficient<6>(kTurning, angle_deg, {1.0, lateral, frontal, slender, outline, centre});
  const double pressure = 0.5 * kAir_kg_m3 * flow;
  const double across = side * cy * pressure * s.lateral_m2;
  return {.x = cx * pressure * s.frontal_m2,
          .y = across,
          .k = across * s.height_m,
          .n = side * cn * pressure * s.lateral_m2 * length};
}

}  // namespace skerry::server
