// FishingLegs: to and fro over a ground, at trawling speed.
#pragma once

#include <cstdint>

#include "protocol/quantity/geo_point.hpp"

namespace skerry::server {

struct FishingOrder {
  double course_deg = 0.0;
  double speed_mps = 0.0;
};

// Legs of 5 to 20 minutes at 2.5 to 4 kn, their courses by chance but into the circle: near its
// edge she turns back towards the middle.  All follows from the seed and where she is.
// A copy is a snapshot.
class FishingLegs {
 public:
  FishingLegs(GeoPoint middle, double radius_m, std::uint64_t seed);

  // `circle_m`: across the circle that she turns in.
  FishingOrder steer(GeoPoint position, double now_s, double circle_m);
  void work_round(GeoPoint middle) { middle_ = middle; }

 private:
  void begin_leg(double to_middle_deg, bool at_edge, double now_s);

  GeoPoint middle_;
  double radius_m_;
  std::uint64_t seed_;
  std::uint64_t leg_ = 0;
  double until_s_ = -1.0;
  bool was_at_edge_ = false;
  FishingOrder order_;
};

}  // namespace skerry::server
