#include "server/plotter/tracks/own_motion.hpp"

namespace skerry::server {

void OwnMotion::start(PlanePoint place, ScenarioTime time) {
  state_ = {};
  state_.mean(0) = place.east_m;
  state_.mean(1) = place.north_m;
  state_.covariance.diagonal() << 1.0, 1.0, 200.0, 200.0, 0.0;
  time_ = time;
}

void OwnMotion::take(PlanePoint place, ScenarioTime time) {
  if (time - time_ < kEvery) return;
  predict(state_, kModel, std::chrono::duration<double>(time - time_).count());
  time_ = time;
  MeasuredPlace measured;
  measured.place = {place.east_m, place.north_m};
  measured.covariance *= kPlaceSigma_m * kPlaceSigma_m;
  correct(state_, measured, innovation(state_, measured));
}

}  // namespace skerry::server
