#include "echo/artefacts/saturation.hpp"

#include <algorithm>
#include <vector>

#include "echo/kernel/exact_math.hpp"
#include "echo/kernel/fast_math.hpp"
#include "echo/kernel/row_losses.hpp"

namespace skerry::echo {
namespace {

constexpr float kLevel = 1e9f;
static_assert(kSaturationDb == 90.0, "kLevel is that as a ratio");
constexpr auto kMostExcess = static_cast<float>(kMostExcessDb * kOctavesPerDb);
// A loss of 0.02 dB is none.
constexpr float kNoLoss = 0.0066f;

}  // namespace

Saturation::Saturation(const RadarModel& model) {
  const double cell_seconds = 2.0 * model.cell_m / kLightSpeed;
  constexpr double kLog2E = 1.4426950408889634;
  const auto decay =
      static_cast<float>(exact_exp2(std::max(-100.0, -kLog2E * cell_seconds / kRecoverySeconds)));
  float left = 1.0f;
  for (float& d : decay_) {
    left = left * decay < 1e-20f ? 0.0f : left * decay;
    d = left;
  }
}

bool Saturation::apply(const Artefacts& artefacts, std::span<float> power) const {
  if (!artefacts.saturation) return false;
  thread_local std::vector<float> peaks;
  peaks.resize((power.size() + kPeakCells - 1) / kPeakCells);
  if (peaks_of(power, peaks) <= kLevel) return false;
  float loss = 0.0f;  // octaves
  const auto dim = [&](std::span<float> run) {
    if (peak_of(run) <= kLevel) {
      if (loss == 0.0f) return;
      lose_dying(loss, decay_, run);
      loss *= decay_[run.size() - 1];
      if (loss <= kNoLoss) loss = 0.0f;
      return;
    }
    for (float& p : run) {
      const float excess =
          p > kLevel ? std::min(kMostExcess, fast_log2(p * (1.0f / kLevel))) : 0.0f;
      loss *= decay_[0];
      if (excess >= loss) {
        loss = excess;  // drives the receiver itself: full on the screen
      } else if (loss > kNoLoss) {
        p *= fast_exp2(-loss);
      } else {
        loss = 0.0f;
      }
    }
  };
  for (std::size_t b = 0; b < peaks.size(); ++b) {
    if (loss == 0.0f && peaks[b] <= kLevel) continue;
    const std::size_t begin = b * kPeakCells;
    const auto block = power.subspan(begin, std::min(kPeakCells, power.size() - begin));
    for (std::size_t at = 0; at < block.size(); at += kRun)
      dim(block.subspan(at, std::min(kRun, block.size() - at)));
  }
  return true;
}

}  // namespace skerry::echo
