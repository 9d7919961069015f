// FaultState: what is wrong aboard an own ship.
#pragma once

#include <optional>

#include "protocol/quantity/geo_point.hpp"
#include "protocol/quantity/time.hpp"
#include "protocol/wire/exercise.pb.h"

namespace skerry::server {

// Times are on the exercise's clock.
struct FaultState {
  wire::Faults faults;
  Duration gyro_drifts_since{}, gnss_drifts_since{};
  // What compass and receiver said last, of those that are lost: displays that cannot do without
  // keep it.
  std::optional<double> held_heading_deg = {};  // true, [0, 360)
  std::optional<GeoPoint> held_position = {};
};

}  // namespace skerry::server
