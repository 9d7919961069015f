#include "server/world/handling/ship_class.hpp"

#include <array>
#include <utility>
#include <vector>

#include "protocol/quantity/speed.hpp"
#include "server/world/handling/container_hull.hpp"
#include "server/world/handling/mariner_hull.hpp"
#include "server/world/handling/mmg_ships.hpp"
#include "server/world/handling/tanker_hull.hpp"

namespace skerry::server {
namespace {

// 0.15 kN of force for each kW.
constexpr Thruster thruster(double power_kw, double ahead_m) { return {150.0 * power_kw, ahead_m}; }

// Derived from sizes alone: areas above the water, thrusters and gear are assumed.
struct Derived {
  std::string_view key;
  MainSizes sizes;
  double height_m, service_kn, astern;  // astern: of the ahead shaft's turns
  SteeringGear gear;
  Thruster bow, stern;
  WindShape wind;
};

ShipClass made(const Derived& d) {
  auto hull = std::make_shared<const MmgHull>(from_sizes(d.sizes));
  const double service = d.service_kn * kKnot;
  const double ahead = shaft_for(*hull, service);
  return {.key = d.key,
          .source = "derived",
          .beam_m = d.sizes.beam_m,
          .height_m = d.height_m,
          .service_speed_mps = service,
          .ahead_rps = ahead,
          .astern_rps = d.astern * ahead,
          .gear = d.gear,
          .bow = d.bow,
          .stern = d.stern,
          .wind = d.wind,
          .block = d.sizes.block,
          .hull = std::move(hull)};
}

std::vector<ShipClass> all_classes() {
  std::vector<ShipClass> classes;
  {
    auto hull = std::make_shared<const MmgHull>(kvlcc2());
    const double service = 15.5 * kKnot;
    classes.push_back({.key = "vlcc",
                       .source = "Yasukawa and Yoshimura 2015",
                       .beam_m = 58.0,
                       .height_m = 30.0,
                       .service_speed_mps = service,
                       .ahead_rps = shaft_for(*hull, service),
                       .astern_rps = 0.7 * shaft_for(*hull, service),
                       .gear = {.rate_deg_s = 2.34},
                       .wind = {WindType::tanker_loaded, 1150.0, 3500.0, -15.0, 8.0},
                       .block = 0.81,
                       .hull = hull});
  }
  classes.push_back({.key = "tanker",
                     .source = "van Berlekom and Goddard 1972",
                     .beam_m = 47.17,
                     .height_m = 28.0,
                     .service_speed_mps = 8.23,
                     .ahead_rps = 80.0 / 60.0,
                     .astern_rps = 60.0 / 60.0,
                     .gear = {.rate_deg_s = 2.33},
                     .wind = {WindType::tanker_loaded, 900.0, 2900.0, -15.0, 7.0},
                     .block = 0.83,
                     .hull = std::make_shared<const TankerHull>()});
  classes.push_back({.key = "container",
                     .source = "Son and Nomoto 1982",
                     .beam_m = 25.4,
                     .height_m = 26.0,
                     .service_speed_mps = 8.3767,
                     .ahead_rps = 80.0 / 60.0,
                     .astern_rps = 60.0 / 60.0,
                     .gear = {.rate_deg_s = 5.0, .lag_s = 1.0},
                     .bow = thruster(1000.0, 75.0),
                     .wind = {WindType::container_loaded, 650.0, 3700.0, 0.0, 11.0},
                     .block = 0.572,
                     .hull = std::make_shared<const ContainerHull>()});
  classes.push_back({.key = "mariner",
                     .source = "Chislett and Stroem-Tejsen 1965",
                     .beam_m = 23.17,
                     .height_m = 22.0,
                     .service_speed_mps = MarinerHull::kServiceSpeed_mps,
                     .ahead_rps = MarinerHull::kServiceShaft_rps,
                     .astern_rps = MarinerHull::kServiceShaft_rps,
                     .gear = {.rate_deg_s = 5.0, .lag_s = 1.0},
                     .wind = {WindType::cargo_loaded, 450.0, 1900.0, 0.0, 7.0},
                     .block = 0.6,
                     .hull = std::make_shared<const MarinerHull>()});
  const std::array<Derived, 6> derived = {{
      {"ferry",
       {120.0, 20.0, 5.5, 0.60, 0.0060, 4.2, 19.0, 0.05},
       24.0,
       20.0,
       0.8,
       {.rate_deg_s = 4.0},
       thruster(2000.0, 50.0),
       {},
       {WindType::ferry, 420.0, 2100.0, 2.0, 10.0}},
      {"coaster",
       {80.0, 13.0, 5.2, 0.72, 0.0060, 3.0, 9.2, 0.05},
       14.0,
       12.0,
       0.7,
       {.rate_deg_s = 3.0},
       thruster(250.0, 33.0),
       {},
       {WindType::cargo_loaded, 140.0, 480.0, -4.0, 4.0}},
      {"fast_craft",
       {38.0, 7.2, 1.6, 0.42, 0.0100, 1.15, 2.4, 0.6},
       10.0,
       28.0,
       0.6,
       {.rate_deg_s = 8.0},
       {},
       {},
       {WindType::speedboat, 40.0, 160.0, 1.0, 2.8}},
      {"fishing",
       {30.0, 8.0, 3.2, 0.58, 0.0120, 2.1, 3.2, 0.2},
       11.0,
       11.0,
       0.7,
       {.rate_deg_s = 5.0},
       {},
       {},
       {WindType::fishing, 50.0, 150.0, 1.0, 2.8}},
      {"tug",
       {28.0, 10.0, 3.8, 0.52, 0.0160, 2.4, 4.3, 0.3},
       12.0,
       12.5,
       0.8,
       {.rate_deg_s = 8.0},
       thruster(150.0, 10.0),
       {},
       {WindType::offshore_supply, 70.0, 160.0, 3.0, 3.5}},
      {"pilot",
       {14.0, 4.4, 1.1, 0.42, 0.0120, 0.8, 0.7, 1.0},
       5.0,
       22.0,
       0.6,
       {.rate_deg_s = 10.0},
       {},
       {},
       {WindType::speedboat, 11.0, 32.0, 0.5, 1.5}},
  }};
  for (const Derived& d : derived) classes.push_back(made(d));
  return classes;
}

const std::vector<ShipClass>& table() {
  static const std::vector<ShipClass> classes = all_classes();
  return classes;
}

struct Superstructure {
  double share;  // of the lateral area
  int masts;
};

Superstructure superstructure_of(WindType type) {
  switch (type) {
    case WindType::container_loaded:
      return {0.65, 1};
    case WindType::ferry:
      return {0.6, 1};
    case WindType::tanker_loaded:
      return {0.35, 1};
    case WindType::cargo_loaded:
      return {0.45, 2};
    case WindType::fishing:
    case WindType::research:
      return {0.5, 2};
    case WindType::offshore_supply:
    case WindType::speedboat:
    case WindType::tender:
      break;
  }
  return {0.5, 1};
}

IsherwoodShape isherwood_shape(const ShipClass& ship) {
  const double length = ship.hull->length_m();
  const Superstructure above = superstructure_of(ship.wind.type);
  return {.length_m = length,
          .beam_m = ship.beam_m,
          .frontal_m2 = ship.wind.frontal_m2,
          .lateral_m2 = ship.wind.lateral_m2,
          .superstructure_m2 = above.share * ship.wind.lateral_m2,
          .perimeter_m = length + 2.0 * ship.height_m,
          .centre_from_bow_m = 0.5 * length - ship.wind.centre_m,
          .masts = above.masts,
          .height_m = ship.wind.height_m};
}

}  // namespace

const ShipClass& in_isherwoods_wind(const ShipClass& ship) {
  static const std::vector<ShipClass> classes = [] {
    std::vector<ShipClass> all = table();
    for (ShipClass& each : all) each.isherwood = isherwood_shape(each);
    return all;
  }();
  for (const ShipClass& each : classes) {
    if (each.key == ship.key) return each;
  }
  return ship;
}

std::span<const ShipClass> ship_classes() { return table(); }

const ShipClass* find_ship_class(std::string_view key) {
  for (const ShipClass& c : table()) {
    if (c.key == key) return &c;
  }
  return nullptr;
}

std::string ship_class_keys() {
  std::string keys;
  for (const ShipClass& c : table()) {
    if (!keys.empty()) keys += ", ";
    keys += c.key;
  }
  return keys;
}

}  // namespace skerry::server
