#include "server/config/field_value.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <utility>

namespace skerry::server {
namespace {

using google::protobuf::FieldDescriptor;
using google::protobuf::Message;

[[noreturn]] void refuse_type(const FieldDescriptor& field) {
  throw std::logic_error(
      fmt::format("{}: a {} cannot be read from YAML", field.full_name(), field.type_name()));
}

// The value at hand and where it stands.
struct Given {
  const YamlNode& node;
  const FieldDescriptor& field;
  const std::string& path;
  const YamlSource& source;

  std::string shown() const { return printable(node.text); }
  [[noreturn]] void refuse(const std::string& text) const { throw source.error(path, text); }
  [[noreturn]] void refuse_kind() const {
    refuse(fmt::format("expected {}, given {}{}", expected_by(field), given_by(node), allowance()));
  }
  [[noreturn]] void refuse_range() const {
    refuse(fmt::format("{} is {}{}", shown(),
                       rule_of(field).one_of_size() > 0 ? "not one of these" : "out of range",
                       allowance()));
  }

  // "; allowed: ..." by the rule, or else by the type; empty for a number without bounds.
  std::string allowance() const {
    std::string allowed = allowed_by(rule_of(field));
    if (allowed.empty() && field.cpp_type() == FieldDescriptor::CPPTYPE_UINT32) {
      allowed = fmt::format("0 to {}", std::numeric_limits<std::uint32_t>::max());
    } else if (allowed.empty() && field.cpp_type() == FieldDescriptor::CPPTYPE_UINT64) {
      allowed = fmt::format("0 to {}", std::numeric_limits<std::uint64_t>::max());
    }
    return allowed.empty() ? "" : "; allowed: " + allowed;
  }
};

bool permits(const config::FieldRule& rule, double value) {
  if (rule.one_of_size() > 0) {
    return std::find(rule.one_of().begin(), rule.one_of().end(), value) != rule.one_of().end();
  }
  return (!rule.has_min() || value >= rule.min()) && (!rule.has_max() || value <= rule.max());
}

// Decimal digits with an optional sign, point and exponent, as in YAML's core schema.
bool looks_like_number(std::string_view text) {
  if (!text.empty() && (text[0] == '-' || text[0] == '+')) text.remove_prefix(1);
  if (!text.empty() && text[0] == '.') text.remove_prefix(1);
  return !text.empty() && text[0] >= '0' && text[0] <= '9';
}

bool names_no_finite_number(std::string_view text) {
  if (!text.empty() && (text[0] == '-' || text[0] == '+')) text.remove_prefix(1);
  if (!text.empty() && text[0] == '.') text.remove_prefix(1);
  std::string lower(text.substr(0, 9));
  for (char& c : lower) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return lower == "nan" || lower == "inf" || lower == "infinity";
}

double number_of(const Given& given) {
  std::string_view text = given.node.text;
  if (given.node.kind != YamlNode::Kind::plain) given.refuse_kind();
  if (names_no_finite_number(text)) {
    given.refuse(fmt::format("{} is not a finite number{}", given.shown(), given.allowance()));
  }
  if (!looks_like_number(text)) given.refuse_kind();
  if (text[0] == '+') text.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (end != text.data() + text.size()) given.refuse_kind();
  if (error == std::errc::result_out_of_range) {
    given.refuse(fmt::format("{} is too large or too small for a double{}", given.shown(),
                             given.allowance()));
  }
  return value;
}

std::uint64_t whole_number_of(const Given& given, std::uint64_t largest) {
  const double approximate = number_of(given);
  std::string_view text = given.node.text;
  if (text[0] == '+') text.remove_prefix(1);
  const std::size_t digits = text[0] == '-' ? 1 : 0;
  if (text.find_first_not_of("0123456789", digits) != std::string_view::npos) {
    given.refuse(fmt::format("{} is not a whole number{}", given.shown(), given.allowance()));
  }
  if (approximate < 0.0) given.refuse_range();
  text.remove_prefix(digits);  // "-0"
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || value > largest) given.refuse_range();
  return value;
}

bool truth_of(const Given& given) {
  const std::string& text = given.node.text;
  if (given.node.kind == YamlNode::Kind::plain && text == "true") return true;
  if (given.node.kind == YamlNode::Kind::plain && text == "false") return false;
  given.refuse_kind();
}

const std::string& text_of(const Given& given) {
  if (given.node.kind != YamlNode::Kind::plain && given.node.kind != YamlNode::Kind::quoted) {
    given.refuse_kind();
  }
  const std::string& text = given.node.text;
  if (text.size() > kMaxTextValueBytes) {
    given.refuse(
        fmt::format("{} bytes of text; allowed: at most {}", text.size(), kMaxTextValueBytes));
  }
  if (text.empty() && rule_of(given.field).required()) {
    given.refuse("is empty; allowed: at least one character");
  }
  // parse_yaml() let only UTF-8 through, but quoted text can spell control characters.
  if (printable(text, kMaxTextValueBytes) != text) {
    given.refuse(
        fmt::format("\"{}\" holds a control character; allowed: one line of text", given.shown()));
  }
  return text;
}

}  // namespace

