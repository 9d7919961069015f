// Traffic classes: what sorts of ships there are among the targets.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "server/world/scenario.pb.h"

namespace skerry::server {

// A typical ship of her sort, not a certain one: sizes and speeds are rounded from what ships of
// the sort commonly have, time constants and rates of turn are this project's choice.
struct TrafficClass {
  std::string_view key;
  double length_m, beam_m;
  double height_m;  // of hull and superstructure above the water
  double draught_m;
  double cross_section_m2;  // median at X band, bow aspect; 0: from her size
  double service_kn, most_kn;
  double most_rate_deg_min;  // with the way of a third of her service speed or more
  double turn_s, speed_s;    // time constants of rate of turn and of speed
  scenario::ShipType type;
  bool ais_class_b;
};

// All of them, largest first.
std::span<const TrafficClass> traffic_classes();
// nullptr if there is none of that key.
const TrafficClass* find_traffic_class(std::string_view key);
// The class nearest to a length: how a ship answers of which nothing else is known.
const TrafficClass& traffic_class_of_length(double length_m);
// "vlcc, container, ..." for messages.
std::string traffic_class_keys();
// The class that a mistyped key probably means, "" if none is near.
std::string nearest_traffic_class(const std::string& key);

}  // namespace skerry::server
