#include "echo/targets/ship_shadow.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "echo/kernel/exact_math.hpp"
#include "echo/kernel/power_stages.hpp"
#include "echo/radar/beam.hpp"
#include "echo/targets/sector_view.hpp"
#include "protocol/quantity/bearing.hpp"

namespace skerry::echo {
namespace {

constexpr double kTopOfHeight = 0.7;
constexpr std::size_t kSteps = 512;  // over the main lobe
constexpr float kNoShadow = 0.99f;   // a shadow that leaves more is none

}  // namespace

ShipShadow::ShipShadow(const RadarModel& model, double effective_earth_m)
    : model_(model), earth_m_(effective_earth_m) {
  // To the first null of the cosine taper, 1.25 beam widths.
  const double reach_deg = 1.25 * model.set.beam_width_deg;
  reach_units_ = static_cast<std::uint32_t>(reach_deg * kUnitsPerDegree);
  std::vector<double> sum(kSteps + 1, 0.0);
  for (std::size_t k = 0; k < kSteps; ++k) {
    const double off = reach_deg * (2.0 * (static_cast<double>(k) + 0.5) / kSteps - 1.0);
    const double voltage = cosine_taper_voltage(off, model.set.beam_width_deg);
    sum[k + 1] = sum[k] + voltage * voltage;
  }
  for (const double s : sum) gathered_.push_back(static_cast<float>(s / sum.back()));
}

double ShipShadow::covered(std::int64_t from, std::int64_t to) const {
  const auto gathered = [&](std::int64_t off) {
    const double reach = reach_units_;
    const double place =
        std::clamp((static_cast<double>(off) + reach) / (2.0 * reach), 0.0, 1.0) * kSteps;
    const auto k = std::min(static_cast<std::size_t>(place), kSteps - 1);
    const double t = place - static_cast<double>(k);
    return gathered_[k] + t * (gathered_[k + 1] - gathered_[k]);
  };
  return gathered(to) - gathered(from);
}

void ShipShadow::prepare(const Scene& scene, const SectorView& view,
                         std::span<const std::uint32_t> met) {
  hulls_.clear();
  const double antenna = model_.set.antenna_height_m;
  const double reach = model_.cell_m * model_.geometry.cells;
  for (const std::uint32_t i : met) {
    const Hull& hull = scene.hulls[i];
    const ShipSight sight = sight_of(hull, view);
    const double range = sight.at.range_m, side = sight.side, ahead = sight.ahead;
    const double depth = 0.5 * (hull.length_m * ahead + hull.beam_m * side);
    if (!(range > 2.0 * depth + 1.0) || range > reach) continue;
    // 0.9: rounded ends.
    const double half = 0.45 * (hull.length_m * side + hull.beam_m * ahead);
    const double top = kTopOfHeight * hull.height_m - range * range / (2.0 * earth_m_);
    const double slope = (antenna - top) / range;
    // antenna - slope r = -r^2 / 2ae
    const double root = slope * slope - 2.0 * antenna / earth_m_;
    double end = std::numeric_limits<double>::infinity();
    if (slope > 0.0 && root >= 0.0) end = earth_m_ * (slope - std::sqrt(root));
    if (end <= range + depth) continue;
    hulls_.push_back(
        {i, sight.at.units, units_of_radians(exact_atan2(half, range)), range + depth, end, slope});
  }
}

float ShipShadow::left_of(const Shading& shading, std::uint32_t plane_units) const {
  const std::int64_t off = static_cast<std::int32_t>(shading.units - plane_units);
  const std::int64_t half = shading.half_units;
  if (off - half >= reach_units_ || off + half <= -std::int64_t{reach_units_}) return 1.0f;
  const double open = 1.0 - covered(off - half, off + half);
  return static_cast<float>(open * open);
}

void ShipShadow::shadows(const SpokeAim& aim, std::vector<ShadowedCells>& out) const {
  out.clear();
  const double cells = model_.geometry.cells;
  for (const Shading& shading : hulls_) {
    const float factor = left_of(shading, aim.plane_units);
    const double from = std::ceil(shading.near_m / model_.cell_m);
    const double to = std::min(cells, std::floor(shading.far_m / model_.cell_m));
    if (factor > kNoShadow || from >= to) continue;
    out.push_back({static_cast<std::uint32_t>(from), static_cast<std::uint32_t>(to) - 1, factor});
  }
}

void ShipShadow::apply(const SpokeAim& aim, std::span<float> power) const {
  if (hulls_.empty()) return;
  thread_local std::vector<ShadowedCells> list;
  shadows(aim, list);
  for (const ShadowedCells& shadow : list) {
    const std::size_t end = std::min<std::size_t>(power.size(), shadow.last_cell + std::size_t{1});
    if (end > shadow.first_cell)
      scale_row(power.subspan(shadow.first_cell, end - shadow.first_cell), shadow.factor);
  }
}

float ShipShadow::seen(std::uint32_t plane_units, double range_m, double height_m,
                       std::uint32_t not_by) const {
  float seen = 1.0f;
  for (const Shading& shading : hulls_) {
    if (shading.hull == not_by || range_m <= shading.near_m || range_m >= shading.far_m) continue;
    const std::int64_t off = static_cast<std::int32_t>(shading.units - plane_units);
    if (off > shading.half_units || -off > shading.half_units) continue;
    const double line = model_.set.antenna_height_m - shading.slope * range_m +
                        range_m * range_m / (2.0 * earth_m_);
    seen = std::min(seen, static_cast<float>(std::clamp(1.0 - line / height_m, 0.0, 1.0)));
  }
  return seen;
}

}  // namespace skerry::echo
