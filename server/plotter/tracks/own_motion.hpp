// OwnMotion: own ship's velocity, from where its spokes say that it was.
#pragma once

#include "protocol/quantity/time.hpp"
#include "server/plotter/motion/motion_model.hpp"

namespace skerry::server {

// A Kalman filter of places: receivers repeat a place for a second, and leave one some metres off.
class OwnMotion {
 public:
  void start(PlanePoint place, ScenarioTime time);
  void take(PlanePoint place, ScenarioTime time);
  PlanePoint velocity_mps() const { return state_.velocity(); }

  // In another plane (see ImmFilter::change).
  template <typename Change>
  void change(Change&& change) {
    change(state_);
  }

 private:
  static constexpr Duration kEvery = std::chrono::milliseconds(250);
  static constexpr double kPlaceSigma_m = 1.0;
  static constexpr MotionModel kModel{.acceleration = 0.02, .turn_ahead = 0.01};
  MotionState state_;
  ScenarioTime time_{};
};

}  // namespace skerry::server
