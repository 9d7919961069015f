#include "server/world/route_checks.hpp"

#include <fmt/format.h>

#include <GeographicLib/Geodesic.hpp>

#include "protocol/wire/printable_text.hpp"
#include "server/world/handling/ship_class.hpp"
#include "server/world/ship_units.hpp"

namespace skerry::server {
namespace {

constexpr Length kShortestLeg = metres(1.0);
constexpr Length kLongestLeg = nautical_miles(5000.0);
constexpr double kMostOfService = 1.2;  // of the class's speed

}  // namespace

Length distance_between(GeoPoint from, GeoPoint to) {
  double distance_m = 0.0;
  GeographicLib::Geodesic::WGS84().Inverse(from.latitude_deg, from.longitude_deg, to.latitude_deg,
                                           to.longitude_deg, distance_m);
  return metres(distance_m);
}

bool is_leg(Length length) { return length >= kShortestLeg && length <= kLongestLeg; }

void check_leg(GeoPoint from, GeoPoint to, const std::string& path, YamlSource& source) {
  const Length leg = distance_between(from, to);
  if (is_leg(leg)) return;
  source.refuse(path, fmt::format("the leg to it is {:.3f} NM long; allowed: {} m to {} NM",
                                  leg.in_nautical_miles(), kShortestLeg.in_metres(),
                                  kLongestLeg.in_nautical_miles()));
}

void check_ship_class(scenario::OwnShip& ship, const std::string& path, YamlSource& source) {
  if (!ship.has_ship_class()) {
    for (const char* key : {".route", ".turn_radius_nm", ".wind_model"}) {
      if (!source.has(path + key)) continue;
      source.refuse(path + key, fmt::format("given for a ship without a ship_class; allowed: with "
                                            "one of {}",
                                            ship_class_keys()));
    }
    return;
  }
  if (!source.is_sound(path + ".ship_class")) return;
  const ShipClass* const found = find_ship_class(ship.ship_class());
  if (found == nullptr) {
    source.refuse(path + ".ship_class",
                  fmt::format("\"{}\" is no ship class; allowed: {}", printable(ship.ship_class()),
                              ship_class_keys()));
    return;
  }
  for (const char* key :
       {".speed_time_constant_s", ".turn_time_constant_s", ".max_rate_of_turn_deg_min"}) {
    if (!source.has(path + key)) continue;
    source.refuse(path + key,
                  "given besides a ship_class, which says how she answers; allowed: "
                  "one of the two");
  }
  if (!source.has(path + ".length_m")) ship.set_length_m(found->hull->length_m());
  if (!source.has(path + ".beam_m")) ship.set_beam_m(found->beam_m);
  if (!source.has(path + ".height_m")) ship.set_height_m(found->height_m);
  const double most_kn = kMostOfService * found->service_speed_mps / knots_in_mps(1.0);
  if (source.is_sound(path + ".speed_kn") && ship.speed_kn() > most_kn) {
    source.refuse(path + ".speed_kn", fmt::format("{} kn for a {}; allowed: up to {:.1f} kn",
                                                  ship.speed_kn(), found->key, most_kn));
  }
  std::string from_path = path + ".position";
  GeoPoint from = geo_point(ship.position());
  for (int i = 0; i < ship.route_size(); ++i) {
    const std::string to_path = fmt::format("{}.route[{}]", path, i);
    if (source.is_sound(from_path) && source.is_sound(to_path)) {
      check_leg(from, geo_point(ship.route(i)), to_path, source);
    }
    from = geo_point(ship.route(i));
    from_path = to_path;
  }
}

}  // namespace skerry::server
