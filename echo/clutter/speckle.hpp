// Speckle: the fluctuation of what has many scatterers in a cell.
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "echo/kernel/aligned_floats.hpp"
#include "echo/radar/radar_model.hpp"

namespace skerry::echo {

// A torus of unit-mean exponential values (Rayleigh amplitude), correlated in azimuth over the time
// or the beam that two spokes share and in range over the pulse.  A scan begins at a place of its
// own on the torus, so turns are independent; within a turn there is no seam, between its last
// spoke and the first of the next there is one. Exact: the distribution, whatever the correlation
// (mean 1 within 2e-4, mean of the decibels -2.507 and their deviation 5.570 within 0.005; held by
// Speckle.HasTheMomentsOfTheExponential). Values lie in [1.9e-6, 13.2]. Immutable, shared between
// radars of the same correlation (speckle_for); any thread.  1 MB.
class Speckle {
 public:
  static constexpr std::uint32_t kLongestRow = 2 * ScanGeometry::kMaxCells;

  // Correlation lengths (1/e of the field's, not of the power's, autocorrelation) in spokes, 0
  // for none, and in cells: of the power exp(-2 (d / length)^2).  At most 96 of either.
  Speckle(double spokes, double cells, std::uint64_t seed);

  // Values of one spoke, at least `count` (<= kLongestRow) of them, nearest first, 64-byte aligned.
  // Those `from` on are what is used: the same of the next spoke are fetched ahead.
  std::span<const float> row(std::uint64_t key, std::uint32_t scan, std::uint32_t spoke,
                             std::uint32_t count, std::uint32_t from = 0) const;

 private:
  AlignedFloats tile_;  // the ring of lattice_field.hpp and its beginning once more
};

// The speckle of those lengths, rounded to steps of an eighth of an octave (below 1/4: none); kept
// for all radars, the sixteen used last.  Thread: any; one makes, the others wait (20 to 60 ms).
std::shared_ptr<const Speckle> speckle_for(double spokes, double cells);

// Correlation of the speckle that a radar sees, as lengths above.  In azimuth two spokes share
// their beams (voltage pattern of both ways: exp(-(d / 0.849 beam widths)^2)) and the time in
// between: scatterers that move forget their phases with exp(-(t / lifetime)^2).  In range they
// share the pulse: its overlap falls to 1/e at 0.632 pulse lengths.
struct SpeckleLengths {
  double spokes = 0.0, cells = 0.0;
};
SpeckleLengths speckle_lengths(const RadarModel& model, double lifetime_s);

}  // namespace skerry::echo
