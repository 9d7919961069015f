#include "server/config/config_error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>

#include "protocol/wire/utf8.hpp"

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

std::string YamlSource::where(const std::string& path) const {
  const TextPlace place = place_of(path);
  const std::string line = fmt::format("line {}", place.line);
  return place.file == 0
             ? line
             : printable(files_.at(static_cast<std::size_t>(place.file)), 4096) + ", " + line;
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
  shown_.insert(after, {place, message_of(files_.at(static_cast<std::size_t>(place.file)), place,
                                          path, text)});
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
  if (errors_ > 1) all += fmt::format("\n{}: {} errors", printable(file_name(), 4096), errors_);
  if (errors_ > shown_.size()) {
    all += fmt::format(": {} shown and {} more", shown_.size(), errors_ - shown_.size());
  }
  return ConfigError(all);
}

std::string printable(std::string_view text, std::size_t longest) {
  std::string out;
  while (!text.empty()) {
    if (out.size() >= longest) return out + "...";
    const std::string_view from = text;
    const auto point = take_code_point(text);
    if (!point || is_control_character(*point)) {
      out += fmt::format("\\x{:02x}", static_cast<std::uint8_t>(from.front()));
      text = from.substr(1);
    } else {
      out += from.substr(0, from.size() - text.size());
    }
  }
  return out;
}

}  // namespace skerry::server
