// skerry exercise fault and clear: what is wrong aboard an own ship.
#include <fmt/format.h>

#include <cmath>

#include "clients/cli/exercise/exercise_link.hpp"
#include "clients/cli/field_words.hpp"
#include "protocol/wire/printable_text.hpp"
#include "protocol/wire/schema.hpp"

namespace skerry::client {
namespace {

using wire::FieldDescriptor;

std::vector<const FieldDescriptor*> fault_kinds() {
  return wire::fields_of(*wire::Faults::descriptor());
}

const FieldDescriptor* kind_named(const std::string& name) {
  for (const FieldDescriptor* kind : fault_kinds()) {
    if (name == distinct_name(*kind) || name == kind->name()) return kind;
  }
  return nullptr;
}

// Each with its help, a line each.
std::string list_of_kinds() {
  std::string list = "Kinds:\n";
  for (const FieldDescriptor* kind : fault_kinds()) {
    list += fmt::format("  {:<26}{}\n", distinct_name(*kind), help_of(*kind));
  }
  return list;
}

struct FaultRequest {
  std::string ship;
  std::vector<std::string> kinds;
};

std::string no_such_kind(const std::string& name) {
  return fmt::format("there is no fault '{}'; the kinds stand in skerry exercise fault --help",
                     printable(name, 40));
}

// "gyro-bias=5" and "gyro-lost"; what is wrong with it, if anything is.
std::optional<std::string> read_fault(const std::string& text, wire::FaultChange& change) {
  const std::size_t equals = text.find('=');
  const FieldDescriptor* const kind = kind_named(text.substr(0, equals));
  if (kind == nullptr) {
    return no_such_kind(text.substr(0, equals));
  }
  const std::string value = equals == std::string::npos ? "" : text.substr(equals + 1);
  const bool is_switch = kind->cpp_type() == FieldDescriptor::CPPTYPE_BOOL;
  const std::string name = distinct_name(*kind);
  if (is_switch && equals != std::string::npos && value != "on" && value != "off") {
    return fmt::format("fault {}: '{}' is neither on nor off", name, printable(value, 40));
  }
  char* end = nullptr;
  const double number = std::strtod(value.c_str(), &end);
  if (!is_switch && (value.empty() || *end != '\0' || !std::isfinite(number))) {
    return fmt::format("fault {}: '{}' is not a number; expected {}={}", name, printable(value, 40),
                       name, wire::allowed_by(wire::rule_of(*kind)));
  }
  const double switched = value == "off" ? 0.0 : 1.0;
  wire::put_value(*change.mutable_faults(), *kind, is_switch ? switched : number);
  change.add_change(kind->name());
  return std::nullopt;
}

// "gyro-bias": without it from now on.
std::optional<std::string> read_cleared(const std::string& text, wire::FaultChange& change) {
  const FieldDescriptor* const kind = kind_named(text);
  if (kind == nullptr) return no_such_kind(text);
  change.add_change(kind->name());
  return std::nullopt;
}

int change_faults(const ExercisePlace& place, const std::string& ship, wire::FaultChange change) {
  auto client = place.server.connect();
  if (!client) return report(client.error());
  const auto state = exercise_now(*client, place);
  if (!state) return report(state.error());
  const auto found = find_ship(*state, ship, true);
  if (!found) return report(found.error());
  change.set_own_ship((*found)->number());
  change.mutable_faults();
  wire::ExerciseOrder order;
  *order.mutable_fault() = std::move(change);
  return give_order(*client, place, order);
}

using ReadKind = std::optional<std::string> (*)(const std::string&, wire::FaultChange&);

Command make_fault_part(CLI::App& exercise, const char* name, const char* help, ReadKind read,
                        const char* what, bool needs_kind) {
  const auto place = std::make_shared<ExercisePlace>();
  const auto request = std::make_shared<FaultRequest>();
  const Command made =
      make_exercise_part(exercise, name, help, place, [request, read](const ExercisePlace& at) {
        wire::FaultChange change;
        for (const std::string& kind : request->kinds) {
          if (const auto wrong = read(kind, change)) {
            report(*wrong);
            return kExitUsage;
          }
        }
        return change_faults(at, request->ship, std::move(change));
      });
  made.app->add_option("SHIP", request->ship, "Her name or number")->required();
  made.app->footer(list_of_kinds());
  made.app->add_option("KIND", request->kinds, what)->required(needs_kind);
  return made;
}

}  // namespace

std::vector<Command> make_fault_commands(CLI::App& exercise) {
  return {make_fault_part(exercise, "fault", "Sets faults aboard an own ship", read_fault,
                          "KIND=VALUE, or KIND alone for one that is on or off", true),
          make_fault_part(exercise, "clear", "Takes faults aboard an own ship away", read_cleared,
                          "Those to take away; without any: all", false)};
}

}  // namespace skerry::client
