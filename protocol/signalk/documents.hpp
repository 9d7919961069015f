// The documents of the Signal K interfaces: radars, own ship, server, deltas, replies.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "protocol/quantity/geo_point.hpp"
#include "protocol/quantity/time.hpp"
#include "protocol/signalk/control_value.hpp"
#include "protocol/signalk/json.hpp"
#include "protocol/signalk/legend.hpp"

namespace skerry::signalk {

inline constexpr std::string_view kRadarApiVersion = "3.4.0";
inline constexpr std::string_view kSelf = "vessels.self";
inline constexpr std::string_view kRadarsPath = "/signalk/v2/api/vessels/self/radars";
inline constexpr std::string_view kStreamPath = "/signalk/v1/stream";

// How the list of radars is written; displays differ (signalk/README.md).
enum class Dialect : std::uint8_t {
  current,  // {"version","radars":{id: radar}}: Radar API 3.4.0
  array,    // [radar, ...] with its state: Signal K server 2.23
  keyed,    // {id: radar} with the addresses of its streams: displays of April 2026
};

// The facts of a radar that do not change while the server runs.
struct Radar {
  std::string id;       // letters, digits, '-' and '_'
  std::string name;     // "Frida X-band"
  std::string brand;    // "Skerry"
  std::string model;    // "25 kW X"
  std::string address;  // of the server, as the client has it
  std::uint32_t spokes_per_turn = 0, cells = 0;
  Legend legend;
};
// A key of the control table and what it says.
using ControlStates = std::vector<std::pair<std::string, ControlState>>;

// The server as the client has it.
struct HttpPlace {
  std::string authority;  // "192.0.2.7:7480"
  bool secure = false;    // by TLS
  std::string http() const { return (secure ? "https://" : "http://") + authority; }
  std::string ws() const { return (secure ? "wss://" : "ws://") + authority; }
};

Json radar_document(const Radar& radar);
// `state_of` of each radar's controls are asked for by Dialect::array alone.
struct ListedRadar {
  Radar radar;
  ControlStates states;
};
Json radar_list_document(std::span<const ListedRadar> radars, Dialect dialect,
                         const HttpPlace& place);
Json capabilities_document(const Radar& radar);
Json controls_document(const ControlStates& states);
// Signal K server 2.23: status, time and controls in one.
Json radar_state_document(const Radar& radar, const ControlStates& states, UtcTime now);
Json interfaces_document(std::string_view address);

// Unknown values of her motion are absent.
struct OwnShip {
  std::string name;
  std::optional<GeoPoint> position = {};
  std::optional<double> heading_deg = {}, course_over_ground_deg = {};  // true
  std::optional<double> speed_over_ground_mps = {};
  std::optional<double> rate_of_turn_deg_min = {};
};
// Known values: path ("navigation.position") and value, SI units.
std::vector<std::pair<std::string, Json>> own_ship_values(const OwnShip& ship);
// The ship as a tree, as /signalk/v1/api/vessels/self has it.
Json own_ship_document(const OwnShip& ship, UtcTime now);

// Another vessel, as an AIS receiver aboard own ship, or her plotter, would tell of her.
struct OtherVessel {
  std::string key;         // vessel_key() or tracked_vessel_key(): no two have the same
  std::uint32_t mmsi = 0;  // nine digits; 0: none, she is a plotter's
  OwnShip ship;
  double length_m = 0.0, beam_m = 0.0;  // 0: not known
};
// "urn:mrn:imo:mmsi:257000222": in the tree of vessels; behind "vessels.", her context in deltas.
std::string vessel_key(std::uint32_t mmsi);
// The same of a tracked target that no AIS target is taken to be: a UUID of radar and number.
std::string tracked_vessel_key(std::uint32_t radar, std::uint32_t target);
// Name and number are at the path "".
std::vector<std::pair<std::string, Json>> other_vessel_values(const OtherVessel& vessel);
Json other_vessel_document(const OtherVessel& vessel, UtcTime now);

Json endpoints_document(std::string_view server, const HttpPlace& place);
Json hello_document(std::string_view server, UtcTime now);
Json features_document();
// `logged_in`: what this client asks for is obeyed.
Json login_status_document(bool logged_in, bool login_possible);

// {"state":..,"statusCode":..,"message":..}
Json reply_document(unsigned status, std::string_view message);

Json delta_document(std::string_view source, UtcTime now, Json values, Json meta,
                    std::string_view context = kSelf);

}  // namespace skerry::signalk
