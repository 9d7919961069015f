#include "echo/targets/side_lobe_targets.hpp"

#include <algorithm>

#include "echo/kernel/exact_math.hpp"
#include "echo/kernel/hash.hpp"
#include "echo/targets/echo_parts.hpp"
#include "echo/targets/fluctuation.hpp"
#include "echo/targets/point_echo.hpp"
#include "echo/targets/sector_view.hpp"
#include "echo/targets/ship_figure.hpp"

namespace skerry::echo {
namespace {

constexpr double kMostGain = 16.0;  // two-ray lobing's, two-way power
constexpr std::uint32_t kBlocksPerTurn = 8;
constexpr int kMaxPoints = 3;
constexpr std::uint64_t kLobeSalt = 0x51DE;

}  // namespace

SideLobeTargets::SideLobeTargets(const RadarModel& model) : model_(model) {
  const double highest = std::max(model.set.near_side_lobe_db, model.set.far_side_lobe_db);
  least_power_ = static_cast<float>(kLeastLobePower / ratio_from_decibels(2.0 * highest));
}

void SideLobeTargets::update(const Scene& scene, const SpokeAim& first, const SectorView& view,
                             const TargetMedium& medium, const HiddenHeight& hidden) {
  const std::uint64_t block =
      first.spoke / std::max(1u, model_.geometry.spokes_per_turn / kBlocksPerTurn);
  const std::size_t targets = scene.hulls.size() + scene.points.size() + scene.turbines.size();
  if (block == block_ && targets == made_for_) return;
  block_ = block, made_for_ = targets;
  strong_.points.clear();
  ++strong_.version;
  for (std::uint32_t i = 0; i < scene.hulls.size(); ++i) {
    const Hull& hull = scene.hulls[i];
    const ShipSight sight = sight_of(hull, view);
    add(scene, view, medium, hidden,
        {sight.from_own_ship, ship_mean_cross_section(hull, model_.set.frequency_hz, sight.side),
         hull.height_m, hull.length_m * sight.ahead + hull.beam_m * sight.side, true,
         Fluctuation::rayleigh, hull.identity, body_of(BodyKind::ship, i)});
  }
  const bool x_band = model_.set.band() == Band::x;
  for (std::uint32_t i = 0; i < scene.points.size(); ++i) {
    const PointTarget& point = scene.points[i];
    add(scene, view, medium, hidden,
        {view.from_own_ship(point.place, point.velocity),
         x_band ? point.x_band_m2 : point.s_band_m2, point.height_m, 0.0, false, point.fluctuation,
         point.identity, body_of(BodyKind::point, i)});
  }
  for (std::uint32_t i = 0; i < scene.turbines.size(); ++i) {
    const WindTurbine& turbine = scene.turbines[i];
    add(scene, view, medium, hidden,
        {turbine.place - view.own_ship(), kTowerSection, turbine.hub_height_m, 0.0, true,
         Fluctuation::steady, turbine.identity, body_of(BodyKind::turbine, i)});
  }
}

void SideLobeTargets::add(const Scene& scene, const SectorView& view, const TargetMedium& medium,
                          const HiddenHeight& hidden, const Whole& whole) {
  const double range = length_of(whole.from_own_ship);
  if (range - 0.5 * whole.depth_m > model_.cell_m * model_.geometry.cells) return;
  const auto least = static_cast<double>(least_power_);
  if (!(whole.section_m2 * kMostGain * medium.free_space_snr(range) > least)) return;
  double power =
      whole.section_m2 * (whole.from_the_water ? medium.body_snr(range, whole.height_m)
                                               : medium.point_snr(range, whole.height_m));
  if (!(power > least)) return;
  const Polar at = polar_of(whole.from_own_ship);
  if (hidden) {
    const double under = static_cast<double>(hidden(at.units, at.range_m));
    const auto share = static_cast<float>(std::clamp(1.0 - under / whole.height_m, 0.0, 1.0));
    power *= static_cast<double>(whole.from_the_water ? share : upper_quarter(share));
    if (!(power > least)) return;
  }
  const double pulse = std::max(1.0, model_.pulse_cells) * model_.cell_m;
  const int count = std::clamp(static_cast<int>(whole.depth_m / pulse) + 1, 1, kMaxPoints);
  const std::uint64_t pass = std::uint64_t{model_.radar} << 32 | view.pass(at.units);
  const std::uint64_t key = mixed(scene.seed, whole.identity ^ kLobeSalt, pass);
  for (int k = 0; k < count; ++k) {
    const std::uint64_t hash = mixed(key + static_cast<std::uint64_t>(k));
    PointEcho echo;
    echo.range_m = std::max(0.0, at.range_m + whole.depth_m * ((k + 0.5) / count - 0.5));
    echo.bearing_units = at.units;
    echo.power = std::min(kMaxPointPower, static_cast<float>(power / count) *
                                              fluctuation_of(whole.fluctuation, hash));
    echo.phase = static_cast<float>(hash & 1023u) * 0x1p-10f;
    echo.body = whole.body;
    echo.height_m = static_cast<float>(whole.height_m);
    strong_.points.push_back(echo);
  }
}

}  // namespace skerry::echo
