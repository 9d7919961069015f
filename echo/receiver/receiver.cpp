#include "echo/receiver/receiver.hpp"

#include <algorithm>
#include <cmath>

#include "echo/kernel/exact_math.hpp"
#include "protocol/quantity/length.hpp"

namespace skerry::echo {
namespace {
constexpr double kDecibelsPerOctave = 3.0102999566398120;
// The differentiator looks back over this much range, a few rain pulses.
constexpr double kDifferentiatorLength = 400.0;
}  // namespace

double threshold_db(double gain) { return 22.9 - 0.258 * gain; }

double stc_db(double sea, double range_m) {
  const double limit = nautical_miles(8.0).in_metres() * sea / 100.0;
  if (range_m >= limit) return 0.0;
  const double ratio = limit / std::max(range_m, 1e-3);
  return std::min(kMaxStcDb, 3.0 * decibels_from_ratio(ratio));
}

Receiver::Receiver(const ScanGeometry& geometry, const ViewControls& controls)
    : offsets_(geometry.cells), rain_weight_(controls.rain / 100.0) {
  const double levels = geometry.bits == 4 ? 16.0 : 256.0;
  const double steps_per_db = levels / kDynamicRangeDb;
  scale_ = {static_cast<float>(steps_per_db * kDecibelsPerOctave),
            static_cast<float>(levels - 1.0)};
  const double cell = geometry.cell_size(controls.range_scale).in_metres();
  for (std::size_t i = 0; i < offsets_.size(); ++i) {
    const double range = (static_cast<double>(i) + 0.5) * cell;
    offsets_[i] = static_cast<float>(-steps_per_db *
                                     (threshold_db(controls.gain) + stc_db(controls.sea, range)));
  }
  rain_cells_ = std::clamp<std::size_t>(static_cast<std::size_t>(kDifferentiatorLength / cell), 2,
                                        geometry.cells);
  noise_octaves_ = static_cast<float>(threshold_db(controls.gain) / kDecibelsPerOctave);
}

void Receiver::receive(std::span<const float> power, NoiseKey noise,
                       std::span<std::uint8_t> video) const {
  if (rain_weight_ <= 0.0) {
    detect_and_quantise(power, offsets_, noise, scale_, video);
    return;
  }
  thread_local std::vector<float> octaves;
  octaves.resize(video.size());
  detect(power, noise, octaves);
  differentiate(octaves);
  quantise(octaves, offsets_, scale_, video);
}

// Takes away a share of the mean of the cells before, as far as it stands above the threshold: what
// is as deep as rain loses its mean, an edge or a ship keeps its front.
void Receiver::differentiate(std::span<float> octaves) const {
  const auto weight = static_cast<float>(rain_weight_);
  const float share = 1.0f / static_cast<float>(rain_cells_);
  thread_local std::vector<float> history;
  history.assign(rain_cells_, 0.0f);
  float sum = 0.0f;
  std::size_t slot = 0;
  for (float& value : octaves) {
    const float excess = std::max(0.0f, value - noise_octaves_);
    value -= weight * sum * share;
    sum += excess - history[slot];
    history[slot] = excess;
    slot = slot + 1 == rain_cells_ ? 0 : slot + 1;
  }
}

}  // namespace skerry::echo