const config::FieldRule& rule_of(const FieldDescriptor& field) {
  return field.options().GetExtension(config::rule);
}

std::string allowed_by(const config::FieldRule& rule) {
  std::string allowed;
  if (rule.one_of_size() > 0) {
    allowed = fmt::format("{}", fmt::join(rule.one_of().begin(), rule.one_of().end(), ", "));
  } else if (rule.has_min() && rule.has_max()) {
    allowed = fmt::format("{} to {}", rule.min(), rule.max());
  } else if (rule.has_min()) {
    allowed = fmt::format("at least {}", rule.min());
  } else if (rule.has_max()) {
    allowed = fmt::format("at most {}", rule.max());
  }
  if (!allowed.empty() && !rule.unit().empty()) allowed += " " + rule.unit();
  return allowed;
}

std::string expected_by(const FieldDescriptor& field) {
  switch (field.cpp_type()) {
    case FieldDescriptor::CPPTYPE_DOUBLE:
      return "a number";
    case FieldDescriptor::CPPTYPE_UINT32:
    case FieldDescriptor::CPPTYPE_UINT64:
      return "a whole number";
    case FieldDescriptor::CPPTYPE_BOOL:
      return "true or false";
    case FieldDescriptor::CPPTYPE_STRING:
      return "text";
    case FieldDescriptor::CPPTYPE_MESSAGE:
      return "keys and values";
    default:
      refuse_type(field);
  }
}

std::string given_by(const YamlNode& node) {
  switch (node.kind) {
    case YamlNode::Kind::null:
      return "nothing";
    case YamlNode::Kind::plain:
      return printable(node.text);
    case YamlNode::Kind::quoted:
      return fmt::format("the text \"{}\"", printable(node.text));
    case YamlNode::Kind::list:
      return "a list";
    case YamlNode::Kind::map:
      return "keys and values";
  }
  return "nothing";
}

void set_value(const YamlNode& node, const FieldDescriptor& field, const std::string& path,
               const YamlSource& source, Message& out) {
  const Given given{node, field, path, source};
  const google::protobuf::Reflection& reflection = *out.GetReflection();
  // A single field is set, a repeated one grows.
  const auto put = [&](auto set, auto add, auto value) {
    (reflection.*(field.is_repeated() ? add : set))(&out, &field, std::move(value));
  };
  using R = google::protobuf::Reflection;
  switch (field.cpp_type()) {
    case FieldDescriptor::CPPTYPE_DOUBLE: {
      const double value = number_of(given);
      if (!permits(rule_of(field), value)) given.refuse_range();
      return put(&R::SetDouble, &R::AddDouble, value);
    }
    case FieldDescriptor::CPPTYPE_UINT32: {
      const auto value = whole_number_of(given, std::numeric_limits<std::uint32_t>::max());
      if (!permits(rule_of(field), static_cast<double>(value))) given.refuse_range();
      return put(&R::SetUInt32, &R::AddUInt32, static_cast<std::uint32_t>(value));
    }
    case FieldDescriptor::CPPTYPE_UINT64: {
      const auto value = whole_number_of(given, std::numeric_limits<std::uint64_t>::max());
      if (!permits(rule_of(field), static_cast<double>(value))) given.refuse_range();
      return put(&R::SetUInt64, &R::AddUInt64, value);
    }
    case FieldDescriptor::CPPTYPE_BOOL:
      return put(&R::SetBool, &R::AddBool, truth_of(given));
    case FieldDescriptor::CPPTYPE_STRING:
      return put(&R::SetString, &R::AddString, text_of(given));
    default:
      refuse_type(field);
  }
}

void set_default(const FieldDescriptor& field, Message& out) {
  const config::FieldRule& rule = rule_of(field);
  if (!rule.has_default_()) return;
  const google::protobuf::Reflection& reflection = *out.GetReflection();
  const double value = rule.default_();
  switch (field.cpp_type()) {
    case FieldDescriptor::CPPTYPE_DOUBLE:
      return reflection.SetDouble(&out, &field, value);
    case FieldDescriptor::CPPTYPE_UINT32:
      return reflection.SetUInt32(&out, &field, static_cast<std::uint32_t>(value));
    case FieldDescriptor::CPPTYPE_UINT64:
      return reflection.SetUInt64(&out, &field, static_cast<std::uint64_t>(value));
    case FieldDescriptor::CPPTYPE_BOOL:
      return reflection.SetBool(&out, &field, value != 0.0);
    default:
      refuse_type(field);
  }
}

}  // namespace skerry::server
