#include "clients/cli/exercise/exercise_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "clients/cli/field_words.hpp"
#include "protocol/picture/label_text.hpp"
#include "protocol/wire/printable_text.hpp"
#include "protocol/wire/schema.hpp"

namespace skerry::client {
namespace {

using wire::ExerciseShip;
using wire::ExerciseState;
using wire::FieldDescriptor;

std::string exercise_clock(double seconds) {
  const auto whole = static_cast<std::int64_t>(seconds);
  return fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
}

std::string pace_text(const ExerciseState& state) {
  return fmt::format("{}, pace {:g}", state.frozen() ? "frozen" : "running", state.rate());
}

// "1 waypoint left", "3 waypoints left".
std::string counted(int count, const char* one, const char* many) {
  return fmt::format("{} {}", count, count == 1 ? one : many);
}

// "gyro bias 5 deg, gyro lost"
std::string faults_text(const wire::Faults& faults) {
  std::string text;
  for (const FieldDescriptor* kind : wire::fields_of(*wire::Faults::descriptor())) {
    if (wire::value_of(faults, *kind).value_or(0.0) == 0.0) continue;
    const std::string& label = wire::control_of(*kind).label();
    text += fmt::format("{}{}", text.empty() ? "" : ", ", label);
    if (kind->cpp_type() != FieldDescriptor::CPPTYPE_BOOL) text += " " + text_of(faults, *kind);
  }
  return text;
}

std::string notes_of(const ExerciseShip& ship) {
  std::string notes;
  const auto add = [&](const std::string& note) {
    notes += fmt::format("{}{}", notes.empty() ? "" : ", ", note);
  };
  if (ship.removed()) add("off the water");
  if (ship.aground()) add("aground: put her elsewhere");
  if (!ship.con().empty()) add("con: " + printable(ship.con(), 48));
  if (ship.gives_way_now()) add("gives way");
  if (ship.on_course()) add("off her route");
  if (ship.route_size() > 0) add(counted(ship.route_size(), "waypoint left", "waypoints left"));
  if (ship.sart()) add("SART");
  if (ship.ais_off()) add("AIS off");
  if (const std::string faults = faults_text(ship.faults()); !faults.empty()) add(faults);
  return notes;
}

std::string with_degrees(std::string text) {
  for (std::size_t at; (at = text.find('^')) != std::string::npos;) text.replace(at, 1, "\u00b0");
  return text;
}

std::string ships_text(const ExerciseState& state, bool own) {
  std::string out = fmt::format("{:<7} {:<20} {:<12} {:<27} {:>7} {:>7} {:>8} {:>14}  {}\n",
                                own ? "OWN" : "TARGET", "NAME", "CLASS", "POSITION", "HEADING",
                                "COURSE", "SPEED", "ORDERED", "NOTES");
  bool any = false;
  for (const ExerciseShip& ship : state.ships()) {
    if (ship.own() != own) continue;
    any = true;
    out += with_degrees(
        fmt::format("{:<7} {:<20} {:<12} {:<27} {:>7} {:>7} {:>5.1f} kn {} {:>5.1f} kn  {}\n",
                    ship.number(), printable(ship.name(), 20),
                    ship.ship_class().empty() ? "-" : printable(ship.ship_class(), 12),
                    position_text({ship.latitude_deg(), ship.longitude_deg()}),
                    bearing_text(ship.heading_deg()), bearing_text(ship.course_over_ground_deg()),
                    ship.speed_kn(), bearing_text(ship.ordered_course_deg()),
                    ship.ordered_speed_kn(), notes_of(ship)));
  }
  if (any) return out;
  return own ? "no own ships\n" : "no targets\n";
}

std::string mark_line(const wire::ExerciseMark& mark) {
  return fmt::format("{:>8}  {:<9} {}\n", exercise_clock(mark.exercise_s()),
                     printable(mark.kind(), 9), printable(mark.text()));
}

bool same_mark(const wire::ExerciseMark& a, const wire::ExerciseMark& b) {
  return a.exercise_s() == b.exercise_s() && a.kind() == b.kind() && a.text() == b.text();
}

// The marks of `after` that come after the last of `before`.
int first_new_mark(const ExerciseState& before, const ExerciseState& after) {
  if (before.marks().empty()) return 0;
  const wire::ExerciseMark& last = before.marks(before.marks_size() - 1);
  for (int i = after.marks_size(); i-- > 0;) {
    if (same_mark(after.marks(i), last)) return i + 1;
  }
  return after.marks_size();  // a snapshot brought an older log back
}

// What a ship does by herself, all the time.
constexpr std::array<std::string_view, 9> kMoving = {
    "latitude_deg",           "longitude_deg", "heading_deg",
    "course_over_ground_deg", "speed_kn",      "rate_of_turn_deg_min",
    "gyro_error_deg",         "gnss_error_m",  "number"};

// Great circles: on a leg of her route the course she is to steer changes all the time, a little.
bool only_creeps(const FieldDescriptor& field, const ExerciseShip& before,
                 const ExerciseShip& after) {
  constexpr double kCourse_deg = 0.5;
  if (field.name() != "ordered_course_deg") return false;
  return std::abs(std::remainder(after.ordered_course_deg() - before.ordered_course_deg(), 360.0)) <
         kCourse_deg;
}

std::string ship_changes(const ExerciseShip& before, const ExerciseShip& after) {
  std::string text;
  const auto add = [&](const std::string& change) {
    text += fmt::format("{}{}", text.empty() ? "" : ", ", change);
  };
  for (const FieldDescriptor* field : wire::fields_of(*ExerciseShip::descriptor())) {
    if (field->is_repeated() || field->cpp_type() == FieldDescriptor::CPPTYPE_MESSAGE ||
        std::find(kMoving.begin(), kMoving.end(), field->name()) != kMoving.end()) {
      continue;
    }
    if (only_creeps(*field, before, after)) continue;
    const std::string was = text_of(before, *field), is = text_of(after, *field);
    if (was != is) add(fmt::format("{} {}", wire::spoken_name(*field), is.empty() ? "nobody" : is));
  }
  if (before.route_size() != after.route_size()) {
    add(counted(after.route_size(), "waypoint left", "waypoints left"));
  }
  const std::string was = faults_text(before.faults()), is = faults_text(after.faults());
  if (was != is) add("faults: " + (is.empty() ? "none" : is));
  return text;
}

}  // namespace

std::string exercise_text(const ExerciseState& state) {
  std::string out =
      fmt::format("EXERCISE   {}, {}\n", exercise_clock(state.exercise_s()), pace_text(state));
  if (state.orders() > 0) {
    out += fmt::format("ORDERS     {}, the last by {}: {}\n", state.orders(),
                       printable(state.last_by(), 64), printable(state.last_order()));
  }
  if (!state.can_undo().empty()) out += fmt::format("UNDO       {}\n", printable(state.can_undo()));
  std::string snapshots;
  for (const std::string& name : state.snapshots()) {
    snapshots += fmt::format("{}{}", snapshots.empty() ? "" : ", ", printable(name));
  }
  if (!snapshots.empty()) out += fmt::format("SNAPSHOTS  {}\n", snapshots);
  out += "\n" + ships_text(state, true) + "\n" + ships_text(state, false);
  if (!state.marks().empty()) out += "\n";
  for (const wire::ExerciseMark& mark : state.marks()) out += mark_line(mark);
  return out;
}

std::vector<std::string> exercise_changes(const ExerciseState& before, const ExerciseState& after) {
  std::vector<std::string> lines;
  const auto add = [&](const std::string& text) {
    lines.push_back(fmt::format("{:>8}  {}", exercise_clock(after.exercise_s()), text));
  };
  if (after.orders() != before.orders()) {
    add(fmt::format("{} by {}", printable(after.last_order()), printable(after.last_by(), 64)));
  }
  if (after.frozen() != before.frozen() || after.rate() != before.rate()) add(pace_text(after));
  for (const std::string& name : after.snapshots()) {
    const auto& known = before.snapshots();
    if (std::find(known.begin(), known.end(), name) == known.end()) {
      add("snapshot " + printable(name));
    }
  }
  for (const ExerciseShip& ship : after.ships()) {
    const auto was =
        std::find_if(before.ships().begin(), before.ships().end(), [&](const ExerciseShip& other) {
          return other.own() == ship.own() && other.number() == ship.number();
        });
    const std::string text =
        was == before.ships().end()
            ? with_degrees("new, at " + position_text({ship.latitude_deg(), ship.longitude_deg()}))
            : ship_changes(*was, ship);
    if (!text.empty()) add(fmt::format("{}: {}", printable(ship.name(), 64), text));
  }
  for (int i = first_new_mark(before, after); i < after.marks_size(); ++i) {
    std::string line = mark_line(after.marks(i));
    line.pop_back();
    lines.push_back(std::move(line));
  }
  return lines;
}

}  // namespace skerry::client
