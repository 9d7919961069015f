#include "echo/chart/gdal/polygons/laid_ring.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "echo/chart/gdal/chart_sheet.hpp"

namespace skerry::echo {
namespace {

constexpr double kDoubtful = 270.0;  // degrees: as written; 90 the other way

void append(std::vector<OGRRawPoint>& laid, double x, double y) {
  if (laid.empty() || laid.back().x != x || laid.back().y != y) laid.emplace_back(x, y);
}

double twice_laid_area(const std::vector<OGRRawPoint>& laid) {
  double sum = 0.0;
  for (std::size_t i = 0, n = laid.size(); i < n; ++i) {
    const OGRRawPoint &a = laid[i], &b = laid[i + 1 == n ? 0 : i + 1], &o = laid[0];
    sum += (a.x - o.x) * (b.y - o.y) - (b.x - o.x) * (a.y - o.y);
  }
  return sum;
}

// A ring that goes around by `turn`, -360 or 360 degrees: begun where it crosses the antimeridian
// nearest to the pole, so that the way to the pole crosses it nowhere.
std::vector<OGRRawPoint> by_way_of_pole(const std::vector<GeoPoint>& places, double turn,
                                        double pole) {
  const std::size_t n = places.size();
  std::size_t after = 0;
  double from = -pole;
  for (std::size_t i = 0; i < n; ++i) {
    const GeoPoint a = places[i], b = places[i + 1 == n ? 0 : i + 1];
    const double run = wrapped_longitude(b.longitude_deg - a.longitude_deg);
    const double end = a.longitude_deg + run;
    if (end < 180.0 && end >= -180.0) continue;
    const double margin = end < -180.0 ? -180.0 : 180.0;
    const double t = run == 0.0 ? 0.0 : (margin - a.longitude_deg) / run;
    const double crossing = a.latitude_deg + t * (b.latitude_deg - a.latitude_deg);
    if ((pole > 0.0) == (crossing > from)) {
      from = std::round(crossing * kStepsPerDegree) / kStepsPerDegree;
      after = i + 1;
    }
  }
  std::vector<OGRRawPoint> laid;
  double x = turn > 0.0 ? -180.0 : 180.0;
  append(laid, x, from);
  for (std::size_t i = 0; i < n; ++i) {
    const GeoPoint p = places[(after + i) % n];
    x = near_to(x, p.longitude_deg);
    append(laid, x, p.latitude_deg);
  }
  append(laid, laid.front().x + turn, from);
  append(laid, laid.front().x + turn, pole);
  append(laid, laid.front().x, pole);
  return laid;
}

}  // namespace

double near_to(double x, double longitude) {
  const double turns = std::round((x - longitude) / 360.0);
  return turns == 0.0 ? longitude : longitude + 360.0 * turns;
}

std::vector<OGRRawPoint> laid_ring(const std::vector<GeoPoint>& places, std::string& fault,
                                   std::string& doubt) {
  std::vector<OGRRawPoint> laid;
  bool full_turn = false;
  double x = places.front().longitude_deg, south = 90.0, north = -90.0, longest = 0.0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const GeoPoint p = places[i], before = places[i == 0 ? places.size() - 1 : i - 1];
    const double step = std::abs(p.longitude_deg - before.longitude_deg);
    full_turn = full_turn || step == 360.0;
    if (step > 180.0 && step <= kDoubtful) longest = std::max(longest, step);
    x = near_to(x, p.longitude_deg);
    append(laid, x, p.latitude_deg);
    south = std::min(south, p.latitude_deg);
    north = std::max(north, p.latitude_deg);
  }
  const double turn = near_to(x, places.front().longitude_deg) - laid.front().x;
  while (turn == 0.0 && laid.size() > 1 && laid.back().x == laid.front().x &&
         laid.back().y == laid.front().y)
    laid.pop_back();
  if (full_turn && (turn != 0.0 || laid.size() < 3 || twice_laid_area(laid) == 0.0)) {
    laid.clear();
    for (const GeoPoint p : places) append(laid, p.longitude_deg, p.latitude_deg);
    return laid;
  }
  if (longest > 0.0)
    doubt = fmt::format(
        "an edge over {:.1f} degrees of longitude is taken the shortest way, across the "
        "antimeridian; put more vertices on it if it goes the other way",
        longest);
  if (turn == 0.0) return laid;
  if (std::abs(turn) == 360.0 && (south >= 0.0 || north <= 0.0))
    return by_way_of_pole(places, turn, south >= 0.0 ? 90.0 : -90.0);
  fault =
      "a ring goes around the Earth and does not say which pole it holds; expected a ring by way "
      "of the pole, along the antimeridian";
  return {};
}

void bring_near(const OGREnvelope& box, OGRLinearRing& ring) {
  OGREnvelope own;
  ring.getEnvelope(&own);
  const double turns = std::round((box.MinX + box.MaxX - own.MinX - own.MaxX) / 720.0);
  if (turns == 0.0) return;
  for (int i = 0; i < ring.getNumPoints(); ++i)
    ring.setPoint(i, ring.getX(i) + 360.0 * turns, ring.getY(i));
}

double longitude_of(double x) {
  if (x >= -180.0 && x < 180.0) return x;
  constexpr double kDecimals = 1e12;
  return wrapped_longitude(std::round(wrapped_longitude(x) * kDecimals) / kDecimals);
}

}  // namespace skerry::echo
