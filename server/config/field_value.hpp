// One value of a YAML file, checked and set in a protobuf message.
#pragma once

#include <google/protobuf/descriptor.h>
#include <google/protobuf/message.h>

#include <string>

#include "server/config/field_rules.pb.h"
#include "server/config/yaml_source.hpp"
#include "server/config/yaml_tree.hpp"

namespace skerry::server {

inline constexpr std::size_t kMaxTextValueBytes = 4096;

// What the schema says of a field beyond its type.
const config::FieldRule& rule_of(const google::protobuf::FieldDescriptor& field);

// "12 to 60 turns/min", "4, 8 per cell", "at least 2 m"; empty if the rule bounds nothing.
std::string allowed_by(const config::FieldRule& rule);

// "a number", "a whole number", "text", "true or false", "a list", "keys and values".
std::string expected_by(const google::protobuf::FieldDescriptor& field);

// "75", "the text "fast"", "a list", "keys and values", "nothing".
std::string given_by(const YamlNode& node);

// Sets `field` of `out` (adds to it if it is repeated) to the value of `node`.  Numbers are decimal
// and finite, whole ones without a point; true and false are spelled so; text is at most
// kMaxTextValueBytes without control characters.
// Error: ConfigError if the value is not of the field's type or the field's rule forbids it;
// std::logic_error if the schema uses a type other than double, uint32, uint64, bool and string.
void set_value(const YamlNode& node, const google::protobuf::FieldDescriptor& field,
               const std::string& path, const YamlSource& source, google::protobuf::Message& out);

// Sets `field` to its rule's default, if it has one.  Requires a single number or bool.
void set_default(const google::protobuf::FieldDescriptor& field, google::protobuf::Message& out);

}  // namespace skerry::server
