#include "server/playback/pace_watch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace skerry::server {
namespace {

// A little behind, it gives up less often than once a window.
constexpr double kHeld = 0.97;

}  // namespace

bool PaceWatch::say(std::string text) {
  behind_.swap(text);
  return behind_ != text;
}

bool PaceWatch::begin(double rate) {
  last_.reset();
  if (std::exchange(rate_, rate) == rate) return false;
  played_ = taken_ = {};
  gave_up_ = false;
  return say("");
}

bool PaceWatch::note(UtcTime moment, SteadyTime now, bool gave_up) {
  // A file may say any time.
  if (last_) {
    played_ += std::clamp<Duration>(moment - last_->moment, {}, std::chrono::hours(1));
    taken_ += now - last_->now;
  }
  last_ = {moment, now};
  gave_up_ |= gave_up;
  if (taken_ < kWindow) return false;
  const double pace = std::min(rate_, in_seconds(played_) / in_seconds(taken_));
  played_ = taken_ = {};
  const bool still = !behind_.empty() && pace < kHeld * rate_;
  if (!std::exchange(gave_up_, false) && !still) return say("");
  return say(fmt::format("behind: reaches {:.{}f}x of {:g}x", pace, pace < 9.95 ? 1 : 0, rate_));
}

}  // namespace skerry::server
