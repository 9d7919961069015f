// ThinChoice: how thin a relay's spokes are, by what its link carries.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>

#include "protocol/quantity/time.hpp"

namespace skerry::server {

// Begins at the thinnest, so that a slow link is not filled with what it cannot carry, and goes
// finer every kSettle + kLook while that carries.  A level that was too much is left for the one
// before; then it waits before it tries again, twice as long each time.  Where a link becomes
// slower, as many levels are left at once as the rate that came through asks for. Thread: one at a
// time.  Time is passed in.
class ThinChoice {
 public:
  using Time = std::chrono::steady_clock::time_point;
  static constexpr std::chrono::seconds kLook{2};    // over which is measured
  static constexpr std::chrono::seconds kSettle{2};  // behind a change, not measured
  static constexpr double kMostLost = 0.02;          // of the spokes
  // By how much spokes may come slower than they were made: more of them wait on the way.
  static constexpr double kMostBehind = 0.05;
  // Of the rate that came through while spokes were lost, for the level that is chosen.
  static constexpr double kRoom = 0.8;
  static constexpr std::chrono::seconds kFirstPatience{30}, kLastPatience{600};
  static constexpr std::chrono::seconds kProven{20};  // a finer level that lasts so long is right

  // `fixed`: that level, for ever; nothing: as the link has it.
  ThinChoice(std::optional<std::uint32_t> fixed, Time now);

  std::uint32_t level() const { return level_; }
  // What came since it was last called.
  struct Came {
    std::uint64_t spokes = 0, lost = 0, bytes = 0;
    Duration made{0}, took{0};  // spokes of so long a time came in so long, of all radars
  };
  // True if another level is to be asked for.
  bool look(const Came& came, Time now);

 private:
  bool go_thinner(const Came& all, double missing, Time now);
  void change(std::uint32_t level, Time now);
  void begin_look(Time now);

  const bool fixed_;
  std::uint32_t level_;
  Time changed_, look_began_, calm_since_;
  bool is_trying_ = false;            // a finer level
  std::chrono::seconds patience_{0};  // none until a level was too much
  Came came_;                         // in this look
};

}  // namespace skerry::server
