// PacedThread: a thread that does the same thing again and again, with a pause between.
#pragma once

#include <chrono>
#include <functional>
#include <stop_token>
#include <thread>

namespace skerry::server {

// Thread: one at a time for start() and stop().
class PacedThread {
 public:
  // `look` is called at once, and `pause` after it has returned, on a thread of that name (at most
  // 15 letters).  It ends early where its token says so.  Must not throw.
  void start(const char* name, std::chrono::milliseconds pause,
             std::function<void(const std::stop_token&)> look);
  // Cuts the pause short; when it returns, look() is not running and will not be called.
  void stop() { thread_ = {}; }

 private:
  std::jthread thread_;
};

}  // namespace skerry::server
