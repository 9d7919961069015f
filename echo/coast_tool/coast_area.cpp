#include "echo/coast_tool/coast_area.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <stdexcept>

#include "echo/chart/local_plane.hpp"

namespace skerry::echo {
namespace {

constexpr const char* kExpected =
    "expected two opposite corners in degrees, lat1,lon1,lat2,lon2, such as 60.0,4.6,60.6,5.6";

// Areas whose box-count dimensions are known, for comparison (SOURCES.md "Shorelines").
const std::array<CoastArea, 5>& places() {
  static const std::array<CoastArea, 5> all = {{
      {"bergen", 60.0, 60.6, 4.6, 5.6},
      {"plymouth", 50.15, 50.55, -4.6, -3.6},
      {"dalian", 38.7, 39.2, 121.0, 122.0},
      {"solent", 50.5, 50.95, -1.75, -0.9},
      {"vaettern", 57.7, 58.95, 14.0, 15.2},
  }};
  return all;
}

std::vector<double> numbers_in(const std::string& text) {
  std::vector<double> numbers;
  const char* at = text.c_str();
  while (true) {
    char* end = nullptr;
    numbers.push_back(std::strtod(at, &end));
    if (end == at || !std::isfinite(numbers.back()))
      throw std::invalid_argument(
          fmt::format("--area {}: number {} cannot be read; {}", text, numbers.size(), kExpected));
    if (*end == '\0') return numbers;
    if (*end != ',' || numbers.size() == 4)
      throw std::invalid_argument(fmt::format("--area {}: \"{}\" after number {}; {}", text, end,
                                              numbers.size(), kExpected));
    at = end + 1;
  }
}

std::string degrees_text(double a, double b, char positive, char negative) {
  const auto one = [&](double d) {
    return fmt::format("{:.6g} {}", std::fabs(d), d < 0.0 ? negative : positive);
  };
  if ((a < 0.0) == (b < 0.0))
    return fmt::format("{:.6g}..{}", std::fabs(a < 0.0 ? b : a), one(a < 0.0 ? a : b));
  return one(a) + ".." + one(b);
}

}  // namespace

GeoPoint CoastArea::centre() const {
  return {(south_deg + north_deg) / 2.0, wrapped_longitude((west_deg + east_deg) / 2.0)};
}

Length CoastArea::radius() const {
  const LocalPlane plane(centre());
  double farthest = 0.0;
  for (double latitude : {south_deg, north_deg}) {
    const PlanePoint p = plane.to_plane({latitude, wrapped_longitude(east_deg)});
    farthest = std::max(farthest, std::hypot(p.east_m, p.north_m));
  }
  return metres(farthest * 1.01 + 100.0);
}

bool CoastArea::contains(GeoPoint point) const {
  if (point.latitude_deg < south_deg || point.latitude_deg > north_deg) return false;
  double east = point.longitude_deg - west_deg;
  east -= 360.0 * std::floor(east / 360.0);
  return east <= east_deg - west_deg;
}

std::string CoastArea::limits() const {
  return degrees_text(south_deg, north_deg, 'N', 'S') + ", " +
         degrees_text(wrapped_longitude(west_deg), wrapped_longitude(east_deg), 'E', 'W');
}

CoastArea parse_area(const std::string& text) {
  const std::vector<double> n = numbers_in(text);
  if (n.size() != 4)
    throw std::invalid_argument(
        fmt::format("--area {}: {} numbers; {}", text, n.size(), kExpected));
  for (std::size_t i : {0u, 2u}) {
    if (std::fabs(n[i]) > 90.0)
      throw std::invalid_argument(fmt::format(
          "--area {}: latitude {} is not between -90 and 90; {}", text, n[i], kExpected));
    if (std::fabs(n[i + 1]) > 360.0)
      throw std::invalid_argument(fmt::format(
          "--area {}: longitude {} is not between -180 and 180; {}", text, n[i + 1], kExpected));
  }
  CoastArea area{"area", std::min(n[0], n[2]), std::max(n[0], n[2])};
  const double a = wrapped_longitude(n[1]), b = wrapped_longitude(n[3]);
  area.west_deg = std::min(a, b);
  area.east_deg = std::max(a, b);
  if (area.east_deg - area.west_deg > 180.0) {
    area.west_deg = std::max(a, b);
    area.east_deg = std::min(a, b) + 360.0;
  }
  return checked(area, fmt::format("--area {}", text));
}

CoastArea checked(const CoastArea& area, const std::string& what) {
  if (!(area.north_deg > area.south_deg) || !(area.east_deg > area.west_deg))
    throw std::invalid_argument(fmt::format("{}: the corners span no area; {}", what, kExpected));
  const bool wide = area.east_deg - area.west_deg >= 180.0;
  const double high = (area.north_deg - area.south_deg) * 60.0;
  const double radius =
      wide || high > 2.0 * kMostRadiusNm ? 1e9 : area.radius().in_nautical_miles();
  if (radius > kMostRadiusNm)
    throw std::invalid_argument(fmt::format(
        "{}: {} reaches farther than {:.0f} NM from its middle and cannot be laid into one plane. "
        "Take a smaller area (--area lat1,lon1,lat2,lon2)",
        what, area.limits(), kMostRadiusNm));
  return area;
}

CoastArea named_place(const std::string& name) {
  std::string lower = name;
  for (char& c : lower) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  for (const CoastArea& place : places()) {
    if (place.name == lower) return place;
  }
  throw std::invalid_argument(fmt::format(
      "--place {}: no such place; known are {}. Any other coast: --area lat1,lon1,lat2,lon2", name,
      fmt::join(place_names(), ", ")));
}

std::vector<std::string> place_names() {
  std::vector<std::string> names;
  for (const CoastArea& place : places()) names.push_back(place.name);
  return names;
}

}  // namespace skerry::echo
