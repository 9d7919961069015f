// Ship classes: the ships that a scenario can name as its own ships' `class`.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "server/world/handling/bank_load.hpp"
#include "server/world/handling/hull.hpp"
#include "server/world/handling/isherwood_load.hpp"
#include "server/world/handling/steering_gear.hpp"
#include "server/world/handling/wave_load.hpp"
#include "server/world/handling/wind_load.hpp"

namespace skerry::server {

// A tunnel thruster.  Half its force is left at 2.5 kn of way, by 1 / (1 + (u / 2.5 kn)^2).
struct Thruster {
  double force_n = 0.0;  // at rest; 0: there is none
  double ahead_m = 0.0;  // of midship
};

struct ShipClass {
  std::string_view key;     // "kvlcc2", as a scenario names it
  std::string_view source;  // of her coefficients; "derived" where from her sizes alone
  double beam_m, height_m;  // height: of hull and superstructure above the water
  double service_speed_mps;
  double ahead_rps, astern_rps;  // full; both positive
  SteeringGear gear;
  Thruster bow = {}, stern = {};
  WindShape wind;
  double block;
  std::shared_ptr<const Hull> hull;  // never null
  // Her wind is Isherwood's instead of Blendermann's.
  std::optional<IsherwoodShape> isherwood = {};

  BankShape bank_shape() const { return {hull->length_m(), beam_m, hull->draught_m(), block}; }
  WaveShape wave_shape() const { return {hull->length_m(), beam_m, hull->draught_m(), block}; }
};

// All of them, largest first.  Made once.
std::span<const ShipClass> ship_classes();
// nullptr if there is none of that key.
const ShipClass* find_ship_class(std::string_view key);
// The same class as `ship` of the table, with her wind by Isherwood.  His factors that the table
// has not are assumed: her length over all is that of her hull, the outline rises by her height and
// falls again, and the superstructure's share of the lateral area and the masts go by her wind type
// (0.65 and one for a container ship with her boxes, 0.6 and one for a ferry, 0.35 and one for a
// tanker, 0.45 and two for a cargo ship, 0.5 and two for a fishing or research vessel, else 0.5 and
// one).  Made once.
const ShipClass& in_isherwoods_wind(const ShipClass& ship);
// "coaster, container, ..." for messages.
std::string ship_class_keys();

}  // namespace skerry::server
