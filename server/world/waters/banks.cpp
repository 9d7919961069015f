#include "server/world/waters/banks.hpp"

#include <algorithm>
#include <cmath>

#include "echo/kernel/exact_math.hpp"
#include "server/world/ship_units.hpp"
#include "server/world/short_way.hpp"

namespace skerry::server {
namespace {

constexpr double kSame_m = 1e-6;

double east_of(GeoPoint from, GeoPoint to) {
  return wrapped_longitude(to.longitude_deg - from.longitude_deg);
}

}  // namespace

Banks::Banks(const scenario::Scenario& scenario) {
  for (const scenario::Bank& bank : scenario.banks()) {
    Line line;
    line.name = bank.name().empty() ? "the bank" : bank.name();
    for (const scenario::Position& point : bank.line()) line.points.push_back(geo_point(point));
    line.south = line.north = line.points.front().latitude_deg;
    for (const GeoPoint point : line.points) {
      const double east = east_of(line.points.front(), point);
      line.south = std::min(line.south, point.latitude_deg);
      line.north = std::max(line.north, point.latitude_deg);
      line.west = std::min(line.west, east);
      line.east = std::max(line.east, east);
    }
    lines_.push_back(std::move(line));
  }
}

bool Banks::may_reach(const Line& line, GeoPoint at, double reach_m) {
  const double degrees = reach_m / kLeastDegree_m;
  if (at.latitude_deg < line.south - degrees || at.latitude_deg > line.north + degrees) {
    return false;
  }
  const double shrinks = echo::sin_cos_degrees(at.latitude_deg).cos;
  const double east = east_of(line.points.front(), at);
  return east * shrinks >= line.west * shrinks - degrees &&
         east * shrinks <= line.east * shrinks + degrees;
}

std::vector<NearWall> Banks::near(GeoPoint at, double reach_m) const {
  std::vector<NearWall> all;
  for (const Line& line : lines_) {
    if (!may_reach(line, at, reach_m)) continue;
    PlanePoint from = plane_way_between(at, line.points.front());
    for (std::size_t i = 1; i < line.points.size(); ++i) {
      const PlanePoint to = plane_way_between(at, line.points[i]), part = to - from;
      const double along = std::clamp(-dot(from, part) / dot(part, part), 0.0, 1.0);
      const PlanePoint way = from + part * along;
      const double square = dot(way, way);
      if (square < reach_m * reach_m && square > kSame_m * kSame_m) {
        const bool is_beyond = along == 0.0 || along == 1.0;
        const double aside = cross(part, way);
        all.push_back(
            {way, std::sqrt(square), is_beyond ? aside * aside / (dot(part, part) * square) : 1.0});
      }
      from = to;
    }
  }
  std::stable_sort(all.begin(), all.end(), [](const NearWall& a, const NearWall& b) {
    return a.distance_m < b.distance_m;
  });
  return all;
}

const std::string* Banks::touched_by(GeoPoint at, const HullOutline& hull) const {
  double reach_m = 0.0;
  for (const PlanePoint corner : hull) reach_m = std::max(reach_m, length_of(corner));
  for (const Line& line : lines_) {
    if (!may_reach(line, at, reach_m)) continue;
    PlanePoint from = plane_way_between(at, line.points.front());
    for (std::size_t i = 1; i < line.points.size(); ++i) {
      const PlanePoint to = plane_way_between(at, line.points[i]);
      // An outline without an inside.
      if (outlines_touch(hull, {from, to, to, to, from}, {})) return &line.name;
      from = to;
    }
  }
  return nullptr;
}

}  // namespace skerry::server
