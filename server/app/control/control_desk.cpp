#include "server/app/control/control_desk.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "protocol/quantity/angle.hpp"
#include "protocol/wire/schema.hpp"
#include "server/app/control/control_ranges.hpp"
#include "server/app/control/controls_message.hpp"
#include "server/world/rhumb_step.hpp"
#include "server/world/ship_units.hpp"
#include "server/world/world_change.hpp"

namespace skerry::server {
namespace {

std::vector<std::size_t> own_ships_of(const std::vector<RadarUnit*>& units) {
  std::vector<std::size_t> own_ships;
  for (const RadarUnit* unit : units) own_ships.push_back(unit->config().own_ship);
  return own_ships;
}

wire::Settings message_of(const RadarUnit& unit, const echo::ViewControls& view,
                          const echo::RadarControls& radar) {
  wire::Settings settings;
  tell_view(view, settings);
  tell_radar(radar, unit.config().set, settings);
  return settings;
}

// The number of the view whose controls those of `view` are; that itself if it is not there.
std::uint32_t operated_view(const RadarUnit& unit, std::uint32_t view) {
  const RadarViewPtr found = unit.views().find(view);
  return found && found->follows() ? found->followed->number : view;
}

std::string list_of(const std::vector<std::string>& names) {
  return names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "));
}

}  // namespace

struct ControlDesk::Next {
  RadarViewPtr view;
  echo::ViewControls controls;
  echo::RadarControls radar;
  std::optional<Environment> environment;
  Duration environment_time{};  // of the exercise, as of which it is changed
  std::vector<ControlChange> changes;
};

ControlDesk::ControlDesk(Timeline& timeline, std::vector<RadarUnit*> units,
                         const std::vector<std::vector<std::string>>& locks, ChangeLog log,
                         InputLog* inputs)
    : timeline_(timeline),
      units_(std::move(units)),
      locks_(own_ships_of(units_)),
      cons_(timeline.latest()->own_ships.size()),
      inputs_(inputs),
      log_(std::move(log)) {
  for (std::size_t radar = 0; radar < locks.size(); ++radar) {
    wire::Set set;
    set.set_radar(static_cast<std::uint32_t>(radar));
    for (const std::string& name : locks[radar]) set.add_lock(name);
    locks_.change(set);
  }
}

ControlDesk::~ControlDesk() { log_.flush_all(); }

wire::Reply ControlDesk::apply(const wire::Set& set, const std::string& origin) {
  const std::lock_guard lock(mutex_);
  Next next;
  if (const auto wrong = prepare(set, origin, next)) return *wrong;
  if (const auto wrong = carry_out(set, origin, next)) return *wrong;
  log(set, origin, next);
  return {};
}

std::optional<wire::Reply> ControlDesk::refusal_now(const wire::Set& set,
                                                    const std::string& origin) const {
  const std::lock_guard lock(mutex_);
  Next next;
  return prepare(set, origin, next);
}

std::optional<wire::Reply> ControlDesk::prepare(const wire::Set& set, const std::string& origin,
                                                Next& next) const {
  if (auto wrong = refusal_of(set)) return wrong;
  if (auto wrong = refusal_by_state(set)) return wrong;
  if (auto wrong = refusal_by_con(set, origin)) return wrong;
  if (auto wrong = plan(set, next)) return wrong;
  return refusal_by_lock(set, next);
}

std::optional<wire::Reply> ControlDesk::refusal_by_state(const wire::Set& set) const {
  if (set.radar() >= units_.size() || !units_[set.radar()]->views().find(set.view())) {
    return refusal(
        wire::Reply::UNKNOWN,
        fmt::format("no view {} of radar {}; there are radars 0 to {}, each with view 0 and those "
                    "that consoles have opened",
                    set.view(), set.radar(), units_.size() - 1));
  }
  const RangeScale on_air = units_[set.radar()]->range_on_air();
  if (operated_view(*units_[set.radar()], set.view()) != 0 && set.has_range_nm() &&
      set.range_nm() > on_air.in_nautical_miles()) {
    return refusal(wire::Reply::OUT_OF_RANGE,
                   fmt::format("range: {} NM is more than the radar's own range scale; allowed in "
                               "view {}: up to {} NM",
                               set.range_nm(), set.view(), on_air.in_nautical_miles()));
  }
  if ((set.has_course_deg() || set.has_speed_kn() || set.has_con()) &&
      own_ship_of(set.radar()).driven) {
    return refusal(wire::Reply::REFUSED,
                   "course and speed: a simulator outside drives this own ship; it takes orders "
                   "again when that has been silent for ten seconds");
  }
  return std::nullopt;
}

std::optional<wire::Reply> ControlDesk::refusal_by_con(const wire::Set& set,
                                                       const std::string& origin) const {
  if (set.has_exercise()) {
    if (!set.instructor()) {
      return refusal(wire::Reply::REFUSED, "exercise: only the instructor orders the exercise");
    }
    if (const auto fault = timeline_.fault_of(set.exercise())) {
      return refusal(wire::Reply::REFUSED, *fault);
    }
  }
  if (!set.has_course_deg() && !set.has_speed_kn() && !set.has_con()) return std::nullopt;
  const std::size_t ship = units_[set.radar()]->config().own_ship;
  const wire::ConOrder* const con = set.has_con() ? &set.con() : nullptr;
  if (con != nullptr) {
    if (const auto fault = timeline_.fault_of(ship, *con)) {
      return refusal(wire::Reply::REFUSED, *fault);
    }
  }
  if (const auto fault =
          cons_.refusal(ship, own_ship_of(set.radar()).name, con, origin, set.instructor())) {
    return refusal(wire::Reply::REFUSED, *fault);
  }
  return std::nullopt;
}

void ControlDesk::leave(const std::string& origin) {
  const std::lock_guard lock(mutex_);
  const auto now = ChangeLog::Clock::now();
  for (const std::size_t ship : cons_.leave(origin)) {
    log_.add(origin, timeline_.latest()->own_ships[ship].name,
             {"con", origin, "nobody: its console has left"}, now);
  }
}

std::string ControlDesk::con_of(std::uint32_t radar) const {
  const std::lock_guard lock(mutex_);
  return cons_.holder(units_.at(radar)->config().own_ship);
}

ShipState ControlDesk::own_ship_of(std::uint32_t radar) const {
  return timeline_.latest()->own_ships[units_[radar]->config().own_ship];
}

std::optional<wire::Reply> ControlDesk::plan(const wire::Set& set, Next& next) const {
  const RadarUnit& unit = *units_[set.radar()];
  next.view = unit.views().find(set.view());
  if (!next.view) return refusal(wire::Reply::UNKNOWN, "the view has just been closed");
  next.controls = next.view->controls_in_force();
  next.radar = unit.radar_controls();
  const wire::Settings before = message_of(unit, next.controls, next.radar);
  change_view(set, next.controls);
  change_radar(set, next.radar);
  if (!is_instrumented_range(next.controls.instrumented_range_m, next.controls.range_scale)) {
    const double scale_m = next.controls.range_scale.length().in_metres();
    return refusal(wire::Reply::OUT_OF_RANGE,
                   fmt::format("instrumented range: {} m is out of range; allowed: {} to {} m, or "
                               "0 for the range scale",
                               next.controls.instrumented_range_m, kShortestReach * scale_m,
                               kLongestReach * scale_m));
  }
  next.changes = differences(before, message_of(unit, next.controls, next.radar));
  plan_orders(set, next);
  return plan_world(set, next);
}

void ControlDesk::plan_orders(const wire::Set& set, Next& next) const {
  const ShipState ship = own_ship_of(set.radar());
  const auto add = [&](const char* control, double before, double after) {
    // Orders are kept in other units, so they are equal but for rounding.
    if (std::abs(before - after) > 1e-9) {
      next.changes.push_back(
          {control, fmt::format("{:.6g}", before), fmt::format("{:.6g}", after)});
    }
  };
  if (set.has_course_deg()) {
    add("course_deg", ship.ordered_course_deg, wrapped_degrees(set.course_deg()));
  }
  if (set.has_con() && ship.con) {
    const ConState& con = *ship.con;
    const wire::ConOrder& order = set.con();
    const auto steers = [&](int mode) {
      const auto before = static_cast<int>(con.steering);
      if (mode == before) return;
      next.changes.push_back({"con.steering", wire::word_of(*wire::Steering_descriptor(), before),
                              wire::word_of(*wire::Steering_descriptor(), mode)});
    };
    if (order.has_rudder_deg()) {
      add("con.rudder_deg", con.rudder_order_deg, order.rudder_deg());
      steers(wire::STEERING_HAND);
    } else if (order.has_heading_deg()) {
      add("con.heading_deg", con.heading_order_deg, wrapped_degrees(order.heading_deg()));
      steers(wire::STEERING_HEADING);
    } else if (order.has_steering()) {
      steers(order.steering());
    }
    if (order.has_engine_percent()) {
      add("con.engine_percent", con.engine_percent, order.engine_percent());
    }
    if (order.has_bow_thruster_percent()) {
      add("con.bow_thruster_percent", con.bow_percent, order.bow_thruster_percent());
    }
    if (order.has_stern_thruster_percent()) {
      add("con.stern_thruster_percent", con.stern_percent, order.stern_thruster_percent());
    }
    if (order.has_turn_rate_deg_min()) {
      add("con.turn_rate_deg_min", con.turn_rate_deg_min, order.turn_rate_deg_min());
    }
  }
  if (set.has_speed_kn()) {
    add("speed_kn", ship.ordered_speed_mps / knots_in_mps(1.0), set.speed_kn());
  }
}

std::optional<wire::Reply> ControlDesk::plan_world(const wire::Set& set, Next& next) const {
  if (!set.has_world()) return std::nullopt;
  const Duration now = timeline_.latest()->exercise;
  next.environment = *timeline_.environment();
  next.environment_time = now;
  const wire::World before = world_message(*next.environment, now);
  if (auto wrong = change_environment(set.world(), now, *next.environment)) return wrong;
  for (ControlChange& change : differences(before, world_message(*next.environment, now))) {
    next.changes.push_back(std::move(change));
  }
  return std::nullopt;
}

std::optional<wire::Reply> ControlDesk::refusal_by_lock(const wire::Set& set,
                                                        const Next& next) const {
  if (set.instructor()) return std::nullopt;
  for (const ControlChange& change : next.changes) {
    const std::string control = lock_of(change);
    if (next.view->follows() && control == "instrumented_range_m") continue;
    // Who may not order a course or speed may not steer or run the engine to the same end.
    const bool is_con = control == "con";
    const char* const order = change.control == "con.engine_percent" ? "speed_kn" : "course_deg";
    if (locks_.is_locked(set.radar(), control) ||
        (is_con && locks_.is_locked(set.radar(), order))) {
      return refusal(wire::Reply::REFUSED, fmt::format("{}: locked by the instructor; it stays {}",
                                                       change.control, change.before));
    }
  }
  return std::nullopt;
}

void ControlDesk::give_orders(const wire::Set& set) {
  const std::size_t ship = units_[set.radar()]->config().own_ship;
  if (set.has_course_deg() || set.has_speed_kn()) {
    const auto course = set.has_course_deg() ? std::optional(set.course_deg()) : std::nullopt;
    const auto speed = set.has_speed_kn() ? std::optional(set.speed_kn()) : std::nullopt;
    const std::uint64_t tick = timeline_.order(ship, course, speed);
    if (inputs_ != nullptr) inputs_->ordered(tick, ship, course, speed);
  }
}

std::optional<wire::Reply> ControlDesk::give_con_orders(const wire::Set& set) {
  wire::ConOrder order = set.con();
  order.clear_take();
  order.clear_release();
  if (order.ByteSizeLong() == 0) return std::nullopt;
  const std::size_t ship = units_[set.radar()]->config().own_ship;
  const Timeline::ConOrdered ordered = timeline_.order(ship, order);
  if (ordered.fault) return refusal(wire::Reply::REFUSED, *ordered.fault);
  if (inputs_ != nullptr) inputs_->ordered(ordered.tick, ship, order);
  return std::nullopt;
}

std::optional<wire::Reply> ControlDesk::give_exercise_order(const wire::Set& set,
                                                            const std::string& origin, Next& next) {
  if (!set.has_exercise()) return std::nullopt;
  const Timeline::ConOrdered ordered = timeline_.order(set.exercise(), origin);
  if (ordered.fault) return refusal(wire::Reply::REFUSED, *ordered.fault);
  if (inputs_ != nullptr) inputs_->exercised(ordered.tick, set.exercise(), origin);
  constexpr std::size_t kLongestTold = 200;  // a route has up to a frame's length
  std::string told = set.exercise().ShortDebugString();
  if (told.size() > kLongestTold) {
    told = fmt::format("{}... ({} characters)", told.substr(0, kLongestTold), told.size());
  }
  next.changes.push_back({"exercise", "", std::move(told)});
  world_version_.fetch_add(1);
  return std::nullopt;
}

std::optional<wire::Reply> ControlDesk::carry_out(const wire::Set& set, const std::string& origin,
                                                  Next& next) {
  RadarUnit& unit = *units_[set.radar()];
  const auto giving = inputs_ != nullptr ? inputs_->giving() : std::unique_lock<std::mutex>();
  // Those that may fail come before anything has changed.
  if (const auto wrong = give_con_orders(set)) return wrong;
  if (const auto wrong = give_exercise_order(set, origin, next)) return wrong;
  if (next.environment) {
    const std::uint64_t tick = timeline_.set_environment(*std::move(next.environment));
    if (inputs_ != nullptr) inputs_->changed(tick, set.world(), next.environment_time);
    world_version_.fetch_add(1);
  }
  give_orders(set);
  if (set.has_con()) {
    const std::size_t ship = unit.config().own_ship;
    const std::string before = cons_.holder(ship);
    if (cons_.change(ship, set.con(), origin)) {
      const auto named = [](const std::string& holder) {
        return holder.empty() ? "nobody" : holder;
      };
      next.changes.push_back({"con", named(before), named(cons_.holder(ship))});
    }
  }
  bool changed = false;
  if (next.controls != next.view->controls_in_force()) {
    put_view(unit, *next.view, next.controls);
    changed = true;
  }
  if (next.radar != unit.radar_controls()) {
    unit.set_radar_controls(next.radar);
    changed = true;
  }
  const std::string before = list_of(locks_.locked(set.radar()));
  if (locks_.change(set)) {
    next.changes.push_back({"lock", before, list_of(locks_.locked(set.radar()))});
    changed = true;
  }
  if (changed) settings_version_.fetch_add(1);
  return std::nullopt;
}

void ControlDesk::put_view(RadarUnit& unit, RadarView& view, const echo::ViewControls& controls) {
  const RangeScale before = view.controls_in_force().range_scale;
  view.set_controls(controls);
  if (before == controls.range_scale) return;
  const RadarView* const operated = view.follows() ? view.followed.get() : &view;
  const std::shared_ptr<const RadarViews> views = unit.views().get();  // lives as long as the loop
  for (const RadarViewPtr& other : *views) {
    if (other->followed.get() != operated || other.get() == &view) continue;
    echo::ViewControls theirs = *other->controls.get();
    theirs.instrumented_range_m =
        carried_range_m(theirs.instrumented_range_m, before, controls.range_scale);
    other->controls.set(theirs);
  }
}

void ControlDesk::log(const wire::Set& set, const std::string& origin, const Next& next) {
  const std::string place = fmt::format("radar {} view {}", set.radar(), set.view());
  const auto now = ChangeLog::Clock::now();
  for (const ControlChange& change : next.changes) log_.add(origin, place, change, now);
}

void ControlDesk::flush_log() {
  const std::lock_guard lock(mutex_);
  if (log_.waits()) log_.flush(ChangeLog::Clock::now());
}

wire::Settings ControlDesk::settings(std::uint32_t radar, std::uint32_t view) const {
  const RadarUnit& unit = *units_.at(radar);
  RadarViewPtr found = unit.views().find(view);
  if (!found) found = unit.views().get()->front();
  const double on_air = unit.range_on_air().in_nautical_miles();
  const echo::Pulse& pulse = unit.pulse_on_air();
  wire::Settings settings = message_of(unit, found->controls_in_force(), unit.radar_controls());
  settings.set_radar(radar);
  settings.set_view(view);
  settings.set_range_nm(std::min(settings.range_nm(), on_air));
  settings.set_pulse_length_us(pulse.length_s * 1e6);
  settings.set_prf_hz(pulse.prf_hz);
  settings.set_radar_range_nm(on_air);
  for (std::string& control : locks_.locked(radar)) settings.add_locked(std::move(control));
  return settings;
}

}  // namespace skerry::server
