#include "server/world/traffic/class_sizes.hpp"

#include <fmt/format.h>

#include "protocol/wire/printable_text.hpp"

namespace skerry::server {

void take_sizes(const TrafficClass& her_class, const GivenSizes& given, scenario::Target& target) {
  if (!given.length) target.set_length_m(her_class.length_m);
  if (!given.beam) target.set_beam_m(her_class.beam_m);
  if (!given.height) target.set_height_m(her_class.height_m);
  if (!target.has_cross_section_m2() && her_class.cross_section_m2 > 0.0) {
    target.set_cross_section_m2(her_class.cross_section_m2);
  }
  if (!target.has_ship_type()) target.set_ship_type(her_class.type);
  const bool lies = target.anchored() || target.fishes_within_nm() > 0.0;
  if (!given.wake) target.set_wake(!lies);
  if (!given.speed && !lies && !target.has_follows()) target.set_speed_kn(her_class.service_kn);
}

std::string complaint_of_class(const std::string& key) {
  const std::string near = nearest_traffic_class(key);
  return fmt::format("\"{}\" is no class of traffic{}; allowed: {}", skerry::printable(key),
                     near.empty() ? "" : fmt::format(", did you mean \"{}\"?", near),
                     traffic_class_keys());
}

}  // namespace skerry::server
