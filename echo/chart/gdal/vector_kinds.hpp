// The words of GeoJSON and Shapefile charts.
#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "echo/chart/chart_object.hpp"
#include "echo/chart/coast_chart.hpp"

namespace skerry::echo {

// What `kind` of a GeoJSON or Shapefile feature may say, besides coverage, cover and marina.
struct VectorKind {
  std::string_view name;
  ObjectClass is;
  std::string_view as;  // S57 class whose default it takes
  int category;
};
inline constexpr std::array kVectorKinds = {
    VectorKind{"pier", ObjectClass::pier, "SLCONS", 4},
    VectorKind{"breakwater", ObjectClass::breakwater, "SLCONS", 1},
    VectorKind{"bridge", ObjectClass::bridge, "BRIDGE", 0},
    VectorKind{"pontoon", ObjectClass::pontoon, "PONTON", 0},
    VectorKind{"pile", ObjectClass::pile, "PILPNT", 0},
    VectorKind{"building", ObjectClass::building, "BUISGL", 0},
    VectorKind{"landmark", ObjectClass::landmark, "LNDMRK", 0},
    VectorKind{"buoy", ObjectClass::buoy, "BOYLAT", 0},
    VectorKind{"beacon", ObjectClass::beacon, "BCNLAT", 0},
    VectorKind{"rock", ObjectClass::rock, "UWTROC", 0},
    VectorKind{"reflector", ObjectClass::reflector, "RADRFL", 0},
    VectorKind{"racon", ObjectClass::racon, "RTPBCN", 0},
};

// What `type` of land may say.
inline std::optional<CoastType> type_named(std::string_view name) {
  if (name == "artificial") return CoastType::artificial;
  if (name == "rocky") return CoastType::rocky;
  if (name == "sandy") return CoastType::sandy;
  if (name == "unknown" || name.empty()) return CoastType::unknown;
  return std::nullopt;
}

}  // namespace skerry::echo
