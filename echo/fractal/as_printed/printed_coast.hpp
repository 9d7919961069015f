// The coastline algorithms of Ji et al. 2016 as printed, to compare others with.
//
// Source: Ji, Zhang, Yang, Liu, Sawhney, Application of fractal algorithms of coastline echo's
// generation on marine radar simulator, Visualization in Engineering 4:8 (2016).  Its errors are
// kept; SOURCES.md "Corrections" numbers them: 1 to 3 (direction and size of the displacement), 5
// (it may cross anything), 9 (one fixed curve whose ends do not join), 11 (lengths in pixels of the
// display).  edge_refiner.hpp makes the coasts that are shown.
//
// The paper leaves some points open.  Here they are read so:
//  - c (Koch, 15): an edge longer than c pixels is first cut into equal pieces of at most c pixels,
//    each of which then is a Koch edge (Corrections 10: "adds points to Koch"; 11: in screen
//    samples).
//  - "heights of the sample points" (fBm): the display's y of the vertices passed in.
//  - Weierstrass-Mandelbrot: t runs from 0 to 1 along each edge, and W(t) times `amplitude` times
//    the edge's length is added along the edge's left normal; an iteration halves t.  An edge's far
//    end stays where the next begins, so the curve steps back there by W(1) (Corrections 9).
//  - number of terms and amplitude of the series: not printed; the defaults are ours.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "echo/fractal/as_printed/display.hpp"
#include "echo/fractal/coast_style.hpp"

namespace skerry::echo::as_printed {

// Defaults: the values printed.
struct Parameters {
  CoastMethod method = CoastMethod::random_koch;
  int iterations = 3;  // 1 .. 8
  // L, pixels, 0 .. 1e6: only what is longer is refined further (the improved algorithm, printed
  // with 10); 0: everything is (the unimproved one).
  double threshold_px = 0.0;
  std::uint64_t seed = 0;

  double control_value_px = 15.0;  // Koch: c, 1 .. 1e6, or 0: no edge is cut
  double apex_factor = 1.0;        // Koch: height of the apex, as part of an equilateral's, 0 .. 2

  double hurst = 0.6;  // fBm: H, 0 .. 1
  // fBm: standard deviation, pixels, 0 .. 1e6; default: that of the heights of the points.
  std::optional<double> sigma_px = std::nullopt;

  double dimension = 1.5;                      // series: D, 1 .. 1.99
  double gamma = 1.5;                          // series: 1.01 .. 8
  SeriesPhases phases = SeriesPhases::cosine;  // cosine or alternating
  int terms_below = 20;                        // series: n from -terms_below, 0 .. 300,
  int terms_above = 40;                        // to terms_above, 0 .. 300
  double amplitude = 0.05;                     // series: 0 .. 10

  // Not in the paper: more points than this are never made; 2 .. kMostPoints.
  std::size_t most_points = 100'000'000;
};
inline constexpr std::size_t kMostPoints = 100'000'000;

// Error: std::invalid_argument naming the parameter, its value and the range allowed.
void require_valid(const Parameters& parameters);

// The refined polyline, first and last point as they were.  Without L and with no edge cut by c, n
// edges become 4^iterations n of Koch and 2^iterations n of the others, plus one point.
//   random Koch     each edge gets the two sides of a triangle in place of its middle third, the
//                   apex on a side by chance; regular Koch: on the left
//   midpoint        eqs 3-5: x_mid = (x1 + x2)/2 + h_i, y_mid = (y1 + y2)/2 + h_i, the same h_i =
//                   sigma 2^(-iH) sqrt(1 - 2^(2H-2)) Gauss, i the number of the iteration
//   weierstrass     see the reading above
//   straight        as it is (the conventional method)
// "Left" is of the way along the line, as the display shows it.  Chance is a pure function of seed,
// edge and place in the edge, so a finer iteration keeps the vertices of a coarser one.
// Error: std::invalid_argument as require_valid(), and for a coordinate that is not finite or
// beyond 1e9 pixels; std::length_error when there would be more than most_points: at once without
// L, else as soon as they are exceeded.
std::vector<PixelPoint> refine(std::span<const PixelPoint> line, const Parameters& parameters);

// Standard deviation of the y of the points, pixels; 0 for none.
double deviation_of_heights(std::span<const PixelPoint> line);

// W(t) = sum over n of gamma^(-(2-D)n) (1 - cos(gamma^n t)) with phases 0; with phases n pi the
// alternating sine series, sum of (-1)^n gamma^(-(2-D)n) sin(gamma^n t).
// Error against all n: at most 2 g^(-h(N+1)) / (1 - g^-h), h = 2 - D, of the terms left out above
// (half of it for the sines), and (t^2/2) g^(-D(M+1)) / (1 - g^-D) of those below (cosines;
// SOURCES.md "Fractals").  A double no longer holds the phase of a term beyond 2^53: such terms
// count nothing, which is within the same bound, N being the last term kept (gamma 1.5, t <= 1: n =
// 90, 1.3e-7).
class Series {
 public:
  // Error: std::invalid_argument as require_valid().
  explicit Series(const Parameters& parameters);
  double at(double t) const;  // finite t

 private:
  struct Term {
    double turns, weight;  // of a wave: turns for t = 1
  };
  std::vector<Term> terms_;
  bool sines_;
};

}  // namespace skerry::echo::as_printed
