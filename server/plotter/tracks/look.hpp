// Look: when in a turn the antenna has passed a target.
#pragma once

namespace skerry::server {

// An antenna that turns has no turns for a target but its own: it has been looked for once the
// antenna has come from before its bearing and gone past it.  So a target near north, or one that
// moves with the antenna, is looked for once a turn and never twice.
class Look {
 public:
  // The antenna is at `off_deg` from the target, -180 to 180, positive past it; the next plot is
  // within `half_deg`, 0 to kMostHalf_deg, of where it is expected.  `blind`: there is no video of
  // where the target is.  True if this ends the look; done() lets the next begin.
  bool pass(double off_deg, double half_deg, bool blind);
  bool is_over() const { return over_; }
  // There was video all the while: that nothing was seen means something.
  bool could_see() const { return !blind_; }
  void done() { over_ = armed_ = blind_ = false; }

  static constexpr double kMostHalf_deg = 45.0;

 private:
  bool armed_ = false, over_ = false, blind_ = false;
};

inline bool Look::pass(double off_deg, double half_deg, bool blind) {
  if (over_) return false;
  if (off_deg < -half_deg) {
    armed_ = true;
    blind_ = false;
  } else if (armed_ && off_deg < half_deg) {
    blind_ = blind_ || blind;
  } else if (armed_) {
    blind_ = blind_ || blind;
    over_ = true;
  }
  return over_;
}

}  // namespace skerry::server
