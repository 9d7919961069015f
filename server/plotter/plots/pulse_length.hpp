// PulseLength: how long a point shows along the range, learnt from the echoes.
#pragma once

#include <algorithm>

namespace skerry::server {

// A pulse begins at its target and lasts: what the set's pulse, filter and cells add lies behind
// the target.  How much that is no spoke says, and it changes with the range; but few targets are
// shorter than it, and many are hardly longer.  So it is the length that a fifth of the strong
// echoes stay below (a quantile by stochastic approximation, Robbins and Monro 1951), of some fifty
// echoes; a new beginning where cells have another length.
class PulseLength {
 public:
  // 0: learnt; else it is that, m.
  explicit PulseLength(double fixed_m) : fixed_m_(fixed_m) {}

  void learn(double length_m, double cell_m) {
    begin(cell_m);
    const double step_m = 0.25 * cell_m;
    length_m_ += length_m > length_m_ ? kShare * step_m : -(1.0 - kShare) * step_m;
    length_m_ = std::clamp(length_m_, cell_m, kMost_m);
  }
  // Of what has been learnt for such cells; before, three cells, 20 m at least.
  double of(double cell_m) {
    if (fixed_m_ > 0.0) return fixed_m_;
    begin(cell_m);
    return length_m_;
  }

  static constexpr double kMost_m = 500.0;

 private:
  static constexpr double kShare = 0.2;

  void begin(double cell_m) {
    if (cell_m == cell_m_) return;
    cell_m_ = cell_m;
    length_m_ = std::min(std::max(3.0 * cell_m, 20.0), kMost_m);
  }

  double fixed_m_, cell_m_ = 0.0, length_m_ = 20.0;
};

}  // namespace skerry::server
