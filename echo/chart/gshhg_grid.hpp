// GshhgGrid: the bins a GSHHG file cuts the Earth into, and the places on their grid.
#pragma once

#include <cstdint>
#include <vector>

#include "protocol/quantity/geo_point.hpp"

namespace skerry::echo {

// A place in a bin: 1/65535 of the bin's side east and north of its south-west corner; 0 and 65535
// are the bin's borders, so a place on a border has coordinates in both bins.
struct BinPoint {
  std::uint16_t x = 0;
  std::uint16_t y = 0;
  friend constexpr bool operator==(const BinPoint&, const BinPoint&) = default;
};

// Bins [first, first + count) of one row, west to east.
struct BinRun {
  int first = 0;
  int count = 0;
};

// Bin b is column b mod columns() eastward from Greenwich, row b / columns() southward from the
// North Pole; all bins are bin_minutes() by bin_minutes() of arc.
class GshhgGrid {
 public:
  static constexpr std::int64_t kUnits = 65535;  // grid units in the side of a bin

  // `bin_minutes` divides 180 degrees.
  explicit GshhgGrid(int bin_minutes);

  int bin_minutes() const { return minutes_; }
  int columns() const { return 360 * 60 / minutes_; }
  int rows() const { return 180 * 60 / minutes_; }
  int bin_count() const { return columns() * rows(); }

  double south_of(int bin) const;  // degrees
  double north_of(int bin) const;
  double west_of(int bin) const;  // degrees in [-180, 180)

  // Computed from the integer coordinate on the globe with one rounding each for latitude and
  // longitude: a place shared by neighbouring bins is bit-identical in both.
  GeoPoint position(int bin, BinPoint point) const;

  // The same integers as one number, `north of the South Pole << 32 | east of Greenwich`; the poles
  // have one identity each.  The same for every bin and window of a file, another in a file of
  // another bin size.
  std::uint64_t identity(int bin, BinPoint point) const;

  // At most the geodesic distance from `from` to the nearest place of the bin, at least 0.988 of
  // it.
  double nearest_metres(GeoPoint from, int bin) const;

  // Every bin that has a place within `radius_m` of `centre`, and perhaps a few up to 1.2 %
  // farther, north to south.  A circle that holds a pole gets all bins of the polar row.
  std::vector<BinRun> bins_within(GeoPoint centre, double radius_m) const;

 private:
  struct GlobePoint {
    std::int64_t east, north;  // grid units
  };
  GlobePoint on_globe(int bin, BinPoint point) const;

  int minutes_;
};

}  // namespace skerry::echo
