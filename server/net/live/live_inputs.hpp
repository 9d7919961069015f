// LiveInputs: the sockets and the thread of radars that are real.
#pragma once

#include <chrono>
#include <cstddef>
#include <memory>
#include <vector>

#include "server/live/live_host.hpp"

namespace skerry::server {

// Listens to each source's groups on its interface, gives the host what comes, and every
// kAskEvery asks radars of makes that announce themselves only when asked who is there.  To a radar
// whose source has `commands` it sends the host's orders; nothing else leaves.
// Bounded whatever comes: of each source at most kMost datagrams are looked at in every kWindow;
// those beyond are counted and dropped.
// Thread: its own, "live"; the functions are the owner's.
class LiveInputs {
 public:
  static constexpr std::chrono::milliseconds kWindow{100};
  static constexpr std::size_t kMost = 4000;
  static constexpr std::chrono::seconds kAskEvery{2};

  // `host`, which must outlive it, has the same sources.
  // Error: std::runtime_error naming the source, its interface or address, and the reason.
  LiveInputs(LiveHost& host, const std::vector<LiveSource>& sources);
  ~LiveInputs();

  void start();
  void stop();

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace skerry::server
