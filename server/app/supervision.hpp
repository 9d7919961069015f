// Supervision: the main thread while the server runs.  It waits for signals, and tells the service
// manager when the radars turn and that they go on.
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

#include "server/app/load_watch.hpp"
#include "server/app/service_manager.hpp"

namespace skerry::server {

// Whether radars go on.  A radar that leaves sectors out for want of time goes on too.
class RadarPulse {
 public:
  // Whether each of them has come further since this was last true, the first time since its start.
  // The same radars in the same order every time; with none it is always true.
  bool beats(std::span<const RadarPace> radars);

 private:
  std::vector<std::uint64_t> sectors_;
};

// Ready is told when every radar has had its first sector; from then on the watchdog is fed as long
// as all of them go on, four times as often as it asks for.  So a server one of whose radars hangs
// is started again.
class Supervision {
 public:
  using Paces = std::function<std::vector<RadarPace>()>;
  // Without `paces` (a recording is played) it is ready at once, and alive as long as this runs.
  // The manager must outlive it.
  explicit Supervision(const ServiceManager& manager, Paces paces = {});

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
  Paces paces_;
  std::function<void()> reload_;
  std::string status_;
  RadarPulse pulse_;
  bool is_ready_ = false;
};

}  // namespace skerry::server
