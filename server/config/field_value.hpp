// One value of a YAML file, checked and set in a protobuf message.
#pragma once

#include <google/protobuf/descriptor.h>
#include <google/protobuf/message.h>

#include <stdexcept>
#include <string>

#include "protocol/wire/schema.hpp"
#include "server/config/yaml_tree.hpp"

namespace skerry::server {

inline constexpr std::size_t kMaxTextValueBytes = 4096;

// Error: std::logic_error for a type that YAML files do not hold (bytes, maps).
void require_readable(const google::protobuf::FieldDescriptor& field);

using wire::allowed_by;
using wire::rule_of;

// "a number", "a whole number", "text", "true or false", "one of SLOW, FAST", "keys and values".
std::string expected_by(const google::protobuf::FieldDescriptor& field);

// "75", "the text "fast"", "a list", "keys and values", "nothing".
std::string given_by(const YamlNode& node);

// The fault of a value; its reader knows the place.
class ValueError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// Sets `field` of `out` (adds to it if it is repeated) to the value of `node`.  Numbers are decimal
// and finite, whole ones without a point, or hexadecimal after 0x; true, false and enums are
// spelled as in the schema; text is at most kMaxTextValueBytes without control characters, and a
// rule's bounds are on its characters.  Requires a readable field that is no message.
// Error: ValueError if the value is not of the field's type or the field's rule forbids it; then
// `out` is as before.
void set_value(const YamlNode& node, const google::protobuf::FieldDescriptor& field,
               google::protobuf::Message& out);

// Sets `field` to its rule's default, if it has one.  Requires a single number, bool or enum.
void set_default(const google::protobuf::FieldDescriptor& field, google::protobuf::Message& out);

}  // namespace skerry::server
