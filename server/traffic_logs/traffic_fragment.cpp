#include "server/traffic_logs/traffic_fragment.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "protocol/wire/printable_text.hpp"
#include "server/traffic_logs/ship_kind.hpp"

namespace skerry::server {
namespace {

constexpr std::size_t kLongestName = 64;

std::string quoted(std::string_view text) {
  std::string out = "\"";
  for (const char c : printable(text, kLongestName)) {
    if (c == '"' || c == '\\') out += '\\';
    out += c;
  }
  return out + '"';
}

// Without zeros at the end.
std::string decimal(double value, int decimals) {
  std::string text = fmt::format("{:.{}f}", value, decimals);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text;
}

double minutes_at(const LogFix& fix, std::int64_t begin_ms) {
  return static_cast<double>(fix.utc_ms - begin_ms) / 60'000.0;
}

std::string place_text(const LogFix& fix) {
  return fmt::format("lat: {}, lon: {}", decimal(fix.latitude_e7 * 1e-7, 7),
                     decimal(fix.longitude_e7 * 1e-7, 7));
}

std::string size_text(const HeardIdentity& ship) {
  std::string text;
  const bool length = ship.length_m >= 1.0 && ship.length_m <= 500.0;
  const bool beam = ship.beam_m >= 0.3 && ship.beam_m <= 80.0;
  // One without the other might contradict the class's.
  if (!length || !beam || ship.beam_m > ship.length_m) return text;
  return fmt::format(", length_m: {}, beam_m: {}", decimal(ship.length_m, 1),
                     decimal(ship.beam_m, 1));
}

std::string target_text(const HeardIdentity& ship, const LoggedPiece& piece,
                        std::int64_t begin_ms) {
  const std::string name = ship.name.empty() ? fmt::format("MMSI {}", ship.mmsi) : ship.name;
  std::string text = fmt::format("  - {{name: {}, mmsi: {}, ship_class: {}{}", quoted(name),
                                 ship.mmsi, traffic_class_of(ship), size_text(ship));
  if (const auto type = ship_type_of(ship.ship_type); type != scenario::type_not_given) {
    text += fmt::format(", ship_type: {}", scenario::ShipType_Name(type));
  }
  if (ship.class_b.value_or(false)) text += ", ais_class: class_b";
  const double start_min = minutes_at(piece.fixes.front(), begin_ms);
  text += ",\n     as_logged: true";
  if (start_min > 0.0) text += fmt::format(", start_min: {}", decimal(start_min, 5));
  if (piece.heading_deg) {
    // 360: a course of 0 is one that is not given.
    const double heading = *piece.heading_deg < 0.05 ? 360.0 : *piece.heading_deg;
    text += fmt::format(", course_deg: {}", decimal(heading, 1));
  }
  text += fmt::format(", position: {{{}}}, waypoints: [", place_text(piece.fixes.front()));
  for (std::size_t i = 1; i < piece.fixes.size(); ++i) {
    text +=
        fmt::format("{}\n       {{{}, arrive_min: {}}}", i > 1 ? "," : "",
                    place_text(piece.fixes[i]), decimal(minutes_at(piece.fixes[i], begin_ms), 5));
  }
  return text + "]}\n";
}

}  // namespace

std::string utc_text(UtcTime utc) {
  const auto seconds = std::chrono::floor<std::chrono::seconds>(utc.time_since_epoch()).count();
  return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(static_cast<std::time_t>(seconds)));
}

TrafficFragment traffic_fragment(std::vector<LoggedShip> ships, std::optional<UtcTime> begin,
                                 const FragmentRules& rules, const std::string& origin) {
  TrafficFragment fragment;
  // Those that are heard most come first, as long as there is room.
  std::stable_sort(ships.begin(), ships.end(),
                   [](const LoggedShip& a, const LoggedShip& b) { return a.heard > b.heard; });
  std::int64_t begin_ms = 0;
  if (begin) {
    begin_ms =
        std::chrono::duration_cast<std::chrono::milliseconds>(begin->time_since_epoch()).count();
  } else if (!ships.empty()) {
    begin_ms = ships.front().pieces.front().fixes.front().utc_ms;
    for (const LoggedShip& ship : ships) {
      begin_ms = std::min(begin_ms, ship.pieces.front().fixes.front().utc_ms);
    }
    begin_ms -= begin_ms % 1000;
  }
  fragment.begin = UtcTime(std::chrono::milliseconds(begin_ms));
  std::vector<std::pair<std::int64_t, std::string>> texts;  // by when they appear
  std::size_t bytes = 0;
  for (const LoggedShip& ship : ships) {
    std::string text;
    std::size_t waypoints = 0;
    double worst_m = 0.0, end_min = 0.0;
    for (const LoggedPiece& piece : ship.pieces) {
      text += target_text(ship.identity, piece, begin_ms);
      waypoints += piece.fixes.size() - 1;
      worst_m = std::max(worst_m, piece.worst_m);
      end_min = minutes_at(piece.fixes.back(), begin_ms);
    }
    if (fragment.targets + ship.pieces.size() > rules.most_targets ||
        bytes + text.size() > rules.most_bytes ||
        fragment.waypoints + waypoints > rules.most_waypoints) {
      ++fragment.ships_beyond;
      continue;
    }
    bytes += text.size();
    ++fragment.ships;
    fragment.targets += ship.pieces.size();
    fragment.waypoints += waypoints;
    fragment.fixes += ship.heard;
    fragment.worst_m = std::max(fragment.worst_m, worst_m);
    fragment.length_min = std::max(fragment.length_min, end_min);
    texts.emplace_back(ship.pieces.front().fixes.front().utc_ms, std::move(text));
  }
  std::stable_sort(texts.begin(), texts.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  fragment.yaml = fmt::format(
      "# {}\n# Minute 0 of the exercise is {}; it lasts {:.0f} min.\n"
      "# Use it in a scenario: include: [this file]\ntargets:{}\n",
      printable(origin), utc_text(fragment.begin), std::ceil(fragment.length_min),
      texts.empty() ? " []" : "");
  for (const auto& [when, text] : texts) fragment.yaml += text;
  return fragment;
}

}  // namespace skerry::server
