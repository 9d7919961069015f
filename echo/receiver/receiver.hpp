// Receiver: from mean power per cell to video.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "echo/kernel/log_receiver.hpp"
#include "echo/receiver/controls.hpp"
#include "protocol/video/scan_geometry.hpp"

namespace skerry::echo {

// Log amplifier over kDynamicRangeDb above a threshold that the gain control sets.
inline constexpr double kDynamicRangeDb = 45.0;

// Threshold over mean noise, dB: 22.9 at gain 0, 10 at 50 (a cell in 22 000 sparkles), -1.6 at 95
// (half of all cells; recordings.md h), -2.9 at 100.
double threshold_db(double gain);

// Attenuation of the sea control (STC) at a range, dB: 30 log10(Rmax / R), the R^-3 law of surface
// echoes, within Rmax = 8 NM * sea / 100 and 0 beyond; at most kMaxStcDb.  Source: physics.md B7.
inline constexpr double kMaxStcDb = 70.0;
double stc_db(double sea, double range_m);

// Immutable; any thread.
class Receiver {
 public:
  Receiver(const ScanGeometry& geometry, const ViewControls& controls);

  // power: mean signal over noise; video: one byte per cell, 0 .. 2^bits - 1.
  void receive(std::span<const float> power, NoiseKey noise, std::span<std::uint8_t> video) const;

  // Video steps per dB of the curve, and the offset (gain, STC) of a cell, in steps.
  const QuantiserScale& scale() const { return scale_; }
  std::span<const float> offsets() const { return offsets_; }

 private:
  void differentiate(std::span<float> octaves) const;

  QuantiserScale scale_;
  std::vector<float> offsets_;
  double rain_weight_;
  std::size_t rain_cells_;
  float noise_octaves_;
};

}  // namespace skerry::echo
