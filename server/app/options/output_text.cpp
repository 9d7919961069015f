#include "server/app/options/output_text.hpp"

#include <fmt/format.h>
#include <google/protobuf/descriptor.h>

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <stdexcept>
#include <utility>
#include <vector>

#include "server/config/yaml_message.hpp"

namespace skerry::server {
namespace {

// A value as YAML: text in quotes, anything else as it stands.
std::string as_yaml(const std::string& value, bool text) {
  if (!text) return value;
  std::string quoted = "\"";
  for (const char c : value) {
    if (c == '"' || c == '\\') quoted += '\\';
    quoted += c;
  }
  return quoted + "\"";
}

// The text as the YAML of a message of that schema.
void parse_entry(const std::string& text, const char* option, google::protobuf::Message& out) {
  const auto colon = text.find(':');
  const std::string name = std::string(option) + " " + text;
  std::vector<std::pair<std::string, std::vector<std::string>>> keys = {
      {"kind", {text.substr(0, colon)}}};
  std::string rest = colon == std::string::npos ? "" : text.substr(colon + 1);
  while (!rest.empty()) {
    const auto comma = std::min(rest.find(','), rest.size());
    const std::string part = rest.substr(0, comma);
    rest.erase(0, comma + 1);
    const auto equals = part.find('=');
    if (equals == std::string::npos || equals == 0) {
      throw std::runtime_error(
          fmt::format("{}: '{}' is not key=value; expected KIND:key=value,key=value", name, part));
    }
    const std::string key = part.substr(0, equals);
    auto known =
        std::find_if(keys.begin(), keys.end(), [&](const auto& k) { return k.first == key; });
    if (known == keys.end()) known = keys.insert(keys.end(), {key, {}});
    known->second.push_back(part.substr(equals + 1));
  }
  std::string yaml;
  for (const auto& [key, values] : keys) {
    const auto* field = out.GetDescriptor()->FindFieldByName(key);
    const bool is_text =
        field != nullptr && field->type() == google::protobuf::FieldDescriptor::TYPE_STRING;
    const bool is_list = field != nullptr && field->is_repeated();
    if (!is_list && values.size() > 1) {
      throw std::runtime_error(fmt::format("{}: '{}' is given twice", name, key));
    }
    yaml += fmt::format("{}: ", as_yaml(key, true));
    if (is_list) yaml += "[";
    for (std::size_t i = 0; i < values.size(); ++i) {
      yaml += (i == 0 ? "" : ", ") + as_yaml(values[i], is_text);
    }
    yaml += is_list ? "]\n" : "\n";
  }
  load_yaml(yaml, name, out);
}

}  // namespace

app::Output parse_output(const std::string& text) {
  app::Output output;
  parse_entry(text, "--output", output);
  return output;
}

app::Input parse_input(const std::string& text) {
  app::Input input;
  parse_entry(text, "--input", input);
  return input;
}

app::Destination parse_destination(const std::string& text) {
  const auto fail = [&](const std::string& why) -> std::runtime_error {
    return std::runtime_error("destination '" + text + "': " + why +
                              "; expected [RADAR@]ADDRESS:PORT, e.g. 127.0.0.1:7411, "
                              "1@239.192.7.1:7411 or [::1]:7411");
  };
  app::Destination out;
  std::string rest = text;
  const auto number = [&](const std::string& digits, std::uint32_t most, const char* what) {
    std::uint32_t value = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (error != std::errc{} || end != digits.data() + digits.size() || value > most) {
      throw fail(std::string(what) + " '" + digits + "' is not a number up to " +
                 std::to_string(most));
    }
    return value;
  };
  if (const auto at = rest.find('@'); at != std::string::npos) {
    out.set_radar(number(rest.substr(0, at), 4095, "radar"));
    rest = rest.substr(at + 1);
  }
  const auto colon = rest.rfind(':');
  if (colon == std::string::npos) throw fail("no port");
  out.set_port(number(rest.substr(colon + 1), 65535, "port"));
  if (out.port() == 0) throw fail("port 0 cannot be sent to");
  std::string address = rest.substr(0, colon);
  if (address.size() > 2 && address.front() == '[' && address.back() == ']') {
    address = address.substr(1, address.size() - 2);
  }
  if (address.empty()) throw fail("no address");
  out.set_address(address);
  return out;
}

}  // namespace skerry::server
