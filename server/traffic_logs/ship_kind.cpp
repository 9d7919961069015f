#include "server/traffic_logs/ship_kind.hpp"

#include <cmath>
#include <initializer_list>

#include "server/world/traffic/traffic_class.hpp"

namespace skerry::server {
namespace {

// Of those, the class nearest in length; the first if no length is known.
std::string_view nearest_of(std::initializer_list<std::string_view> keys, double length_m) {
  std::string_view best = *keys.begin();
  if (!(length_m > 0.0)) return best;
  for (const std::string_view key : keys) {
    const double off_m = std::fabs(find_traffic_class(key)->length_m - length_m);
    if (off_m < std::fabs(find_traffic_class(best)->length_m - length_m)) best = key;
  }
  return best;
}

}  // namespace

scenario::ShipType ship_type_of(unsigned ais_type) {
  if (ais_type == 0 || ais_type > 99) return scenario::type_not_given;
  if (scenario::ShipType_IsValid(static_cast<int>(ais_type))) {
    return static_cast<scenario::ShipType>(ais_type);
  }
  if (ais_type == 32) return scenario::towing;
  switch (ais_type / 10) {
    case 4:
      return scenario::high_speed_craft;
    case 6:
      return scenario::passenger;
    case 7:
      return scenario::cargo;
    case 8:
      return scenario::tanker;
    default:
      return ais_type < 20 ? scenario::type_not_given : scenario::other_ship;
  }
}

std::string_view traffic_class_of(const HeardIdentity& ship) {
  const double length_m = ship.length_m;
  switch (ship_type_of(ship.ship_type)) {
    case scenario::fishing:
      return "fishing";
    case scenario::towing:
    case scenario::tug:
    case scenario::port_tender:
    case scenario::diving:
      return "tug";
    case scenario::dredger:
      return "dredger";
    case scenario::naval:
      return "naval";
    case scenario::sailing:
      return "sailing";
    case scenario::pleasure_craft:
      return nearest_of({"yacht", "boat"}, length_m);
    case scenario::high_speed_craft:
      return nearest_of({"fast_ferry", "fast_craft"}, length_m);
    case scenario::pilot:
      return "pilot";
    case scenario::search_and_rescue:
    case scenario::law_enforcement:
      return nearest_of({"pilot", "fast_craft", "naval"}, length_m);
    case scenario::passenger:
      return nearest_of({"ferry", "fast_ferry", "cruise"}, length_m);
    case scenario::cargo:
      return nearest_of({"coaster", "mariner", "container", "bulker"}, length_m);
    case scenario::tanker:
      return nearest_of({"product_tanker", "tanker", "vlcc"}, length_m);
    default:
      if (length_m > 0.0) return traffic_class_of_length(length_m).key;
      return ship.class_b.value_or(false) ? "yacht" : "coaster";
  }
}

}  // namespace skerry::server
