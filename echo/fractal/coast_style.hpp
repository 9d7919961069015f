// CoastStyle: by which method a stretch of coast is refined, and how rough it is.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string_view>

namespace skerry::echo {

// Each has its row in coast_methods().  The numbers stand in the C interface.
enum class CoastMethod : std::uint8_t {
  straight,      // the chart's edge as it is
  regular_koch,  // every apex on the same side
  random_koch,   // joints, height and side of every apex by chance
  midpoint,      // fractional Brownian motion by random midpoint displacement
  weierstrass,   // Weierstrass-Mandelbrot function
};

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

class EdgeMethod;

// All that the program knows of one method.  Scenario keys, command lines, reports, the C interface
// and the refiner take it from here.
struct CoastMethodRow {
  CoastMethod method;
  std::string_view name;         // in scenarios and command lines; as scenario.proto has it
  std::string_view label;        // in reports and pictures
  std::string_view paper_label;  // in Ji et al. 2016; empty: the paper does not print it
  double greatest_dimension;     // that a style may ask for
  bool by_chance;                // the edge's seed decides
  std::unique_ptr<const EdgeMethod> (*make)(const CoastStyle& style);  // edge_refiner.hpp
};

// One row per method, row i of method number i.
std::span<const CoastMethodRow> coast_methods();
const CoastMethodRow& row_of(CoastMethod method);
std::optional<CoastMethod> find_method(std::string_view name);
inline std::string_view name_of(CoastMethod method) { return row_of(method).name; }
inline double greatest_dimension(CoastMethod method) { return row_of(method).greatest_dimension; }

// Whether another seed makes another coast.
bool depends_on_seed(const CoastStyle& style);

// Error: std::invalid_argument naming the parameter, its value and the range allowed.
void require_valid(const CoastStyle& style);

}  // namespace skerry::echo
