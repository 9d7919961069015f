#include "server/config/config_error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>

namespace skerry::server {

namespace {

std::string message_of(const std::string& file, TextPlace place, const std::string& path,
                       const std::string& text) {
  return fmt::format("{}:{}:{}: {}{}{}", printable(file, 4096), place.line, place.column, path,
                     path.empty() ? "" : ": ", text);
}

}  // namespace

ConfigError::ConfigError(const std::string& file, TextPlace place, const std::string& path,
                         const std::string& text)
    : std::runtime_error(message_of(file, place, path, text)) {}

TextPlace YamlSource::place_of(std::string path) const {
  for (;;) {
    const auto found = places_.find(path);
    if (found != places_.end()) return found->second;
    if (path.empty()) return {};
    const std::size_t cut = path.find_last_of(".[");
    path.resize(cut == std::string::npos ? 0 : cut);
  }
}

void YamlSource::refuse(const std::string& path, const std::string& text) {
  refuse(path, text, place_of(path));
}

void YamlSource::refuse(const std::string& path, const std::string& text, TextPlace place) {
  refused_.insert(path);
  add_error(path, text, place);
}

void YamlSource::complain(const std::string& text, TextPlace place) { add_error("", text, place); }

void YamlSource::add_error(const std::string& path, const std::string& text, TextPlace place) {
  ++errors_;
  const auto after = std::upper_bound(shown_.begin(), shown_.end(), place,
                                      [](TextPlace p, const Shown& s) { return p < s.place; });
  shown_.insert(after, {place, message_of(file_name_, place, path, text)});
  if (shown_.size() > kMostShown) shown_.pop_back();
}

bool YamlSource::is_sound(const std::string& path) const {
  if (refused_.empty()) return true;
  for (std::string around = path;;) {
    if (refused_.count(around) != 0) return false;
    if (around.empty()) break;
    const std::size_t cut = around.find_last_of(".[");
    around.resize(cut == std::string::npos ? 0 : cut);
  }
  if (path.empty()) return false;
  const auto holds = [&](const std::string& begin) {
    const auto first = refused_.lower_bound(begin);
    return first != refused_.end() && first->compare(0, begin.size(), begin) == 0;
  };
  return !holds(path + ".") && !holds(path + "[");
}

void YamlSource::require_sound() const {
  if (errors_ > 0) throw all_errors();
}

void YamlSource::fail(const std::string& text, TextPlace place) {
  complain(text, place);
  throw all_errors();
}

ConfigError YamlSource::all_errors() const {
  std::string all;
  for (const Shown& each : shown_) all += (all.empty() ? "" : "\n") + each.message;
  if (errors_ > 1) all += fmt::format("\n{}: {} errors", printable(file_name_, 4096), errors_);
  if (errors_ > shown_.size()) {
    all += fmt::format(": {} shown and {} more", shown_.size(), errors_ - shown_.size());
  }
  return ConfigError(all);
}

std::size_t utf8_length(std::string_view text, std::size_t at) {
  const auto byte = [&](std::size_t i) {
    return i < text.size() ? static_cast<std::uint8_t>(text[i]) : std::uint8_t{0};
  };
  const auto continues = [&](std::size_t i) { return (byte(i) & 0xC0) == 0x80; };
  const std::uint8_t first = byte(at);
  const std::uint8_t second = byte(at + 1);
  if (first < 0x80) return 1;
  if (first >= 0xC2 && first <= 0xDF) return continues(at + 1) ? 2 : 0;
  if (first >= 0xE0 && first <= 0xEF) {
    if ((first == 0xE0 && second < 0xA0) || (first == 0xED && second > 0x9F)) return 0;
    return continues(at + 1) && continues(at + 2) ? 3 : 0;
  }
  if (first >= 0xF0 && first <= 0xF4) {
    if ((first == 0xF0 && second < 0x90) || (first == 0xF4 && second > 0x8F)) return 0;
    return continues(at + 1) && continues(at + 2) && continues(at + 3) ? 4 : 0;
  }
  return 0;
}

std::size_t character_count(std::string_view text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}

std::string printable(std::string_view text, std::size_t longest) {
  std::string out;
  for (std::size_t at = 0; at < text.size();) {
    if (out.size() >= longest) return out + "...";
    const std::size_t length = utf8_length(text, at);
    const auto byte = static_cast<std::uint8_t>(text[at]);
    // C1 controls are U+0080 to U+009F: C2 80 to C2 9F.
    const bool control =
        byte < 0x20 || byte == 0x7F ||
        (length == 2 && byte == 0xC2 && static_cast<std::uint8_t>(text[at + 1]) < 0xA0);
    if (length == 0 || control) {
      out += fmt::format("\\x{:02x}", byte);
      ++at;
    } else {
      out += text.substr(at, length);
      at += length;
    }
  }
  return out;
}

}  // namespace skerry::server
