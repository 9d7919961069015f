// LostTargets: targets that went out of sight, and may come out again where their course has them.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "server/plotter/motion/motion_state.hpp"
#include "server/plotter/tracks/target.hpp"

namespace skerry::server {

// A ship goes behind a headland and comes out a minute or two later: she is the one she was.  She
// may have turned or slowed down meanwhile, so the gate grows with time; her course and speed must
// be much the same, or each echo of the headland would be her.
//
// Thread: one at a time.
class LostTargets {
 public:
  static constexpr std::size_t kMost = 200;       // then the one that was lost first makes room
  static constexpr double kRemembered_s = 300.0;  // since it was last seen
  static constexpr double kTurnAhead = 0.002;     // m^2/s^3: place's variance grows by t^3 of it
  static constexpr double kOtherSpeed_mps = 1.0;  // standard deviation of what has changed
  static constexpr double kGate = 9.0;            // squared, of the place and of the velocity
  static constexpr double kFurthest_m = 600.0;    // whatever the gate
  static constexpr double kLeastSpeed_mps = 1.0;  // what stays is not told by its course

  struct Lost {
    MotionState state;  // when it was last looked for
    ScenarioTime time{}, seen{};
    std::uint32_t number = 0;
    bool by_hand = false;
  };
  void keep(const Target& target, std::uint32_t number, bool by_hand);
  // The likeliest that this one is, which is then no longer lost; it began to be seen after the
  // other had been lost from sight.
  std::optional<Lost> take(const Target& target);
  void forget() { lost_.clear(); }

  template <typename Change>
  void change(Change&& change) {
    for (Lost& lost : lost_) change(lost.state);
  }

 private:
  std::vector<Lost> lost_;  // in the order in which they were lost
};

}  // namespace skerry::server
