// From latitude and longitude to metres.
#include <GeographicLib/Geodesic.hpp>
#include <GeographicLib/LocalCartesian.hpp>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "echo/chart/local_plane.hpp"
#include "tests/bench/error/study.hpp"

namespace skerry::bench {
namespace {

PlanePoint by_geodesic(GeoPoint from, GeoPoint to) {
  double range = 0.0, azimuth = 0.0, back = 0.0;
  GeographicLib::Geodesic::WGS84().Inverse(from.latitude_deg, from.longitude_deg, to.latitude_deg,
                                           to.longitude_deg, range, azimuth, back);
  const double a = azimuth * std::numbers::pi / 180.0;
  return {range * std::sin(a), range * std::cos(a)};
}

// The sphere as a flat chart: what most simulators do.
PlanePoint by_flat_sphere(GeoPoint from, GeoPoint to) {
  constexpr double kPerDegree = 1852.0 * 60.0;
  const double cos_lat = std::cos(from.latitude_deg * std::numbers::pi / 180.0);
  return {wrapped_longitude(to.longitude_deg - from.longitude_deg) * kPerDegree * cos_lat,
          (to.latitude_deg - from.latitude_deg) * kPerDegree};
}

}  // namespace

std::vector<ErrorRow> study_projection(const ErrorStudy& study) {
  const echo::LocalPlane plane(study.own_ship);
  const GeographicLib::LocalCartesian tangent(study.own_ship.latitude_deg,
                                              study.own_ship.longitude_deg, 0.0);
  std::vector<GeoPoint> points;
  std::vector<PlanePoint> truth;
  for (const echo::CoastRing& ring : study.chart.rings) {
    for (const GeoPoint& p : ring.vertices) {
      const PlanePoint t = plane.to_plane(p);
      if (std::hypot(t.east_m, t.north_m) <= study.range_m) points.push_back(p);
    }
  }
  std::vector<ErrorRow> rows;
  const auto measure = [&](const char* setting, bool in_use, auto&& project) {
    study.progress(std::string("projection: ") + setting);
    ErrorRow row;
    row.knob = "projection";
    row.setting = setting;
    row.in_use = in_use;
    row.dimension = std::numeric_limits<double>::quiet_NaN();
    std::vector<PlanePoint> laid(points.size());
    const double seconds = median_seconds(study.repetitions, [&] {
      for (std::size_t i = 0; i < points.size(); ++i) laid[i] = project(points[i]);
    });
    if (truth.empty()) truth = laid;
    std::vector<double> errors;
    for (std::size_t i = 0; i < points.size(); ++i) {
      errors.push_back(
          std::hypot(laid[i].east_m - truth[i].east_m, laid[i].north_m - truth[i].north_m));
    }
    fill_errors(errors, row);
    row.microseconds_per_spoke = 1e6 * seconds / kStudySpokes;
    rows.push_back(row);
  };
  measure("geodesic of each vertex (reference)", false,
          [&](GeoPoint p) { return by_geodesic(study.own_ship, p); });
  measure("local plane", true, [&](GeoPoint p) { return plane.to_plane(p); });
  measure("tangent plane", false, [&](GeoPoint p) {
    PlanePoint out;
    double up = 0.0;
    tangent.Forward(p.latitude_deg, p.longitude_deg, 0.0, out.east_m, out.north_m, up);
    return out;
  });
  measure("flat sphere", false, [&](GeoPoint p) { return by_flat_sphere(study.own_ship, p); });
  return rows;
}

}  // namespace skerry::bench
