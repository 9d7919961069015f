// ChartObject: something charted that echoes by itself.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "protocol/quantity/geo_point.hpp"

namespace skerry::echo {

enum class ObjectClass : std::uint8_t {
  pier,        // SLCONS drawn as a line, or as an area that is not land: mole, jetty, wharf ...
  breakwater,  // the same of loose rock
  bridge,      // BRIDGE: a span over the water
  pontoon,     // PONTON
  pile,        // PILPNT and single posts
  building,    // BUISGL
  landmark,    // LNDMRK: mast, chimney, tower ...
  buoy,        // BOYLAT, BOYCAR ...
  beacon,      // BCNLAT ...
  rock,        // UWTROC and obstructions that stand out of the water
  reflector,   // RADRFL, and buoys charted radar conspicuous
  racon,       // RTPBCN
  craft,       // moored craft, made up where a chart has berths (moored_craft.hpp)
};

// A point, a wall (an open line of vertical faces) or a block (a closed one).
struct ChartObject {
  ObjectClass kind = ObjectClass::buoy;
  std::string name;               // OBJNAM, may be empty
  std::vector<GeoPoint> outline;  // 1 vertex: a point; 2 or more: a line
  bool closed = false;            // the last vertex joins the first
  float height_m = 1.0f;          // over the water
  float clearance_m = 0.0f;       // of a bridge: the face begins so high over the water
  float cross_section_m2 = 1.0f;  // of a point, X band; 0: echoes as a face only
  std::string racon_code;         // Morse letters, e.g. "Q"; empty: no racon
  std::uint64_t identity = 0;     // from class and integer chart coordinates
};

}  // namespace skerry::echo
