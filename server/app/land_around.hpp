// LandAround: the land around a place, for many questions.
#pragma once

#include "echo/chart/chart_source.hpp"
#include "echo/chart/land_lookup.hpp"

namespace skerry::server {

// The chart's land, before it is refined.  Thread: immutable.
class LandAround {
 public:
  // Error: as ChartSource::load().
  LandAround(const echo::ChartSource& chart, GeoPoint centre, double radius_m);
  // Of a chart that was loaded for that circle.
  LandAround(echo::CoastChart chart, GeoPoint centre, double radius_m);
  LandAround(const LandAround&) = delete;
  LandAround& operator=(const LandAround&) = delete;
  bool is_land(GeoPoint place) const { return lookup_.is_land(place); }

 private:
  echo::CoastChart chart_;
  echo::LandLookup lookup_;
};

}  // namespace skerry::server
