// CoastStyle: by which method a stretch of coast is refined, and how rough it is.
#pragma once

#include <cstdint>
#include <string_view>

namespace skerry::echo {

enum class CoastMethod : std::uint8_t {
  straight,      // conventional: the chart's edge as it is
  regular_koch,  // every apex on the same side
  random_koch,   // joints, height and side of every apex by chance
  midpoint,      // fractional Brownian motion by random midpoint displacement
  weierstrass,   // Weierstrass-Mandelbrot function
};
inline constexpr int kCoastMethods = 5;

// Phases of the Weierstrass-Mandelbrot series (Ji et al. 2016 section 2; SOURCES.md "Corrections
// 9").
enum class SeriesPhases : std::uint8_t {
  cosine,       // phi_n = 0
  alternating,  // phi_n = n pi: the alternating sine series
  random,       // from the edge's seed
};

// How a coast is refined (edge_refiner.hpp); the paper as printed is in echo/fractal/as_printed.
struct CoastStyle {
  CoastMethod method = CoastMethod::random_koch;
  // Fractal dimension asked for, 1 .. the method's greatest_dimension().  Koch: the similarity
  // dimension of an edge with all the room there is (half-angle 30 deg).  Midpoint and Weierstrass:
  // 2 - H, as the variogram of an edge's offsets has it, whatever the room.  1 is straight.
  double dimension = 1.15;
  // Factor on the amplitude that dimension, edge length and room imply, 0 .. 4.  Koch: on the
  // height of the apexes, up to what the room allows.
  double amplitude = 1.0;
  double gamma = 1.5;  // weierstrass: ratio of wave numbers, 1.05 .. 8
  SeriesPhases phases = SeriesPhases::random;
  friend bool operator==(const CoastStyle&, const CoastStyle&) = default;
};

// The largest dimension a method can be asked for: 1 for straight, 1.25 for regular Koch, 1.175 for
// random Koch, 1.5 for midpoint and Weierstrass.
double greatest_dimension(CoastMethod method);

// As scenarios write it: "straight", "koch", "random_koch", "midpoint", "weierstrass".
std::string_view name_of(CoastMethod method);

// Error: std::invalid_argument naming the parameter, its value and the range allowed.
void require_valid(const CoastStyle& style);

}  // namespace skerry::echo
