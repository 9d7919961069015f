// One ray across land: what stands out above everything nearer.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

#include "echo/radar/radar_equation.hpp"
#include "echo/returns/land_returns.hpp"

namespace skerry::echo {

// Goes from cell to cell, nearest first, and keeps the slope below which land and Earth hide what
// lies behind.  Slopes are heights over the antenna's level, less the Earth's drop, by range.
class LandRay {
 public:
  LandRay(const LandModel& model, std::span<float> power)
      : model_(model),
        power_(power),
        horizon_(std::sqrt(2.0 * kEffectiveEarth * model.antenna_height_m)) {}

  double middle_of(std::size_t cell) const {
    return (static_cast<double>(cell) + 0.5) * model_.cell_m;
  }
  double shadow() const { return shadow_; }
  // Land whose slopes were worked out elsewhere.
  void raise_shadow(double slope) { shadow_ = std::max(shadow_, slope); }
  double slope_of(double height, double range) const {
    return (height - model_.antenna_height_m - drop_at(range)) / range;
  }

  // Whether nothing up to `height` between the two ranges can show.
  bool hides(double height, double near, double far) const {
    const double above = height - model_.antenna_height_m - drop_at(near) + 1e-3;
    return above / (above > 0.0 ? near : far) <= shadow_;
  }

  // How much of `height` at that range stands out; what stands there hides from now on.
  double shown(double height, double range) {
    const double below = hidden_below(range);
    const double slope = slope_of(height, range);
    if (slope <= below) return 0.0;
    shadow_ = slope;
    return std::min(height, (slope - below) * range);
  }

  // Adds what `height` metres across the line of sight return, gamma and cover given.
  void echo(std::size_t cell, double height, double gamma, double cover) {
    const double middle = middle_of(cell);
    power_[cell] += static_cast<float>(model_.unit_signal_to_noise * gamma * cover *
                                       model_.ray_radians * height / (middle * middle * middle));
  }

 private:
  static double drop_at(double range) { return range * range / (2.0 * kEffectiveEarth); }
  // The slope below which the sea's own curve or the land before hides everything at that range.
  double hidden_below(double range) const {
    const double sea_range = std::min(range, horizon_);
    const double sea = -model_.antenna_height_m / sea_range - sea_range / (2.0 * kEffectiveEarth);
    return std::max(shadow_, sea);
  }

  const LandModel& model_;
  std::span<float> power_;
  double horizon_;
  double shadow_ = -1e9;
};

}  // namespace skerry::echo
