// A target's sizes and type as those of her class.
#pragma once

#include <string>

#include "server/world/scenario.pb.h"
#include "server/world/traffic/traffic_class.hpp"

namespace skerry::server {

// What the scenario gives itself, and the class does not touch.
struct GivenSizes {
  bool length = false, beam = false, height = false, wake = false, speed = false;
};

// Speed: her service speed; in waters where she does not choose it herself (at anchor, on station,
// fishing) it is left alone.
void take_sizes(const TrafficClass& her_class, const GivenSizes& given, scenario::Target& target);

// "\"coster\" is no class of traffic (did you mean coaster?); allowed: ..."
std::string complaint_of_class(const std::string& key);

}  // namespace skerry::server
