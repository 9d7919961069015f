// What an instructor and the scenario's events do to the world.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "protocol/quantity/angle.hpp"
#include "server/world/ais_identities.hpp"
#include "server/world/scenario.hpp"
#include "server/world/ship_units.hpp"
#include "server/world/traffic/new_target.hpp"
#include "server/world/world.hpp"
#include "server/world/world_change.hpp"

namespace skerry::server {
namespace {

std::optional<std::string> fault_of_text(const char* what, const std::string& text,
                                         std::size_t most) {
  if (!text.empty() && text.size() <= most) return std::nullopt;
  return fmt::format("{}: {} characters; allowed: 1 to {}", what, text.size(), most);
}

std::optional<std::string> fault_of_place(const char* what, bool latitude, bool longitude) {
  if (latitude == longitude) return std::nullopt;
  return fmt::format("{}: a position is latitude and longitude; one of them is missing", what);
}

std::optional<std::string> fault_of_names(const wire::FaultChange& change) {
  for (const std::string& name : change.change()) {
    if (wire::Faults::descriptor()->FindFieldByName(name) == nullptr) {
      return fmt::format("faults: there is no fault \"{}\"; the fields of Faults are the faults",
                         name.substr(0, 40));
    }
  }
  return std::nullopt;
}

// The faults of `change` instead of those before, field by field.
wire::Faults changed(const wire::Faults& before, const wire::FaultChange& change) {
  if (change.change().empty()) return change.faults();
  wire::Faults faults = before;
  const auto& from = *change.faults().GetReflection();
  const auto& into = *faults.GetReflection();
  for (const std::string& name : change.change()) {
    const auto& field = *wire::Faults::descriptor()->FindFieldByName(name);
    if (field.cpp_type() == google::protobuf::FieldDescriptor::CPPTYPE_BOOL) {
      into.SetBool(&faults, &field, from.GetBool(change.faults(), &field));
    } else {
      into.SetDouble(&faults, &field, from.GetDouble(change.faults(), &field));
    }
  }
  return faults;
}

std::string name_of(const scenario::Scenario& scenario, std::size_t target) {
  return scenario.targets(static_cast<int>(target)).name();
}

}  // namespace

ExerciseLog& World::log() {
  auto next = std::make_shared<ExerciseLog>(*log_);
  ExerciseLog& changed = *next;
  log_ = std::move(next);
  return changed;
}

void World::mark(const std::string& kind, const std::string& text, Duration when) {
  ExerciseLog& log = this->log();
  if (log.marks.size() >= ExerciseLog::kMaxMarks) log.marks.erase(log.marks.begin());
  wire::ExerciseMark& mark = log.marks.emplace_back();
  mark.set_exercise_s(in_seconds(when));
  mark.set_kind(kind);
  mark.set_text(text);
}

void World::remember(std::string what, decltype(Undo::before) before) {
  if (undo_.size() >= kMaxUndo) undo_.pop_front();
  undo_.push_back({std::move(what), std::move(before)});
  log().can_undo = undo_.back().what;
}

void World::set_environment(Environment environment) {
  remember("a change of the weather", part_.environment);
  part_.environment = std::make_shared<const Environment>(std::move(environment));
}

std::optional<std::string> World::fault_of(const wire::ExerciseOrder& order) const {
  const auto no_such_ship = [&](std::uint32_t ship) -> std::optional<std::string> {
    if (ship < own_ship_count()) return std::nullopt;
    return fmt::format("own ship {}: there are {}, counted from 0", ship, own_ship_count());
  };
  switch (order.kind_case()) {
    case wire::ExerciseOrder::kClock:
      return std::nullopt;
    case wire::ExerciseOrder::kTarget: {
      const wire::TargetChange& change = order.target();
      if (auto fault =
              fault_of_place("target", change.has_latitude_deg(), change.has_longitude_deg())) {
        return fault;
      }
      return part_.traffic.fault_of(change);
    }
    case wire::ExerciseOrder::kNewTarget:
      return fault_of_new(order.new_target());
    case wire::ExerciseOrder::kOwnShip:
      if (auto fault = fault_of_place("own ship", order.own_ship().has_latitude_deg(),
                                      order.own_ship().has_longitude_deg())) {
        return fault;
      }
      return no_such_ship(order.own_ship().own_ship());
    case wire::ExerciseOrder::kFault:
      if (auto fault = no_such_ship(order.fault().own_ship())) return fault;
      return fault_of_names(order.fault());
    case wire::ExerciseOrder::kText:
      if (order.text().has_own_ship()) {
        if (auto fault = no_such_ship(order.text().own_ship())) return fault;
      }
      return fault_of_text("text", order.text().text(), kMaxText);
    case wire::ExerciseOrder::kMark:
      return fault_of_text("mark", order.mark(), kMaxMark);
    case wire::ExerciseOrder::kSnapshot:
      if (snapshots_.size() >= kMaxSnapshots && !snapshots_.contains(order.snapshot())) {
        return fmt::format("snapshot: there are {}; use the name of one of them again",
                           snapshots_.size());
      }
      return fault_of_text("snapshot", order.snapshot(), kMaxName);
    case wire::ExerciseOrder::kRestore: {
      if (snapshots_.contains(order.restore())) return std::nullopt;
      std::string names;
      for (const auto& [name, part] : snapshots_) names += (names.empty() ? "" : ", ") + name;
      return fmt::format("restore: there is no snapshot \"{}\"; allowed: {}",
                         order.restore().substr(0, kMaxName),
                         names.empty() ? "none was taken" : names);
    }
    case wire::ExerciseOrder::kUndo:
      if (!undo_.empty()) return std::nullopt;
      return "undo: there is nothing to take back";
    case wire::ExerciseOrder::kAground:
      return no_such_ship(order.aground());
    case wire::ExerciseOrder::KIND_NOT_SET:
      break;
  }
  return "exercise: an order that says nothing; expected clock, target, new_target, own_ship, "
         "fault, text, mark, snapshot, restore, undo or aground";
}

std::optional<std::string> World::fault_of_new(const wire::NewTarget& target) const {
  int ships = 0;
  for (const auto& each : part_.scenario->targets()) {
    if (each.kind() == scenario::Target::ship) ++ships;
  }
  if (ships >= kMaxTargets) {
    return fmt::format("new target: there are {} ships; allowed: at most {}", ships, kMaxTargets);
  }
  return skerry::server::fault_of(target);
}

void World::order(const wire::ExerciseOrder& order, const std::string& by) {
  part_.contacts.search_anew();
  std::string what;
  switch (order.kind_case()) {
    case wire::ExerciseOrder::kClock:
      if (order.clock().has_rate()) part_.clock.set_rate(order.clock().rate());
      if (order.clock().has_frozen()) part_.clock.frozen = order.clock().frozen();
      what = part_.clock.frozen ? "the clock stands"
                                : fmt::format("the clock runs at {} times", part_.clock.rate());
      break;
    case wire::ExerciseOrder::kTarget:
      what = fmt::format("orders to {}", name_of(*part_.scenario, order.target().target()));
      remember(what, part_.traffic.keep(order.target().target()));
      part_.traffic.order(order.target(), part_.clock.now);
      break;
    case wire::ExerciseOrder::kNewTarget:
      what = add_target(order.new_target());
      break;
    case wire::ExerciseOrder::kOwnShip:
      what = put(order.own_ship());
      break;
    case wire::ExerciseOrder::kFault:
      what = set_faults(order.fault());
      break;
    case wire::ExerciseOrder::kText:
      say(order.text().has_own_ship() ? std::optional(order.text().own_ship()) : std::nullopt,
          order.text().text());
      what = "a text to the con";
      break;
    case wire::ExerciseOrder::kMark:
      mark("mark", order.mark());
      what = "a mark";
      break;
    case wire::ExerciseOrder::kSnapshot:
      take_snapshot(order.snapshot());
      what = fmt::format("snapshot \"{}\"", order.snapshot());
      break;
    case wire::ExerciseOrder::kRestore:
      restore(order.restore());
      what = fmt::format("restored \"{}\"", order.restore());
      break;
    case wire::ExerciseOrder::kUndo:
      what = "took back " + undo_.back().what;
      undo();
      break;
    case wire::ExerciseOrder::kAground:
      what = ground(order.aground());
      break;
    case wire::ExerciseOrder::KIND_NOT_SET:
      return;
  }
  ExerciseLog& log = this->log();
  log.last_by = by;
  log.last_order = what;
  ++log.orders;
}

std::string World::add_target(const wire::NewTarget& wanted) {
  auto next = std::make_shared<scenario::Scenario>(*part_.scenario);
  const auto number = static_cast<std::size_t>(next->targets_size());
  scenario::Target& target = *next->add_targets();
  target = target_of(wanted);
  if (target.name().empty()) target.set_name(fmt::format("Target {}", number + 1));
  fill_in_mmsi(*next);
  part_.traffic.add(target, number, part_.clock.now);
  const std::string what = fmt::format("the new target {}", target.name());
  part_.scenario = std::move(next);
  remember(what, number);
  return what;
}

std::string World::put(const wire::OwnShipPut& put) {
  OwnShip& ship = part_.own_ships[put.own_ship()];
  const ShipState before = own_ship_at(put.own_ship());
  ShipState there = before;
  if (put.has_latitude_deg()) {
    there.position = {put.latitude_deg(), wrapped_longitude(put.longitude_deg())};
  }
  if (put.has_heading_deg()) there.heading_deg = wrapped_degrees(put.heading_deg());
  if (put.has_speed_kn()) there.speed_mps = knots_in_mps(put.speed_kn());
  there.aground = false;
  ship.put(there, *part_.environment);
  std::string what = fmt::format("{} put elsewhere", before.name);
  remember(what, PutBack{put.own_ship(), before});
  return what;
}

std::string World::set_faults(const wire::FaultChange& change) {
  OwnShip& ship = part_.own_ships[change.own_ship()];
  std::string what = fmt::format("faults of {}", ship.state().name);
  remember(what, FaultsBack{change.own_ship(), ship.faults()});
  ship.set_faults(changed(ship.faults(), change));
  return what;
}

void World::say(std::optional<std::uint32_t> own_ship, const std::string& text) {
  ExerciseLog& log = this->log();
  for (std::size_t i = 0; i < log.texts.size(); ++i) {
    if (!own_ship || *own_ship == i) log.texts[i] = {text, log.texts[i].count + 1};
  }
  mark("text",
       own_ship ? fmt::format("to {}: {}", part_.own_ships[*own_ship].state().name, text) : text);
}

void World::take_snapshot(const std::string& name) {
  snapshots_[name] = std::make_shared<const Part>(part_);
  std::vector<std::string>& names = log().snapshots;
  std::erase(names, name);
  names.push_back(name);
}

void World::restore(const std::string& name) {
  // Member by member: an own ship of a class is copied, not assigned.
  const Part kept = *snapshots_.at(name);
  const bool frozen = part_.clock.frozen;
  part_.clock = kept.clock;
  part_.clock.frozen = frozen;
  part_.steps = kept.steps;
  part_.scenario = kept.scenario;
  part_.own_ships = std::vector<OwnShip>(kept.own_ships);
  part_.traffic = kept.traffic;
  part_.environment = kept.environment;
  part_.events = kept.events;
  part_.contacts = kept.contacts;
  undo_.clear();
  log().can_undo.clear();
  mark("mark", fmt::format("restored \"{}\"", name));
}

void World::undo() {
  const Undo last = std::move(undo_.back());
  undo_.pop_back();
  if (const auto* environment = std::get_if<EnvironmentPtr>(&last.before)) {
    part_.environment = *environment;
  } else if (const auto* kept = std::get_if<std::shared_ptr<const Traffic::Kept>>(&last.before)) {
    part_.traffic.put_back(**kept);
  } else if (const auto* put = std::get_if<PutBack>(&last.before)) {
    part_.own_ships[put->own_ship].put(put->before, *part_.environment);
  } else if (const auto* faults = std::get_if<FaultsBack>(&last.before)) {
    part_.own_ships[faults->own_ship].set_faults(faults->before);
  } else {
    wire::TargetChange gone;
    gone.set_target(static_cast<std::uint32_t>(std::get<std::size_t>(last.before)));
    gone.set_removed(true);
    part_.traffic.order(gone, part_.clock.now);
  }
  log().can_undo = undo_.empty() ? "" : undo_.back().what;
}

void World::happen(const scenario::Event& event) {
  part_.contacts.search_anew();
  mark("event", event.name());
  std::vector<std::string> faults;
  const auto own_ship_called = [&](const std::string& name) {
    std::uint32_t ship = 0;
    while (part_.own_ships[ship].state().name != name) ++ship;
    return ship;
  };
  if (event.has_weather()) {
    Environment environment = *part_.environment;
    if (const auto wrong = change_environment(event.weather(), part_.clock.now, environment)) {
      faults.push_back(wrong->text());
    } else {
      part_.environment = std::make_shared<const Environment>(std::move(environment));
    }
  }
  for (const scenario::TargetEvent& each : event.targets()) {
    wire::TargetChange change = each.change();
    std::uint32_t number = 0;
    while (name_of(*part_.scenario, number) != each.target_name()) ++number;
    change.set_target(number);
    auto fault = part_.traffic.fault_of(change);
    if (fault) {
      faults.push_back(*std::move(fault));
    } else {
      part_.traffic.order(change, part_.clock.now);
    }
  }
  for (const scenario::ShipEvent& each : event.own_ships()) {
    const std::uint32_t number = own_ship_called(each.own_ship());
    OwnShip& ship = part_.own_ships[number];
    if (each.has_course_deg()) ship.order_course(each.course_deg());
    if (each.has_speed_kn()) ship.order_speed(knots_in_mps(each.speed_kn()));
    if (each.has_con()) {
      auto fault = ship.fault_of(each.con());
      if (fault) {
        faults.push_back(*std::move(fault));
      } else {
        ship.order(each.con());
      }
    }
    if (each.has_faults()) ship.set_faults(each.faults());
    if (each.has_text()) say(number, each.text());
  }
  if (event.has_text()) say(std::nullopt, event.text());
  if (event.has_mark()) mark("mark", event.mark());
  if (event.freeze()) part_.clock.frozen = true;
  for (const std::string& fault : faults) {
    mark("event", fmt::format("{}: could not be done: {}", event.name(), fault));
  }
}

}  // namespace skerry::server
