// What the banks near a ship do to her.
#pragma once

#include "protocol/quantity/geo_point.hpp"
#include "server/world/handling/bank_load.hpp"
#include "server/world/waters/banks.hpp"

namespace skerry::server {

// Every part of a bank acts as a straight wall (wall_pull()), and on each side of her the one that
// pulls the most acts alone; the two sides add up.  A wall that is not parallel to her, or ends,
// pulls less: by the square of the cosine of the angle between her heading and the wall, and by
// NearWall::share.  So nothing jumps, wherever she goes.
// Assumed: these squares; that a short wall is as good as a long one; and that two banks do not
// mirror one another.
// Cost: 1 us or 2 beside a bank; less than 0.1 us where all are farther than her reach.
BankPull pull_of(const Banks& banks, const BankShape& shape, GeoPoint at, double heading_deg,
                 double depth_m);

}  // namespace skerry::server
