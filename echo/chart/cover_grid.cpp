#include "echo/chart/cover_grid.hpp"

#include <algorithm>
#include <cmath>

#include "echo/kernel/exact_math.hpp"

namespace skerry::echo {
namespace {

constexpr double kWindowMetresPerDegree = 110'500.0;  // of latitude, where it is about least

// Degrees east of `west`, 0 .. 360.
double turn_east(double west, double longitude) {
  return wrapped_longitude(longitude - west - 180.0) + 180.0;
}

struct WindowBox {
  double south = 90.0, north = -90.0;
  double west = 0.0, east = 0.0;  // degrees east of the window's west, 0 .. its width
};

// The part of the window that the areas' boxes cover.
WindowBox covered_part(const CoastChart& chart, const WindowBox& window, double west_deg) {
  WindowBox part{90.0, -90.0, window.east, 0.0};
  for (const CoverArea& area : chart.covers) {
    if (area.cover == LandCover::none || area.rings.empty()) continue;
    double x = 0.0, least = 0.0, most = 0.0, south = 90.0, north = -90.0;
    const std::vector<GeoPoint>& ring = area.rings.front();
    if (ring.empty()) continue;
    GeoPoint before = ring.front();
    for (const GeoPoint p : ring) {
      x += wrapped_longitude(p.longitude_deg - before.longitude_deg);
      least = std::min(least, x);
      most = std::max(most, x);
      south = std::min(south, p.latitude_deg);
      north = std::max(north, p.latitude_deg);
      before = p;
    }
    if (north < window.south || south > window.north) continue;
    const double start = turn_east(west_deg, ring.front().longitude_deg);
    bool met = false;
    for (const double shift : {-360.0, 0.0, 360.0}) {
      const double from = start + least + shift, to = start + most + shift;
      if (to < 0.0 || from > window.east) continue;
      met = true;
      part.west = std::min(part.west, std::max(0.0, from));
      part.east = std::max(part.east, std::min(window.east, to));
    }
    if (!met) continue;
    part.south = std::min(part.south, std::max(window.south, south));
    part.north = std::max(part.north, std::min(window.north, north));
  }
  return part;
}

}  // namespace

double crossings_of(const std::vector<GeoPoint>& ring) {
  double way = 0.0;
  for (std::size_t i = 0, n = ring.size(); i < n; ++i)
    way += std::abs(ring[i + 1 == n ? 0 : i + 1].latitude_deg - ring[i].latitude_deg);
  return way / CoverGrid::kFinestStep;
}

std::shared_ptr<const CoverGrid> CoverGrid::of(const CoastChart& chart) {
  if (chart.covers.empty()) return nullptr;
  const double reach = chart.radius_m / kWindowMetresPerDegree;
  WindowBox window;
  window.south = std::max(-90.0, chart.centre.latitude_deg - reach);
  window.north = std::min(90.0, chart.centre.latitude_deg + reach);
  const double farthest = std::max(std::abs(window.south), std::abs(window.north));
  const double shrink = sin_cos_degrees(farthest).cos;
  const double aside = shrink > reach / 180.0 ? std::min(180.0, 1.01 * reach / shrink) : 180.0;
  const double west = wrapped_longitude(chart.centre.longitude_deg - aside);
  window.west = 0.0;
  window.east = 2.0 * aside;
  const WindowBox part = covered_part(chart, window, west);
  if (part.north < part.south || part.east < part.west) return nullptr;

  auto grid = std::make_shared<CoverGrid>();
  const double squeeze = sin_cos_degrees(chart.centre.latitude_deg).cos;
  double wide = 1.0;
  while (2.0 * wide * squeeze <= 1.0 && wide < 64.0) wide *= 2.0;
  for (double step = kFinestStep;; step *= 2.0) {
    grid->step_lat_ = step;
    grid->step_lon_ = step * wide;
    const double row = std::floor(part.south / grid->step_lat_);
    const double column = std::floor((west + part.west) / grid->step_lon_);
    grid->south_deg_ = row * grid->step_lat_;
    grid->west_deg_ = column * grid->step_lon_;
    grid->rows_ = static_cast<std::int64_t>(std::ceil(part.north / grid->step_lat_) - row) + 1;
    grid->columns_ =
        static_cast<std::int64_t>(std::ceil((west + part.east) / grid->step_lon_) - column) + 1;
    if (grid->rows_ * grid->columns_ <= static_cast<std::int64_t>(kMostCells)) break;
  }
  grid->cells_.assign(static_cast<std::size_t>(grid->rows_ * grid->columns_), LandCover::none);
  std::size_t painted = 0;
  for (const CoverArea& area : chart.covers) grid->paint(area, painted);
  return grid;
}

bool CoverGrid::cross(const std::vector<GeoPoint>& ring, double shift_deg,
                      std::vector<std::uint64_t>& crossings) const {
  const double start = (turn_east(west_deg_, ring.front().longitude_deg) + shift_deg) / step_lon_;
  double x = start, west = start, east = start;
  for (std::size_t i = 0; i + 1 < ring.size(); ++i) {
    x += wrapped_longitude(ring[i + 1].longitude_deg - ring[i].longitude_deg) / step_lon_;
    west = std::min(west, x);
    east = std::max(east, x);
  }
  if (east < 0.0 || west > static_cast<double>(columns_)) return true;
  x = start;
  const double rows = static_cast<double>(rows_), columns = static_cast<double>(columns_);
  for (std::size_t i = 0, n = ring.size(); i < n; ++i) {
    const GeoPoint a = ring[i], b = ring[i + 1 == n ? 0 : i + 1];
    const double from_x = x;
    x += wrapped_longitude(b.longitude_deg - a.longitude_deg) / step_lon_;
    const double from_y = (a.latitude_deg - south_deg_) / step_lat_;
    const double to_y = (b.latitude_deg - south_deg_) / step_lat_;
    const double first = std::max(0.0, std::ceil(std::min(from_y, to_y) - 0.5));
    const double last = std::min(rows, std::ceil(std::max(from_y, to_y) - 0.5));
    if (!(first < last)) continue;
    if (crossings.size() + static_cast<std::size_t>(last - first) > kMostCrossings) return false;
    const double slope = (x - from_x) / (to_y - from_y);
    for (double row = first; row < last; row += 1.0) {
      const double at = from_x + (row + 0.5 - from_y) * slope;
      const double column = std::clamp(std::ceil(at - 0.5), 0.0, columns);
      crossings.push_back(static_cast<std::uint64_t>(row) << 32 |
                          static_cast<std::uint64_t>(column));
    }
  }
  return true;
}

void CoverGrid::paint(const CoverArea& area, std::size_t& painted) {
  std::vector<std::uint64_t> crossings;
  for (const std::vector<GeoPoint>& ring : area.rings) {
    if (ring.size() < 3) continue;
    // A ring may begin on the other side of the grid's western limit.
    for (const double shift : {-360.0, 0.0, 360.0}) {
      if (!cross(ring, shift, crossings)) return;
    }
  }
  std::sort(crossings.begin(), crossings.end());
  for (std::size_t i = 0; i + 1 < crossings.size();) {
    const std::uint64_t row = crossings[i] >> 32;
    if (crossings[i + 1] >> 32 != row) {
      ++i;  // a ring around a pole, or one that is not closed
      continue;
    }
    const auto from = static_cast<std::size_t>(crossings[i] & 0xFFFFFFFFu);
    const auto to = static_cast<std::size_t>(crossings[i + 1] & 0xFFFFFFFFu);
    i += 2;
    painted += to - from;
    if (painted > kMostPainted) return;
    const std::size_t start = static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_);
    std::fill(cells_.data() + start + from, cells_.data() + start + to, area.cover);
  }
}

