// MidpointFunction: fractional Brownian motion by random midpoint displacement.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "echo/fractal/fractional_bridge.hpp"
#include "echo/fractal/gaussian_hash.hpp"
#include "echo/fractal/offset_graph.hpp"
#include "echo/kernel/hash.hpp"

namespace skerry::echo {

// The numbers of a style.  A middle is the exact conditional mean given the two vertices on either
// side of it, plus an innovation that is correlated with those of the middles beside it as it
// should be: far + near = 1/2 weigh the vertices, own and next the Gaussian numbers of the middle
// and of its two neighbours.
//
// Plain midpoint displacement knows one vertex on either side and makes every middle by itself; its
// variances are up to 25 % low and differ by place (creases; SOURCES.md "Fractals" and "Corrections
// 6"). Error: the variance of every increment of lag 1 to 32 finest steps, at every place, is
// within 0.5 % of fractional Brownian motion, H 0.5 to 0.98; held by
// MidpointLaw.EveryIncrementHasTheVarianceOfFractionalBrownianMotion.
// Source: Norros, Mannersalo, Wang 1999 (conditioning on neighbours); here the neighbours are those
// of the coarser level only, so that a value depends on its place and not on what was made before.
class MidpointTables {
 public:
  explicit MidpointTables(const FractionalBridge& bridge);

  double far = 0.0, near = 0.5;
  double own = 1.0, next = 0.0;
  // The bridge at -2, -1, 2, 3 from four independent Gaussian numbers: lower triangle.
  std::array<std::array<double, 4>, 4> start{};
};

class MidpointFunction {
 public:
  // Values at -2 .. 3, in pieces of the level, from the left end of the piece.
  using State = const double*;
  struct Halves {
    std::array<double, 7> at = {};        // -1 .. 2 in halves of the piece
    std::array<double, 5> gaussian = {};  // of the pieces two to the left .. two to the right
  };

  // `scale` is 2^(-H level), by level.
  MidpointFunction(const MidpointTables& tables, std::span<const double> scale, std::uint64_t seed);

  State start() const { return start_.data(); }

  double middle(State v, int level, std::int64_t piece, Halves& halves) const {
    for (std::size_t i = 1; i <= 3; ++i) {
      halves.gaussian[i] = gaussian(level, piece - 2 + static_cast<std::int64_t>(i));
    }
    return halves.at[3] = made(v + 1, level, &halves.gaussian[1]);
  }
  void open(State v, int level, std::int64_t piece, Halves& halves) const {
    halves.gaussian[0] = gaussian(level, piece - 2);
    halves.gaussian[4] = gaussian(level, piece + 2);
    halves.at[0] = v[1];
    halves.at[1] = made(v, level, &halves.gaussian[0]);
    halves.at[2] = v[2];
    halves.at[4] = v[3];
    halves.at[5] = made(v + 2, level, &halves.gaussian[2]);
    halves.at[6] = v[4];
  }
  State left(State, const Halves& halves) const { return halves.at.data(); }
  State right(State, const Halves& halves) const { return halves.at.data() + 1; }

 private:
  // The middle of the middle one of the three pieces between v[0] .. v[3], whose own Gaussian
  // numbers are z[0] .. z[2].
  double made(const double* v, int level, const double* z) const {
    const double mean = tables_.far * (v[0] + v[3]) + tables_.near * (v[1] + v[2]);
    const double innovation = tables_.own * z[1] + tables_.next * (z[0] + z[2]);
    return mean + scale_[static_cast<std::size_t>(level)] * innovation;
  }
  double gaussian(int level, std::int64_t piece) const {
    const auto place =
        static_cast<std::uint64_t>(piece) + (static_cast<std::uint64_t>(level) << 48);
    return gaussian_of(mixed(key_ ^ place));
  }

  const MidpointTables& tables_;
  std::span<const double> scale_;
  std::uint64_t key_;
  std::array<double, 6> start_;
};

}  // namespace skerry::echo
