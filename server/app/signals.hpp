// Signals: what the system's signals mean to a server that runs.
#pragma once

#include <csignal>
#include <functional>
#include <vector>

namespace skerry::server {

// While it lives, SIGINT and SIGTERM end await_end(), and SIGHUP has files taken up anew.  Until
// then the first two end the program at once, however long a chart or a recording takes. Thread:
// the one that waits; make it before any other thread, as those inherit what it blocks.
class Signals {
 public:
  Signals();
  Signals(const Signals&) = delete;
  Signals& operator=(const Signals&) = delete;

  // What is done at each SIGHUP, in the order of the calls; it should return soon.
  void on_hang_up(std::function<void()> what) { on_hang_up_.push_back(std::move(what)); }
  // Until the server shall end.  That is also a SIGHUP that comes because the terminal on which it
  // was started has gone.
  void await_end();

 private:
  bool has_lost_terminal() const;

  sigset_t set_;
  const bool had_terminal_;
  std::vector<std::function<void()>> on_hang_up_;
};

}  // namespace skerry::server
