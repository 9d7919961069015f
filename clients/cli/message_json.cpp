#include "clients/cli/message_json.hpp"

#include <google/protobuf/util/json_util.h>

#include <stdexcept>

namespace skerry::client {

std::string json_text(const wire::Message& message) {
  google::protobuf::util::JsonPrintOptions format;
  format.add_whitespace = true;
  format.always_print_primitive_fields = true;
  format.preserve_proto_field_names = true;
  std::string out;
  const auto done = google::protobuf::util::MessageToJsonString(message, &out, format);
  if (!done.ok()) {
    throw std::runtime_error(message.GetTypeName() +
                             " cannot be written as JSON: " + std::string(done.message()));
  }
  return out;
}

}  // namespace skerry::client
