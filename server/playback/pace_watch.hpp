// PaceWatch: whether a playback holds the rate that it was asked for.
#pragma once

#include <chrono>
#include <optional>
#include <string>

#include "protocol/quantity/time.hpp"

namespace skerry::server {

// Judges windows of kWindow of playing, without what lies between two begin(): so what it says
// changes at most that often.  Time is always passed in.
class PaceWatch {
 public:
  using SteadyTime = std::chrono::steady_clock::time_point;
  static constexpr Duration kWindow = std::chrono::seconds(2);

  // From here on at `rate`; another one than before forgets what was seen.  True if behind() is
  // another now; so does note().
  bool begin(double rate);
  // `moment` of the recording is ready at `now`; `gave_up`: it was so late that the rest is, too.
  bool note(UtcTime moment, SteadyTime now, bool gave_up);

  // "behind: reaches 83x of 100x" from a window in which it gave up to the first that holds the
  // rate; else empty.
  const std::string& behind() const { return behind_; }

 private:
  struct Place {
    UtcTime moment{};
    SteadyTime now{};
  };
  bool say(std::string text);

  double rate_ = 0.0;
  std::optional<Place> last_;
  Duration played_{}, taken_{};  // of the recording, and in real time, in this window
  bool gave_up_ = false;         // in this window
  std::string behind_;
};

}  // namespace skerry::server
