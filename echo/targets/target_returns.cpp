#include "echo/targets/target_returns.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "echo/kernel/exact_math.hpp"
#include "echo/kernel/hash.hpp"
#include "echo/targets/echo_parts.hpp"
#include "echo/targets/fluctuation.hpp"
#include "echo/targets/sector_view.hpp"
#include "protocol/quantity/bearing.hpp"

namespace skerry::echo {
namespace {

constexpr double kLeastEcho = 1e-4;  // of the noise: what is weaker is left out
constexpr double kLongestWake = 800.0;
constexpr std::uint64_t kPointSalt = 0x9017;

// Radians to the right of the line of sight; the series is 3e-8 off at a quarter.
double bearing_off(double right_m, double ahead_m) {
  const double q = right_m / ahead_m;
  if (!(ahead_m > 0.0) || std::fabs(q) > 0.25) return exact_atan2(right_m, ahead_m);
  const double q2 = q * q;
  return q * (1.0 - q2 * (1.0 / 3 - q2 * (1.0 / 5 - q2 * (1.0 / 7 - q2 * (1.0 / 9)))));
}

}  // namespace

struct TargetReturns::Sector {
  const Scene& scene;
  const SectorView& view;
  const HiddenHeight& hidden;
  double reach_m;

  std::uint64_t pass_key(std::uint64_t radar, std::uint32_t plane_units) const {
    return mixed(scene.seed, radar << 32 | view.pass(plane_units));
  }
};

TargetReturns::TargetReturns(const RadarModel& model, const Propagation* propagation)
    : model_(model),
      medium_{propagation, model.set.antenna_height_m, model.unit_snr},
      reach_units_(static_cast<std::uint32_t>(1.25 * model.set.beam_width_deg * kUnitsPerDegree)),
      beam_radians_(model.set.beam_width_deg * std::numbers::pi / 180.0),
      shadows_(model, medium_.effective_earth_m()),
      side_lobes_(model) {}

void TargetReturns::set_propagation(const Propagation* propagation) {
  medium_.propagation = propagation;
  shadows_ = ShipShadow(model_, medium_.effective_earth_m());
}

void TargetReturns::prepare(const Scene& scene, const SpokeAim& first, const SpokeAim& last,
                            const HiddenHeight& hidden, std::vector<PointEcho>& out) {
  out.clear();
  out_ = &out;
  const SectorView view(first, last, reach_units_);
  const Sector sector{scene, view, hidden, model_.cell_m * model_.geometry.cells};
  if (figures_.size() < scene.hulls.size()) figures_.resize(scene.hulls.size());
  met_.clear();
  bool wakes = false;
  for (std::uint32_t i = 0; i < scene.hulls.size(); ++i) {
    const Hull& hull = scene.hulls[i];
    if (view.meets(view.from_own_ship(hull.centre, hull.velocity), radius_of(hull)))
      met_.push_back(i);
    wakes = wakes || hull.wake;
  }
  shadows_.prepare(scene, view, met_);
  for (const std::uint32_t i : met_) add_ship(sector, i);
  for (std::uint32_t i = 0; wakes && i < scene.hulls.size(); ++i) {
    if (scene.hulls[i].wake) add_wake(sector, i);
  }
  for (std::uint32_t i = 0; i < scene.points.size(); ++i) {
    const PointTarget& point = scene.points[i];
    if (view.meets(view.from_own_ship(point.place, point.velocity), 1.0)) add_point(sector, i);
  }
  for (std::uint32_t i = 0; i < scene.turbines.size(); ++i) {
    const WindTurbine& turbine = scene.turbines[i];
    if (view.meets(turbine.place - view.own_ship(), 0.5 * turbine.rotor_diameter_m + 4.0))
      add_turbine(sector, i);
  }
  if (scene.artefacts.overhead_cables) {
    for (std::uint32_t i = 0; i < scene.cables.size(); ++i) add_cable(sector, i);
  }
  const Artefacts& show = scene.artefacts;
  wants_strong_ = show.side_lobes || show.multiple_echoes ||
                  (show.indirect_echoes && !scene.obstructions.empty());
  if (wants_strong_) side_lobes_.update(scene, first, view, medium_, hidden);
  out_ = nullptr;
}

float TargetReturns::seen(const Sector& sector, const Polar& at, double height_m,
                          std::uint32_t not_by) const {
  float share = 1.0f;
  if (sector.hidden) {
    const double under = static_cast<double>(sector.hidden(at.units, at.range_m));
    share = static_cast<float>(std::clamp(1.0 - under / height_m, 0.0, 1.0));
  }
  return shadows_.any() ? std::min(share, shadows_.seen(at.units, at.range_m, height_m, not_by))
                        : share;
}

const TargetReturns::Figure& TargetReturns::figure_of(const Hull& hull, std::uint32_t index,
                                                      ShipDetail detail, std::uint32_t aspect_units,
                                                      std::uint64_t pass_key) {
  Figure& figure = figures_[index];
  const std::uint32_t step = aspect_units >> 22;
  if (figure.scatterers.empty() || figure.identity != hull.identity ||
      figure.pass_key != pass_key || figure.along != detail.along || figure.rows != detail.rows ||
      figure.aspect_step != step) {
    figure.identity = hull.identity, figure.pass_key = pass_key;
    figure.along = detail.along, figure.rows = detail.rows, figure.aspect_step = step;
    ship_shares(hull.identity, detail, step << 22, figure.scatterers);
    fluctuate(hull.identity, pass_key, figure.scatterers);
  }
  return figure;
}

void TargetReturns::add_ship(const Sector& sector, std::uint32_t index) {
  const Hull& hull = sector.scene.hulls[index];
  const ShipSight sight = sight_of(hull, sector.view);
  const double range = sight.at.range_m;
  if (range - radius_of(hull) > sector.reach_m) return;
  const double section = ship_mean_cross_section(hull, model_.set.frequency_hz, sight.side);
  const double power = section * medium_.body_snr(range, hull.height_m);
  if (!(power > kLeastEcho)) return;

  const PlanePoint p = sight.from_own_ship;
  const ShipResolution resolution{std::max(1.0, model_.pulse_cells) * model_.cell_m,
                                  std::max(1.0, range * beam_radians_)};
  const Figure& figure =
      figure_of(hull, index, ship_detail(hull, sight.side, sight.ahead, resolution),
                sight.aspect_units, sector.pass_key(model_.radar, sight.at.units));

  // Along and right of the line of sight, per metre forward and to starboard.
  const double per_range = 1.0 / std::max(1.0, range);
  const double forward_along = (sight.bow.sin * p.east_m + sight.bow.cos * p.north_m) * per_range;
  const double forward_right = (sight.bow.sin * p.north_m - sight.bow.cos * p.east_m) * per_range;
  const auto polar_at = [&](double forward, double starboard) {
    const double along = range + forward * forward_along - starboard * forward_right;
    const double right = forward * forward_right + starboard * forward_along;
    return Polar{std::sqrt(along * along + right * right),
                 sight.at.units + units_of_radians(bearing_off(right, along))};
  };
  const bool covered =
      (sector.hidden || shadows_.any()) &&
      (seen(sector, sight.at, hull.height_m, index) < 1.0f ||
       seen(sector, polar_at(0.5 * hull.length_m, 0.0), hull.height_m, index) < 1.0f ||
       seen(sector, polar_at(-0.5 * hull.length_m, 0.0), hull.height_m, index) < 1.0f);

  PointEcho echo;
  echo.body = body_of(BodyKind::ship, index);
  echo.height_m = static_cast<float>(hull.height_m);
  const double range2 = std::max(25.0, range * range);
  for (const ShipScatterer& s : figure.scatterers) {
    const Polar at = polar_at(static_cast<double>(s.forward) * hull.length_m,
                              static_cast<double>(s.starboard) * hull.beam_m);
    const double nearer = range2 / std::max(25.0, at.range_m * at.range_m);
    double share = static_cast<double>(s.share) * nearer * nearer;
    if (covered) share *= static_cast<double>(seen(sector, at, hull.height_m, index));
    echo.range_m = at.range_m;
    echo.bearing_units = at.units;
    echo.power = std::min(kMaxPointPower, static_cast<float>(power * share));
    echo.phase = s.phase;
    if (static_cast<double>(echo.power) > kLeastEcho) out_->push_back(echo);
  }
}

void TargetReturns::add_part(const Sector& sector, const EchoPart& part, const Polar& at,
                             std::uint32_t body) {
  if (at.range_m >= sector.reach_m) return;
  const double snr = part.from_the_water ? medium_.body_snr(at.range_m, part.height_m)
                                         : medium_.point_snr(at.range_m, part.height_m);
  double power = part.cross_section_m2 * snr;
  if (!(power > kLeastEcho)) return;
  if (sector.hidden || shadows_.any()) {
    const float share = seen(sector, at, part.height_m, ~0u);
    power *= static_cast<double>(part.from_the_water ? share : upper_quarter(share));
    if (!(power > kLeastEcho)) return;
  }
  out_->push_back({at.range_m, at.units, std::min(kMaxPointPower, static_cast<float>(power)),
                   part.phase, body, static_cast<float>(part.height_m)});
}

void TargetReturns::add_parts(const Sector& sector, std::uint32_t body) {
  for (const EchoPart& part : parts_) {
    const PlanePoint p = part.place - sector.view.own_ship();
    if (sector.view.meets(p, 1.0)) add_part(sector, part, polar_of(p), body);
  }
}

void TargetReturns::add_point(const Sector& sector, std::uint32_t index) {
  const PointTarget& point = sector.scene.points[index];
  const Polar at = polar_of(sector.view.from_own_ship(point.place, point.velocity));
  const double mean = model_.set.band() == Band::x ? point.x_band_m2 : point.s_band_m2;
  const std::uint64_t key =
      mixed(point.identity ^ kPointSalt, sector.pass_key(model_.radar, at.units));
  const auto now = static_cast<double>(fluctuation_of(point.fluctuation, key));
  add_part(sector, {{}, point.height_m, mean * now, false, 0.0f}, at,
           body_of(BodyKind::point, index));
}

void TargetReturns::add_turbine(const Sector& sector, std::uint32_t index) {
  const WindTurbine& turbine = sector.scene.turbines[index];
  const Polar at = polar_of(turbine.place - sector.view.own_ship());
  turbine_parts(turbine, sector.view.own_ship(),
                in_seconds(sector.scene.time.time_since_epoch()) + sector.view.dt(),
                sector.pass_key(model_.radar, at.units), parts_);
  add_parts(sector, body_of(BodyKind::turbine, index));
}

void TargetReturns::add_wake(const Sector& sector, std::uint32_t index) {
  const Hull& hull = sector.scene.hulls[index];
  const PlanePoint p = sector.view.from_own_ship(hull.centre, hull.velocity);
  const double radius = kLongestWake + hull.length_m;
  if (!sector.view.meets(p, radius) || length_of(p) - radius > sector.reach_m) return;
  wake_parts(hull, sector.view.dt(), sector.pass_key(model_.radar, polar_of(p).units), parts_);
  add_parts(sector, body_of(BodyKind::wake, index));
}

void TargetReturns::add_cable(const Sector& sector, std::uint32_t index) {
  const auto part = cable_part(sector.scene.cables[index], sector.view.own_ship());
  if (!part) return;
  parts_.assign(1, *part);
  add_parts(sector, body_of(BodyKind::cable, index));
}

}  // namespace skerry::echo
