// Indirect echoes: by way of own ship's obstructions, and by way of bridges.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "echo/artefacts/multiple_echoes.hpp"

namespace skerry::echo {

// How one obstruction throws what comes from one target.
struct Detour {
  double ratio = 0.0;     // one way, of the power that goes straight
  double off_rad = 0.0;   // bearing it comes from, clockwise from the obstruction's middle
  double longer_m = 0.0;  // one way, than straight
};

// A round mast of width w at distance d throws a wave of spherical front into the angle `turn_rad`
// (between the directions from mast to antenna and from mast to target, clockwise from above):
//   ratio = rho^2 r / (d + r), r = (w / 4) cos(turn / 2): the radius of the reflected front,
// rho the voltage reflectivity, d the way to the point of the mast that mirrors, on whose bearing
// it comes in. Source: geometrical optics of a cylinder (radii of reflected fronts d and (1/d +
// 2/(a cos))^-1). Error: good for masts wider than a wavelength; the antenna is taken as a point.
Detour detour_by(const Obstruction& obstruction, double target_range_m, double off_bow_rad);

// Echoes of `strong` by way of each obstruction whose bearing lies within `where`: out and back the
// same way, so weaker by the square of the ratio, at the obstruction's bearing, fixed to the ship.
// Points of all round must be in `strong`.  `bow_units`: from the plane's north.
// The first OwnShipGain::kMostObstructions count.
void add_indirect_echoes(const Scene& scene, std::uint32_t bow_units, const BearingSpan& where,
                         std::span<const PointEcho> strong, std::vector<PointEcho>& out);

// A bridge again at 2, 3 .. kMostTrips times its range, as multiple_echoes.hpp has it for ships: a
// bridge returns 0 dB of the height and arc it shows (SOURCES.md "Land"), what the beam holds of it
// goes to and fro.  Points on bearings half a beam apart, the same for every sector, to
// kBridgeReach; at most kMostBridges walls. Error: land before a bridge does not hide it here; both
// legs are taken as equally long.
inline constexpr double kBridgeReach = 1000.0;  // metres
inline constexpr std::size_t kMostBridges = 16;
void add_bridge_echoes(const RadarModel& model, const Scene& scene, const SpokeAim& aim,
                       const BearingSpan& where, std::vector<PointEcho>& out);

}  // namespace skerry::echo
