#include "server/world/timeline.hpp"

#include <algorithm>
#include <utility>

namespace skerry::server {

Timeline::Timeline(World world) : world_(std::move(world)) {
  kept_[world_.tick() % kKept] = std::make_shared<const WorldState>(world_.state());
}

WorldStatePtr Timeline::at(ScenarioTime t) {
  const auto since_start = std::max(t.time_since_epoch(), Duration::zero());
  const auto wanted = static_cast<std::uint64_t>(since_start / World::kTick);
  const std::lock_guard lock(mutex_);
  if (wanted > world_.tick()) make_up_to(wanted);
  std::uint64_t tick = std::min(wanted, world_.tick());
  if (world_.tick() - tick >= kKept) tick = world_.tick() - kKept + 1;
  while (!kept_[tick % kKept]) ++tick;  // before the world's first tick here
  return kept_[tick % kKept];
}

void Timeline::make_up_to(std::uint64_t tick) {
  const std::uint64_t most = std::max<std::uint64_t>(
      1, kMaxShipSteps / std::max<std::size_t>(1, world_.own_ship_count() * world_.ticks_ahead()));
  const std::uint64_t last = std::min({tick, last_, world_.tick() + most});
  while (world_.tick() < last) {
    world_.step();
    // Only the end of a long jump is ever read.
    if (last - world_.tick() < kKept) {
      kept_[world_.tick() % kKept] = std::make_shared<const WorldState>(world_.state());
    }
  }
}

void Timeline::keep_to(std::uint64_t last) {
  const std::lock_guard lock(mutex_);
  last_ = last;
}

void Timeline::make(std::uint64_t tick) {
  for (bool is_there = false; !is_there;) {
    const std::lock_guard lock(mutex_);
    make_up_to(tick);
    is_there = world_.tick() >= std::min(tick, last_);
  }
}

WorldStatePtr Timeline::latest() const {
  const std::lock_guard lock(mutex_);
  return kept_[world_.tick() % kKept];
}

std::uint64_t Timeline::order(std::size_t own_ship, std::optional<double> course_deg,
                              std::optional<double> speed_kn) {
  const std::lock_guard lock(mutex_);
  world_.order(own_ship, course_deg, speed_kn);
  return world_.tick() + 1;
}

Timeline::ConOrdered Timeline::order(std::size_t own_ship, const wire::ConOrder& order) {
  const std::lock_guard lock(mutex_);
  if (auto fault = world_.fault_of(own_ship, order)) return {.fault = std::move(fault)};
  world_.order(own_ship, order);
  return {.tick = world_.tick() + 1};
}

std::optional<std::string> Timeline::fault_of(std::size_t own_ship,
                                              const wire::ConOrder& order) const {
  const std::lock_guard lock(mutex_);
  return world_.fault_of(own_ship, order);
}

Timeline::ConOrdered Timeline::order(const wire::ExerciseOrder& order, const std::string& by) {
  const std::lock_guard lock(mutex_);
  if (auto fault = world_.fault_of(order)) return {.fault = std::move(fault)};
  world_.order(order, by);
  return {.tick = world_.tick() + 1};
}

std::optional<std::string> Timeline::fault_of(const wire::ExerciseOrder& order) const {
  const std::lock_guard lock(mutex_);
  return world_.fault_of(order);
}

World Timeline::world() const {
  const std::lock_guard lock(mutex_);
  return world_;
}

void Timeline::restore(World world) {
  const std::lock_guard lock(mutex_);
  world_ = std::move(world);
  kept_ = {};
  kept_[world_.tick() % kKept] = std::make_shared<const WorldState>(world_.state());
}

void Timeline::tell(wire::ExerciseState& state) const {
  const std::lock_guard lock(mutex_);
  world_.tell(state);
}

Timeline::Driven Timeline::drive(std::size_t own_ship, const OwnShipFix& fix, ScenarioTime now) {
  const std::lock_guard lock(mutex_);
  const bool begins = world_.drive(own_ship, fix, now);
  return {world_.tick() + 1, begins};
}

EnvironmentPtr Timeline::environment() const {
  const std::lock_guard lock(mutex_);
  return world_.environment();
}

std::uint64_t Timeline::set_environment(Environment environment) {
  const std::lock_guard lock(mutex_);
  world_.set_environment(std::move(environment));
  return world_.tick() + 1;
}

}  // namespace skerry::server
