// CoastArea: a piece of the Earth between two parallels and two meridians.
#pragma once

#include <string>
#include <vector>

#include "protocol/quantity/geo_point.hpp"
#include "protocol/quantity/length.hpp"

namespace skerry::echo {

struct CoastArea {
  std::string name;
  double south_deg = 0.0, north_deg = 0.0;
  double west_deg = 0.0, east_deg = 0.0;  // east of west by less than 180; may be over 180

  GeoPoint centre() const;
  Length radius() const;  // to the farthest corner from the centre, and a little more
  bool contains(GeoPoint point) const;
  std::string limits() const;  // "60.00..60.60 N, 4.60..5.60 E"
};

// An area no larger than this across can be laid into one plane (local_plane.hpp).
inline constexpr double kMostRadiusNm = 200.0;

// "lat1,lon1,lat2,lon2", degrees, two opposite corners in any order; the area is the one between
// them that is less than 180 degrees wide.
// Error: std::invalid_argument saying which part is wrong and what was expected.
CoastArea parse_area(const std::string& text);

// `area` itself.  Error: std::invalid_argument, after `what`, for one that spans nothing or is
// larger than a plane.
CoastArea checked(const CoastArea& area, const std::string& what);

// "bergen", "plymouth", "dalian", "solent", "vaettern".  Error: std::invalid_argument that lists
// them.
CoastArea named_place(const std::string& name);
std::vector<std::string> place_names();

}  // namespace skerry::echo