LandCover CoverGrid::at(GeoPoint place) const {
  LandCover cover = LandCover::none;
  along(place, {}, {&cover, 1});
  return cover;
}

bool CoverGrid::along(GeoPoint from, GeoPoint step, std::span<LandCover> out) const {
  const double v0 = (from.latitude_deg - south_deg_) / step_lat_;
  const double v1 = step.latitude_deg / step_lat_, u1 = step.longitude_deg / step_lon_;
  // The lowest turn of the longitude that is not west of the grid for all of the way.
  const double way = step.longitude_deg * static_cast<double>(out.size());
  const double westmost = from.longitude_deg + std::min(0.0, way);
  const double eastmost = std::abs(way) / step_lon_;
  double least = (wrapped_longitude(westmost - west_deg_ - 180.0) + 180.0) / step_lon_;
  const double round = 360.0 / step_lon_;
  if (least > static_cast<double>(columns_) && least + eastmost > round) least -= round;
  const double u0 = way < 0.0 ? least - way / step_lon_ : least;
  const auto rows = static_cast<double>(rows_), columns = static_cast<double>(columns_);
  bool any = false;
  for (std::size_t k = 0; k < out.size(); ++k) {
    const double v = v0 + v1 * static_cast<double>(k), u = u0 + u1 * static_cast<double>(k);
    LandCover cover = LandCover::none;
    if (v >= 0.0 && u >= 0.0 && v < rows && u < columns)
      cover = cells_[static_cast<std::size_t>(static_cast<std::int64_t>(v) * columns_ +
                                              static_cast<std::int64_t>(u))];
    any = any || cover != LandCover::none;
    out[k] = cover;
  }
  return any;
}

}  // namespace skerry::echo
