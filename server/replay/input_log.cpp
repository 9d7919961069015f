#include "server/replay/input_log.hpp"

#include <algorithm>
#include <utility>

#include "server/replay/input_messages.hpp"

namespace skerry::server {

InputLog::InputLog(std::size_t radars, std::vector<ExerciseDocument> documents)
    : documents_(std::move(documents)) {
  for (std::size_t i = 0; i < radars; ++i) last_.push_back(std::make_unique<Last>());
}

void InputLog::add(const recording::Input& input) {
  std::string bytes = input.SerializeAsString();
  const std::lock_guard lock(mutex_);
  if (full_) return;
  if (bytes_ + bytes.size() > kMaxBytes) {
    full_ = true;
    recording::Input end;
    end.mutable_incomplete();
    bytes = end.SerializeAsString();
  }
  bytes_ += bytes.size();
  inputs_.push_back(std::move(bytes));
}

void InputLog::began(UtcTime epoch, const std::string& server) {
  for (const auto& last : last_) last->utc = {{}, epoch};
  epoch_ = epoch;
  follows({{}, epoch});
  recording::Input input;
  input.mutable_began()->set_utc_ns(static_cast<std::uint64_t>(epoch.time_since_epoch().count()));
  input.mutable_began()->set_server(server);
  add(input);
}

void InputLog::ordered(std::uint64_t tick, std::size_t own_ship, std::optional<double> course_deg,
                       std::optional<double> speed_kn) {
  recording::Input input;
  recording::Input::Order& order = *input.mutable_order();
  order.set_tick(tick);
  order.set_own_ship(static_cast<std::uint32_t>(own_ship));
  if (course_deg) order.set_course_deg(*course_deg);
  if (speed_kn) order.set_speed_kn(*speed_kn);
  add(input);
}

void InputLog::ordered(std::uint64_t tick, std::size_t own_ship, const wire::ConOrder& con) {
  recording::Input input;
  recording::Input::Order& order = *input.mutable_order();
  order.set_tick(tick);
  order.set_own_ship(static_cast<std::uint32_t>(own_ship));
  *order.mutable_con() = con;
  add(input);
}

void InputLog::driven(std::uint64_t tick, std::size_t own_ship, const OwnShipFix& fix,
                      ScenarioTime now) {
  recording::Input input;
  recording::Input::Fix& told = *input.mutable_fix();
  told = message_of(fix);
  told.set_tick(tick);
  told.set_own_ship(static_cast<std::uint32_t>(own_ship));
  told.set_scenario_ns(now.time_since_epoch().count());
  add(input);
}

void InputLog::changed(std::uint64_t tick, const wire::WorldChange& change, Duration now) {
  recording::Input input;
  recording::Input::Environment& told = *input.mutable_environment();
  told.set_tick(tick);
  told.set_scenario_ns(now.count());
  *told.mutable_change() = change;
  add(input);
}

void InputLog::exercised(std::uint64_t tick, const wire::ExerciseOrder& order,
                         const std::string& by) {
  recording::Input input;
  recording::Input::Exercise& told = *input.mutable_exercise();
  told.set_tick(tick);
  *told.mutable_order() = order;
  told.set_by(by);
  add(input);
}

bool InputLog::tell_differences(Last& last, const SectorInputs& inputs,
                                recording::Input::Taken& taken) {
  bool differs = false;
  if (last.radar != inputs.radar) {
    *taken.mutable_controls() = message_of(inputs.radar);
    last.radar = inputs.radar;
    differs = true;
  }
  if (last.views != inputs.views) {
    for (const ViewInForce& view : inputs.views) *taken.add_views() = message_of(view);
    last.views = inputs.views;
    differs = true;
  }
  if (last.on_air != inputs.on_air) {
    taken.set_range_scale(static_cast<std::uint32_t>(inputs.on_air.index()));
    last.on_air = inputs.on_air;
    differs = true;
  }
  if (last.coast != inputs.coast->origin) {
    taken.mutable_coast()->set_wish(inputs.coast->origin.wish);
    taken.mutable_coast()->set_laid(inputs.coast->origin.laid);
    last.coast = inputs.coast->origin;
    differs = true;
  }
  if (last.emissions != inputs.emissions->version) {
    taken.set_emissions(inputs.emissions->version);
    last.emissions = inputs.emissions->version;
    differs = true;
  }
  if (last.numbered_from != inputs.numbered_from) {
    taken.set_numbered_from(inputs.numbered_from);
    last.numbered_from = inputs.numbered_from;
    differs = true;
  }
  if (last.utc != inputs.utc) {
    *taken.mutable_utc() = message_of(inputs.utc);
    last.utc = inputs.utc;
    differs = true;
  }
  return differs;
}

void InputLog::warmed_up(std::uint32_t radar, const SectorInputs& inputs) {
  recording::Input input;
  recording::Input::Taken& taken = *input.mutable_taken();
  taken.set_radar(radar);
  taken.set_warm_up(true);
  tell_differences(*last_[radar], inputs, taken);
  add(input);
}

void InputLog::took(std::uint32_t radar, std::uint64_t first, const SectorInputs& inputs,
                    bool emits) {
  Last& last = *last_[radar];
  end_skipping(last, radar);
  recording::Input input;
  recording::Input::Taken& taken = *input.mutable_taken();
  const bool differs = tell_differences(last, inputs, taken);
  if (differs || emits) {
    taken.set_radar(radar);
    taken.set_first(first);
    taken.set_emits(emits);
    add(input);
  }
  last.reached.store(first + 1, std::memory_order_release);
}

void InputLog::skipped(std::uint32_t radar, std::uint64_t first,
                       const echo::RadarControls& controls) {
  Last& last = *last_[radar];
  if (last.radar != controls) {  // the antenna turns by them from here on
    end_skipping(last, radar);
    recording::Input input;
    recording::Input::Taken& taken = *input.mutable_taken();
    taken.set_radar(radar);
    taken.set_first(first);
    *taken.mutable_controls() = message_of(controls);
    last.radar = controls;
    add(input);
  }
  if (last.skipped_sectors++ == 0) last.skipped_first = first;
}

void InputLog::end_skipping(Last& last, std::uint32_t radar) {
  if (last.skipped_sectors == 0) return;
  recording::Input input;
  recording::Input::Skipped& skipped = *input.mutable_skipped();
  skipped.set_radar(radar);
  skipped.set_first(last.skipped_first);
  skipped.set_sectors(std::exchange(last.skipped_sectors, 0));
  add(input);
}

std::vector<std::string> InputLog::since(std::size_t from) const {
  const std::lock_guard lock(mutex_);
  if (from >= inputs_.size()) return {};
  const std::size_t end = std::min(inputs_.size(), from + kMostAtOnce);
  return {inputs_.begin() + static_cast<std::ptrdiff_t>(from),
          inputs_.begin() + static_cast<std::ptrdiff_t>(end)};
}

std::optional<ScenarioZero> InputLog::zero() const {
  const auto clock = utc_.get();
  if (!clock) return std::nullopt;
  return ScenarioZero{epoch_, clock->utc - clock->from.time_since_epoch()};
}

std::vector<std::string> InputLog::reached() const {
  const std::lock_guard giving(giving_);
  std::vector<std::string> messages;
  for (std::size_t radar = 0; radar < last_.size(); ++radar) {
    const std::uint64_t reached = last_[radar]->reached.load(std::memory_order_acquire);
    if (reached == 0) continue;
    recording::Input input;
    input.mutable_reached()->set_radar(static_cast<std::uint32_t>(radar));
    input.mutable_reached()->set_first(reached - 1);
    messages.push_back(input.SerializeAsString());
  }
  return messages;
}

}  // namespace skerry::server
