// A YAML file, read into a protobuf message and checked against its schema key by key.
#pragma once

#include <google/protobuf/message.h>

#include <string>

#include "server/config/config_error.hpp"
#include "server/config/yaml_tree.hpp"

namespace skerry::server {

// Reads a text into `out`, which is replaced.  Every key must be a field of the message, given
// once, with a value of its type that its rule (field_rules.proto) permits; a required key must be
// there and a required list hold something.  Absent keys get their rule's default.  An absent
// section (an inner message) is filled with its defaults, unless it is declared `optional`, holds
// itself, or has required keys, itself or further in: then it stays absent.  Lists become repeated
// fields, inner maps messages.
// `source` learns where everything stands and all that is wrong.  A wrong value stays at its
// default; a wrong entry in a list of plain values is left out.  Cost is bounded by the limits in
// yaml_tree.hpp.
// Error: ConfigError as parse_yaml(): then nothing else was checked and `out` is as before;
// std::logic_error for a schema with bytes or maps.
// Thread: any.
void read_yaml(const std::string& text, YamlSource& source, google::protobuf::Message& out);

// The same of a tree.
void read_yaml(const YamlNode& root, YamlSource& source, google::protobuf::Message& out);

// The same where nothing remains to be checked.  Returns where everything stands.
// Error: ConfigError with all that is wrong; then `out` is as before.
YamlSource load_yaml(const std::string& text, const std::string& file_name,
                     google::protobuf::Message& out);

// The text of a file.  Error: ConfigError naming the file and why it cannot be read, or is too
// long.
std::string read_yaml_file(const std::string& path);

// load_yaml() of a file, which messages name by `path`.
// Error: also ConfigError if the file cannot be read.
YamlSource load_yaml_file(const std::string& path, google::protobuf::Message& out);

}  // namespace skerry::server
