// Supervision: the main thread while the server runs.  It waits for signals, and tells the service
// manager when the radars turn and that all goes on.
#pragma once

#include <signal.h>

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "server/app/service_manager.hpp"

namespace skerry::server {

// Whether threads go on, by counts of what they have done.
class Pulse {
 public:
  // Whether each of them has come further since this was last true, the first time since its start.
  // The same threads in the same order every time; with none it is always true.
  bool beats(std::span<const std::uint64_t> steps);

 private:
  std::vector<std::uint64_t> before_;
};

// Ready is told when every thread that is watched has made its first step; from then on the
// watchdog is fed as long as all of them go on, four times as often as it asks for.  So a server
// one of whose threads hangs is started again.
class Supervision {
 public:
  // Of each thread that is watched: a radar's sectors, of which it may leave some out for want of
  // time, and looks of net-0.
  using Steps = std::function<std::vector<std::uint64_t>()>;
  // The manager must outlive it.
  Supervision(const ServiceManager& manager, Steps steps);

  // Called on SIGHUP, on the thread that waits, while the manager is told that it reloads.  What
  // cannot be read is its own to tell; it must not throw.
  void on_reload(std::function<void()> reload) { reload_ = std::move(reload); }

  // Until SIGINT or SIGTERM, or SIGHUP of a terminal that has gone; gives its number.  `signals`
  // are these three, blocked in every thread.  `status`: one line of what runs.
  int await(const sigset_t& signals, const std::string& status);

  static constexpr std::chrono::milliseconds kFirstLooks{20};  // between them, until it is ready

 private:
  void look();
  // Until the next look(); nothing: none is needed, as nobody is to be told.
  std::optional<std::chrono::nanoseconds> pause() const;

  const ServiceManager& manager_;
  Steps steps_;
  std::function<void()> reload_;
  std::string status_;
  Pulse pulse_;
  bool is_ready_ = false;
};

}  // namespace skerry::server
