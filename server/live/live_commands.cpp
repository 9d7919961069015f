#include "server/live/live_commands.hpp"

#include <fmt/format.h>

#include "protocol/navico/command.hpp"
#include "protocol/raymarine/quantum_command.hpp"
#include "protocol/wire/schema.hpp"

namespace skerry::server {

using captures::Family;

Commands live_commands(const LiveKind& kind, navico::Model model, const wire::Set& set,
                       const wire::Settings& now) {
  switch (kind.family) {
    case Family::navico:
      return navico_commands(model, set, now);
    case Family::garmin:
      return garmin_commands(set, now);
    case Family::quantum:
      return quantum_commands(set, now);
    case Family::rd:
    case Family::furuno:
    case Family::cat240:
    case Family::native:
      break;
  }
  return Failure{fmt::format("a {} takes no commands", name_of(kind.family))};
}

StayAlive stay_alive_of(const LiveKind& kind) {
  if (kind.family == Family::navico) {
    return {std::chrono::seconds(1),
            {navico::encode_command({.kind = navico::CommandKind::stay_alive}),
             navico::encode_command({.kind = navico::CommandKind::ask_controls})}};
  }
  if (kind.family == Family::quantum) {
    return {std::chrono::milliseconds(500),
            {raymarine::encode_quantum_command(raymarine::QuantumControl::stay_alive, 0)}};
  }
  return {};
}

wire::Set changes_of(const wire::Set& set) {
  wire::Set changes = set;
  changes.clear_radar();
  changes.clear_view();
  changes.clear_token();
  changes.clear_instructor();
  return changes;
}

std::optional<std::string> lacking_in(const wire::Set& rest, std::string_view radar) {
  if (rest.ByteSizeLong() == 0) return std::nullopt;
  std::vector<const google::protobuf::FieldDescriptor*> fields;
  rest.GetReflection()->ListFields(rest, &fields);
  return fmt::format("a {} has no control '{}'", radar,
                     fields.empty() ? "unknown" : wire::spoken_name(*fields.front()));
}

}  // namespace skerry::server
