#include "server/config/yaml_message.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <vector>

#include "server/config/field_value.hpp"
#include "server/config/nearest_key.hpp"
#include "server/config/yaml_tree.hpp"

namespace skerry::server {
namespace {

using google::protobuf::Descriptor;
using google::protobuf::FieldDescriptor;
using google::protobuf::Message;

std::string joined(const std::string& path, const std::string& key) {
  return path.empty() ? key : path + "." + key;
}

bool is_section(const FieldDescriptor& field) {
  return field.cpp_type() == FieldDescriptor::CPPTYPE_MESSAGE && !field.is_repeated() &&
         !field.has_optional_keyword();
}

// Whether defaults can make all of an absent section.  `within` are the messages around it.
bool can_be_filled(const Descriptor& section, std::vector<const Descriptor*>& within) {
  if (std::find(within.begin(), within.end(), &section) != within.end()) return false;
  within.push_back(&section);
  bool can = true;
  for (int i = 0; can && i < section.field_count(); ++i) {
    const FieldDescriptor& field = *section.field(i);
    can = !rule_of(field).required() &&
          (!is_section(field) || can_be_filled(*field.message_type(), within));
  }
  within.pop_back();
  return can;
}

void fill_absent(const FieldDescriptor& field, Message& out) {
  set_default(field, out);
  if (!is_section(field)) return;
  std::vector<const Descriptor*> within{out.GetDescriptor()};
  if (!can_be_filled(*field.message_type(), within)) return;
  Message& section = *out.GetReflection()->MutableMessage(&out, &field);
  for (int i = 0; i < section.GetDescriptor()->field_count(); ++i) {
    fill_absent(*section.GetDescriptor()->field(i), section);
  }
}

// What a map that is read into `schema` may have as keys: its fields, and those of a field that
// stands in place, but for the ones that the schema has by that name itself or that are no keys.
std::vector<const FieldDescriptor*> keys_of(const Descriptor& schema) {
  std::vector<const FieldDescriptor*> keys;
  for (const FieldDescriptor* field : wire::fields_of(schema)) {
    if (!rule_of(*field).in_place()) {
      keys.push_back(field);
      continue;
    }
    for (const FieldDescriptor* inner : wire::fields_of(*field->message_type())) {
      const bool own = schema.FindFieldByName(inner->name()) != nullptr;
      if (!own && !wire::control_of(*inner).no_key()) keys.push_back(inner);
    }
  }
  return keys;
}

// The message that has the field of a key: `out`, or the one in place within it.
Message& holder_of(const FieldDescriptor& key, Message& out) {
  if (key.containing_type() == out.GetDescriptor()) return out;
  for (const FieldDescriptor* field : wire::fields_of(*out.GetDescriptor())) {
    if (rule_of(*field).in_place() && field->message_type() == key.containing_type()) {
      return *out.GetReflection()->MutableMessage(&out, field);
    }
  }
  return out;
}

// Reads all that can be read; what cannot is an error in the source.
class MessageReader {
 public:
  explicit MessageReader(YamlSource& source) : source_(source) {}

  void read(const YamlNode& node, const std::string& path, Message& out) {
    source_.add(path, node.place);
    if (node.kind != YamlNode::Kind::map) {
      source_.refuse(path, "expected keys and values, given " + given_by(node));
      return;
    }
    const std::vector<const FieldDescriptor*> known = keys_of(*out.GetDescriptor());
    std::map<const FieldDescriptor*, TextPlace> seen;
    for (std::size_t i = 0; i < node.keys.size(); ++i) {
      const YamlNode& key = node.keys[i];
      const FieldDescriptor* const field = field_of(key, path, known);
      if (field == nullptr) continue;
      const std::string field_path = joined(path, field->name());
      const auto [earlier, first] = seen.emplace(field, key.place);
      if (first) {
        read_field(node.items[i], *field, field_path, holder_of(*field, out));
      } else {
        source_.refuse(field_path,
                       fmt::format("given twice; first in line {}", earlier->second.line),
                       key.place);
      }
    }
    for (const FieldDescriptor* field : known) {
      if (seen.count(field) != 0) continue;
      if (rule_of(*field).required()) refuse_missing(node, *field, path);
      fill_absent(*field, holder_of(*field, out));
    }
  }

