// Association: which AIS target is which tracked target.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "protocol/quantity/geo_point.hpp"
#include "protocol/quantity/speed.hpp"

namespace skerry::server {

// A target as the radar, or AIS, has it.
struct MovingTarget {
  PlanePoint place;                      // from own ship, m
  std::optional<PlanePoint> motion_mps;  // over ground; absent: not known yet, or not told
};

// What two that are one may differ by.  Source: what is usual in other makers' displays; no
// standard is known to give numbers.
struct AssociationGates {
  double place_m = 0.5 * 1852.0;
  double course_deg = 15.0;
  double speed_mps = 2.0 * kKnot;  // slower ones have no course worth comparing
};
inline constexpr double kDissolvesAt = 1.5;  // of the gates

// By place and motion.  One that the radar does not know the motion of yet, by its place alone; one
// that AIS tells no motion of, never once the radar does.
bool is_same_target(const MovingTarget& tracked, const MovingTarget& ais,
                    const AssociationGates& gates, double factor);

// For each tracked target the AIS target that it is.  `before`: for each tracked one what it was;
// those stay until they differ by kDissolvesAt.  The others pair the nearest first, each at most
// once.  `widened`: 1 to 3.
using Partners = std::vector<std::optional<std::size_t>>;
Partners associate(std::span<const MovingTarget> tracked, std::span<const MovingTarget> ais,
                   const Partners& before, const AssociationGates& gates, double widened);

}  // namespace skerry::server
