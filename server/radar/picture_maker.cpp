#include "server/radar/picture_maker.hpp"

namespace skerry::server {

CoastInSight seen_from(const echo::CoastPicturePtr& picture, const CoastWish& wish,
                       const PictureOrigin& origin) {
  const PlanePoint own_ship = picture->plane.to_plane(wish.own_ship);
  const double slack = echo::index_slack_for(wish.resolution.range_m, wish.speed_mps);
  return {picture, echo::index_of(*picture, own_ship, slack), own_ship, slack, origin};
}

void PictureMaker::lay(const CoastWish& wish) {
  preparer_ = std::make_unique<echo::CoastPreparer>(
      chart_.load(wish.own_ship, echo::chart_window_for(wish.resolution.range_m)), wish.own_ship,
      rules_);
}

bool PictureMaker::serves(const CoastWish& wish) const {
  return preparer_ && preparer_->serves(wish.own_ship, wish.resolution.range_m);
}

echo::CoastPicturePtr PictureMaker::picture(const CoastWish& wish) {
  return preparer_->prepare(wish.own_ship, wish.resolution);
}

}  // namespace skerry::server
