#include "server/replay/replayed_world.hpp"

#include <fmt/format.h>

#include <stdexcept>
#include <utility>

#include "server/replay/input_messages.hpp"
#include "server/world/world_change.hpp"

namespace skerry::server {
namespace {

ScenarioTime time_of(std::uint64_t tick) {
  return ScenarioTime(static_cast<std::int64_t>(tick) * World::kTick);
}

// When something was given that holds from the tick on, which is at `latest`.
// Error: std::invalid_argument.
Duration near(Duration latest, std::int64_t given_ns) {
  const Duration when(given_ns);
  if (when < Duration::zero() || when > latest) {
    throw std::invalid_argument("its own time is not before that of the tick");
  }
  return when;
}

}  // namespace

ReplayedWorld::ReplayedWorld(const scenario::Scenario& scenario,
                             const std::vector<WorldInput>& inputs, RangeCheck in_range)
    : timeline_(World(scenario)), inputs_(inputs), in_range_(std::move(in_range)) {}

// The timeline makes a bounded number of ticks in one call.
void ReplayedWorld::make_up_to(std::uint64_t tick) {
  while (timeline_.latest()->time < time_of(tick)) timeline_.at(time_of(tick));
}

WorldStatePtr ReplayedWorld::at(ScenarioTime time) {
  const auto wanted = static_cast<std::uint64_t>(
      std::max(time.time_since_epoch(), Duration::zero()) / World::kTick);
  for (; next_ < inputs_.size() && inputs_[next_].tick <= wanted; ++next_) {
    const WorldInput& input = inputs_[next_];
    if (input.tick > 0) make_up_to(input.tick - 1);
    give(input);
  }
  make_up_to(wanted);
  return timeline_.at(time);
}

void ReplayedWorld::give(const WorldInput& given) {
  try {
    if (given.input.has_order()) {
      const recording::Input::Order& order = given.input.order();
      timeline_.order(order.own_ship(),
                      order.has_course_deg() ? std::optional(order.course_deg()) : std::nullopt,
                      order.has_speed_kn() ? std::optional(order.speed_kn()) : std::nullopt);
      if (order.has_con()) {
        const auto ordered = timeline_.order(order.own_ship(), order.con());
        if (ordered.fault) throw std::invalid_argument(*ordered.fault);
      }
    } else if (given.input.has_fix()) {
      const recording::Input::Fix& fix = given.input.fix();
      timeline_.drive(
          fix.own_ship(), fix_of(fix),
          ScenarioTime(near(time_of(given.tick).time_since_epoch(), fix.scenario_ns())));
    } else if (given.input.has_exercise()) {
      const recording::Input::Exercise& told = given.input.exercise();
      wire::Set set;
      *set.mutable_exercise() = told.order();
      if (!in_range_(set)) throw std::invalid_argument("an order to the exercise is out of range");
      const auto ordered = timeline_.order(told.order(), told.by());
      if (ordered.fault) throw std::invalid_argument(*ordered.fault);
    } else {
      const recording::Input::Environment& told = given.input.environment();
      Environment environment = *timeline_.environment();
      const Duration when = near(timeline_.latest()->exercise, told.scenario_ns());
      wire::Set set;
      *set.mutable_world() = told.change();
      if (!in_range_(set) || change_environment(told.change(), when, environment)) {
        throw std::invalid_argument("a change of the world is refused");
      }
      timeline_.set_environment(std::move(environment));
    }
  } catch (const std::invalid_argument& refused) {
    if (!fault_) fault_ = fmt::format("tick {}: {}", given.tick, refused.what());
  }
}

}  // namespace skerry::server
