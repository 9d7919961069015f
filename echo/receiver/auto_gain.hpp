// AutoGain: the gain control that follows noise and clutter by itself.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

namespace skerry::echo {

// Looks at the level of bins of range all round, behind the sea control, and sets the threshold
// kOverMedianDb over what half of them stay below: on open water that is gain 50, where noise just
// sparkles; in rain, or amid land, it is less gain, down to kMostDb.  Echoes of ships fill few bins
// and do not move it.  It follows from turn to turn, half of what was and half of what is new, and
// changes where a turn begins.
// Thread: one at a time; const members any.
class AutoGain {
 public:
  static constexpr double kOverMedianDb = 10.0, kLeastDb = 4.0, kMostDb = 16.0;

  // Mean decibels over noise of a bin of range in one spoke.
  void add(double level_db);
  void finish_turn();
  // Forgets a turn begun: the antenna jumped.
  void drop_turn();

  // Over mean noise; kOverMedianDb before the first whole turn.
  double threshold_db() const;

 private:
  static constexpr double kLowestDb = -10.0, kStepDb = 0.25;
  static constexpr std::size_t kClasses = 320;  // to 70 dB

  std::array<std::uint32_t, kClasses> counts_{};
  std::uint64_t bins_ = 0;
  std::optional<double> median_db_;
};

}  // namespace skerry::echo
