// What a log says of a ship: a fix, or who she is.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "protocol/quantity/geo_point.hpp"
#include "protocol/quantity/time.hpp"

namespace skerry::server {

struct HeardFix {
  std::uint32_t mmsi = 0;
  std::optional<UtcTime> utc = {};
  std::optional<GeoPoint> position = {};
  std::optional<double> heading_deg = {};  // true, [0, 360)
  std::optional<double> course_deg = {};   // over ground, true, [0, 360)
  std::optional<bool> class_b = {};
};

// What is absent, 0 or empty is not said.
struct HeardIdentity {
  std::uint32_t mmsi = 0;
  std::string name = {};
  unsigned ship_type = 0;  // as AIS message 5 has it
  double length_m = 0.0, beam_m = 0.0;
  std::optional<bool> class_b = {};
};

}  // namespace skerry::server
