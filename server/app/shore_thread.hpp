// ShoreThread: has own ships run aground at the chart's shore.
#pragma once

#include <functional>
#include <stop_token>
#include <utility>

#include "server/app/shore_watch.hpp"
#include "server/core/paced_thread.hpp"
#include "server/radar/coast_service.hpp"
#include "server/replay/input_log.hpp"
#include "server/world/timeline.hpp"

namespace skerry::server {

// Looks at every tick of the world four times a second (ShoreWatch), on a thread of its own
// ("shore"), and gives the world an order for each ship that has run aground.  She stops with the
// next tick: some 0.3 s after she touched, at twenty times as fast some 6 s of the exercise.
class ShoreThread {
 public:
  static constexpr auto kPause = std::chrono::milliseconds(250);
  static constexpr const char* kBy = "the chart";  // who gave the order

  // All must outlive it.  `now`: the scenario's time.
  ShoreThread(Timeline& timeline, CoastService& coast, InputLog& inputs,
              std::function<ScenarioTime()> now);
  // A ship that runs aground is told there instead; it may be told again until she is.  Before
  // start().
  void set_elsewhere(std::function<void(const wire::ExerciseOrder&)> tell) {
    elsewhere_ = std::move(tell);
  }
  void start();
  // Ends the thread.  Before the coast's.
  void stop() { thread_.stop(); }

 private:
  void look(const std::stop_token& stop);
  void ground(std::size_t own_ship, GeoPoint at);

  Timeline& timeline_;
  InputLog& inputs_;
  std::function<ScenarioTime()> now_;
  std::function<void(const wire::ExerciseOrder&)> elsewhere_;
  ShoreWatch watch_;
  ScenarioTime next_{};  // to be looked at
  PacedThread thread_;
};

}  // namespace skerry::server
