// Which land cover the properties of a GeoJSON or Shapefile feature name.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "echo/chart/land_cover.hpp"

namespace skerry::echo {

// The cover with that name of ours: built_up, forest ...
std::optional<LandCover> cover_named(std::string_view name);

// What OpenStreetMap's keys make of an area.
struct TaggedCover {
  LandCover cover = LandCover::none;
  std::string tag;     // "landuse=forest", for reports; empty: no key of these at all
  bool land = false;   // the tag says no more than that it is land
  bool known = false;  // cover or land
};
// `value` gives the property of that name, in lower case; empty: none.  The first key that says
// something rules: aeroway, building, natural (wetland with it), landuse, leisure.
TaggedCover cover_tagged(const std::function<std::string(const char*)>& value);

}  // namespace skerry::echo
