// RangeResponse: what the pulse and the receiver's filter make of a point, along range.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "echo/radar/radar_model.hpp"

namespace skerry::echo {

// Pulse and filter in cells: all that the response depends on.
struct RangeShape {
  RangeFilter filter = RangeFilter::none;
  double pulse_cells = 1.0;      // c tau / 2; less than a cell counts as one
  double bandwidth_cells = 0.0;  // noise bandwidth times the time of a cell

  friend auto operator<=>(const RangeShape&, const RangeShape&) = default;
};
inline RangeShape range_shape(const RadarModel& model) {
  return {model.set.range_filter, model.pulse_cells, model.bandwidth_cells};
}

// The echo of a point: the voltage of a pulse behind a filter of the noise bandwidth B, of peak 1,
// so the radar equation's ratio is that of the peak.  The filter answers a step
//   two_poles  with 1 - (1 + x) e^-x, x = 4 B t: the echo begins at the point's range and decays
//              as the filter lets it
//   gaussian   with (1 + erf(sqrt(2 pi) B t)) / 2: half of it at the point's range, and the far end
//              as the near one
// Source: SOURCES.md "Receiver".
//
// Voltage below kEnd is left out.  The leading edge, where a long echo is 20 dB below its peak:
//   two_poles  0.13 / B behind the point's range (40 dB: 0.036 / B)
//   gaussian   0.36 / B before it (40 dB: 0.66 / B)
// times c / 2.  Held by RangeResponse.TheLeadingEdgeLies...
// Error: the mean over a cell by sums at kSteps places of it, 1e-3 of the peak; held by
// RangeResponse.MatchesItsReference.  Immutable; any thread.
class RangeResponse {
 public:
  static constexpr double kEnd = 3e-4;         // voltage, of the peak: -70 dB
  static constexpr std::uint32_t kSteps = 32;  // of a cell
  static constexpr std::uint32_t kMostTaps = 48;
  // A filter as fast as that is none: its rise takes less than a fifth of a cell.
  static constexpr double kFastest = 4.0;  // bandwidth times the time of a cell

  explicit RangeResponse(const RangeShape& shape);

  bool is_box() const { return taps_.empty(); }
  double pulse_cells() const { return pulse_cells_; }
  // Cells that a point may fill, of which so many lie before its own.
  std::uint32_t cells() const { return cells_; }
  std::uint32_t lead() const { return lead_; }

  // Mean power by cell of a point `into` (0 to 1) its cell, of peak 1; shares.size() is cells().
  void shares_of(double into, std::span<float> shares) const;

  // Weights of what lies at the beginning of a cell, each for tap_cells() cells, the first for the
  // cell lead() before; for filter_range().  Empty for a box.
  std::span<const float> taps() const { return taps_; }
  std::uint32_t tap_cells() const { return tap_cells_; }

 private:
  double pulse_cells_;
  std::uint32_t cells_ = 0, lead_ = 0, tap_cells_ = 1;
  std::vector<double> sums_;  // of power before each step, in cells; empty for a box
  std::vector<float> taps_;
};

// The model's, shared by all who ask for the same.  Any thread.
std::shared_ptr<const RangeResponse> range_response_for(const RadarModel& model);

// Cells after which the voltage of unrelated scatterers is correlated by 1/e; 0.632 pulses without
// a filter.  Requires pulse_cells > 0.  Error: 1e-3 of itself.
double coherence_cells(const RangeShape& shape);

// Voltage `x` cells behind the point, before it is scaled to a peak of 1.  In double with libm.
double range_voltage_reference(double x, const RangeShape& shape);

}  // namespace skerry::echo
