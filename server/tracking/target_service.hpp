// TargetService: the plotters of all views that somebody wants, on a thread of their own.
#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "server/core/radar_host.hpp"
#include "server/core/target_port.hpp"
#include "server/tracking/view_plotter.hpp"

namespace skerry::server {

// A source is a source: the host's radars may be simulated, played back or real.
// Use: construct; host.set_targets(); start() once the host's channels have the format; stop()
// before the host ends.  Its thread is "plotters".
class TargetService final : public TargetPort {
 public:
  // Between looks at the rings while nobody wakes it.
  static constexpr std::chrono::milliseconds kLook{50};
  static constexpr std::size_t kMostPlotters = 256;  // of all radars

  // Own ship as her sensors tell of her.
  using Sensed = std::function<wire::OwnShip(std::uint32_t radar)>;

  // The host must outlive it.
  TargetService(RadarHost& host, std::string format, Sensed sensed);
  ~TargetService() override;  // stop()
  TargetService(const TargetService&) = delete;
  TargetService& operator=(const TargetService&) = delete;

  void start();
  // A stopped service stays stopped.  Thread: start() and stop() from one thread.
  void stop();

  std::shared_ptr<const void> want(std::uint32_t radar, std::uint32_t view) override;
  TargetListPtr targets(std::uint32_t radar, std::uint32_t view) const override;
  TargetPlotsPtr plots(std::uint32_t radar, std::uint32_t view) const override;
  wire::Reply order(const wire::TargetOrder& order, const std::string& origin) override;

 private:
  using Steady = std::chrono::steady_clock::time_point;
  using Key = std::pair<std::uint32_t, std::uint32_t>;  // radar, view
  struct Entry {
    std::shared_ptr<ViewPlotter> plotter;
    std::weak_ptr<const int> wanted;
    Steady last_wanted{};
  };
  using Plotters = std::vector<std::pair<Key, std::shared_ptr<ViewPlotter>>>;

  void run();
  // Those at work now; ends those that nobody has wanted for kGrace.
  Plotters at_work(Steady now);
  // Until lists are due; true if more waits.
  bool take(const Plotters& plotters, Steady until);
  void tell(const Plotters& plotters);
  std::shared_ptr<ViewPlotter> find(std::uint32_t radar, std::uint32_t view) const;
  double beam_of(std::uint32_t radar) const;
  void wake();

  RadarHost& host_;
  const std::string format_;
  const Sensed sensed_;

  mutable std::mutex mutex_;
  std::map<Key, Entry> entries_;

  std::mutex wake_mutex_;  // its own, so that a radar's thread waits for nobody
  std::condition_variable wakes_;
  bool woken_ = false, stopping_ = false;

  std::size_t next_ = 0;  // of plotters, the thread's own
  std::thread thread_;    // last: ends before what it uses
};

}  // namespace skerry::server
