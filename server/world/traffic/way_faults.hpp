// What is wrong with speeds and routes that are ordered.
#pragma once

#include <google/protobuf/repeated_ptr_field.h>

#include <optional>
#include <string>

#include "protocol/quantity/geo_point.hpp"
#include "protocol/wire/exercise.pb.h"

namespace skerry::server {

// `who`: "Lyngen, a coaster,".
std::optional<std::string> fault_of_speed(const std::string& who, double speed_kn, double most_mps);
// A route from a place on.
std::optional<std::string> fault_of_way(
    const std::string& who, GeoPoint from,
    const google::protobuf::RepeatedPtrField<wire::Waypoint>& route, double most_mps);

}  // namespace skerry::server
