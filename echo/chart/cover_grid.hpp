// CoverGrid: the land's cover around a place, as a raster.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "echo/chart/coast_chart.hpp"
#include "protocol/quantity/geo_point.hpp"

namespace skerry::echo {

// Cells of latitude and longitude, a byte each, painted once per chart window; a cell has the cover
// of its middle.  Its lattice is the Earth's: neighbouring windows of one cell size have the same
// cells.  Plain arithmetic: the same bits on every machine.
// Memory: kMostCells bytes at most; where the window needs more, cells are twice, four times ... as
// large.  Error: the limits of an area are off by half a cell: 5.6 m, 11 m ...
// Thread: immutable.
class CoverGrid {
 public:
  static constexpr double kFinestStep = 1e-4;  // degrees of latitude: 11.1 m
  static constexpr std::size_t kMostCells = 16u << 20;
  // Bounds on the work of painting, far above any real chart: areas beyond them stay unpainted.
  static constexpr std::size_t kMostCrossings = 4'000'000;  // of one area's outline with rows
  static constexpr std::size_t kMostPainted = 4'000'000'000;

  // Of chart.covers within chart.radius_m; null where there are none.
  static std::shared_ptr<const CoverGrid> of(const CoastChart& chart);

  LandCover at(GeoPoint place) const;
  // Of out.size() places from `from`, each `step` (degrees) further; the longitude need not be
  // wrapped, and must not go round the Earth.  Returns whether any is covered.
  bool along(GeoPoint from, GeoPoint step, std::span<LandCover> out) const;

  std::int64_t rows() const { return rows_; }
  std::int64_t columns() const { return columns_; }
  double step_lat_deg() const { return step_lat_; }
  double step_lon_deg() const { return step_lon_; }

 private:
  void paint(const CoverArea& area, std::size_t& painted);
  // Crossings of the ring with the middles of rows, shifted by so many degrees.
  bool cross(const std::vector<GeoPoint>& ring, double shift_deg,
             std::vector<std::uint64_t>& crossings) const;

  double south_deg_ = 0.0, west_deg_ = 0.0;
  double step_lat_ = kFinestStep, step_lon_ = kFinestStep;
  std::int64_t rows_ = 0, columns_ = 0;
  std::vector<LandCover> cells_;
};

// How many rows of the finest grid the ring's outline crosses: what painting it costs.
double crossings_of(const std::vector<GeoPoint>& ring);

}  // namespace skerry::echo
