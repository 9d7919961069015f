#include "server/world/timeline.hpp"

#include <algorithm>
#include <memory>
#include <utility>

namespace skerry::server {

Timeline::Timeline(World world) : world_(std::move(world)) {
  kept_.push_back(std::make_shared<const WorldState>(world_.state()));
}

WorldStatePtr Timeline::at(ScenarioTime t) {
  // Two ticks short of the end of time, so that the tick to come has an end too.
  const Duration since_start =
      std::clamp(t.time_since_epoch(), Duration::zero(), Duration::max() - 2 * World::kTick);
  const std::int64_t tick = since_start / World::kTick;
  const std::lock_guard lock(mutex_);
  advance_to(tick);
  const std::int64_t oldest = world_.ticks() - static_cast<std::int64_t>(kept_.size()) + 1;
  return kept_[static_cast<std::size_t>(std::max(tick - oldest, std::int64_t{0}))];
}

void Timeline::advance_to(std::int64_t tick) {
  constexpr auto kKeptTicks = static_cast<std::int64_t>(kKept);
  if (tick - world_.ticks() > kMaxFineTicks) world_.leap(tick - world_.ticks() - kKeptTicks);
  while (world_.ticks() < tick) {
    world_.step();
    if (tick - world_.ticks() >= kKeptTicks) continue;
    kept_.push_back(std::make_shared<const WorldState>(world_.state()));
    if (kept_.size() > kKept) kept_.pop_front();
  }
}

void Timeline::order(std::size_t own_ship, std::optional<double> course_deg,
                     std::optional<double> speed_mps) {
  const std::lock_guard lock(mutex_);
  world_.order(own_ship, course_deg, speed_mps);
}

WorldStatePtr Timeline::latest() const {
  const std::lock_guard lock(mutex_);
  return kept_.back();
}

}  // namespace skerry::server
