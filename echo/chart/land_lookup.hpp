// Is a place on land: for many places of a small part of a chart.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "echo/chart/coast_chart.hpp"

namespace skerry::echo {

// winding_number() (land_mask.hpp) of the same rings, with the edges sorted by longitude.  Requires
// that the rings outlive it.  Thread: immutable.
class LandLookup {
 public:
  // For places from `west_deg` to `width_deg` east of it, and no further south than `south_deg`.
  LandLookup(const std::vector<CoastRing>& rings, double west_deg, double width_deg,
             double south_deg);

  bool is_land(GeoPoint place) const { return winding_number(place) > 0; }
  int winding_number(GeoPoint place) const;
  // The edges that the question takes a look at: its cost, 2 ns each.
  std::size_t cost(GeoPoint place) const { return column(place).size() + wide_.size(); }

 private:
  using Edge = std::pair<std::uint32_t, std::uint32_t>;  // of a ring: from that vertex on
  static constexpr std::size_t kColumns = 1024;
  static constexpr std::size_t kWide = 64;  // columns: an edge wider is in none of them

  double column_of(double longitude_deg) const;
  const std::vector<Edge>& column(GeoPoint place) const;
  int turn_of(const Edge& edge, GeoPoint place) const;

  const std::vector<CoastRing>& rings_;
  double west_deg_, width_deg_;
  std::array<std::vector<Edge>, kColumns> columns_;
  std::vector<Edge> wide_;
  int around_pole_ = 0;  // what rings around a pole add everywhere
};

}  // namespace skerry::echo
