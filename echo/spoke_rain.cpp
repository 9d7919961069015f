#include "echo/spoke_rain.hpp"

#include <algorithm>
#include <utility>

#include "protocol/quantity/angle.hpp"

namespace skerry::echo {
namespace {

constexpr double kBeamsBeside = 1.0 / 6.0;  // between a spoke and the middle of its group
constexpr double kRadiiBeside = 1.0 / 20.0;

}  // namespace

std::uint32_t rain_spokes(const Scene& scene, const RadarModel& model) {
  const double spoke_radians = kRadiansPerTurn / model.geometry.spokes_per_turn;
  const double beam_radians = model.set.beam_width_deg * kRadiansPerDegree;
  const double reach_m = model.cell_m * model.geometry.cells;
  double most = kBeamsBeside * beam_radians;
  for (const RainCell& cell : scene.rain) {
    if (cell.kind != RainKind::even) continue;
    const double farthest_m = std::min(reach_m, length_of(cell.centre - scene.own_ship));
    most = std::min(most, kRadiiBeside * cell.radius_m / std::max(1.0, farthest_m));
  }
  std::uint32_t together = 1;
  while (together < 16 && (together - 0.5) * spoke_radians <= most) together *= 2;
  return together;
}

SpokeAim rain_aim(const Scene& scene, const SpokeClock& clock, std::uint64_t spoke,
                  std::uint32_t together) {
  SpokeAim aim = aim_of(scene, clock, spoke / together * together + together / 2);
  if (together > 1)
    aim.plane_units -= static_cast<std::uint32_t>(0x80000000u / clock.spokes_per_turn());
  return aim;
}

SpokeRain::SpokeRain(const RadarModel& model) : model_(model), returns_(model) {}

Shelf<std::vector<SpokeRain::Group>>& SpokeRain::shelf() {
  static Shelf<std::vector<Group>> shelf;
  return shelf;
}

void SpokeRain::prepare(const Scene& scene, std::span<const SpokeAim> aims, bool sways,
                        const ParallelFor& parallel) {
  count_ = 0;
  if (scene.rain.empty()) return;
  together_ = sways ? 1 : rain_spokes(scene, model_);
  first_group_ = aims.front().spoke / together_;
  count_ = static_cast<std::size_t>(aims.back().spoke / together_ - first_group_) + 1;
  if (groups_.empty()) groups_ = shelf().take();
  if (groups_.size() < count_) groups_.resize(count_);
  parallel(count_, [&](std::size_t g) {
    Group& group = groups_[g];
    const SpokeAim aim =
        together_ == 1 ? aims[g]
                       : rain_aim(scene, model_.clock, (first_group_ + g) * together_, together_);
    group.path.trace(scene, model_, aim);
    if (!group.path.any()) return;
    group.echoes.resize(group.path.knot_rates().size());
    rain_echoes(group.path.knot_rates(), group.echoes);
  });
}

void SpokeRain::pass(std::uint64_t seed, const SpokeAim& aim, std::span<float> power) const {
  if (count_ == 0) return;
  const Group& group = groups_[static_cast<std::size_t>(aim.spoke / together_ - first_group_)];
  const RainPath& path = group.path;
  if (!path.any()) return;
  returns_.pass(
      seed, aim,
      {group.echoes, path.knot_transmissions(), path.step(), path.first_wet(), path.end_wet()},
      power);
}

void SpokeRain::release() {
  if (groups_.empty()) return;
  shelf().put_back(std::exchange(groups_, {}));
  count_ = 0;
}

}  // namespace skerry::echo
