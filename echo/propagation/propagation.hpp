// Propagation: what lies between the antenna and an echo, as a factor on its power.
#pragma once

#include <memory>

#include "echo/propagation/path_table.hpp"
#include "echo/radar/radar_set.hpp"
#include "echo/scene/weather.hpp"

namespace skerry::echo {

// Tables over range and height, made once per radar and weather and shared by radars that have the
// same (path_table_for).  Immutable; any thread.
//
// Error of point() and body() against the double references from 100 m to reach and 0.25 to 500 m,
// where they are above -120 dB, in dB two-way.  In nulls of the lobes deeper than kNullDepth the
// power itself is off by kNullBound at most; nulls stand within 2e-3 of a lobe of their place.
// Held by PathTable.PointsStayWithinTheirBoundOfTheReference, ...BodiesStay..., ...NullsStand...
struct PropagationBound {
  double p50_db, p99_db, max_db;
};
inline constexpr PropagationBound kPointBound{0.005, 0.25, 1.5};
inline constexpr PropagationBound kBodyBound{0.05, 0.3, 1.0};
inline constexpr double kNullDepth = 1e-3, kNullBound = 5e-4;

class Propagation {
 public:
  // `wave_height_m`: significant, roughens the sea's reflection.  `reach_m`: farthest range asked
  // for.  Requires a set that passes its checks, k from 0.8 to 4, ducting from 0 to 1.
  Propagation(const RadarSet& set, const Atmosphere& atmosphere, double wave_height_m,
              double reach_m);

  // Two-way power factor of a point target, `height_m` over the water, in (0, 16]: two-ray lobing
  // with roughness within the horizon, diffraction beyond, gas (path_terms.hpp).  1 in free space.
  float point(double range_m, double height_m) const;
  // The same one way, for racons, SARTs and other radars: its square root in power.
  float one_way(double range_m, double height_m) const;
  // Two-way power factor of a body that reaches from the water up to `height_m`: the mean of
  // point() over its height.
  float body(double range_m, double height_m) const;
  // Two-way power factor of gas alone, for surfaces, whose sigma0 holds the rest.
  float gas(double range_m) const;
  // Height that the Earth hides at that range, metres; a duct takes its share away.
  double hidden_height(double range_m) const;
  double horizon_m() const;          // of the antenna over the sea
  double effective_earth_m() const;  // k times the Earth's radius

 private:
  PathConditions conditions_;
  std::shared_ptr<const PathTable> table_;
};

}  // namespace skerry::echo
