#include "echo/chart/gdal/s57/object_defaults.hpp"

#include <array>

namespace skerry::echo {
namespace {

struct Row {
  std::string_view object_class;
  int category;  // 0: any other
  ObjectDefault is;
};

namespace rows {

using enum ObjectClass;

// A class's rows by category first, its row for all others last.
constexpr std::array kRows = {
    // Buoys by BOYSHP: a big one of typical size, a small one as a channel marker.
    Row{"BOY", 4, {buoy, 3.5f, 5.0f}},   // pillar
    Row{"BOY", 5, {buoy, 2.5f, 1.0f}},   // spar
    Row{"BOY", 6, {buoy, 1.0f, 1.0f}},   // barrel
    Row{"BOY", 7, {buoy, 5.0f, 30.0f}},  // superbuoy
    Row{"BOY", 0, {buoy, 3.5f, 5.0f}},   // conical, can, spherical, ice buoy, not charted
    Row{"BOYSPP", 4, {buoy, 3.5f, 5.0f}},
    Row{"BOYSPP", 7, {buoy, 5.0f, 30.0f}},
    Row{"BOYSPP", 0, {buoy, 1.0f, 1.0f}},  // swimming, speed limit, mooring
    Row{"LITFLT", 0, {buoy, 8.0f, 100.0f}},
    Row{"LITVES", 0, {buoy, 12.0f, 1000.0f}},
    // Beacons by BCNSHP.
    Row{"BCN", 1, {beacon, 3.0f, 1.0f}},    // stake, pole, perch
    Row{"BCN", 2, {beacon, 2.0f, 0.5f}},    // withy
    Row{"BCN", 3, {beacon, 10.0f, 50.0f}},  // tower
    Row{"BCN", 4, {beacon, 8.0f, 30.0f}},   // lattice
    Row{"BCN", 5, {beacon, 5.0f, 10.0f}},   // piles
    Row{"BCN", 6, {beacon, 3.0f, 3.0f}},    // cairn
    Row{"BCN", 7, {beacon, 3.0f, 2.0f}},    // buoyant
    Row{"BCN", 0, {beacon, 4.0f, 3.0f}},
    // Landmarks by CATLMK.
    Row{"LNDMRK", 1, {landmark, 3.0f, 3.0f}},       // cairn
    Row{"LNDMRK", 3, {landmark, 50.0f, 300.0f}},    // chimney
    Row{"LNDMRK", 4, {landmark, 10.0f, 100.0f}},    // dish aerial
    Row{"LNDMRK", 5, {landmark, 10.0f, 1.0f}},      // flagstaff
    Row{"LNDMRK", 6, {landmark, 40.0f, 100.0f}},    // flare stack
    Row{"LNDMRK", 7, {landmark, 40.0f, 30.0f}},     // mast
    Row{"LNDMRK", 9, {landmark, 15.0f, 50.0f}},     // monument
    Row{"LNDMRK", 12, {landmark, 15.0f, 50.0f}},    // obelisk
    Row{"LNDMRK", 13, {landmark, 6.0f, 10.0f}},     // statue
    Row{"LNDMRK", 14, {landmark, 6.0f, 3.0f}},      // cross
    Row{"LNDMRK", 15, {landmark, 25.0f, 500.0f}},   // dome
    Row{"LNDMRK", 17, {landmark, 30.0f, 300.0f}},   // tower
    Row{"LNDMRK", 18, {landmark, 20.0f, 100.0f}},   // windmill
    Row{"LNDMRK", 19, {landmark, 80.0f, 1000.0f}},  // wind turbine
    Row{"LNDMRK", 20, {landmark, 35.0f, 100.0f}},   // spire
    Row{"LNDMRK", 21, {rock, 3.0f, 20.0f}},         // large rock
    Row{"LNDMRK", 0, {landmark, 20.0f, 100.0f}},
    Row{"PYLONS", 0, {landmark, 30.0f, 100.0f}},
    Row{"CRANES", 0, {landmark, 30.0f, 300.0f}},
    Row{"SILTNK", 0, {building, 12.0f, 300.0f}},
    Row{"BUISGL", 0, {building, 8.0f, 100.0f}},
    Row{"FORSTC", 0, {building, 8.0f, 300.0f}},
    Row{"OFSPLF", 0, {building, 25.0f, 5000.0f}},
    // Shoreline constructions by CATSLC; heights over high water.
    Row{"SLCONS", 1, {breakwater, 2.5f, 10.0f}},
    Row{"SLCONS", 2, {breakwater, 1.0f, 3.0f}},  // groyne
    Row{"SLCONS", 3, {pier, 2.5f, 10.0f}},       // mole
    Row{"SLCONS", 4, {pier, 2.0f, 10.0f}},       // pier, jetty
    Row{"SLCONS", 5, {pier, 4.0f, 20.0f}},       // promenade pier
    Row{"SLCONS", 6, {pier, 2.5f, 20.0f}},       // wharf, quay
    Row{"SLCONS", 7, {breakwater, 1.0f, 3.0f}},  // training wall
    Row{"SLCONS", 8, {breakwater, 1.5f, 3.0f}},  // rip rap
    Row{"SLCONS", 9, {breakwater, 1.5f, 3.0f}},  // revetment
    Row{"SLCONS", 10, {pier, 2.0f, 10.0f}},      // sea wall
    Row{"SLCONS", 11, {pier, 1.0f, 3.0f}},       // landing steps
    Row{"SLCONS", 12, {pier, 0.5f, 1.0f}},       // ramp
    Row{"SLCONS", 13, {pier, 0.5f, 1.0f}},       // slipway
    Row{"SLCONS", 14, {pier, 1.5f, 3.0f}},       // fender
    Row{"SLCONS", 15, {pier, 2.5f, 20.0f}},      // wharf with a solid face
    Row{"SLCONS", 16, {pier, 2.5f, 10.0f}},      // open wharf
    Row{"SLCONS", 0, {pier, 2.0f, 5.0f}},
    // Bridges: from the clearance up, so much (bridge_faces in s57_objects.cpp).
    Row{"BRIDGE", 6, {bridge, 2.0f, 0.0f}},   // pontoon bridge
    Row{"BRIDGE", 9, {bridge, 1.5f, 0.0f}},   // footbridge
    Row{"BRIDGE", 12, {bridge, 6.0f, 0.0f}},  // suspension
    Row{"BRIDGE", 0, {bridge, 3.0f, 0.0f}},
    Row{"CONVYR", 0, {bridge, 3.0f, 0.0f}},
    // Afloat.
    Row{"PONTON", 0, {pontoon, 0.8f, 3.0f}},
    Row{"HULKES", 0, {pontoon, 4.0f, 100.0f}},
    Row{"FLODOC", 0, {pontoon, 10.0f, 1000.0f}},
    // Posts.
    Row{"PILPNT", 0, {pile, 2.0f, 1.0f}},
    Row{"MORFAC", 1, {pile, 3.0f, 5.0f}},  // dolphin
    Row{"MORFAC", 2, {pile, 3.0f, 5.0f}},  // deviation dolphin
    Row{"MORFAC", 3, {pile, 0.5f, 0.3f}},  // bollard
    Row{"MORFAC", 4, {pier, 2.0f, 5.0f}},  // tie-up wall
    Row{"MORFAC", 5, {pile, 2.0f, 1.0f}},  // post or pile
    Row{"MORFAC", 7, {buoy, 1.0f, 1.0f}},  // mooring buoy
    // Rocks that stand out of the water (WATLEV), and islets charted as points.
    Row{"UWTROC", 0, {rock, 1.0f, 3.0f}},
    Row{"OBSTRN", 0, {rock, 0.5f, 1.0f}},
    Row{"WRECKS", 0, {rock, 2.0f, 30.0f}},
    Row{"LNDARE", 0, {rock, 2.0f, 20.0f}},
    Row{"RADRFL", 0, {reflector, kReflectorHeight, kReflectorCrossSection}},
    Row{"RTPBCN", 0, {racon, 5.0f, 0.0f}},
};

}  // namespace rows

// The rows of BOY and BCN stand for all classes of buoys and beacons that have none of their own.
std::string_view row_name(std::string_view object_class) {
  if (object_class == "BOYSPP") return object_class;
  if (object_class.starts_with("BOY")) return "BOY";
  if (object_class.starts_with("BCN")) return "BCN";
  return object_class;
}

}  // namespace

std::optional<ObjectDefault> default_of(std::string_view object_class, int category) {
  const std::string_view name = row_name(object_class);
  std::optional<ObjectDefault> any;
  for (const Row& row : rows::kRows) {
    if (row.object_class != name) continue;
    if (row.category == category) return row.is;
    if (row.category == 0) any = row.is;
  }
  return any;
}

std::string_view category_attribute(std::string_view object_class) {
  if (object_class.starts_with("BOY")) return "BOYSHP";
  if (object_class.starts_with("BCN")) return "BCNSHP";
  if (object_class == "LNDMRK") return "CATLMK";
  if (object_class == "SLCONS") return "CATSLC";
  if (object_class == "BRIDGE") return "CATBRG";
  if (object_class == "MORFAC") return "CATMOR";
  return {};
}

CoastType type_of_coastline(int catcoa) {
  switch (catcoa) {
    case 1:   // steep coast
    case 4:   // stony shore
    case 6:   // glacier, seaward end
    case 10:  // ice coast
      return CoastType::rocky;
    case 2:   // flat coast
    case 3:   // sandy shore
    case 5:   // shingly shore
    case 7:   // mangrove
    case 8:   // marshy shore
    case 9:   // coral reef
    case 11:  // shelly shore
      return CoastType::sandy;
    default:
      return CoastType::unknown;
  }
}

CoastType type_of_surface(int natsur) {
  switch (natsur) {
    case 1:   // mud
    case 2:   // clay
    case 3:   // silt
    case 4:   // sand
    case 6:   // gravel
    case 7:   // pebbles
    case 14:  // coral
    case 17:  // shells
      return CoastType::sandy;
    case 5:   // stone
    case 8:   // cobbles
    case 9:   // rock
    case 11:  // lava
    case 18:  // boulders
      return CoastType::rocky;
    default:
      return CoastType::unknown;
  }
}

CoastType type_of_region(int catlnd) {
  switch (catlnd) {
    case 2:   // marsh
    case 12:  // swamp
    case 20:  // cay
      return CoastType::sandy;
    case 14:  // lava flow
    case 19:  // rock or pinnacle
      return CoastType::rocky;
    default:
      return CoastType::unknown;
  }
}

}  // namespace skerry::echo
