// Propagation: what lies between the antenna and an echo, as a factor on its power.
#pragma once

#include <cstdint>
#include <vector>

#include "echo/radar/radar_set.hpp"
#include "echo/scene/weather.hpp"

namespace skerry::echo {

// Tables over range and height, made once per radar and weather.  Immutable; any thread.
class Propagation {
 public:
  // `wave_height_m`: significant, roughens the sea's reflection.  `reach_m`: farthest range asked
  // for.
  Propagation(const RadarSet& set, const Atmosphere& atmosphere, double wave_height_m,
              double reach_m);

  // Two-way power factor of a point target, `height_m` over the water, in (0, 16]: two-ray lobing
  // with roughness within the horizon, diffraction beyond, gas.  1 in free space.
  float point(double range_m, double height_m) const;
  // The same one way, for racons, SARTs and other radars: its square root in power.
  float one_way(double range_m, double height_m) const;
  // Two-way power factor of a body that reaches from the water up to `height_m`: the mean of
  // point() over its height.
  float body(double range_m, double height_m) const;
  // Two-way power factor of gas alone, for surfaces, whose sigma0 holds the rest.
  float gas(double range_m) const;
  // Grazing angle of the sea at that range, radians, 0 beyond the horizon.
  double grazing(double range_m) const;
  // Height that the Earth hides at that range, metres.
  double hidden_height(double range_m) const;
  double horizon_m() const;          // of the antenna over the sea
  double effective_earth_m() const;  // k times the Earth's radius

 private:
  RadarSet set_;
  Atmosphere atmosphere_;
  // Owner: adds tables as needed.
};

}  // namespace skerry::echo
