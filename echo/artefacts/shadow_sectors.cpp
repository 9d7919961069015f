#include "echo/artefacts/shadow_sectors.hpp"

#include <algorithm>

#include "echo/artefacts/strip_shadow.hpp"
#include "echo/kernel/exact_math.hpp"
#include "protocol/quantity/bearing.hpp"

namespace skerry::echo {
namespace {

constexpr std::uint32_t kBits = 13, kSize = 1u << kBits, kFraction = 32 - kBits;

std::uint32_t off_bow_units(double bearing_deg) {
  return RelativeBearing::from(degrees(bearing_deg)).units();
}

}  // namespace

OwnShipGain::OwnShipGain(const RadarModel& model)
    : wavelength_m_(model.set.wavelength_m()),
      antenna_m_(antenna_width_m(model.set.beam_width_deg, wavelength_m_)) {}

void OwnShipGain::prepare(const Scene& scene) {
  static const std::vector<Obstruction> kNone;
  const auto& obstructions = scene.artefacts.shadow_sectors ? scene.obstructions : kNone;
  if (obstructions != obstructions_) {
    obstructions_ = obstructions;
    lay_shadows();
  }
  if (scene.blanked != asked_blanked_) {
    asked_blanked_ = scene.blanked;
    blanked_.clear();
    for (const BlankedSector& sector : asked_blanked_) {
      if (blanked_.size() == kMostBlanked || sector.from_deg == sector.to_deg) continue;
      const std::uint32_t from = off_bow_units(sector.from_deg);
      const std::uint32_t width = off_bow_units(sector.to_deg) - from;
      // 0 to 360 is all round.
      blanked_.push_back({from, width == 0 ? ~std::uint32_t{0} : width});
    }
  }
}

void OwnShipGain::lay_shadows() {
  table_.clear();
  const std::size_t count = std::min(obstructions_.size(), kMostObstructions);
  if (count == 0) return;
  std::vector<double> gain(kSize, 1.0);
  for (std::size_t k = 0; k < count; ++k) {
    const Obstruction& obstruction = obstructions_[k];
    const StripShadow shadow(obstruction, wavelength_m_, antenna_m_);
    const std::uint32_t middle = off_bow_units(obstruction.bearing_deg);
    for (std::uint32_t i = 0; i < kSize; ++i) {
      const SinCos off = sin_cos_units((i << kFraction) - middle);
      // The point where its line passes the strip's plane, if it does.
      if (off.cos * shadow.reach_m() <= obstruction.distance_m * std::max(off.sin, -off.sin))
        continue;
      gain[i] *= shadow.one_way(obstruction.distance_m * off.sin / off.cos);
    }
  }
  table_.resize(kSize + 1);
  for (std::uint32_t i = 0; i < kSize; ++i)
    table_[i] = static_cast<float>(std::clamp(gain[i], kLeastGain, 1.9));
  table_[kSize] = table_[0];
}

bool OwnShipGain::transmits(std::uint32_t relative_units) const {
  return std::none_of(blanked_.begin(), blanked_.end(), [&](const Sector& sector) {
    return relative_units - sector.from_units <= sector.width_units;
  });
}

float OwnShipGain::one_way(std::uint32_t relative_units) const {
  if (table_.empty()) return 1.0f;
  const std::uint32_t i = relative_units >> kFraction;
  const float t = static_cast<float>(relative_units & ((1u << kFraction) - 1u)) *
                  (1.0f / static_cast<float>(1u << kFraction));
  return (1.0f - t) * table_[i] + t * table_[i + 1];
}

float OwnShipGain::two_way(std::uint32_t relative_units) const {
  if (!transmits(relative_units)) return 0.0f;
  const float way = one_way(relative_units);
  return way * way;
}

}  // namespace skerry::echo
