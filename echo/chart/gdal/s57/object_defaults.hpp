// How high things stand and how they echo where the chart does not say.
#pragma once

#include <optional>
#include <string_view>

#include "echo/chart/chart_object.hpp"
#include "echo/chart/coast_chart.hpp"

namespace skerry::echo {

// Charted heights above this, metres, are ignored.
inline constexpr double kGreatestHeight = 1000.0;

struct ObjectDefault {
  ObjectClass kind = ObjectClass::building;
  float height_m = 1.0f;          // of its top over the water, or over the ground it stands on
  float cross_section_m2 = 0.0f;  // of a point, X band
};

// Defaults by S-57 object class ("BOYLAT") and its category (BOYSHP, BCNSHP, CATLMK, CATSLC,
// CATBRG, CATMOR; 0: none charted).  nullopt for classes that do not stand out of the water.
//
// Source: only three rows rest on a document, MSC.192(79) table 2 (SOURCES.md "Rules"): a buoy
// with a corner reflector 3.5 m high, 10 m2; a typical buoy 3.5 m, 5 m2; a channel marker 1 m, 1
// m2. All other heights and cross-sections are this project's ASSUMPTIONS: usual sizes, and of the
// order of what such a shape returns between its strongest and weakest aspect.
std::optional<ObjectDefault> default_of(std::string_view object_class, int category);

// The attribute that holds an object class's category; empty: none.
std::string_view category_attribute(std::string_view object_class);

// With a radar reflector, or charted radar conspicuous: MSC.192(79) table 2.
inline constexpr float kReflectorCrossSection = 10.0f;
inline constexpr float kReflectorHeight = 3.5f;

// The shore's type by COALNE's CATCOA, and by NATSUR and CATLND of the ground along it.
CoastType type_of_coastline(int catcoa);
CoastType type_of_surface(int natsur);
CoastType type_of_region(int catlnd);

}  // namespace skerry::echo
