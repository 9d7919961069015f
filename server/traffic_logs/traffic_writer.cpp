#include "server/traffic_logs/traffic_writer.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <utility>

#include "protocol/nmea/ais_sentences.hpp"
#include "protocol/nmea/sentence.hpp"
#include "protocol/quantity/speed.hpp"
#include "server/navigation/ais_reports.hpp"
#include "server/traffic_logs/traffic_fragment.hpp"

namespace skerry::server {
namespace {

// More within a second than a ship that steers does.
constexpr double kTurnsAtOnce_deg = 8.0, kChangesAtOnce_kn = 1.0;

std::string csv_quoted(std::string_view text) {
  if (text.find_first_of(",\"\n\r") == std::string_view::npos) return std::string(text);
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"') out += '"';
    out += c;
  }
  return out + '"';
}

}  // namespace

TrafficWriter::TrafficWriter(TrafficForm form, std::optional<Duration> every, Sink sink)
    : form_(form), every_(every), sink_(std::move(sink)) {
  if (form_ == TrafficForm::csv) {
    sink_("mmsi,time,lat,lon,sog,cog,heading,name,type,class,length,beam\n");
  }
}

bool TrafficWriter::is_due(const Ship& ship, const TrafficItem& now, UtcTime utc) const {
  if (!ship.has_reported) return true;
  if (every_) return utc - ship.reported >= *every_;
  const Duration interval = position_interval(now.kind, now.speed_mps, now.rate_of_turn_deg_min);
  if (interval != ship.interval || utc - ship.reported >= interval) return true;
  if (now.kind == TrafficKind::aid_to_navigation) return false;
  const double turn_deg =
      std::remainder(now.course_over_ground_deg - ship.item.course_over_ground_deg, 360.0);
  return std::fabs(now.speed_mps - ship.item.speed_mps) > kChangesAtOnce_kn * kKnot ||
         (now.speed_mps > kKnot && std::fabs(turn_deg) > kTurnsAtOnce_deg);
}

void TrafficWriter::second(const std::vector<TrafficItem>& items, UtcTime utc) {
  for (const TrafficItem& item : items) {
    if (item.mmsi == 0 || item.kind == TrafficKind::other) continue;
    const auto [found, is_new] = ships_.try_emplace(item.number);
    Ship& ship = found->second;
    if (is_new) ++ships_seen_;
    const bool due = is_due(ship, item, utc);
    ship.interval = position_interval(item.kind, item.speed_mps, item.rate_of_turn_deg_min);
    ship.item = item;
    ship.seen = utc;
    if (due) report(ship);
  }
  // Who is no longer there was last seen a second ago.
  for (auto it = ships_.begin(); it != ships_.end();) {
    if (it->second.seen == utc) {
      ++it;
    } else {
      if (it->second.reported != it->second.seen) report(it->second);
      it = ships_.erase(it);
    }
  }
}

void TrafficWriter::finish() {
  for (auto& [number, ship] : ships_) {
    if (ship.reported != ship.seen) report(ship);
  }
  ships_.clear();
}

void TrafficWriter::report(Ship& ship) {
  const auto position = position_report(ship.item, ship.seen);
  const bool first = !ship.has_reported;
  ship.has_reported = true;
  ship.reported = ship.seen;
  if (!position) return;  // her AIS is silent
  if (form_ == TrafficForm::csv) {
    if (ship.item.kind == TrafficKind::aid_to_navigation) return;
    ++reports_;
    return row(ship.item, ship.seen);
  }
  ++reports_;
  say(*position, ship.seen);
  if (!first && ship.seen - ship.named < kStaticInterval) return;
  ship.named = ship.seen;
  for (const nmea::AisMessage& message : static_reports(ship.item)) say(message, ship.seen);
}

void TrafficWriter::say(const nmea::AisMessage& message, UtcTime utc) {
  const auto lines = nmea::encode_ais(message, false, identifier_, channel_b_ ? 'B' : 'A');
  const auto seconds = std::chrono::floor<std::chrono::seconds>(utc.time_since_epoch()).count();
  for (std::size_t i = 0; i < lines.size(); ++i) {
    std::string tags = fmt::format("s:SKERRY,c:{}", seconds);
    if (lines.size() > 1) {
      tags = fmt::format("g:{}-{}-{},", i + 1, lines.size(), identifier_ + 1) + tags;
    }
    sink_(fmt::format("\\{}*{}\\{}", tags, nmea::checksum_text(tags), lines[i]));
  }
  if (lines.size() > 1) identifier_ = (identifier_ + 1) % 10;
  channel_b_ = !channel_b_;
}

void TrafficWriter::row(const TrafficItem& item, UtcTime utc) {
  const AisSaid said = said_by_ais(item);
  const auto optional = [](std::optional<double> value, double scale) {
    return value ? fmt::format("{:.1f}", *value / scale) : std::string();
  };
  const auto place = [&](double GeoPoint::*part) {
    return said.position ? fmt::format("{:.7f}", (*said.position).*part) : std::string();
  };
  sink_(fmt::format("{},{},{},{},{},{},{},{},{},{},{:.1f},{:.1f}\n", item.mmsi, utc_text(utc),
                    place(&GeoPoint::latitude_deg), place(&GeoPoint::longitude_deg),
                    optional(said.speed_mps, kKnot), optional(said.course_over_ground_deg, 1.0),
                    optional(said.heading_deg, 1.0), csv_quoted(item.name), item.ship_type,
                    item.kind == TrafficKind::boat ? 'B' : 'A', item.length_m, item.beam_m));
}

}  // namespace skerry::server
