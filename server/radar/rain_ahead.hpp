// RainAhead: the next step of every rain area's map, made before a radar needs it.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <vector>

#include "echo/rain/rain_map.hpp"
#include "server/core/paced_thread.hpp"
#include "server/world/timeline.hpp"

namespace skerry::server {

// The field of a rain area is renewed every 1 to 20 s (echo/rain/rain_map.hpp), which takes up to
// some milliseconds: a good part of a sector's time for the radar that needs it first, and for
// those that wait for it.  A thread ("rain") asks for each map kLead early; radars share it.  It
// changes no echo: a map is a function of its key.
class RainAhead {
 public:
  static constexpr std::chrono::milliseconds kPause{250};
  // More than a pause and a map's time; less than the shortest step of a map, so that the step
  // before the one that is made ahead is the present one, which stays.
  static constexpr std::chrono::milliseconds kLead{800};
  // Nothing farther from a ship than this is seen by radar: two of the largest range scale (96 NM).
  static constexpr double kFarthestSight_m = 400e3;

  // The maps that radars of the scenario's seed want kLead after `now`, of the areas that an own
  // ship may see; none for an even area, which has no map.  Thread: any.
  static std::vector<echo::RainMapPtr> make(const WorldState& state, std::uint64_t seed,
                                            ScenarioTime now);

  // The timeline must outlive it.  `now`: the scenario's time.
  RainAhead(Timeline& timeline, std::uint64_t seed, std::function<ScenarioTime()> now);
  void start();
  void stop() { thread_.stop(); }

 private:
  Timeline& timeline_;
  std::uint64_t seed_;
  std::function<ScenarioTime()> now_;
  PacedThread thread_;
};

}  // namespace skerry::server
