// Speckle: the fluctuation of what has many scatterers in a cell.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace skerry::echo {

// A torus of unit-mean exponential values (Rayleigh amplitude), correlated in azimuth over the time
// or the beam that two spokes share and in range over the pulse.  A scan begins at a place of its
// own on the torus, so turns are independent.
// Immutable, shared between radars of the same correlation (speckle_for); any thread.
class Speckle {
 public:
  // Correlation lengths (1/e of the field's, not of the power's, autocorrelation) in spokes, 0
  // for none, and in cells.
  Speckle(double spokes, double cells, std::uint64_t seed);

  // Values of one spoke, at least `count` (<= 4096) of them, nearest first.
  std::span<const float> row(std::uint64_t key, std::uint32_t scan, std::uint32_t spoke,
                             std::uint32_t count) const;

 private:
  std::vector<float> tile_;
};

// The speckle of those lengths, rounded to steps of an eighth of an octave; kept for all radars.
std::shared_ptr<const Speckle> speckle_for(double spokes, double cells);

}  // namespace skerry::echo
