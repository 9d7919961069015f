#include "server/radar/laid_fixtures.hpp"

#include <cmath>

#include "echo/kernel/hash.hpp"
#include "protocol/quantity/plane_geometry.hpp"
#include "server/world/ship_units.hpp"

namespace skerry::server {
namespace {

constexpr double kPlaneLatitudes = 3.5;  // degrees to either side: 210 NM

echo::Fluctuation fluctuation_of(scenario::Target::Fluctuation fluctuation) {
  switch (fluctuation) {
    case scenario::Target::steady:
      return echo::Fluctuation::steady;
    case scenario::Target::one_dominant:
      return echo::Fluctuation::one_dominant;
    default:
      return echo::Fluctuation::rayleigh;
  }
}

}  // namespace

std::uint64_t identity_of(std::uint64_t seed, Fixture kind, std::uint64_t number) {
  return echo::mixed(echo::mixed(seed, 0xF1A7 + static_cast<std::uint64_t>(kind)), number);
}

bool in_plane(const echo::LocalPlane& plane, GeoPoint place) {
  return std::fabs(place.latitude_deg - plane.anchor().latitude_deg) <= kPlaneLatitudes;
}

echo::PointTarget point_of(const scenario::Target& target, std::uint64_t seed, std::size_t number) {
  echo::PointTarget point;
  point.height_m = target.height_m();
  point.x_band_m2 = target.x_band_m2();
  point.s_band_m2 = target.s_band_m2();
  point.fluctuation = fluctuation_of(target.fluctuation());
  point.identity = identity_of(seed, Fixture::small_target, number);
  return point;
}

LaidFixtures::LaidFixtures(const scenario::Scenario& scenario, std::uint64_t seed,
                           const echo::LocalPlane& plane) {
  for (int i = 0; i < scenario.targets_size(); ++i) {
    const scenario::Target& target = scenario.targets(i);
    const GeoPoint place = geo_point(target.position());
    if (target.kind() == scenario::Target::ship || target.speed_kn() > 0.0) continue;
    if (!in_plane(plane, place)) continue;
    points_.push_back(point_of(target, seed, static_cast<std::size_t>(i)));
    points_.back().place = plane.to_plane(place);
  }
  for (int i = 0; i < scenario.wind_turbines_size(); ++i) {
    const scenario::WindTurbine& said = scenario.wind_turbines(i);
    const GeoPoint place = geo_point(said.position());
    if (!in_plane(plane, place)) continue;
    turbines_.push_back({plane.to_plane(place), said.hub_height_m(), said.rotor_diameter_m(),
                         said.rotor_rpm(), said.facing_deg() + plane.true_north_degrees(place),
                         identity_of(seed, Fixture::turbine, static_cast<std::uint64_t>(i))});
  }
  for (int i = 0; i < scenario.cables_size(); ++i) {
    const scenario::OverheadCable& said = scenario.cables(i);
    const GeoPoint from = geo_point(said.from()), to = geo_point(said.to());
    if (!in_plane(plane, from) || !in_plane(plane, to)) continue;
    cables_.push_back({plane.to_plane(from), plane.to_plane(to), said.height_m(),
                       identity_of(seed, Fixture::cable, static_cast<std::uint64_t>(i))});
  }
  for (int i = 0; i < scenario.racons_size(); ++i) {
    const scenario::Racon& said = scenario.racons(i);
    const GeoPoint place = geo_point(said.position());
    if (!in_plane(plane, place)) continue;
    echo::Racon racon;
    racon.place = plane.to_plane(place);
    racon.height_m = said.height_m();
    racon.code = said.code();
    racon.x_band = said.x_band();
    racon.s_band = said.s_band();
    racon.delay_s = said.delay_us() * 1e-6;
    racon.length_s = said.length_us() * 1e-6;
    racon.on_s = said.on_s();
    racon.period_s = said.period_s();
    if (said.sector_from_deg() != 0.0 || said.sector_to_deg() != 0.0) {
      const double north = plane.true_north_degrees(place);
      racon.sector_from_deg = said.sector_from_deg() + north;
      racon.sector_to_deg = said.sector_to_deg() + north;
    }
    racon.power_w = said.power_w();
    racon.antenna_gain_db = said.antenna_gain_db();
    racon.threshold_dbm = said.threshold_dbm();
    racon.side_lobe_suppression = said.side_lobe_suppression();
    racon.identity = identity_of(seed, Fixture::racon, static_cast<std::uint64_t>(i));
    racons_.push_back(std::move(racon));
  }
}

void LaidFixtures::add_to(echo::Scene& scene, double reach_m) const {
  const auto near = [&](PlanePoint place) { return length_of(place - scene.own_ship) <= reach_m; };
  for (const auto& point : points_) {
    if (near(point.place)) scene.points.push_back(point);
  }
  for (const auto& turbine : turbines_) {
    if (near(turbine.place)) scene.turbines.push_back(turbine);
  }
  for (const auto& cable : cables_) {
    if (distance_to_segment(scene.own_ship, cable.from, cable.to) <= reach_m)
      scene.cables.push_back(cable);
  }
  for (const auto& racon : racons_) {
    if (near(racon.place)) scene.racons.push_back(racon);
  }
}

}  // namespace skerry::server
