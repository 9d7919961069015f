// PulseLength: how long a point shows along the range, learnt from the echoes.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

namespace skerry::server {

// A pulse begins at its target and lasts: what the set's pulse, filter and cells add lies behind
// the target.  How much that is no spoke says, and it changes with the range; but few targets are
// shorter than it, and many are hardly longer.  So it is the length that a fifth of the strong
// echoes stay below (a quantile by stochastic approximation, Robbins and Monro 1951), of some fifty
// echoes; a new beginning where cells have another length.
//
// A ship that is alone says nothing of it: learnt from her, it would become her own length, a step
// a turn, and her range would drift as fast, which is a speed that she does not have.  So a step is
// as long as there are echoes in several directions: none where they are all in one, whole where
// they are in kWhole.
class PulseLength {
 public:
  // 0: learnt; else it is that, m.
  explicit PulseLength(double fixed_m) : fixed_m_(fixed_m) {}

  // An echo, and when the beam saw it: turns of the antenna, of any beginning, none less than the
  // one before.
  void learn(double length_m, double cell_m, double turns) {
    begin(cell_m);
    see(turns);
    const double step_m = 0.25 * cell_m * share(turns);
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
  static constexpr std::size_t kWhole = 5;

 private:
  static constexpr double kShare = 0.2;
  // Directions are an eighth of a turn apart: side lobes of a near ship are hers.  What is
  // remembered is less than a turn, by as much as she and her side lobes may come sooner in the
  // next one.
  static constexpr double kApart = 1.0 / 8.0, kRemembered = 7.0 / 8.0;
  static constexpr double kLongAgo = -1e9;

  void begin(double cell_m) {
    if (cell_m == cell_m_) return;
    cell_m_ = cell_m;
    length_m_ = std::min(std::max(3.0 * cell_m, 20.0), kMost_m);
    seen_.fill(kLongAgo);
  }
  void see(double turns) {
    if (turns - seen_.front() < kApart) return;
    std::rotate(seen_.begin(), seen_.end() - 1, seen_.end());
    seen_.front() = turns;
  }
  double share(double turns) const {
    const auto directions = std::count_if(seen_.begin(), seen_.end(),
                                          [&](double seen) { return turns - seen < kRemembered; });
    return static_cast<double>(directions - 1) / (kWhole - 1);
  }

  double fixed_m_, cell_m_ = 0.0, length_m_ = 20.0;
  std::array<double, kWhole> seen_{};  // directions, the latest first, as turns
};

}  // namespace skerry::server
