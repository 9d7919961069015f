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

#include "protocol/wire/utf8.hpp"

namespace skerry::server {
namespace {

using google::protobuf::FieldDescriptor;
using google::protobuf::Message;

[[noreturn]] void refuse_type(const FieldDescriptor& field) {
  throw std::logic_error(
      fmt::format("{}: a {} cannot be read from YAML", field.full_name(), field.type_name()));
}

// The value at hand and what it is for.
struct Given {
  const YamlNode& node;
  const FieldDescriptor& field;

  std::string shown() const { return printable(node.text); }
  [[noreturn]] void refuse(const std::string& text) const { throw ValueError(text); }
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
    if (allowed.empty()) allowed = range_of_type();
    return allowed.empty() ? "" : "; allowed: " + allowed;
  }

 private:
  template <typename Whole>
  static std::string range_of() {
    return fmt::format("{} to {}", std::numeric_limits<Whole>::min(),
                       std::numeric_limits<Whole>::max());
  }
  std::string range_of_type() const {
    switch (field.cpp_type()) {
      case FieldDescriptor::CPPTYPE_INT32:
        return range_of<std::int32_t>();
      case FieldDescriptor::CPPTYPE_INT64:
        return range_of<std::int64_t>();
      case FieldDescriptor::CPPTYPE_UINT32:
        return range_of<std::uint32_t>();
      case FieldDescriptor::CPPTYPE_UINT64:
        return range_of<std::uint64_t>();
      default:
        return {};
    }
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

// Decimal, or hexadecimal after 0x, which is how seeds are often written.
template <typename Whole>
Whole whole_number_of(const Given& given) {
  std::string_view text = given.node.text;
  int base = 10;
  if (given.node.kind == YamlNode::Kind::plain && text.substr(0, 2) == "0x") {
    base = 16;
    text.remove_prefix(2);
    if (text.find_first_not_of("0123456789abcdefABCDEF") != std::string_view::npos ||
        text.empty()) {
      given.refuse_kind();
    }
  } else {
    number_of(given);
    if (text[0] == '+') text.remove_prefix(1);
    if (text.find_first_not_of("0123456789", text[0] == '-' ? 1 : 0) != std::string_view::npos) {
      given.refuse(fmt::format("{} is not a whole number{}", given.shown(), given.allowance()));
    }
    if (text == "-0") text = "0";
  }
  Whole value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value, base);
  // A negative number for an unsigned field is invalid_argument here.
  if (error != std::errc()) given.refuse_range();
  if (!permits(rule_of(given.field), static_cast<double>(value))) given.refuse_range();
  return value;
}

double bounded_number_of(const Given& given) {
  const double value = number_of(given);
  if (!permits(rule_of(given.field), value)) given.refuse_range();
  return value;
}

float float_of(const Given& given) {
  const double value = bounded_number_of(given);
  if (std::fabs(value) > std::numeric_limits<float>::max()) given.refuse_range();
  return static_cast<float>(value);
}

int enum_number_of(const Given& given) {
  const auto* const value = wire::value_named(given.field, given.node.text);
  if (given.node.kind != YamlNode::Kind::plain || value == nullptr) given.refuse_kind();
  return value->number();
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
  const std::size_t characters = character_count(text);
  if (!permits(rule_of(given.field), static_cast<double>(characters))) {
    given.refuse(
        fmt::format("\"{}\" has {} characters{}", given.shown(), characters, given.allowance()));
  }
  // parse_yaml() let only UTF-8 through, but quoted text can spell control characters.
  if (printable(text, kMaxTextValueBytes) != text) {
    given.refuse(
        fmt::format("\"{}\" holds a control character; allowed: one line of text", given.shown()));
  }
  return text;
}

}  // namespace

void require_readable(const FieldDescriptor& field) {
  if (field.is_map() || field.type() == FieldDescriptor::TYPE_BYTES ||
      field.type() == FieldDescriptor::TYPE_GROUP) {
    refuse_type(field);
  }
}

std::string expected_by(const FieldDescriptor& field) {
  switch (field.cpp_type()) {
    case FieldDescriptor::CPPTYPE_DOUBLE:
    case FieldDescriptor::CPPTYPE_FLOAT:
      return "a number";
    case FieldDescriptor::CPPTYPE_INT32:
    case FieldDescriptor::CPPTYPE_INT64:
    case FieldDescriptor::CPPTYPE_UINT32:
    case FieldDescriptor::CPPTYPE_UINT64:
      return "a whole number";
    case FieldDescriptor::CPPTYPE_BOOL:
      return "true or false";
    case FieldDescriptor::CPPTYPE_ENUM: {
      std::string names;
      for (int i = 0; i < field.enum_type()->value_count(); ++i) {
        names += (i == 0 ? "one of " : ", ") + wire::word_of(*field.enum_type()->value(i));
      }
      return names;
    }
    case FieldDescriptor::CPPTYPE_STRING:
      return "text";
    case FieldDescriptor::CPPTYPE_MESSAGE:
      return "keys and values";
  }
  refuse_type(field);
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
    case YamlNode::Kind::alias:
      return "an alias (aliases are not supported; write the value out)";
  }
  return "nothing";
}

void set_value(const YamlNode& node, const FieldDescriptor& field, Message& out) {
  const Given given{node, field};
  const google::protobuf::Reflection& reflection = *out.GetReflection();
  // A single field is set, a repeated one grows.
  const auto put = [&](auto set, auto add, auto value) {
    (reflection.*(field.is_repeated() ? add : set))(&out, &field, std::move(value));
  };
  using R = google::protobuf::Reflection;
  switch (field.cpp_type()) {
    case FieldDescriptor::CPPTYPE_DOUBLE:
      return put(&R::SetDouble, &R::AddDouble, bounded_number_of(given));
    case FieldDescriptor::CPPTYPE_FLOAT:
      return put(&R::SetFloat, &R::AddFloat, float_of(given));
    case FieldDescriptor::CPPTYPE_INT32:
      return put(&R::SetInt32, &R::AddInt32, whole_number_of<std::int32_t>(given));
    case FieldDescriptor::CPPTYPE_INT64:
      return put(&R::SetInt64, &R::AddInt64, whole_number_of<std::int64_t>(given));
    case FieldDescriptor::CPPTYPE_UINT32:
      return put(&R::SetUInt32, &R::AddUInt32, whole_number_of<std::uint32_t>(given));
    case FieldDescriptor::CPPTYPE_UINT64:
      return put(&R::SetUInt64, &R::AddUInt64, whole_number_of<std::uint64_t>(given));
    case FieldDescriptor::CPPTYPE_BOOL:
      return put(&R::SetBool, &R::AddBool, truth_of(given));
    case FieldDescriptor::CPPTYPE_ENUM:
      return put(&R::SetEnumValue, &R::AddEnumValue, enum_number_of(given));
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
    case FieldDescriptor::CPPTYPE_FLOAT:
      return reflection.SetFloat(&out, &field, static_cast<float>(value));
    case FieldDescriptor::CPPTYPE_INT32:
      return reflection.SetInt32(&out, &field, static_cast<std::int32_t>(value));
    case FieldDescriptor::CPPTYPE_INT64:
      return reflection.SetInt64(&out, &field, static_cast<std::int64_t>(value));
    case FieldDescriptor::CPPTYPE_ENUM:
      return reflection.SetEnumValue(&out, &field, static_cast<int>(value));
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
