// Signals: what the system's signals mean to a server that runs.
#pragma once

#include <csignal>
#include <functional>
#include <utility>
#include <vector>

namespace skerry::server {

// From its construction on the main thread alone waits for SIGINT, SIGTERM and SIGHUP
// (Supervision). Until then the first two end the program at once, however long a chart or a
// recording takes. Make it before any other thread, as those inherit what it blocks.  Thread: the
// main one.
class Signals {
 public:
  Signals();
  Signals(const Signals&) = delete;
  Signals& operator=(const Signals&) = delete;

  const sigset_t& set() const { return set_; }
  // What is done at each SIGHUP, in the order of the calls; it should return soon.
  void on_hang_up(std::function<void()> what) { on_hang_up_.push_back(std::move(what)); }
  // Files are taken up anew.
  void hang_up() const;

 private:
  sigset_t set_;
  std::vector<std::function<void()>> on_hang_up_;
};

}  // namespace skerry::server
