#include "server/radar/coast_keeper.hpp"

namespace skerry::server {
namespace {

bool serves(const CoastInSight& coast, const CoastWish& wish) {
  const PlanePoint at = coast.picture->plane.to_plane(wish.own_ship);
  const auto away = [&](PlanePoint from) { return length_of(at - from); };
  return coast.picture->range_m >= wish.resolution.range_m &&
         away(coast.index_centre) <= 0.5 * coast.index_slack_m &&
         away(coast.picture->centre) <= 0.5 * coast.picture->slack_m;
}

}  // namespace

void CoastKeeper::begin(const echo::RadarResolution& resolution) {
  asked_after_ = nullptr;
  asked_for_ = resolution;
}

void CoastKeeper::look_after(const CoastWish& wish, ScenarioTime now) {
  const CoastInSightPtr coast = latest();
  const bool other = !(wish.resolution == asked_for_);
  if (coast == asked_after_ && !other && is_waiting(now)) return;
  if (!other && coast && serves(*coast, wish)) return;
  asked_after_ = coast;
  asked_for_ = wish.resolution;
  asked_at_ = now;
  coast_.ask(slot_, wish);
}

}  // namespace skerry::server
