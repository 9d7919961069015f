// LandCover: what covers the ground, where a chart says so.
#pragma once

#include <cstdint>
#include <vector>

#include "protocol/quantity/geo_point.hpp"

namespace skerry::echo {

// How each echoes is one table: echo/returns/cover_echo.hpp.
enum class LandCover : std::uint8_t {
  none,        // the chart does not say: as the shore's type has it
  built_up,    // houses
  industrial,  // sheds, tanks, warehouses
  forest,
  scrub,
  grass,  // meadows, parks, heath
  farmland,
  marsh,
  mangrove,
  rock,
  sand,
  ice,
  paved,  // runways, aprons, car parks
};
inline constexpr int kLandCovers = 13;

// An area of one cover: what lies within an odd number of its rings, edges straight in latitude and
// longitude.  No ring encloses a pole.  `none` takes away what lies below it.
struct CoverArea {
  LandCover cover = LandCover::none;
  std::vector<std::vector<GeoPoint>> rings;  // closed: the last vertex joins the first
};

}  // namespace skerry::echo
