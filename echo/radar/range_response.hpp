// RangeResponse: what the pulse and the receiver's filter make of a point, along range.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "echo/radar/radar_model.hpp"

namespace skerry::echo {

// The echo of a point behind a filter of two equal poles: the voltage rises as
// 1 - (1 + x) e^-x, x = 4 B t, while the pulse lasts, and decays as the same filter lets it; B is
// the noise bandwidth, which is a quarter of the poles' rate.  It begins at the point's range and
// its peak is 1, so the radar equation's ratio is that of the peak.  Source: SOURCES.md "Receiver".
//
// Voltage that has decayed below kEnd is left out.  The leading edge: a level 20 dB below the peak
// is reached at 0.13 / B, so the edge of an echo 20 dB over the first level of the video
// is late by 0.13 c / 2B, and that of one 40 dB over by 0.036 c / 2B.
// Error: the mean over a cell by sums at kSteps places of it, 1e-3 of the peak; held by
// RangeResponse.MatchesItsReference.  Immutable; any thread.
class RangeResponse {
 public:
  static constexpr double kEnd = 3e-4;         // voltage, of the peak: -70 dB
  static constexpr std::uint32_t kSteps = 32;  // of a cell
  static constexpr std::uint32_t kMostTaps = 48;
  // A filter as fast as that is none: its rise takes less than a fifth of a cell.
  static constexpr double kFastest = 16.0;

  // Of a pulse so long (less than a cell counts as one) and poles of that rate to a cell; 0 or
  // kFastest and more: no filter, a box.
  RangeResponse(double pulse_cells, double poles_per_cell);

  bool is_box() const { return taps_.empty(); }
  double pulse_cells() const { return pulse_cells_; }
  // Cells that a point may fill, its own the first.
  std::uint32_t cells() const { return cells_; }

  // Mean power by cell of a point `into` (0 to 1) its cell, of peak 1; shares.size() is cells().
  void shares_of(double into, std::span<float> shares) const;

  // Weights of what lies at the beginning of a cell, each for tap_cells() cells; for
  // filter_range(). Empty for a box.
  std::span<const float> taps() const { return taps_; }
  std::uint32_t tap_cells() const { return tap_cells_; }

 private:
  double pulse_cells_;
  std::uint32_t cells_ = 0, tap_cells_ = 1;
  std::vector<double> sums_;  // of power before each step, in cells; empty for a box
  std::vector<float> taps_;
};

// The model's, shared by all who ask for the same.  Any thread.
std::shared_ptr<const RangeResponse> range_response_for(const RadarModel& model);

// Cells after which the voltage of unrelated scatterers is correlated by 1/e; 0.632 pulses for a
// box.  pulse_cells > 0; poles_per_cell as of RangeResponse.  Error: 1e-3 of itself.
double coherence_cells(double pulse_cells, double poles_per_cell);

// Voltage `x` cells behind the point, before it is scaled to a peak of 1.  In double with libm.
double range_voltage_reference(double x, double pulse_cells, double poles_per_cell);

}  // namespace skerry::echo
