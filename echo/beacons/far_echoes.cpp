#include "echo/beacons/far_echoes.hpp"

#include <algorithm>

#include "echo/beacons/far_coast.hpp"
#include "echo/beacons/one_way.hpp"
#include "echo/kernel/exact_math.hpp"
#include "echo/kernel/hash.hpp"
#include "echo/targets/fluctuation.hpp"
#include "echo/targets/sector_view.hpp"
#include "echo/targets/ship_figure.hpp"

namespace skerry::echo {

struct FarEchoes::Look {
  const Scene& scene;
  const Propagation& propagation;
  const HiddenHeight& hidden;
  SectorView view;
  TargetMedium medium;
};

FarEchoes::FarEchoes(const RadarModel& model)
    : model_(model),
      reach_units_(BeamBound(model.set).main_units()),
      nearest_m_(unambiguous_range(model.pulse)),
      farthest_m_(std::min(kFarthest, farthest_trace(model.pulse))) {}

bool FarEchoes::in_reach(PlanePoint from_own_ship) const {
  const double range2 = dot(from_own_ship, from_own_ship);
  return range2 >= nearest_m_ * nearest_m_ && range2 < farthest_m_ * farthest_m_;
}

void FarEchoes::add(const Look& look, const Polar& at, double height_m, double power,
                    std::uint32_t body) {
  if (!(power >= static_cast<double>(kLeastTrace))) return;
  const double known_to = model_.cell_m * model_.geometry.cells;
  if (behind_land(look.hidden, at, height_m, model_.set.antenna_height_m, model_.cell_m, known_to))
    return;
  PointEcho echo;
  echo.range_m = at.range_m;
  echo.bearing_units = at.units;
  echo.power = std::min(kMaxPointPower, static_cast<float>(power));
  echo.body = body;
  echo.height_m = static_cast<float>(height_m);
  found_.push_back(echo);
}

void FarEchoes::add_ships(const Look& look) {
  for (std::uint32_t i = 0; i < look.scene.hulls.size(); ++i) {
    const Hull& hull = look.scene.hulls[i];
    const PlanePoint offset = hull.centre + hull.velocity * look.view.dt() - look.view.own_ship();
    if (!in_reach(offset) || !look.view.meets(offset, hull.length_m)) continue;
    const ShipSight sight = sight_of(hull, look.view);
    const std::uint64_t pass = std::uint64_t{model_.radar} << 32 | look.view.pass(sight.at.units);
    const double section =
        ship_mean_cross_section(hull, model_.set.frequency_hz, sight.side) *
        static_cast<double>(exponential_of(mixed(look.scene.seed, pass, hull.identity)));
    add(look, sight.at, hull.height_m,
        section * look.medium.body_snr(sight.at.range_m, hull.height_m),
        body_of(BodyKind::far_ship, i));
  }
}

void FarEchoes::add_points(const Look& look) {
  for (std::uint32_t i = 0; i < look.scene.points.size(); ++i) {
    const PointTarget& point = look.scene.points[i];
    const PlanePoint offset = point.place + point.velocity * look.view.dt() - look.view.own_ship();
    if (!in_reach(offset) || !look.view.meets(offset, 0.0)) continue;
    const Polar at = polar_of(offset);
    const std::uint64_t pass = std::uint64_t{model_.radar} << 32 | look.view.pass(at.units);
    const double section = (model_.set.band() == Band::x ? point.x_band_m2 : point.s_band_m2) *
                           static_cast<double>(fluctuation_of(
                               point.fluctuation, mixed(look.scene.seed, pass, point.identity)));
    add(look, at, point.height_m, section * look.medium.point_snr(at.range_m, point.height_m),
        body_of(BodyKind::far_point, i));
  }
}

void FarEchoes::add_coast(const Look& look) {
  const CoastPicturePtr& coast = look.scene.coast;
  if (!coast || coast->range_m + coast->slack_m < nearest_m_) return;
  const PlanePoint own = look.view.own_ship();
  const PlanePoint sailed = own - made_at_;
  if (coast != made_of_ || dot(sailed, sailed) > kAnewAfter * kAnewAfter) {
    made_of_ = coast, made_at_ = own;
    FarCoast far;
    far.height_m = kCoastHeight;
    far.farthest_m = farthest_m_;
    std::vector<PointEcho> echoes;
    far_coast_points(model_, look.propagation, *coast, own, far, echoes);
    shores_.clear();
    for (const PointEcho& echo : echoes) {
      const SinCos way = sin_cos_units(echo.bearing_units);
      shores_.push_back({own + PlanePoint{way.sin, way.cos} * echo.range_m, echo});
    }
  }
  for (const Shore& shore : shores_) {
    if (!look.view.meets(shore.place - own, 0.0)) continue;
    const Polar at = polar_of(shore.place - own);
    PointEcho echo = shore.echo;
    echo.range_m = at.range_m, echo.bearing_units = at.units;
    found_.push_back(echo);
  }
}

void FarEchoes::append(const Scene& scene, const Propagation& propagation, const SpokeAim& first,
                       const SpokeAim& last, const HiddenHeight& hidden,
                       std::vector<PointEcho>& out, PrfJitter jitter) {
  if (!scene.artefacts.second_trace || nearest_m_ >= farthest_m_) return;
  const Look look{scene, propagation, hidden, SectorView(first, last, reach_units_),
                  TargetMedium{&propagation, model_.set.antenna_height_m, model_.unit_snr}};
  found_.clear();
  add_ships(look);
  add_points(look);
  add_coast(look);
  if (found_.empty()) return;
  fold_second_trace(model_, found_, jitter);
  out.insert(out.end(), found_.begin(), found_.end());
}

}  // namespace skerry::echo
