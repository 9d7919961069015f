#include "server/playback/same_settings.hpp"

#include <google/protobuf/descriptor.h>
#include <google/protobuf/message.h>

#include <string>
#include <vector>

namespace skerry::server {
namespace {

using google::protobuf::FieldDescriptor;

bool is_same(const wire::Set& set, const FieldDescriptor& asked, const wire::Settings& settings) {
  if (asked.name() == "transmit") return set.transmit() != settings.standby();
  const auto* is = wire::Settings::descriptor()->FindFieldByName(asked.name());
  if (is == nullptr || is->is_repeated() || is->cpp_type() != asked.cpp_type()) return false;
  const auto& wanted = *set.GetReflection();
  const auto& held = *settings.GetReflection();
  switch (asked.cpp_type()) {
    case FieldDescriptor::CPPTYPE_DOUBLE:
      return wanted.GetDouble(set, &asked) == held.GetDouble(settings, is);
    case FieldDescriptor::CPPTYPE_BOOL:
      return wanted.GetBool(set, &asked) == held.GetBool(settings, is);
    case FieldDescriptor::CPPTYPE_ENUM:
      return wanted.GetEnumValue(set, &asked) == held.GetEnumValue(settings, is);
    default:
      return false;
  }
}

bool says_where_or_who(const FieldDescriptor& field) {
  return field.name() == "radar" || field.name() == "view" || field.name() == "instructor" ||
         field.name() == "token";
}

}  // namespace

bool is_so_already(const wire::Set& set, const wire::Settings& settings) {
  if (!set.GetReflection()->GetUnknownFields(set).empty()) return false;
  std::vector<const FieldDescriptor*> present;
  set.GetReflection()->ListFields(set, &present);
  for (const FieldDescriptor* field : present) {
    if (says_where_or_who(*field)) continue;
    if (field->is_repeated() || !is_same(set, *field, settings)) return false;
  }
  return true;
}

}  // namespace skerry::server
