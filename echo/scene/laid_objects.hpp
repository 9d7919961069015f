// LaidObjects: what the chart has standing on land and in the water, laid into a plane.
#pragma once

#include <memory>
#include <vector>

#include "echo/chart/chart_object.hpp"
#include "echo/chart/local_plane.hpp"
#include "echo/scene/beacons.hpp"
#include "echo/scene/structures.hpp"

namespace skerry::echo {

// An object of one vertex is a point, of more a chain of walls from its base (a bridge's clearance,
// else the water) to its height; closed where the object is and has at least three.
// Thread: immutable.
class LaidObjects {
 public:
  // Heights, clearances and cross-sections below 0 count as 0, a clearance over the height as it.
  // Error: std::invalid_argument, naming the object, for what is no number or off the globe.
  LaidObjects(const std::vector<ChartObject>& objects, const LocalPlane& plane);

  // All walls and points within `reach_m` of `centre`, in the order of the chart; null where there
  // are none.
  std::shared_ptr<const Structures> within(PlanePoint centre, double reach_m) const;
  // The charted racons there: what the chart says of them, all else as Racon has it.
  std::vector<Racon> racons_within(PlanePoint centre, double reach_m) const;

 private:
  Structures all_;
  std::vector<Racon> racons_;
};

}  // namespace skerry::echo
