// What the wind does to a ship.
#pragma once

#include <cstdint>

#include "server/world/handling/hull.hpp"

namespace skerry::server {

// Blendermann, Parameter identification of wind loads on ships, J. Wind Eng. Ind. Aerodyn. 51
// (1994), table 1.
enum class WindType : std::uint8_t {
  cargo_loaded,
  container_loaded,
  ferry,
  fishing,
  offshore_supply,
  speedboat,
  tanker_loaded,
  tender,
  research,
};

// Areas above the water and where their middle lies.
struct WindShape {
  WindType type = WindType::cargo_loaded;
  double frontal_m2 = 0.0, lateral_m2 = 0.0;
  double centre_m = 0.0;  // of the lateral area, ahead of midship
  double height_m = 0.0;  // of its centre above the water
};

inline constexpr double kAir_kg_m3 = 1.224;

// `wind_x`, `wind_y`: the wind as it blows over her, m/s, ahead and to starboard: a wind from dead
// ahead has a negative x.  Nothing if it is calm.
// Source: Blendermann as above, equations of CX, CY, CK and CN; the mean of his bow and stern
// values where the wind is abeam is not smoothed, as in his text.
// Held by WindLoad.IsThatOfBlendermann against values of another program.
Loads wind_load(const WindShape& shape, double length_m, double wind_x, double wind_y);

}  // namespace skerry::server
