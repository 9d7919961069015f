#include "echo/returns/static_ray.hpp"

#include <algorithm>
#include <optional>

#include "echo/returns/land_returns.hpp"
#include "protocol/quantity/angle.hpp"

namespace skerry::echo {
namespace {

// Land of which no more is known than where it is.
bool is_plain_land(const StaticView& view, const std::vector<LandInterval>& land) {
  if (view.coast->elevation || view.coast->cover) return false;
  if (view.coast->edge_shores.empty()) return true;
  return std::all_of(land.begin(), land.end(),
                     [&](const LandInterval& l) { return is_plain(l, view.coast->shores); });
}

void add_typed_land(const StaticView& view, const LandModel& model, const Ray& ray, double range_m,
                    const LatticePath& path, GroundProfile* profile, StaticScratch& scratch,
                    std::span<float> power) {
  lay_shores(scratch.land, *view.coast, ray, model.ray_radians, model.cell_m, range_m, view.water,
             path, scratch.shores);
  std::optional<ChartedRelief> relief;
  std::optional<ChartedCover> cover;
  if (view.coast->elevation || view.coast->cover) {
    const GroundTrack track(view.geo, view.sailed, ray.bearing_units - view.north_units);
    if (view.coast->elevation) relief.emplace(ChartedRelief{*view.coast->elevation, track});
    if (view.coast->cover) cover.emplace(ChartedCover{*view.coast->cover, track});
  }
  add_shores(scratch.shores, model, view.water, path, relief ? &*relief : nullptr, profile, power,
             cover ? &*cover : nullptr);
}

}  // namespace

bool add_static_ray(const StaticView& view, const StaticRayModel& model, std::uint32_t plane_units,
                    bool profile, StaticScratch& scratch, std::span<float> power) {
  const Ray ray{view.at, plane_units};
  const double range = std::min(model.cell_m * static_cast<double>(power.size()),
                                complete_range(*view.coast, view.at));
  land_along(scratch.crossings, view.ashore, range, scratch.land);
  const StructureModel built{model.cell_m, model.antenna_height_m, model.unit_snr,
                             static_cast<std::uint32_t>(0x100000000ull / model.rays_per_turn)};
  bool structures = false;
  if (view.structures) {
    find_structures(*view.structures, ray, built, scratch.structures);
    structures = scratch.structures.any();
  }
  if (!scratch.land.empty()) {
    const LandModel land{model.cell_m, model.antenna_height_m,
                         kRadiansPerTurn / model.rays_per_turn, model.unit_snr, view.water.seed};
    const LatticePath path =
        lattice_path(view.geo, view.sailed, plane_units - view.north_units, model.cell_m);
    profile = profile || structures;
    if (profile) scratch.ground.clear(power.size());
    GroundProfile* ground = profile ? &scratch.ground : nullptr;
    if (is_plain_land(view, scratch.land)) {
      add_land(scratch.land, land, path, power, ground);
    } else {
      add_typed_land(view, land, ray, range, path, ground, scratch, power);
    }
  }
  bool any = !scratch.land.empty();
  if (structures) {
    any |= add_structures(*view.structures, scratch.structures, ray, built,
                          scratch.land.empty() ? nullptr : &scratch.ground, power);
  }
  return any;
}

}  // namespace skerry::echo
