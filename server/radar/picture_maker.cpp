#include "server/radar/picture_maker.hpp"

#include <algorithm>
#include <cmath>

namespace skerry::server {
namespace {

// The window read from the chart: a quarter more than the range and at least 12 NM, so that the own
// ship sails for a while before the chart is asked again.
Length window_radius(double range_m) {
  return metres(std::max(1.25 * range_m + echo::CoastPreparer::kMaxAnchorDistance,
                         nautical_miles(12.0).in_metres()));
}

}  // namespace

double index_slack_for(double range_m, double speed_mps) {
  return std::max({10.0, range_m / 400.0, 4.0 * std::fabs(speed_mps)});
}

std::shared_ptr<const echo::StructureIndex> structures_in_sight(const echo::CoastPicture& picture,
                                                                PlanePoint own_ship,
                                                                double slack_m) {
  if (!picture.structures) return nullptr;
  return std::make_shared<const echo::StructureIndex>(picture.structures, own_ship, slack_m);
}

CoastInSight seen_from(const echo::CoastPicturePtr& picture, const CoastWish& wish,
                       const PictureOrigin& origin) {
  const PlanePoint own_ship = picture->plane.to_plane(wish.own_ship);
  const double slack = index_slack_for(wish.resolution.range_m, wish.speed_mps);
  return {picture,
          std::make_shared<const echo::PolarIndex>(*picture, own_ship, slack),
          structures_in_sight(*picture, own_ship, slack),
          own_ship,
          slack,
          origin};
}

void PictureMaker::lay(const CoastWish& wish) {
  preparer_ = std::make_unique<echo::CoastPreparer>(
      chart_.load(wish.own_ship, window_radius(wish.resolution.range_m)), wish.own_ship, rules_);
}

bool PictureMaker::serves(const CoastWish& wish) const {
  return preparer_ && preparer_->serves(wish.own_ship, wish.resolution.range_m);
}

echo::CoastPicturePtr PictureMaker::picture(const CoastWish& wish) {
  return preparer_->prepare(wish.own_ship, wish.resolution);
}

}  // namespace skerry::server
