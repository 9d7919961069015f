#include "server/access/asked.hpp"

#include <google/protobuf/descriptor.h>
#include <google/protobuf/message.h>

#include <algorithm>
#include <set>

#include "protocol/wire/controls.pb.h"

namespace skerry::server {
namespace {

using google::protobuf::FieldDescriptor;
using google::protobuf::Message;

// Whom a message is for and who sends it: no right of its own.
bool is_address(const std::string& name) {
  return name == "radar" || name == "view" || name == "token";
}

// Each field of a Set by its own name; those that are controls (controls.proto) as one.
std::vector<std::string> rights_of(const wire::Set& set) {
  std::vector<const FieldDescriptor*> given;
  set.GetReflection()->ListFields(set, &given);
  std::set<std::string> rights;
  for (const FieldDescriptor* field : given) {
    if (is_address(field->name())) continue;
    const bool is_control = wire::Controls::descriptor()->FindFieldByName(field->name()) != nullptr;
    rights.insert("set." + (is_control ? std::string("controls") : field->name()));
  }
  // What this server does not know is answered so by those who may set anything.
  if (rights.empty()) rights.insert("set.controls");
  return {rights.begin(), rights.end()};
}

std::vector<std::string> rights_of(const wire::Subscribe& subscribe) {
  std::vector<std::string> rights{"subscribe"};
  if (subscribe.new_view()) rights.emplace_back("subscribe.new_view");
  if (subscribe.exercise_hz() > 0) rights.emplace_back("subscribe.exercise_hz");
  return rights;
}

std::vector<std::string> rights_of(const wire::BoardAccess& access) {
  const auto& all = access.operations();
  const bool writes = std::any_of(
      all.begin(), all.end(), [](const wire::BoardOperation& each) { return each.has_write(); });
  return {writes ? "board_access.write" : "board_access"};
}

}  // namespace

Asked asked_by(const wire::ClientMessage& message) {
  Asked asked;
  const auto* kinds = wire::ClientMessage::descriptor()->FindOneofByName("kind");
  const auto* kind = message.GetReflection()->GetOneofFieldDescriptor(message, kinds);
  if (kind == nullptr) return asked;
  const Message& inner = message.GetReflection()->GetMessage(message, kind);
  const auto* reflection = inner.GetReflection();
  if (const auto* radar = inner.GetDescriptor()->FindFieldByName("radar")) {
    asked.radar = reflection->GetUInt32(inner, radar);
  }
  const auto* token = inner.GetDescriptor()->FindFieldByName("token");
  if (token != nullptr && !message.has_sign_in()) asked.token = reflection->GetString(inner, token);
  if (message.has_set()) {
    asked.rights = rights_of(message.set());
  } else if (message.has_subscribe()) {
    asked.rights = rights_of(message.subscribe());
  } else if (message.has_board_access()) {
    asked.rights = rights_of(message.board_access());
  } else {
    asked.rights = {kind->name()};
  }
  return asked;
}

}  // namespace skerry::server
