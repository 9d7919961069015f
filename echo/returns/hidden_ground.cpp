#include "echo/returns/hidden_ground.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace skerry::echo {
namespace {

constexpr double kSlopeUnit = 1.0 / 32768.0;
constexpr float kLowestSlope = -1.0f, kHighestSlope = 0.9999f;  // slopes are kept within

}  // namespace

void HiddenGround::reset(std::uint32_t rays, std::uint32_t cells) {
  cells_ = cells;
  steps_ = cells / kStep + 1;
  shadows_.resize(rays * steps_);
  dry_.resize(rays);
  for (DryRuns& dry : dry_) dry.count = 0;
}

void HiddenGround::record(std::uint32_t ray, const StaticRayModel& model,
                          const StaticScratch& scratch) {
  std::int16_t* shadows = shadows_.data() + ray * steps_;
  DryRuns& kept = dry_[ray];
  kept.count = 0;
  if (scratch.land.empty()) {
    std::fill_n(shadows, steps_, std::numeric_limits<std::int16_t>::min());
    return;
  }
  const std::vector<float>& slopes = scratch.ground.shadow;
  for (std::size_t k = 0; k < steps_; ++k) {
    const float slope = slopes[std::min(k * kStep, slopes.size() - 1)];
    shadows[k] = static_cast<std::int16_t>(
        std::floor(std::clamp(slope, kLowestSlope, kHighestSlope) * 32768.0f));
  }
  thread_local std::vector<CellRun> dry;
  find_dry(scratch.land, slopes, model.cell_m, model.antenna_height_m, cells_, dry);
  kept.count = static_cast<std::uint16_t>(std::min(dry.size(), DryRuns::kMostRuns));
  std::copy_n(dry.begin(), kept.count, kept.runs.begin());
}

double HiddenGround::shadow_slope(std::uint32_t ray, std::uint32_t cell) const {
  const std::size_t step = std::min<std::size_t>(cell / kStep, steps_ - 1);
  return shadows_[ray * steps_ + step] * kSlopeUnit;
}

std::size_t HiddenGround::bytes() const {
  return shadows_.capacity() * sizeof(std::int16_t) + dry_.capacity() * sizeof(DryRuns);
}

}  // namespace skerry::echo
