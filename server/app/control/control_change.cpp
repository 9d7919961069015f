#include "server/app/control/control_change.hpp"

#include <fmt/format.h>
#include <google/protobuf/message.h>

#include <string_view>

#include "server/app/control/control_ranges.hpp"

namespace skerry::server {
namespace {

using google::protobuf::FieldDescriptor;
using google::protobuf::Message;

std::string text_of(const wire::BlankedSectors& blanked) {
  std::string text;
  for (const auto& sector : blanked.sectors()) {
    text += fmt::format("{}{:.6g} to {:.6g}", text.empty() ? "" : ", ", sector.from_deg(),
                        sector.to_deg());
  }
  return text.empty() ? "none" : text;
}

std::string text_of(const wire::RainCell& cell) {
  return fmt::format("{}: {} at {:.4f} {:.4f}, {:.3g} NM, {:.3g} mm/h, to {:.0f} at {:.3g} kn",
                     cell.id(), wire::word_of(*wire::RainKind_descriptor(), cell.kind()),
                     cell.latitude_deg(), cell.longitude_deg(), cell.radius_nm(), cell.rate_mm_h(),
                     cell.drift_deg(), cell.drift_kn());
}

std::string text_of(const Message& message, const FieldDescriptor& field) {
  const google::protobuf::Reflection& reflection = *message.GetReflection();
  if (field.has_presence() && !reflection.HasField(message, &field)) {
    return field.name() == "visibility_nm" ? "clear" : "not given";
  }
  switch (field.cpp_type()) {
    case FieldDescriptor::CPPTYPE_DOUBLE:
      return fmt::format("{:.6g}", reflection.GetDouble(message, &field));
    case FieldDescriptor::CPPTYPE_BOOL:
      return reflection.GetBool(message, &field) ? "on" : "off";
    case FieldDescriptor::CPPTYPE_ENUM:
      return wire::word_of(*field.enum_type(), reflection.GetEnumValue(message, &field));
    default:
      return {};
  }
}

// Texts are rounded; a number that is not may have changed nevertheless.
bool is_same_number(const Message& before, const Message& after, const FieldDescriptor& field) {
  return field.cpp_type() != FieldDescriptor::CPPTYPE_DOUBLE ||
         before.GetReflection()->GetDouble(before, &field) ==
             after.GetReflection()->GetDouble(after, &field);
}

bool carries_fields(const FieldDescriptor& field) {
  return field.message_type() == wire::Controls::descriptor() ||
         field.message_type() == wire::Artefacts::descriptor();
}

// The plain fields that differ, under `prefix`.
void add_differences(const Message& before, const Message& after, const std::string& prefix,
                     std::vector<ControlChange>& out) {
  const google::protobuf::Descriptor& type = *before.GetDescriptor();
  for (int i = 0; i < type.field_count(); ++i) {
    const FieldDescriptor& field = *type.field(i);
    if (carries_fields(field)) {
      add_differences(before.GetReflection()->GetMessage(before, &field),
                      after.GetReflection()->GetMessage(after, &field), prefix, out);
      continue;
    }
    if (field.is_repeated() || field.cpp_type() == FieldDescriptor::CPPTYPE_MESSAGE) continue;
    std::string was = text_of(before, field), is = text_of(after, field);
    if (was == is && is_same_number(before, after, field)) continue;
    out.push_back({prefix + field.name(), std::move(was), std::move(is)});
  }
}

}  // namespace

std::string lock_of(const ControlChange& change) {
  return change.control.substr(0, change.control.find('.'));
}

std::vector<ControlChange> differences(const wire::Settings& before, const wire::Settings& after) {
  std::vector<ControlChange> all, changes;
  add_differences(before, after, "", all);
  for (ControlChange& change : all) {
    if (change.control == "standby") {
      changes.push_back(
          {"transmit", before.standby() ? "off" : "on", after.standby() ? "off" : "on"});
    } else if (is_control(change.control)) {
      changes.push_back(std::move(change));
    }
  }
  std::string was = text_of(before.blanked_sectors()), is = text_of(after.blanked_sectors());
  if (was != is) changes.push_back({"blanked_sectors", std::move(was), std::move(is)});
  return changes;
}

std::vector<ControlChange> differences(const wire::World& before, const wire::World& after) {
  std::vector<ControlChange> changes;
  wire::World then = before;
  then.set_scenario_s(after.scenario_s());
  add_differences(then, after, "world.", changes);
  const auto find = [](const wire::World& world, std::uint32_t id) -> const wire::RainCell* {
    for (const wire::RainCell& cell : world.rain()) {
      if (cell.id() == id) return &cell;
    }
    return nullptr;
  };
  for (const wire::RainCell& cell : before.rain()) {
    if (find(after, cell.id()) == nullptr) {
      changes.push_back({"world.rain", text_of(cell), "gone"});
    }
  }
  for (const wire::RainCell& cell : after.rain()) {
    const wire::RainCell* const old = find(before, cell.id());
    std::string was = old != nullptr ? text_of(*old) : "none", is = text_of(cell);
    if (was != is) changes.push_back({"world.rain", std::move(was), std::move(is)});
  }
  return changes;
}

}  // namespace skerry::server
