#include "server/debrief/orders_told.hpp"

#include <fmt/format.h>

#include <string>

#include "server/world/ship_units.hpp"

namespace skerry::server {
namespace {

void add_part(std::string& text, const std::string& part) {
  text += (text.empty() ? "" : ", ") + part;
}

std::string helm_text(const recording::Input::Order& order) {
  const wire::ConOrder& con = order.con();
  std::string text;
  if (order.has_course_deg()) add_part(text, fmt::format("course {:.0f}°", order.course_deg()));
  if (con.has_rudder_deg()) {
    add_part(text, fmt::format("rudder {}{:.0f}°",
                               con.rudder_deg() > 0.0   ? "starboard "
                               : con.rudder_deg() < 0.0 ? "port "
                                                        : "",
                               std::abs(con.rudder_deg())));
  }
  if (con.has_heading_deg()) add_part(text, fmt::format("autopilot {:.0f}°", con.heading_deg()));
  if (con.has_steering()) {
    add_part(text, con.steering() == wire::STEERING_HAND      ? "steering by hand"
                   : con.steering() == wire::STEERING_HEADING ? "steering by autopilot"
                                                              : "steering along the route");
  }
  if (con.has_turn_rate_deg_min()) {
    add_part(text, fmt::format("rate of turn {:.0f}°/min", con.turn_rate_deg_min()));
  }
  return text;
}

std::string engine_text(const recording::Input::Order& order) {
  const wire::ConOrder& con = order.con();
  std::string text;
  if (order.has_speed_kn()) add_part(text, fmt::format("speed {:.1f} kn", order.speed_kn()));
  if (con.has_engine_percent()) {
    add_part(text, fmt::format("engine {:.0f} %", con.engine_percent()));
  }
  if (con.has_bow_thruster_percent()) {
    add_part(text, fmt::format("bow thruster {:.0f} %", con.bow_thruster_percent()));
  }
  if (con.has_stern_thruster_percent()) {
    add_part(text, fmt::format("stern thruster {:.0f} %", con.stern_thruster_percent()));
  }
  return text;
}

// A message's fields on one line, as short as they are.
std::string short_text(const google::protobuf::Message& message) {
  constexpr std::size_t kLongest = 300;
  std::string text = message.ShortDebugString();
  if (text.size() > kLongest) text = text.substr(0, kLongest) + " ...";
  return text;
}

std::string own_ship_name(const scenario::Scenario& scenario, std::uint32_t number) {
  if (number >= static_cast<std::uint32_t>(scenario.own_ships_size())) {
    return fmt::format("own ship {}", number);
  }
  return scenario.own_ships(static_cast<int>(number)).name();
}

std::string target_name(const scenario::Scenario& scenario, std::uint32_t number) {
  if (number >= static_cast<std::uint32_t>(scenario.targets_size())) {
    return fmt::format("target {}", number);
  }
  return scenario.targets(static_cast<int>(number)).name();
}

std::optional<HappenedLine> line_of(const recording::Input::Exercise& told, Moment when,
                                    const scenario::Scenario& scenario) {
  const wire::ExerciseOrder& order = told.order();
  HappenedLine line{when, "order", told.by(), "", {}};
  switch (order.kind_case()) {
    case wire::ExerciseOrder::kClock:
      line.kind = "clock";
      if (order.clock().has_frozen()) {
        line.text = order.clock().frozen() ? "the exercise is frozen" : "the exercise goes on";
      }
      if (order.clock().has_rate())
        add_part(line.text, fmt::format("{} times", order.clock().rate()));
      return line;
    case wire::ExerciseOrder::kTarget: {
      wire::TargetChange change = order.target();
      line.text = target_name(scenario, change.target()) + ": ";
      change.clear_target();
      line.text += short_text(change);
      return line;
    }
    case wire::ExerciseOrder::kNewTarget:
      line.text = "a new target: " + short_text(order.new_target());
      return line;
    case wire::ExerciseOrder::kOwnShip:
      line.own_ship = order.own_ship().own_ship();
      line.text = own_ship_name(scenario, order.own_ship().own_ship()) + " is put elsewhere";
      return line;
    case wire::ExerciseOrder::kFault: {
      line.kind = "fault";
      line.own_ship = order.fault().own_ship();
      const std::string faults = short_text(order.fault().faults());
      line.text = own_ship_name(scenario, order.fault().own_ship()) + ": " +
                  (faults.empty() ? "mended" : faults);
      return line;
    }
    case wire::ExerciseOrder::kSnapshot:
      line.text = fmt::format("snapshot \"{}\"", order.snapshot());
      return line;
    case wire::ExerciseOrder::kRestore:
      line.text = fmt::format("back to the snapshot \"{}\"", order.restore());
      return line;
    case wire::ExerciseOrder::kUndo:
      line.text = "the last change is taken back";
      return line;
    case wire::ExerciseOrder::kText:
    case wire::ExerciseOrder::kMark:
    case wire::ExerciseOrder::kAground:
    case wire::ExerciseOrder::KIND_NOT_SET:
      break;
  }
  return std::nullopt;
}

}  // namespace

std::vector<HappenedLine> lines_of(const recording::Input& input, Moment when,
                                   const scenario::Scenario& scenario) {
  std::vector<HappenedLine> lines;
  if (input.has_order()) {
    const std::size_t ship = input.order().own_ship();
    const std::string name = own_ship_name(scenario, input.order().own_ship());
    for (const auto& [kind, text] :
         {std::pair{"helm", helm_text(input.order())}, {"engine", engine_text(input.order())}}) {
      if (!text.empty()) lines.push_back({when, kind, name, text, ship});
    }
  } else if (input.has_environment()) {
    lines.push_back({when, "weather", "", short_text(input.environment().change()), {}});
  } else if (input.has_exercise()) {
    if (auto line = line_of(input.exercise(), when, scenario)) lines.push_back(*std::move(line));
  }
  return lines;
}

}  // namespace skerry::server