 private:
  void refuse_missing(const YamlNode& node, const FieldDescriptor& field, const std::string& path) {
    const std::string allowed = allowed_by(rule_of(field));
    source_.refuse(
        joined(path, field.name()),
        fmt::format("missing; expected {}{}{}", field.is_repeated() ? "a list" : expected_by(field),
                    allowed.empty() ? "" : ", ", allowed),
        node.place);
  }

  // nullptr: there is no such field.
  const FieldDescriptor* field_of(const YamlNode& key, const std::string& path,
                                  const std::vector<const FieldDescriptor*>& known) {
    if (key.kind != YamlNode::Kind::plain && key.kind != YamlNode::Kind::quoted) {
      source_.refuse(path, fmt::format("expected a key, given {}", given_by(key)), key.place);
      return nullptr;
    }
    std::vector<std::string> names;
    for (const FieldDescriptor* field : known) {
      if (field->name() == key.text) return field;
      names.push_back(field->name());
    }
    const std::string nearest = nearest_key(key.text, names);
    source_.refuse(
        joined(path, printable(key.text)),
        fmt::format("unknown key{}; known keys: {}",
                    nearest.empty() ? "" : fmt::format("; did you mean \"{}\"?", nearest),
                    fmt::join(names, ", ")),
        key.place);
    return nullptr;
  }

  void read_field(const YamlNode& node, const FieldDescriptor& field, const std::string& path,
                  Message& out) {
    require_readable(field);
    source_.add(path, node.place);
    if (!field.is_repeated()) {
      read_value(node, field, path, out);
      return;
    }
    if (node.kind != YamlNode::Kind::list) {
      source_.refuse(path, "expected a list, given " + given_by(node));
      return;
    }
    if (node.items.empty() && rule_of(field).required()) {
      source_.refuse(path, "is empty; expected at least one entry");
    }
    for (std::size_t i = 0; i < node.items.size(); ++i) {
      const std::string entry = fmt::format("{}[{}]", path, i);
      source_.add(entry, node.items[i].place);
      read_value(node.items[i], field, entry, out);
    }
  }

  void read_value(const YamlNode& node, const FieldDescriptor& field, const std::string& path,
                  Message& out) {
    if (field.cpp_type() != FieldDescriptor::CPPTYPE_MESSAGE) {
      read_plain(node, field, path, out);
    } else if (field.is_repeated()) {
      read(node, path, *out.GetReflection()->AddMessage(&out, &field));
    } else {
      read(node, path, *out.GetReflection()->MutableMessage(&out, &field));
    }
  }

  void read_plain(const YamlNode& node, const FieldDescriptor& field, const std::string& path,
                  Message& out) {
    try {
      set_value(node, field, out);
    } catch (const ValueError& wrong) {
      source_.refuse(path, wrong.what());
      if (!field.is_repeated()) set_default(field, out);
    }
  }

  YamlSource& source_;
};

}  // namespace

void read_yaml(const std::string& text, YamlSource& source, Message& out) {
  read_yaml(parse_yaml(text, source), source, out);
}

void read_yaml(const YamlNode& root, YamlSource& source, Message& out) {
  out.Clear();
  MessageReader(source).read(root, "", out);
}

YamlSource load_yaml(const std::string& text, const std::string& file_name, Message& out) {
  YamlSource source(file_name);
  const std::unique_ptr<Message> fresh(out.New());
  read_yaml(text, source, *fresh);
  source.require_sound();
  out.GetReflection()->Swap(&out, fresh.get());
  return source;
}

std::string read_yaml_file(const std::string& path) {
  const auto refuse = [&](const std::string& why) {
    throw ConfigError(fmt::format("{}: cannot be read: {}", printable(path, 4096), why));
  };
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) refuse("it is a directory");
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  if (!file) refuse(std::strerror(errno));
  std::string text(kMaxYamlBytes + 1, '\0');
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (file.bad()) refuse("input error");
  text.resize(static_cast<std::size_t>(file.gcount()));
  if (text.size() > kMaxYamlBytes) {
    refuse(fmt::format("it is too long; allowed: at most {} bytes", kMaxYamlBytes));
  }
  return text;
}

YamlSource load_yaml_file(const std::string& path, Message& out) {
  return load_yaml(read_yaml_file(path), path, out);
}

}  // namespace skerry::server
