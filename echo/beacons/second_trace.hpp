// Second trace: echoes that come back after the next pulse has gone.
#pragma once

#include <cstdint>
#include <vector>

#include "echo/radar/radar_model.hpp"
#include "echo/targets/point_echo.hpp"

namespace skerry::echo {

// c / (2 PRF), metres: what lies beyond shows nearer by a whole number of these.
double unambiguous_range(const Pulse& pulse);

// Farthest range whose echo fold_second_trace() can show: that of the third trace.
double farthest_trace(const Pulse& pulse);

// How the PRF is jittered, which breaks second traces up: each pulse comes up to `share` of the
// period late or early, so a folded point moves by as much range, anew with each `key`.
struct PrfJitter {
  double share = 0.0;     // 0 (off) to 0.1
  std::uint64_t key = 0;  // of the sector, such as a hash of scan and first spoke
};

// Brings points beyond the unambiguous range to where they show, at R - n c / (2 PRF), n = 1 or 2,
// bearing and power kept; points that would then lie beyond the instrumented range, that lie there
// without being folded, or that are lost in the noise (kLeastTrace) are taken out.  Points within
// both ranges are left alone.  A straight coast becomes a hyperbola.
// The model of jitter moves points by the sector, not by the pulse.  Source: SOURCES.md
// "Artefacts". Error: the antenna turns on by up to 0.25 deg (600 Hz, 24 rpm) meanwhile, which is
// left out.
inline constexpr float kLeastTrace = 0.05f;  // of the noise
void fold_second_trace(const RadarModel& model, std::vector<PointEcho>& points,
                       PrfJitter jitter = {});

}  // namespace skerry::echo
