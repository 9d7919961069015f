// The terminal's side of `skerry`: output, progress and Ctrl-C.
#pragma once

#include <chrono>
#include <string>
#include <string_view>

namespace skerry::client {

// The reader of our output went away (| head): time to end, and nothing to complain about.
struct ReaderGone {};

// Writes to stdout at once.  Error: ReaderGone, or std::runtime_error for a full disk and the like.
void write_out(std::string_view text);

// After this, Ctrl-C and SIGTERM make interrupted() true (a second one ends the program), and a
// closed pipe is an error of write_out() instead of a signal.
void watch_signals();
bool interrupted();

// How often a command that waits for the network looks whether it was interrupted.
inline constexpr std::chrono::milliseconds kLookAround{100};

// Says on stderr how far something is, once it has taken longer than a second: in place on a
// terminal, one line per second otherwise.
class Progress {
 public:
  Progress();
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  // Only printed if it is time to.
  void show(const std::string& text);
  // Makes room for something else.
  void clear();

 private:
  using Clock = std::chrono::steady_clock;
  bool in_place_;
  bool shown_ = false;
  Clock::time_point next_;
};

}  // namespace skerry::client
