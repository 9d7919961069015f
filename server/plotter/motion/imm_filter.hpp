// ImmFilter: a target that may go steadily, turn, or change its speed.
#pragma once

#include <array>

#include "server/plotter/motion/motion_model.hpp"

namespace skerry::server {

// Interacting multiple models (Blom and Bar-Shalom 1988, "The Interacting Multiple Model Algorithm
// for Systems with Markovian Switching Coefficients"): one Kalman filter each for steady motion, a
// coordinated turn and a change of speed; how well each expected the last measurements says how
// much it counts, and each begins the next step from what all of them know.
class ImmFilter {
 public:
  static constexpr std::size_t kModels = 3;
  enum Model : std::size_t { steady = 0, turning = 1, accelerating = 2 };

  struct Rule {
    std::array<MotionModel, kModels> models{{
        {.acceleration = 4e-4, .turn_ahead = 0.015},
        {.acceleration = 4e-3, .turns = true, .turn_change = 4e-6},
        {.acceleration = 0.08, .turn_ahead = 0.02},
    }};
    // How long each goes on before another takes over, s, on the average.
    std::array<double, kModels> lasts_s{{150.0, 50.0, 20.0}};
    std::array<double, kModels> shares{{0.8, 0.1, 0.1}};  // at the beginning
  };

  ImmFilter() : ImmFilter(Rule{}) {}
  explicit ImmFilter(const Rule& rule) : rule_(rule) {}

  void start(const MotionState& state);
  // Goes on by so many seconds, 0 to 600.
  void predict(double seconds);
  // Returns how well it fitted the prediction: base-2 logarithm of its density, 1/m^2.
  double correct(const MeasuredPlace& measured);

  // All models together, by their shares.
  const MotionState& state() const { return whole_; }
  double share(Model model) const { return shares_[model]; }

  // Places and velocities of all models in another plane: turned clockwise by `turn`, then moved.
  template <typename Change>
  void change(Change&& change) {
    for (MotionState& state : states_) change(state);
    change(whole_);
  }

 private:
  void mix(double seconds);
  void join();

  Rule rule_;
  std::array<MotionState, kModels> states_;
  std::array<double, kModels> shares_{};
  MotionState whole_;
};

}  // namespace skerry::server
