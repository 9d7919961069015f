// Is a place on land or afloat?
#pragma once

#include "echo/chart/coast_chart.hpp"

namespace skerry::echo {

// The winding number of the chart's rings around `place`: 1 on land, 0 on water (a lake's ring
// takes away what the land's ring around it gives); more than 1 where made-up islands overlap.
// Edges are taken as straight in latitude and longitude.  Any place on Earth; rings may lie across
// the antimeridian and around a pole.  Exact at vertices and on bin borders, where a place belongs
// to the side east and north of it.  At a shoreline it is either.  Only the coast within the
// chart's radius counts: a place farther out may be called water where it is land.
// Cost: about 2 ns per vertex of the chart.
//
// Source: Hormann and Agathos (2001), "The point in polygon problem for arbitrary polygons", with
// the ray running north along the place's meridian, so that no ring is cut by the antimeridian.
int winding_number(const CoastChart& chart, GeoPoint place);

inline bool is_land(const CoastChart& chart, GeoPoint place) {
  return winding_number(chart, place) > 0;
}

}  // namespace skerry::echo
