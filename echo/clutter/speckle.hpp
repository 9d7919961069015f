// Speckle: the fluctuation of what has many scatterers in a cell.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "echo/kernel/aligned_floats.hpp"
#include "echo/kernel/moved_row.hpp"
#include "echo/radar/radar_model.hpp"

namespace skerry::echo {

// A torus of unit-mean exponential values (Rayleigh amplitude), correlated in azimuth over the time
// or the beam that two spokes share and in range over the pulse.  A scan begins at a place of its
// own on the torus, so turns are independent.  Over its last spokes a turn fades into the next,
// voltage by voltage, so that the boundary between turns is like any other.
// Exact: the distribution, whatever the correlation (mean 1 within 2e-4, mean of the decibels
// -2.507 and their deviation 5.570 within 0.005; held by Speckle.HasTheMomentsOfTheExponential).
// Of the spokes that fade: mean within 3 %, for the law is carried over by kLawKnots straight lines
// (Speckle.FadesFromTurnToTurnWithoutASeam).  Values lie in [1.9e-6, 13.2].  Immutable, shared
// between radars of the same correlation (speckle_for); any thread.  3.5 MB.
class Speckle {
 public:
  static constexpr std::uint32_t kLongestRow = 2 * ScanGeometry::kMaxCells;

  // Correlation lengths (1/e of the field's, not of the power's, autocorrelation) in spokes, 0
  // for none, and in cells: of the power exp(-2 (d / length)^2).  At most 96 of either.
  Speckle(double spokes, double cells, std::uint64_t seed);

  struct Spoke {
    std::uint64_t key = 0;
    std::uint32_t scan = 0, spoke = 0;
    std::uint32_t spokes_per_turn = 4096;
  };
  // Values of one spoke, at least `count` (<= kLongestRow) of them, nearest first, 64-byte aligned.
  // Those `from` on are what is used: the same of the next spoke are fetched ahead.  Valid until
  // the same thread's next call but one, on any speckle.
  std::span<const float> row(const Spoke& at, std::uint32_t count, std::uint32_t from = 0) const;
  // The same in half the space, 32-byte aligned, kRowPadding more of them.  Error: 2^-8 relative,
  // 0.017 dB, the mean as exact as above.  Held by Speckle.IsPackedWithinItsBound.
  std::span<const PackedPower> packed_row(const Spoke& at, std::uint32_t count,
                                          std::uint32_t from = 0) const;

  // How many spokes at the end of a turn fade: three correlation lengths, a quarter of a turn at
  // most.
  std::uint32_t fading_spokes(std::uint32_t spokes_per_turn) const;

 private:
  static constexpr std::size_t kLawKnots = 257;

  std::uint32_t place_of(const Spoke& at) const;
  void learn_law(std::span<const float> powers);
  std::span<const float> faded(const Spoke& at, std::uint32_t count, std::uint32_t from) const;

  double spokes_;
  // The rings of lattice_field.hpp and their beginnings once more: what a row is, and the two
  // quadratures it comes from.
  AlignedFloats tile_, in_phase_, quadrature_;
  std::vector<PackedPower, LineAllocator<PackedPower>> packed_;  // the tile
  // From the quadratures' power to that of the tile, by equal steps of its root.
  AlignedFloats law_;
  float to_knot_ = 0.0f;
};

// The speckle of those lengths, rounded to steps of an eighth of an octave (below 1/4: none); kept
// for all radars, the sixteen used last.  Thread: any; one makes it, others who ask for the same
// wait (20 to 60 ms).
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
