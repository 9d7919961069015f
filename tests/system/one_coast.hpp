// The coast of a chart as places on Earth, and where a radar anywhere should see it.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "echo/returns/coast_crossings.hpp"
#include "echo/scene/coast_picture.hpp"
#include "protocol/video/spoke.hpp"

namespace skerry::system_test {

// Places on Earth, joined to runs.
struct CoastOnEarth {
  std::vector<GeoPoint> vertices;
  std::vector<std::uint32_t> run_starts;
};

CoastOnEarth on_earth(const echo::CoastPicture& picture);

// That coast in a plane of the own ship's own.
class CoastSeenFrom {
 public:
  // Good while the own ship is within `slack_m` of `own_ship`.
  CoastSeenFrom(const CoastOnEarth& coast, GeoPoint own_ship, double slack_m);

  // The range of the first shore on that bearing, metres; infinite if there is none.
  double first_shore(GeoPoint own_ship, TrueBearing bearing) const;
  // From the place to the nearest point of the coast, if that is less than kReach.
  double distance(GeoPoint place) const;

  static constexpr double kReach = 200.0;  // metres

 private:
  using Square = std::pair<int, int>;  // of kReach by kReach metres
  static Square square_of(PlanePoint point);

  echo::CoastPicture picture_;
  echo::PolarIndex index_;
  std::vector<std::pair<Square, std::uint32_t>> edges_;  // first vertex of each edge, by square
};

}  // namespace skerry::system_test
