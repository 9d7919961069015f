// WeierstrassFunction: the Weierstrass-Mandelbrot function over an edge.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "echo/fractal/coast_style.hpp"
#include "echo/fractal/fractional_bridge.hpp"
#include "echo/fractal/offset_graph.hpp"

namespace skerry::echo {

// W(t) = c sum of gamma^(-H n) cos(2 pi gamma^n t + phi_n), less the straight line between W(0) and
// W(1); n = 0 is one wave to the edge.  c makes the middle's standard deviation over random phases
// 1, as that of FractionalBridge.  Phases: of the cosine series 0, of the alternating sine series
// n pi - pi/2; both give one fixed curve, to which the edge's seed gives the side, so that coasts
// do not all bulge one way (SOURCES.md "Corrections 9").
//
// The terms:
//  - below: until the rest together is less than kLowTail of the middle's standard deviation;
//  - above: until the rest together stands out by less than kFinest_m, or their waves are shorter
//    than it.  Vertices are never nearer along the edge than 0.1 m, so no phase reaches 2^27
//    radians.
class WeierstrassTables {
 public:
  WeierstrassTables(const CoastStyle& style, const FractionalBridge& bridge);

  static constexpr double kLowTail = 0.1;
  static constexpr double kFinest_m = 0.05;
  static constexpr int kMaxTerms = 512;

  // How many terms an edge has whose offset is at most `gain_m` times W.
  int terms(double length_m, double gain_m) const;

  CoastStyle style;
  int first;                      // n of the first term
  std::vector<double> waves;      // gamma^n
  std::vector<double> amplitude;  // c gamma^(-H n)
  // e^(2 pi i waves 2^-level), level 0 .. kDeepest.
  struct Turns {
    std::vector<double> cos, sin;
  };
  std::array<Turns, GraphStyle::kDeepest + 1> turns;
  std::array<double, 256> circle_cos, circle_sin;  // of the places a random phase may have

 private:
  double tail_;  // of an amplitude: what it and all above add up to
};

class WeierstrassFunction {
 public:
  struct Phasors {
    alignas(32) std::array<double, WeierstrassTables::kMaxTerms> re, im;
  };
  using State = const Phasors*;  // the terms at the left end of the piece
  using Halves = Phasors;        // the terms in the middle

  // The first `terms` terms.
  WeierstrassFunction(const WeierstrassTables& tables, int terms, std::uint64_t seed);

  State start() const { return &start_; }
  double middle(State left_end, int level, std::int64_t piece, Halves& at) const;
  void open(State, int, std::int64_t, Halves&) const {}
  State left(State left_end, const Halves&) const { return left_end; }
  State right(State, const Halves& at) const { return &at; }

 private:
  const WeierstrassTables& tables_;
  std::size_t terms_;  // filled up with terms of no amplitude
  double value_at_0_, value_at_1_;
  Phasors start_;
};

}  // namespace skerry::echo
