// Plot: an echo of one turn, as a place and how well it is known.
#pragma once

#include <cstdint>

#include "protocol/quantity/bearing.hpp"
#include "protocol/quantity/geo_point.hpp"
#include "protocol/quantity/time.hpp"

namespace skerry::server {

// Of the middle of the echo's strength, when the beam stood there: own ship and time are those of
// that spoke, not of the turn.
struct Plot {
  ScenarioTime time{};
  UtcTime utc{};
  GeoPoint own_ship;
  TrueBearing bearing;
  double range_m = 0.0;
  // Standard deviations.
  double bearing_sigma_rad = 0.0, range_sigma_m = 0.0;
  // How far it reaches along the range and across; what the beam and the pulse add is deducted, so
  // 0 for a point.
  double length_m = 0.0, width_m = 0.0;
  std::uint8_t greatest = 0;  // level, 1 to 255
  std::uint32_t cells = 0;    // of rows
  // It goes on beyond what one plot may cover, or the turn it began in: land, or rain.
  bool extended = false;
  // What has been learnt of its place before (land_map.hpp), 0 to 1: how sure that it lies on land,
  // where half means beside it; and how much echoes come and go around it, as those of the sea.
  double on_land = 0.0, clutter = 0.0;
  // In which spans of some turns an echo stood within stood_m of it; bit 0 is the present one.
  std::uint32_t stood = 0;
  double stood_m = 0.0;
  bool by_standing = false;  // land, or another echo that stays, is near
};

}  // namespace skerry::server
