#include "server/recorder/file_names.hpp"

#include <fmt/format.h>

#include <ctime>

#include "protocol/wire/utf8.hpp"

namespace skerry::server {
namespace {

bool is_letter_or_digit(char32_t c) {
  if (c < 0x80) return (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z');
  // Beyond ASCII all but what is punctuation, invisible, turns the direction, or is no character.
  if (c < 0xc0 || c == 0xd7 || c == 0xf7) return false;
  if (c >= 0x2000 && c < 0x2100) return false;
  if (c >= 0x3000 && c < 0x3005) return false;
  if (c == 0x061c || c == 0x180e || (c >= 0xe000 && c < 0xf900)) return false;
  if ((c >= 0xfe00 && c < 0xfe70) || c == 0xfeff || (c >= 0xfff0 && c < 0x10000)) return false;
  return c < 0xe0000;
}

std::optional<std::string> fault_in_length(std::string_view name) {
  if (name.size() <= kMaxName) return std::nullopt;
  return fmt::format("the name has {} bytes; at most {} are taken", name.size(), kMaxName);
}

}  // namespace

std::optional<std::string> fault_in_file_name(std::string_view name) {
  constexpr const char* kExpected =
      "expected letters and digits, and within them space, '.', '_' and '-'";
  if (auto fault = fault_in_length(name)) return fault;
  bool first = true, last_is_letter = false;
  while (!name.empty()) {
    const auto c = take_code_point(name);
    if (!c) return std::string("the name is not UTF-8; ") + kExpected;
    last_is_letter = is_letter_or_digit(*c);
    const bool within = *c == ' ' || *c == '.' || *c == '_' || *c == '-';
    if (!last_is_letter && (first || !within)) {
      return fmt::format("the name has U+{:04X} {}; {}", static_cast<std::uint32_t>(*c),
                         first ? "at its begin" : "in it", kExpected);
    }
    first = false;
  }
  if (!first && !last_is_letter) {
    return std::string("the name does not end with a letter or digit; ") + kExpected;
  }
  return std::nullopt;
}

std::optional<std::string> fault_in_mark_name(std::string_view name) {
  if (auto fault = fault_in_length(name)) return fault;
  while (!name.empty()) {
    const auto c = take_code_point(name);
    if (!c) return "the name is not UTF-8";
    if (is_control_character(*c)) return "the name has a control character";
  }
  return std::nullopt;
}

std::string name_of_time(UtcTime time) {
  const std::time_t seconds =
      std::chrono::floor<std::chrono::seconds>(time).time_since_epoch().count();
  std::tm utc{};
  ::gmtime_r(&seconds, &utc);
  return fmt::format("{:04}-{:02}-{:02} {:02}{:02}{:02}Z", utc.tm_year + 1900, utc.tm_mon + 1,
                     utc.tm_mday, utc.tm_hour, utc.tm_min, utc.tm_sec);
}

std::string file_name(const std::string& name, std::uint32_t number) {
  if (number <= 1) return name + std::string(kFileEnding);
  return fmt::format("{}-{:03}{}", name, number, kFileEnding);
}

}  // namespace skerry::server
