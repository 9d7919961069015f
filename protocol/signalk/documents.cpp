#include "protocol/signalk/documents.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "protocol/quantity/angle.hpp"
#include "protocol/signalk/radar_message.hpp"
#include "protocol/signalk/target.hpp"
#include "protocol/video/range_scale.hpp"

namespace skerry::signalk {
namespace {

const ControlState* state_in(const ControlStates& states, std::string_view key) {
  const auto found = std::find_if(states.begin(), states.end(),
                                  [key](const auto& each) { return each.first == key; });
  return found == states.end() ? nullptr : &found->second;
}

// The name that Signal K server 2.23 uses.
std::string status_of(const ControlStates& states) {
  const ControlState* power = state_in(states, "power");
  if (power == nullptr || power->value == kPowerOff) return "off";
  return power->value == kPowerStandby ? "standby" : "transmit";
}

Json state_in_list(const ListedRadar& listed) {
  const ControlState* range = state_in(listed.states, "range");
  return Json{{"id", listed.radar.id},
              {"name", listed.radar.name},
              {"brand", listed.radar.brand},
              {"status", status_of(listed.states)},
              {"spokesPerRevolution", listed.radar.spokes_per_turn},
              {"maxSpokeLen", listed.radar.cells},
              {"range", number_document(range == nullptr ? 0.0 : range->value)},
              {"controls", controls_document(listed.states)}};
}

}  // namespace

Json radar_document(const Radar& radar) {
  return Json{{"name", radar.name},
              {"brand", radar.brand},
              {"model", radar.model},
              {"radarIpAddress", radar.address}};
}

Json radar_list_document(std::span<const ListedRadar> radars, Dialect dialect,
                         const HttpPlace& place) {
  if (dialect == Dialect::array) {
    Json list = Json::array();
    for (const ListedRadar& listed : radars) list.push_back(state_in_list(listed));
    return list;
  }
  Json keyed = Json::object();
  for (const ListedRadar& listed : radars) {
    Json& radar = keyed[listed.radar.id] = radar_document(listed.radar);
    if (dialect != Dialect::keyed) continue;
    radar["spokeDataUrl"] = fmt::format("{}{}/{}/spokes", place.ws(), kRadarsPath, listed.radar.id);
    radar["streamUrl"] = fmt::format("{}{}", place.ws(), kStreamPath);
  }
  if (dialect == Dialect::keyed) return keyed;
  return Json{{"version", kRadarApiVersion}, {"radars", std::move(keyed)}};
}

Json capabilities_document(const Radar& radar) {
  Json ranges = Json::array();
  for (const double nm : RangeScale::kNauticalMiles) {
    ranges.push_back(whole_metres(nautical_miles(nm)));
  }
  Json controls = Json::object();
  for (const ControlDefinition& definition : control_definitions()) {
    controls[definition.key] = definition_document(definition);
  }
  return Json{{"maxRange", ranges.back()},
              {"minRange", ranges.front()},
              {"supportedRanges", ranges},
              {"spokesPerRevolution", radar.spokes_per_turn},
              {"maxSpokeLength", radar.cells},
              {"pixelValues", radar.legend.levels},
              {"hasDoppler", true},
              {"hasDualRadar", false},
              {"hasDualRange", false},
              {"hasSparseSpokes", false},
              {"noTransmitSectors", kNoTransmitSectors},
              {"stationary", false},
              {"controls", std::move(controls)},
              {"legend", legend_document(radar.legend)}};
}

Json controls_document(const ControlStates& states) {
  Json controls = Json::object();
  for (const auto& [key, state] : states) {
    const ControlDefinition* definition = find_control(key);
    if (definition != nullptr) controls[key] = state_document(*definition, state);
  }
  return controls;
}

Json radar_state_document(const Radar& radar, const ControlStates& states, UtcTime now) {
  return Json{{"id", radar.id},
              {"timestamp", iso_time(now)},
              {"status", status_of(states)},
              {"controls", controls_document(states)}};
}

Json interfaces_document(std::string_view address) {
  Json listeners{{"Skerry", "Active"}};
  Json interface {
    {"status", "Ok"}, {"ip", address}, { "listeners", std::move(listeners) }
  };
  Json inner{{"brands", Json::array({"Skerry"})},
             {"interfaces", Json{{"server", std::move(interface)}}}};
  return Json{{"radars", Json{{"interfaces", std::move(inner)}}}};
}

std::vector<std::pair<std::string, Json>> own_ship_values(const OwnShip& ship) {
  std::vector<std::pair<std::string, Json>> values;
  if (ship.position) {
    values.emplace_back("navigation.position", Json{{"latitude", ship.position->latitude_deg},
                                                    {"longitude", ship.position->longitude_deg}});
  }
  const auto add = [&](const char* path, std::optional<double> value, double unit) {
    if (value) values.emplace_back(path, *value * unit);
  };
  add("navigation.headingTrue", ship.heading_deg, kRadiansPerDegree);
  add("navigation.courseOverGroundTrue", ship.course_over_ground_deg, kRadiansPerDegree);
  add("navigation.speedOverGround", ship.speed_over_ground_mps, 1.0);
  add("navigation.rateOfTurn", ship.rate_of_turn_deg_min, kRadiansPerDegree / 60.0);
  return values;
}

namespace {

using Values = std::vector<std::pair<std::string, Json>>;

// Values at "a.b" as a tree; the members of one at "" stand at its root.
Json tree_of(const Values& values, UtcTime now) {
  Json tree = Json::object();
  for (const auto& [path, value] : values) {
    if (path.empty()) {
      tree.update(value);
      continue;
    }
    Json* at = &tree;
    for (std::size_t begin = 0; begin <= path.size();) {
      const std::size_t end = std::min(path.find('.', begin), path.size());
      at = &(*at)[path.substr(begin, end - begin)];
      begin = end + 1;
    }
    *at = Json{{"value", value}, {"timestamp", iso_time(now)}, {"$source", "skerry"}};
  }
  return tree;
}

}  // namespace

Json own_ship_document(const OwnShip& ship, UtcTime now) {
  Values values{{"", Json{{"name", ship.name}}}};
  for (auto& each : own_ship_values(ship)) values.push_back(std::move(each));
  return tree_of(values, now);
}

std::string vessel_key(std::uint32_t mmsi) { return fmt::format("urn:mrn:imo:mmsi:{:09}", mmsi); }

std::string tracked_vessel_key(std::uint32_t radar, std::uint32_t target) {
  return fmt::format("urn:mrn:signalk:uuid:534b4552-5259-4{:03x}-8000-{:012x}", radar & 0xFFFu,
                     target);
}

Values other_vessel_values(const OtherVessel& vessel) {
  Values values{{"", Json{{"name", vessel.ship.name}}}};
  if (vessel.mmsi != 0) values.front().second["mmsi"] = fmt::format("{:09}", vessel.mmsi);
  for (auto& each : own_ship_values(vessel.ship)) values.push_back(std::move(each));
  if (vessel.length_m > 0.0) {
    values.emplace_back("design.length", Json{{"overall", vessel.length_m}});
  }
  if (vessel.beam_m > 0.0) values.emplace_back("design.beam", vessel.beam_m);
  if (vessel.mmsi != 0) values.emplace_back("sensors.ais.class", "A");
  return values;
}

Json other_vessel_document(const OtherVessel& vessel, UtcTime now) {
  return tree_of(other_vessel_values(vessel), now);
}

Json endpoints_document(std::string_view server, const HttpPlace& place) {
  Json v1{{"version", "1.7.0"},
          {"signalk-http", place.http() + "/signalk/v1/api/"},
          {"signalk-ws", fmt::format("{}{}", place.ws(), kStreamPath)}};
  Json v2{{"version", "2.0.0"}, {"signalk-http", place.http() + "/signalk/v2/api/"}};
  const auto space = server.find(' ');
  return Json{
      {"endpoints", Json{{"v1", std::move(v1)}, {"v2", std::move(v2)}}},
      {"server", Json{{"id", server.substr(0, space)},
                      {"version", space == std::string_view::npos ? std::string_view()
                                                                  : server.substr(space + 1)}}}};
}

Json hello_document(std::string_view server, UtcTime now) {
  const auto space = server.find(' ');
  return Json{{"name", server.substr(0, space)},
              {"version", "1.7.0"},
              {"self", kSelf},
              {"roles", Json::array({"master", "main"})},
              {"timestamp", iso_time(now)}};
}

Json features_document() {
  return Json{{"apis", Json::array({"radar"})}, {"plugins", Json::array()}};
}

Json login_status_document(bool logged_in, bool login_possible) {
  return Json{{"status", logged_in ? "loggedIn" : "notLoggedIn"},
              {"readOnlyAccess", true},
              {"authenticationRequired", false},
              {"allowNewUserRegistration", false},
              {"allowDeviceAccessRequests", false},
              {"securityWasEnabled", login_possible}};
}

Json reply_document(unsigned status, std::string_view message) {
  return Json{{"state", status < 400 ? "COMPLETED" : "FAILED"},
              {"statusCode", status},
              {"message", message}};
}

Json delta_document(std::string_view source, UtcTime now, Json values, Json meta,
                    std::string_view context) {
  Json update{{"$source", source}, {"timestamp", iso_time(now)}};
  if (!meta.empty()) update["meta"] = std::move(meta);
  if (!values.empty()) update["values"] = std::move(values);
  return Json{{"context", context}, {"updates", Json::array({std::move(update)})}};
}

}  // namespace skerry::signalk
