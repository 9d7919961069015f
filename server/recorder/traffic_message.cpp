#include "server/recorder/traffic_message.hpp"

namespace skerry::server {
namespace {

recording::Traffic::Item::Kind kind_of(TrafficKind kind) {
  switch (kind) {
    case TrafficKind::ship:
      return recording::Traffic::Item::SHIP;
    case TrafficKind::boat:
      return recording::Traffic::Item::BOAT;
    case TrafficKind::aid_to_navigation:
      return recording::Traffic::Item::AID_TO_NAVIGATION;
    case TrafficKind::other:
      break;
  }
  return recording::Traffic::Item::OTHER;
}

}  // namespace

recording::Traffic traffic_message(const std::vector<TrafficItem>& traffic) {
  recording::Traffic out;
  for (const TrafficItem& item : traffic) {
    recording::Traffic::Item& to = *out.add_items();
    to.set_number(item.number);
    to.set_kind(kind_of(item.kind));
    to.set_name(item.name);
    to.set_mmsi(item.mmsi);
    to.set_latitude_deg(item.position.latitude_deg);
    to.set_longitude_deg(item.position.longitude_deg);
    to.set_heading_deg(item.heading_deg);
    to.set_course_over_ground_deg(item.course_over_ground_deg);
    to.set_speed_mps(item.speed_mps);
    to.set_rate_of_turn_deg_min(item.rate_of_turn_deg_min);
    to.set_length_m(item.length_m);
    to.set_beam_m(item.beam_m);
    for (const std::uint32_t radar : item.radars) to.add_radars(radar);
    to.set_ship_type(item.ship_type);
    to.set_aid_type(item.aid_type);
  }
  return out;
}

}  // namespace skerry::server
