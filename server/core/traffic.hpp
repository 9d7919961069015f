// Ships and marks around an own ship, and the fixes by which an outside simulator drives her.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "protocol/quantity/geo_point.hpp"

namespace skerry::server {

enum class TrafficKind : std::uint8_t { ship, boat, aid_to_navigation, other };

// What a ship's AIS says of her; absent: "not available".
struct AisSaid {
  bool silent = false;
  std::optional<GeoPoint> position = {};
  std::optional<double> heading_deg = {};             // true, [0, 360)
  std::optional<double> course_over_ground_deg = {};  // true, [0, 360)
  std::optional<double> speed_mps = {};               // over ground, >= 0
  std::optional<double> rate_of_turn_deg_min = {};    // starboard positive
};

// A ship or mark as it really is: no tracker's errors; `ais` is what others
// hear of her.  Own ships are among them.
struct TrafficItem {
  std::uint32_t number = 0;  // of the scenario, stable for as long as the server runs, from 1
  TrafficKind kind = TrafficKind::ship;
  std::string name;
  std::uint32_t mmsi = 0;  // nine digits
  GeoPoint position;
  double heading_deg = 0.0;             // true, [0, 360)
  double course_over_ground_deg = 0.0;  // true, [0, 360)
  double speed_mps = 0.0;               // over ground, >= 0
  double rate_of_turn_deg_min = 0.0;    // starboard positive
  double length_m = 0.0;
  double beam_m = 0.0;
  // One of the server's own ships: the radars aboard her, by which she can leave out herself.
  std::vector<std::uint32_t> radars = {};
  std::uint8_t ship_type = 0;       // as AIS message 5 has it, of ships and boats; 0: not said
  std::uint8_t aid_type = 0;        // as AIS message 21 has it, of aids; 0: not said
  std::optional<AisSaid> ais = {};  // where her AIS does not say the truth
};

inline AisSaid said_by_ais(const TrafficItem& item) {
  if (item.ais) return *item.ais;
  return {false,
          item.position,
          item.heading_deg,
          item.course_over_ground_deg,
          item.speed_mps,
          item.rate_of_turn_deg_min};
}

// Absent members stay as they were.
struct OwnShipFix {
  std::optional<GeoPoint> position = {};
  std::optional<double> heading_deg = {};             // true, [0, 360)
  std::optional<double> course_over_ground_deg = {};  // true, [0, 360)
  std::optional<double> speed_mps = {};               // over ground, 0 .. 100
  std::optional<double> rate_of_turn_deg_min = {};    // starboard positive, up to 1200
};

}  // namespace skerry::server
