// A YAML file, read into a protobuf message and checked against its schema key by key.
#pragma once

#include <google/protobuf/message.h>

#include <string>

#include "server/config/config_error.hpp"
#include "server/config/yaml_source.hpp"

namespace skerry::server {

// Every key must be a field of the message, given once, with a value of its type that its rule
// (field_rules.proto) permits; a required key must be there and a required list hold something.
// Absent keys get their rule's default.  An absent section (an inner message) is filled with its
// defaults, unless it is declared `optional`, holds itself, or has required keys, itself or further
// in: then it stays absent.  Lists become repeated fields, inner maps messages.  `out` is replaced;
// after an error it is as before.  Returns where everything stood, for checks that the rules cannot
// express.
// Error: ConfigError, for the first thing wrong in the order of the text, missing keys last in each
// map; std::logic_error for a schema with bytes or maps.  Cost is bounded by the limits in
// yaml_tree.hpp.
// Thread: any.
YamlSource load_yaml(const std::string& text, const std::string& file_name,
                     google::protobuf::Message& out);

// The text of a file.  Error: ConfigError naming the file and why it cannot be read, or is too
// long.
std::string read_yaml_file(const std::string& path);

// The same from a file, which messages name by `path`.
// Error: also ConfigError if the file cannot be read.
YamlSource load_yaml_file(const std::string& path, google::protobuf::Message& out);

}  // namespace skerry::server
