// Target kinds: what is meant by a buoy, a reflector or a small craft.
#pragma once

#include <string>

#include "server/world/scenario.pb.h"

namespace skerry::server {

// Height over the water and cross-section of a target smaller than the radar can resolve.
struct KindSize {
  double height_m;
  double x_band_m2, s_band_m2;
  scenario::Target::Fluctuation fluctuation;
};

// Requires a kind other than `ship`.
// Source: the rows of MSC.192(79) Table 2 and its footnotes on cross-section, the latter as
// reported by others (SOURCES.md "Rules"); MSC.164(78) for the reflector.  Fluctuation is this
// project's choice.
KindSize size_of(scenario::Target::Kind kind);

// Sets what the file has not given of a target other than a ship: `height_given` says whether it
// has the height.
void fill_in_size(scenario::Target& target, bool height_given);

// "buoy", "reflector_buoy", ...
std::string name_of(scenario::Target::Kind kind);

}  // namespace skerry::server
