#include "server/playback/same_settings.hpp"

#include <vector>

#include "protocol/wire/schema.hpp"

namespace skerry::server {
namespace {

using wire::FieldDescriptor;
using wire::Message;

// Whether all that is present in `asked`, a Set or the controls it carries, is so.
bool is_same(const Message& asked, const wire::Settings& settings);

bool is_same(const Message& asked, const FieldDescriptor& field, const wire::Settings& settings) {
  if (field.message_type() == wire::Controls::descriptor()) {
    return is_same(asked.GetReflection()->GetMessage(asked, &field), settings);
  }
  const auto* const control = wire::Controls::descriptor()->FindFieldByName(field.name());
  if (control == nullptr || control->message_type() != nullptr) return false;
  return wire::value_of(asked, *control) == wire::value_of(settings, *control);
}

bool says_where_or_who(const FieldDescriptor& field) {
  return field.name() == "radar" || field.name() == "view" || field.name() == "instructor" ||
         field.name() == "token";
}

bool is_same(const Message& asked, const wire::Settings& settings) {
  if (!asked.GetReflection()->GetUnknownFields(asked).empty()) return false;
  std::vector<const FieldDescriptor*> present;
  asked.GetReflection()->ListFields(asked, &present);
  for (const FieldDescriptor* field : present) {
    if (!says_where_or_who(*field) && !is_same(asked, *field, settings)) return false;
  }
  return true;
}

}  // namespace

bool is_so_already(const wire::Set& set, const wire::Settings& settings) {
  return is_same(set, settings);
}

}  // namespace skerry::server
