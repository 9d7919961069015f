#include "clients/interchange/ship_tracks.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace skerry::client {
namespace {

using nlohmann::json;

constexpr auto kStep = std::chrono::seconds(5);
constexpr auto kLength = std::chrono::minutes(6);
constexpr std::uint64_t kOwnShip = std::uint64_t{1} << 32;  // no number of the traffic
constexpr double kMetresPerSecondInKnots = 3600.0 / 1852.0;

json position(GeoPoint at) { return json::array({at.longitude_deg, at.latitude_deg}); }

const char* kind_of(recording::Traffic::Item::Kind kind) {
  switch (kind) {
    case recording::Traffic::Item::SHIP:
      return "ship";
    case recording::Traffic::Item::BOAT:
      return "boat";
    case recording::Traffic::Item::AID_TO_NAVIGATION:
      return "aid to navigation";
    default:
      return "other";
  }
}

}  // namespace

void ShipTracks::move(Ship& ship, const Fix& fix) {
  ship.last = fix;
  if (ship.past.empty() || fix.time - ship.past.back().time >= kStep) ship.past.push_back(fix);
}

void ShipTracks::add(const wire::OwnShip& own, UtcTime time) {
  if (own.no_position()) return;
  Ship& ship = ships_[kOwnShip];
  ship.own = true;
  ship.kind = "own ship";
  ship.name = own.name();
  ship.mmsi = own.mmsi();
  ship.heading_deg = own.heading_deg();
  ship.has_heading = !own.no_heading();
  ship.course_deg = own.course_over_ground_deg();
  ship.speed_kn = own.speed_over_ground_kn();
  ship.has_motion = !own.no_motion();
  move(ship, {time, {own.latitude_deg(), own.longitude_deg()}});
}

void ShipTracks::add(const recording::Traffic& traffic, UtcTime time) {
  for (const auto& item : traffic.items()) {
    const auto& radars = item.radars();
    if (std::find(radars.begin(), radars.end(), radar_) != radars.end()) continue;
    if (ships_.size() >= kMost && !ships_.contains(item.number())) continue;
    Ship& ship = ships_[item.number()];
    ship.kind = kind_of(item.kind());
    ship.name = item.name();
    ship.mmsi = item.mmsi();
    ship.heading_deg = item.heading_deg();
    ship.course_deg = item.course_over_ground_deg();
    ship.speed_kn = item.speed_mps() * kMetresPerSecondInKnots;
    move(ship, {time, {item.latitude_deg(), item.longitude_deg()}});
  }
}

std::string ShipTracks::geojson(UtcTime now) {
  std::erase_if(ships_, [&](const auto& each) { return now - each.second.last.time > kLength; });
  json features = json::array();
  for (auto& [number, ship] : ships_) {
    while (!ship.past.empty() && now - ship.past.front().time > kLength) ship.past.pop_front();
    json properties = {{"name", ship.name}, {"kind", ship.kind}, {"own_ship", ship.own}};
    if (ship.mmsi != 0) properties["mmsi"] = ship.mmsi;
    if (ship.has_heading) properties["heading_deg"] = ship.heading_deg;
    if (ship.has_motion) {
      properties["course_over_ground_deg"] = ship.course_deg;
      properties["speed_over_ground_kn"] = ship.speed_kn;
    }
    properties["style"] = {{"color", ship.own ? "#2060c0" : "#c06020"}};
    features.push_back({{"type", "Feature"},
                        {"geometry", {{"type", "Point"}, {"coordinates", position(ship.last.at)}}},
                        {"properties", properties}});
    json line = json::array();
    for (const Fix& fix : ship.past) line.push_back(position(fix.at));
    if (!ship.past.empty() && ship.past.back().time != ship.last.time) {
      line.push_back(position(ship.last.at));
    }
    if (line.size() < 2) continue;
    features.push_back({{"type", "Feature"},
                        {"geometry", {{"type", "LineString"}, {"coordinates", line}}},
                        {"properties",
                         {{"name", ship.name},
                          {"kind", ship.kind},
                          {"own_ship", ship.own},
                          {"style", properties["style"]}}}});
  }
  const json all = {{"type", "FeatureCollection"}, {"features", features}};
  // Names of captures are no proper text perhaps.
  return all.dump(-1, ' ', false, json::error_handler_t::replace);
}

}  // namespace skerry::client
