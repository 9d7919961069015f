// FarCoast: land beyond the range scale, coarsely, for its second trace.
#pragma once

#include <cstdint>
#include <vector>

#include "echo/propagation/propagation.hpp"
#include "echo/radar/radar_model.hpp"
#include "echo/scene/coast_picture.hpp"
#include "echo/targets/point_echo.hpp"

namespace skerry::echo {

// Echoes of a coast from beyond the unambiguous range, as points half a beam apart: of each
// such bearing the nearest shore that lies beyond, taken as a face `height_m` high.  Shadows of
// nearer land and of one shore by another are left out; only what stands out of the noise is made.
// The picture must reach that far: to 54 NM for a second trace at 3000 Hz.  Coarse on purpose: such
// echoes come with ducts and are diffuse.
struct FarCoast {
  double height_m = 60.0;   // over the water: 1 to 3000
  double gamma_db = -8.0;   // as of rocky shore (SOURCES.md "Land")
  double nearest_m = 0.0;   // 0: the unambiguous range
  double farthest_m = 0.0;  // 0: farthest_trace()
};

// Appends to `points`.  Ranges and bearings are the true ones; fold_second_trace() does the rest.
// Cost: one pass over the picture's vertices; a coast changes slowly, so once a second is enough.
void far_coast_points(const RadarModel& model, const Propagation& propagation,
                      const CoastPicture& coast, PlanePoint own_ship, const FarCoast& far,
                      std::vector<PointEcho>& points);

}  // namespace skerry::echo
